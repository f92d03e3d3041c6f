// Time of a rehearsal of the demo's route: 20 flights, without pictures and with them.
export const name = "time of 20 rehearsed flights";
export const alone = true;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction?.fine, "the prediction of the demo's route", 90_000);
  for (const how of ["with", "without"]) {
    if (how === "without") {
      await tools.click(await tools.find("Button", "Settings of the rehearsal"));
      await tools.click(await tools.find("CheckBox", "with pictures"));
      await page.keyboard.press("Escape");
    }
    const begun = Date.now();
    await tools.click(await tools.find("Button", "Rehearse this route"));
    await tools.waitFor((s) => s.plan.rehearsal.progress !== null, "the flights to begin", 20_000);
    const { plan: { rehearsal } } = await tools.waitFor((s) => s.plan.rehearsal.flown === 20 && s.plan.rehearsal.progress === null,
      "twenty flights", 380_000);
    tools.say(`20 flights ${how} pictures: ${((Date.now() - begun) / 1000).toFixed(1)} s, ${(100 * rehearsal.inside_corridor).toFixed(1)} % `
      + `± ${(200 * rehearsal.uncertainty).toFixed(1)} inside, ${rehearsal.rms.toFixed(1)} m RMS, ${rehearsal.predicted_rms.toFixed(1)} m predicted`);
    await tools.screenshot(`rehearsal-${how}-pictures`);
  }
}
