// A link to the view, and a mission file: both lead back to what was there.
export const name = "a copied link shows the same view of the demo, and a saved mission opens as it was";

async function command(page, tools, words) {
  await page.keyboard.press("Control+k");
  await tools.waitFor((s) => s.dialogs.palette, "the palette");
  await page.keyboard.type(words);
  await page.keyboard.press("Enter");
}

/** Waits until the map has been at rest for a second: a plan that opens is put on the map later. */
async function settled(tools) {
  let last = null;
  let since = 0;
  return tools.waitFor(({ map }) => {
    const now = JSON.stringify([map.center, map.metres_per_point]);
    if (now !== last) since = Date.now();
    last = now;
    return Date.now() - since > 1000;
  }, "a map at rest");
}

/** Where the clipboard refuses it, the link is shown to be copied by hand, and not called copied. */
async function refusedCopy(page, tools) {
  await page.evaluate(() => {
    window.writeText = navigator.clipboard.writeText;
    navigator.clipboard.writeText = () => Promise.reject(new DOMException("not allowed", "NotAllowedError"));
  });
  const asked = page.waitForEvent("dialog");
  await command(page, tools, "copy a link to this view");
  const dialog = await asked;
  tools.say(`refused: ${dialog.message()}`);
  tools.check(dialog.defaultValue().startsWith(`${tools.address}#scenario=`), `the link is ${dialog.defaultValue()}`);
  await dialog.dismiss();
  await tools.drawn();
  tools.check(!(await tools.state()).toasts.some((t) => t.title === "Link copied"), "it is called copied");
  tools.check(new URL(page.url()).hash === "", "the address carries the link, which a reload would follow");
  await page.evaluate(() => { navigator.clipboard.writeText = window.writeText; });
}

export async function run(page, tools) {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 40, "the demo", 150_000);
  await page.keyboard.press("Shift+p");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.routes.length > 0, "the plan");
  await page.keyboard.press("Equal");
  await settled(tools);
  await refusedCopy(page, tools);
  await command(page, tools, "copy a link to this view");
  await tools.waitFor((s) => s.toasts.some((t) => t.title === "Link copied"), "the word that it is copied");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  tools.say(`${link}`);
  const seen = await tools.state();

  const download = page.waitForEvent("download");
  await page.keyboard.press("Control+s");
  const saved = await download;
  tools.check(saved.suggestedFilename().endsWith(".pilotage.zip"), `the file is called ${saved.suggestedFilename()}`);
  const parts = [];
  for await (const part of await saved.createReadStream()) parts.push(part);
  const bytes = Buffer.concat(parts);
  tools.check(bytes.subarray(0, 2).toString() === "PK", "it is no zip");

  await page.goto("about:blank");
  await page.goto(link);
  await tools.waitReady();
  const there = await tools.waitFor((s) => s.run_steps > 0 && s.workspace === "Plan", "the view of the link", 150_000)
    .then(() => settled(tools));
  for (const i of [0, 1]) {
    tools.check(Math.abs(there.map.center[i] - seen.map.center[i]) < 0.1, `the map is at ${there.map.center}`);
  }
  tools.check(Math.abs(there.map.metres_per_point - seen.map.metres_per_point) < 1e-3, "the scale is another");

  await page.setInputFiles("#files", [{ name: saved.suggestedFilename(), mimeType: "application/zip", buffer: bytes }]);
  const opened = (s) => s.toasts.some((t) => /Opened .*a mission/.test(t.title));
  const back = await tools.waitFor(opened, "the saved mission", 60_000);
  tools.check(back.landmarks.length === seen.landmarks.length, "landmarks were lost");
  tools.check(back.plan.routes.length === seen.plan.routes.length, "routes were lost");

  // A link that was cut in the middle of an escape is no link of ours, and keeps nothing from starting.
  for (const [path, there] of [["#50%", "html[data-ready='1']"], ["learn.html#landmark-corrects/%", "#lesson-title"]]) {
    await page.goto("about:blank");
    await page.goto(tools.address + path);
    await page.waitForSelector(there, { state: "attached", timeout: 120_000 });
  }
}
