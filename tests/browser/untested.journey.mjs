// Landmarks that nobody asked to have tested: the demo's, which come tested, then boxes that are drawn on fields.
export const name = "the demo's landmarks come tested, and boxes drawn on fields are tested by themselves and called weak";
export const long = true;
export const tags = ["plan"];
export const ahead = true;

/** Boxes on the fields around the demo's village: metres north and east of their middles. */
const FIELDS = [[250, -360], [280, -225], [120, 330], [223, 407], [-134, -458], [17, 520]];
const SIDE = 34; // metres

const fine = (s) => s.plan.prediction?.fine;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  const demo = await tools.waitFor((s) => s.workspace === "Plan" && fine(s), "the prediction", 90_000);
  tools.check(demo.plan.measured.length === demo.landmarks.length, `${demo.plan.measured.length} of ${demo.landmarks.length} landmarks of the demo come tested`);
  await tools.showLandmarks();
  await page.waitForTimeout(300);
  await tools.screenshot("tested");

  const begun = Date.now();
  for (const [north, east] of FIELDS) {
    const { map, landmarks } = await tools.state();
    const [left, top, right, bottom] = map.rect;
    const at = (n, e) => ({
      x: (left + right) / 2 + (e - map.center[1]) / map.metres_per_point,
      y: (top + bottom) / 2 - (n - map.center[0]) / map.metres_per_point,
    });
    await page.keyboard.press("n");
    await tools.drawn();
    await tools.drag(at(north + SIDE / 2, east - SIDE / 2), at(north - SIDE / 2, east + SIDE / 2));
    await tools.waitFor((s) => s.landmarks.length === landmarks.length + 1, "another landmark");
    await page.keyboard.press("Escape");
    await tools.drawn();
  }
  const drawn = await tools.state();
  await tools.screenshot("untested");
  tools.check(drawn.plan.measured.length < drawn.landmarks.length, "all were tested at once");
  const stated = await tools.waitFor((s) => s.plan.untested[1] > 0, "boxes at random", 120_000);
  tools.say(`${stated.plan.untested[1]} boxes at random: ${(100 * stated.plan.untested[0]).toFixed(0)} %`);
  const tested = await tools.waitFor((s) => s.plan.measured.length === s.landmarks.length && fine(s), "all of them tested", 300_000);
  const boxes = tested.plan.measured.slice(-FIELDS.length);
  tools.say(`${FIELDS.length} boxes on fields tested after ${((Date.now() - begun) / 1000).toFixed(1)} s: found in ${boxes.map((m) => (100 * m.probability).toFixed(0)).join(", ")} % of pictures`);
  await page.waitForTimeout(300);
  await tools.screenshot("tested-fields");
  tools.check(boxes.every((m) => m.verdict === "weak"), `called ${boxes.map((m) => m.verdict).join(", ")}`);
}
