// Prints what training detectors with the usual plan costs, one alone and two side by side; judges nothing.
export const name = "figures of training detectors";
export const alone = true;
export const flies = true;

const over = (t) => t.state === "Done" || t.state === "Failed";

export async function run(page, tools) {
  await tools.waitReady();
  const { landmarks } = await tools.waitFor((s) => s.run_complete, "the demo's run", 200_000);
  await page.keyboard.press("Space");
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction?.fine, "the prediction", 90_000);
  await tools.showLandmarks();

  const select = async (name) => {
    await tools.click(await tools.find(null, new RegExp(`^${name}: `)));
    await page.waitForTimeout(1500);
  };
  const names = landmarks.slice(0, 3).map((l) => l.name);
  const trainings = (s, of) => s.plan.trainings.filter((t) => of.includes(t.name));
  /** Trains and says when each phase began, seconds since the start, and when all are over. */
  const train = async (of) => {
    const begun = Date.now();
    const phases = {};
    for (const name of of) {
      await select(name);
      await page.keyboard.press("j");
    }
    const clicked = (Date.now() - begun) / 1e3;
    const end = await tools.waitFor((s) => {
      for (const t of trainings(s, of)) {
        phases[`${t.name} ${t.phase}`] ??= (Date.now() - begun) / 1e3;
      }
      return trainings(s, of).length === of.length && trainings(s, of).every(over);
    }, "the detectors", 380_000);
    const text = Object.entries(phases).map(([phase, at]) => `${phase} ${at.toFixed(1)}`).join(", ");
    tools.say(`asked for after ${clicked.toFixed(1)} s; over after ${((Date.now() - begun) / 1e3).toFixed(1)} s; ${text}`);
    for (const t of trainings(end, of)) {
      tools.say(`${t.name}: ${t.seconds.toFixed(1)} s of work, ${t.stages} stages, ${JSON.stringify(t.outcome ?? t.trouble)}`);
    }
  };
  await train(names.slice(0, 1));
  await tools.screenshot("figures-training");
  if (process.env.PILOTAGE_ONE_TRAINING) return;
  await train(names.slice(1, 3));
}
