// A picture of the view: a PNG file of as many pixels as the canvas has, with the map in it.
export const name = "a picture of the view is saved as it is on the screen";

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 40 && s.map.whole, "the demo", 150_000);
  await page.keyboard.press("Control+k");
  await tools.waitFor((s) => s.dialogs.palette, "the palette");
  await page.keyboard.type("screenshot");
  const download = page.waitForEvent("download");
  await page.keyboard.press("Enter");
  const saved = await download;
  tools.check(/-\d+-\d\d-\d\.png$/.test(saved.suggestedFilename()), `the file is called ${saved.suggestedFilename()}`);
  const parts = [];
  for await (const part of await saved.createReadStream()) parts.push(part);
  const png = Buffer.concat(parts).toString("base64");
  const seen = await page.evaluate(async (png) => {
    const bytes = Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const { width, height } = picture;
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const colours = new Set();
    let clear = 0;
    for (let i = 0; i < data.length; i += 4) {
      colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      clear += data[i + 3] < 255;
    }
    const app = document.getElementById("app");
    return { size: [width, height], canvas: [app.width, app.height], colours: colours.size, clear };
  }, png);
  tools.check(`${seen.size}` === `${seen.canvas}`, `${seen.size} pixels of ${seen.canvas}`);
  tools.check(seen.colours > 1000, `it has ${seen.colours} colours`);
  tools.check(seen.clear === 0, `${seen.clear} pixels shine through`);
}
