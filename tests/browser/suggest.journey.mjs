// Landmarks proposed for the demo's route: asked for, stopped, asked again, added, taken back; then how
// well one of them is found, from which heights, with which tilts.
export const name = "landmarks are suggested with reasons, added and taken back in one step, and one is looked at from other heights";
export const tags = ["plan"];

const COUNT = 3;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  const first = await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction, "the prediction", 90_000);
  const before = first.landmarks.length;
  await tools.showLandmarks();

  /** A button, once it does not move any more. */
  const resting = async (label) => {
    for (let before = null; ;) {
      const node = await tools.find("Button", label);
      if (String(node.rect) === String(before)) return node;
      before = node.rect;
      await page.waitForTimeout(250);
    }
  };

  // A search that is stopped leaves nothing.
  const suggest = () => tools.find("Button", /^Suggest \d+ landmarks for this route$/);
  await tools.click(await suggest());
  await tools.waitFor((s) => s.plan.suggested.progress > 0, "the search to begin", 60_000);
  await tools.screenshot("suggest-under-way");
  await tools.click(await tools.find("Button", "Stop suggesting"));
  await tools.waitFor((s) => s.plan.suggested.progress == null, "the search to end");
  tools.check((await tools.state()).plan.suggested.list.length === 0, "a stopped search proposes something");

  await tools.click(await suggest());
  const begun = Date.now();
  const found = await tools.waitFor((s) => s.plan.suggested.list.length > 0 || s.plan.suggested.trouble, "suggestions", 120_000);
  const { list, trouble } = found.plan.suggested;
  tools.check(list.length >= COUNT, `${list.length} were suggested: ${trouble}`);
  tools.check(list.every((s) => s.reason.length > 20 && s.probability > 0 && s.probability <= 1), "a suggestion without a reason");
  tools.say(`${list.length} after ${((Date.now() - begun) / 1e3).toFixed(1)} s; the first: ${list[0].reason}`);
  await page.mouse.move(...Object.values(tools.middle(await tools.find("Button", "Add suggestion 1"))));
  await page.waitForTimeout(300);
  await tools.screenshot("suggest");

  await tools.click(await tools.find("Button", "Add all"));
  await tools.waitFor((s) => s.landmarks.length === before + list.length, "all of them added");
  await tools.screenshot("suggest-added");
  await page.keyboard.press("Control+z");
  const undone = await tools.waitFor((s) => s.landmarks.length === before, "all of them taken back");
  tools.check(undone.plan.suggested.list.every((s) => !s.added), "one is still called added");

  // One alone, looked at from other heights while it is measured.
  await tools.click(await tools.find("Button", "Add suggestion 1"));
  await tools.waitFor((s) => s.landmarks.length === before + 1 && s.selection === s.landmarks.at(-1).id, "one of them added and selected");
  await tools.click(await tools.find("Button", "Dismiss"));
  while ((await tools.findAll("Button", "Dismiss")).length > 0) await page.waitForTimeout(100);
  // While this waited, the workers may have tested it by themselves.
  await tools.click(await resting(/^Test (how well it is found|again)$/));
  await tools.find("ProgressIndicator", "How far the measurement is");
  const measuring = Date.now();
  await tools.waitFor((s) => s.plan.measured.some((m) => m.id === s.landmarks.at(-1).id), "it measured", 120_000);
  tools.say(`measured after ${((Date.now() - measuring) / 1e3).toFixed(1)} s`);
  await tools.screenshot("suggest-measured");
  await tools.click(await resting("Best altitude"));
  const panel = (await resting("Best altitude")).rect;
  await tools.waitFor((s) => s.plan.envelopes.some((e) => e.looks >= 60), "looks from every height", 120_000);
  await tools.find("Image", /^Detection envelope: 5 heights by 4 tilts, [1-9]\d* looks$/);
  await page.mouse.move((panel[0] + panel[2]) / 2, 620);
  for (const part of ["strips", "envelope"]) {
    await page.mouse.wheel(0, 400);
    await page.waitForTimeout(700);
    await tools.screenshot(`suggest-${part}`);
  }
}
