// A detector trained for a landmark: the table of stages grows, a reload in the middle, resumed to the end,
// chosen, flown with; then all are trained side by side, paused and cancelled.
export const name = "a detector is trained in the page, goes on after a reload, and the flight flies with it";
export const long = true;
export const tags = ["training"];

const idle = (page) => page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
const of = (s, landmark) => s.plan.trainings.find((t) => t.name === landmark);

export async function run(page, tools) {
  const landmark = "dairy barn";
  await tools.waitReady();
  const first = await tools.openRun();
  await page.keyboard.press("Space");

  /** Shows the landmark in the plan. */
  const show = async () => {
    await page.keyboard.press("Shift+P");
    await tools.waitFor((s) => s.workspace === "Plan" && s.landmarks.length === first.landmarks.length, "the plan", 60_000);
    await tools.waitFor((s) => s.plan.prediction?.fine, "the prediction, after which nothing moves", 90_000);
    await tools.showLandmarks();
    await tools.click(await tools.find(null, new RegExp(`^${landmark}: `)));
    await tools.waitFor((s) => s.selection != null, "the landmark selected");
    await page.waitForTimeout(700);
  };
  await show();

  // Few photos, so that it does not take long.
  await tools.click(await tools.find("SpinButton", "Photos to learn from"));
  await page.keyboard.press("Control+a");
  await page.keyboard.type("20");
  await page.keyboard.press("Enter");
  await tools.drawn();
  await tools.click(await tools.find("Button", "Train detector"));
  const begun = await tools.waitFor((s) => of(s, landmark)?.state === "Working", "the training to begin");
  tools.check(of(begun, landmark).photos === 20, `${of(begun, landmark).photos} photos`);
  await tools.waitFor((s) => of(s, landmark).phase === "Photos", "photos to be taken", 60_000);
  await tools.screenshot("training-photos");

  // A reload in the middle.
  const grown = await tools.waitFor((s) => of(s, landmark).stages >= 1, "a whole stage", 120_000);
  tools.check(of(grown, landmark).state === "Working", "it was over before the reload");
  await idle(page);
  await tools.screenshot("training-stages");
  await page.reload();
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo after the reload", 150_000);
  await show();
  const left = of(await tools.waitFor((s) => of(s, landmark), "the training that was left"), landmark);
  tools.check(left.state === "Paused" && left.stages >= 1, `it is ${left.state} with ${left.stages} stages`);
  tools.say(`left at stage ${left.stages + 1} after ${left.seconds.toFixed(1)} s of work`);
  await tools.screenshot("training-left");
  await tools.click(await tools.find("Button", `Resume the training of ${landmark}`));
  const done = await tools.waitFor((s) => of(s, landmark).state === "Done" || of(s, landmark).trouble, "the detector", 180_000);
  const { outcome, stages, seconds, trouble } = of(done, landmark);
  tools.check(outcome, `it came to nothing: ${trouble}`);
  // So few photos make a poor detector: how good one is with the usual ones is measured elsewhere.
  tools.check(stages >= left.stages && outcome.judged >= 10 && outcome.found > 0, `found in ${outcome.found} of ${outcome.judged}`);
  tools.say(`${stages} stages, found in ${outcome.found} of ${outcome.judged} held-out photos, ${seconds.toFixed(1)} s of work`);
  const kept = done.landmarks.find((l) => l.name === landmark);
  tools.check(kept.trained && kept.detector === "template", "the detector is not kept with the landmark");
  await page.waitForTimeout(500);
  await tools.screenshot("training-done");

  // Chosen, and flown with.
  await tools.click(await tools.find("Tab", "Cascade"));
  const chosen = await tools.waitFor((s) => s.landmarks.find((l) => l.name === landmark).detector === "cascade", "the choice");
  await page.keyboard.press("Shift+R");
  const again = await tools.waitFor((s) => s.run_generation > chosen.run_generation && s.run_steps > 60 && s.accepted > 0, "the flight with it", 150_000);
  tools.check(!again.toasts.some((t) => t.trouble), `trouble: ${JSON.stringify(again.toasts)}`);
  await page.evaluate(() => window.app.rest_flight()); // nothing is judged of the rest of it
  await page.keyboard.press("Shift+P");

  // All of them, two at a time; paused they rest, cancelled they are gone.
  await tools.waitFor((s) => s.workspace === "Plan", "the plan");
  await tools.click(await tools.find("Button", "Train all"));
  const all = await tools.waitFor((s) => s.plan.trainings.filter((t) => t.state === "Working" && t.fraction > 0).length === 2, "two at work", 120_000);
  tools.check(all.plan.trainings.length === first.landmarks.length, `${all.plan.trainings.length} trainings`);
  await tools.screenshot("training-all");
  await tools.click(await tools.find("Button", "Pause all trainings"));
  const paused = await tools.waitFor((s) => s.plan.trainings.every((t) => ["Paused", "Done"].includes(t.state)), "all paused");
  await page.waitForTimeout(2500);
  const fractions = (s) => String(s.plan.trainings.map((t) => t.fraction));
  const later = await tools.state();
  await page.waitForTimeout(1500);
  tools.check(fractions(await tools.state()) === fractions(later), "a paused training goes on");
  tools.check(paused.plan.trainings.length === first.landmarks.length, "a paused training is lost");
  await tools.click(await tools.find("Button", "Cancel all trainings"));
  await tools.waitFor((s) => s.plan.trainings.every((t) => t.state === "Done"), "all cancelled");
}
