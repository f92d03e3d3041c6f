// Satellite navigation is cut out of a real flight by dragging over the timeline.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "GPS is cut out of a real flight where the mouse drags, and the error grows within its radius";
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const folder = join(repository, "../shared/data/inertialnav_x8");

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  const before = await tools.openRun();
  await page.keyboard.press("Shift+G");
  const { timeline: line } = await tools.waitFor((s) => s.side_tab === "outage", "the cut's panel");
  await page.mouse.click(line[0] + 0.4 * (line[2] - line[0]), (line[1] + line[3]) / 2);
  await tools.click(await tools.find("Button", "Cut 30 s from here"));
  const demo = await tools.waitFor((s) => s.outage?.results.length >= 4, "the ways through the demo's cut", 60_000);
  const seen = demo.outage.results.find((way) => way.label === "Airspeed, wind, landmarks");
  tools.check(demo.outage.results.every((way) => !/gyros/.test(way.label)), "there are no gyros in the demo");
  tools.check(seen && seen.end_error < 60, `landmarks: ${JSON.stringify(demo.outage.results)}`);
  await page.waitForTimeout(500);
  await tools.screenshot("cut-landmarks");
  const kinds = ["ATT", "GPS", "IMU", "NTUN", "MAG"];
  await page.setInputFiles("#files", kinds.map((kind) => join(folder, `TestLog2_${kind}.csv`)));
  await tools.waitFor((s) => s.columns, "the question what the columns mean", 60_000);
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => s.flight !== before.flight && s.run_complete, "the flight", 150_000);
  await page.keyboard.press("Shift+G");
  await tools.waitFor((s) => s.outage === null, "the other flight's cut gone");
  const { timeline: [left, top, right, bottom], span } = await tools.waitFor((s) => s.side_tab === "outage", "the cut's panel");
  const at = (share) => ({ x: left + share * (right - left), y: (top + bottom) / 2 });
  await page.keyboard.down("Shift");
  await tools.drag(at(0.55), at(0.62));
  await page.keyboard.up("Shift");
  const { selected } = await tools.waitFor((s) => s.selected, "a selected stretch");
  tools.check(selected[0] > span[0] && selected[1] < span[1], `${selected}`);
  await tools.click(await tools.find("Button", /^Cut GPS from/));
  const cut = await tools.waitFor((s) => s.outage?.results.length >= 3, "the ways through the cut", 120_000);
  for (const way of cut.outage.results) {
    tools.say(`${way.label}: ${way.end_error?.toFixed(1)} m at the end, 95 % radius ${way.radius?.toFixed(1)} m`);
  }
  const { winds } = cut.outage;
  tools.check(winds?.from_least_squares < 0.8, `the winds are ${winds?.from_least_squares} m/s apart`);
  const [alone] = cut.outage.results;
  tools.check(alone.end_error < 3 * alone.radius, "the error is far outside its radius");
  await page.waitForTimeout(800);
  await tools.screenshot("cut");
  const { width, height } = page.viewportSize();
  await page.mouse.move(width - 150, height - 250);
  await page.mouse.wheel(0, 4000);
  await page.waitForTimeout(800);
  await tools.screenshot("cut-wind");
}
