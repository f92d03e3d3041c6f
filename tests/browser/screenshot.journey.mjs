// A picture of the view: a PNG file of as many pixels as the canvas has, with the map in it. Then a film of the replay.
export const name = "a picture of the view is saved as it is on the screen, and the replay is filmed";
export const painted = true;

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

  // Filmed for two seconds, then the replay is stopped.
  const film = page.waitForEvent("download", { timeout: 60_000 });
  film.catch(() => {}); // what went wrong before is what is told
  await page.keyboard.press("Control+k");
  await tools.waitFor((s) => s.dialogs.palette, "the palette");
  await page.keyboard.type("movie");
  await page.keyboard.press("Enter");
  const begun = await tools.waitFor((s) => s.playing && s.time < 1, "the replay from its beginning");
  await tools.waitFor((s) => s.time > begun.time + 3, "three seconds of the flight");
  await page.keyboard.press("Space");
  const made = await film;
  tools.check(/-0-00-0-.*\.webm$/.test(made.suggestedFilename()), `the film is called ${made.suggestedFilename()}`);
  const chunks = [];
  for await (const part of await made.createReadStream()) chunks.push(part);
  const bytes = Buffer.concat(chunks);
  const shows = await page.evaluate(async (webm) => {
    const bytes = Uint8Array.from(atob(webm), (letter) => letter.charCodeAt(0));
    const video = Object.assign(document.createElement("video"), { muted: true, src: URL.createObjectURL(new Blob([bytes])) });
    const fails = (failed) => { video.onerror = () => failed(new Error("it cannot be played")); setTimeout(() => failed(new Error("it does not load")), 15_000); };
    await new Promise((done, failed) => { video.onloadeddata = done; fails(failed); });
    video.playbackRate = 4; // such films do not say how long they are
    const over = new Promise((done) => { video.onended = done; setTimeout(done, 15_000); });
    await video.play();
    await over;
    const app = document.getElementById("app");
    return { size: [video.videoWidth, video.videoHeight], canvas: [app.width, app.height], seconds: video.currentTime };
  }, bytes.toString("base64"));
  tools.say(`a film of ${shows.size.join(" x ")} pixels, ${shows.seconds.toFixed(1)} s, ${(bytes.length / 1000).toFixed(0)} kB`);
  tools.check(shows.size.every((side, i) => Math.abs(side - shows.canvas[i]) < 2), `${shows.size} pixels of ${shows.canvas}`);
  tools.check(shows.seconds > 0.8, "it is too short");
}
