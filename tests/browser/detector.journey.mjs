// A mission with a trained detector, dropped on the demo: what its detector saw, stage by stage.
import { readFileSync } from "node:fs";
import { drop } from "./drop.mjs";

export const name = "what a trained detector saw is shown stage by stage, with its features, its score and the edges of its patch";
export const long = true;
export const tags = ["training"];

const mission = new URL("./trained.geojson", import.meta.url);

export async function run(page, tools) {
  await tools.waitReady();
  const { run_generation: before } = await tools.openRun();

  // Without a detector the view says what to do.
  await page.keyboard.press("z");
  await tools.waitFor((s) => s.side_tab === "detector", "the tab of the detector");
  await tools.find(null, /No detector was trained for/);

  await drop(page, [{ name: "trained.geojson", buffer: readFileSync(mission) }]);
  // It looks for its landmark in the first seconds; the rest of the flight need not be flown.
  await tools.waitFor((s) => s.run_generation > before && s.run_steps > 60, "the run by the trained detector", 150_000);
  const trained = (await tools.state()).landmarks.find((l) => l.trained);
  tools.check(trained, "no landmark of the mission has a detector");

  // On through the flight to a picture in which that landmark is looked for.
  await page.keyboard.press("Home");
  let shown = null;
  for (let tried = 0; tried < 120 && !shown; tried += 1) {
    await page.keyboard.press("ArrowRight");
    await tools.drawn();
    const { detector } = await tools.state();
    if (detector.wanted?.[1] === trained.id) {
      shown = await tools.waitFor((s) => s.detector.shown?.landmark === trained.id && s.detector.stages > 0, "what its detector saw, stage by stage", 60_000);
    }
  }
  tools.check(shown, `${trained.name} is looked for nowhere`);
  const { detector } = shown;
  tools.check(!detector.shown.trouble, detector.shown.trouble);
  tools.check(detector.stages > 3 && detector.passed === detector.stages, `${detector.passed} of ${detector.stages} stages`);
  const { left, mean_votes: mean, all_votes: all } = detector.shown;
  tools.check(left.every((count, i) => i === 0 || count <= left[i - 1]) && left.at(-1) < 0.05 * left[0], `left after each stage: ${left}`);
  tools.check(mean > 1 && mean < 0.5 * all, `${mean} of ${all} votes for a window`);
  await tools.find(null, /Each window.* is tested by .* on average; all/);
  await tools.screenshot("detector");

  // One stage after the other, by the keyboard; then all of them by themselves.
  await page.keyboard.press(",");
  await tools.waitFor((s) => s.detector.passed === s.detector.stages - 1, "one stage less");
  for (let stage = detector.stages - 1; stage > 1; stage -= 1) await page.keyboard.press(",");
  await tools.waitFor((s) => s.detector.passed === 1, "the first stage alone");
  await tools.find(null, /^After stage 1 of/);
  await tools.screenshot("detector-first-stage");
  await page.keyboard.press("Shift+Z");
  await tools.waitFor((s) => s.detector.passed >= 3, "stages to pass by themselves", 30_000);
  await page.keyboard.press("Shift+Z");

  // The view below: features and score.
  const picture = await tools.find(null, /^Searched ground/);
  await page.mouse.move(tools.middle(picture).x, tools.middle(picture).y);
  await page.mouse.wheel(0, 420);
  await page.waitForTimeout(600);
  await tools.screenshot("detector-below");
  await page.mouse.wheel(0, 2000);
  await page.waitForTimeout(600);
  await tools.screenshot("detector-score");
}
