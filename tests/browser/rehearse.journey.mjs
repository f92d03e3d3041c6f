// A planned route flown in the simulation: its errors beside the prediction, and one of the flights watched in Replay.
export const name = "a route is rehearsed: its errors lie over the corridor, and a flight of it is watched within seconds";
export const tags = ["plan", "flying"];

const fine = (s) => s.plan.prediction?.fine;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && fine(s), "the prediction of the demo's route", 90_000);

  // Twenty flights without pictures.
  await tools.click(await tools.find("Button", "Settings of the rehearsal"));
  await tools.click(await tools.find("CheckBox", "with pictures"));
  await tools.drawn();
  await page.keyboard.press("Escape");
  let begun = Date.now();
  await tools.click(await tools.find("Button", "Rehearse this route"));
  const flown = await tools.waitFor((s) => s.plan.rehearsal.flown === 20 && s.plan.rehearsal.progress === null, "twenty flights", 120_000);
  const { rehearsal } = flown.plan;
  tools.say(`20 flights without pictures in ${((Date.now() - begun) / 1000).toFixed(1)} s: ${(100 * rehearsal.inside_corridor).toFixed(0)} % inside, ${rehearsal.rms.toFixed(1)} m RMS, ${rehearsal.predicted_rms.toFixed(1)} m predicted`);
  tools.check(rehearsal.current && rehearsal.trouble === null, JSON.stringify(rehearsal));
  tools.check(rehearsal.inside_corridor > 0.8, "the corridor holds too few positions");
  await page.waitForTimeout(500);
  await tools.screenshot("rehearsal");

  // The worst of them, with pictures.
  begun = Date.now();
  await tools.click(await tools.find("Button", `Watch the worst: flight ${rehearsal.worst.seed}`));
  await tools.waitFor((s) => s.workspace === "Replay" && /rehearsal/.test(s.title) && s.run_steps > 0 && s.pictures > 0, "its first picture", 60_000);
  tools.say(`its first picture after ${((Date.now() - begun) / 1000).toFixed(1)} s`);
  await page.waitForTimeout(2000);
  await tools.screenshot("rehearsal-watched");

  // Back at the plan, all of it is still there.
  await page.keyboard.press("Shift+P");
  const back = await tools.waitFor((s) => s.workspace === "Plan" && fine(s), "the plan", 60_000);
  tools.check(back.plan.rehearsal.flown === 20, "the rehearsal is gone");
}
