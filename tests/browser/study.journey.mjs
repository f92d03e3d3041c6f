// A small study is flown in the workers, its plots grow, and a flight that failed is opened in Replay by the keyboard.
export const name = "a failed run of a study is opened in Replay, the very same flight";
export const long = true;
export const tags = ["study", "plan", "flying"];

// Half of the flights recognise nothing and drift away.
const plan = `name = "short"
question = "What if no landmark is recognised?"
seed = 4
draws = 24
fixed = { seconds = 30, step = 0.25, doubts = "no", wind-speed = 8, wind-from = 90 }
cross.recognised = [1, 0.8, 0]
[[measure]]
of = "error-max"
name = "within 20 m"
at_most = 20
`;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0 && s.map.known, "the demo", 120_000);
  await tools.choose("Open", "Fly a study: many flights…");
  await tools.waitFor((s) => s.side_tab === "study", "the sheet of studies");
  await tools.find("Button", "Fly 240 flights");
  await page.waitForTimeout(500);
  await tools.screenshot("study-form");

  // The route of the open mission, in winds that nobody told.
  await tools.click(await tools.find("RadioButton", /along my route/));
  await tools.waitFor((s) => s.study.flights === 40 && s.study.refusal === null, "the plan of the route", 30_000);
  await tools.click(await tools.find("Button", "Fly 40 flights"));
  const own = await tools.waitFor((s) => s.study.study?.flown === 40 && !s.study.study.under_way, "flights along the route", 120_000);
  tools.check(own.study.study.trouble === null && own.study.study.settings.length === 1, JSON.stringify(own.study.study));
  tools.check(own.study.study.settings[0].quantiles[2] < 20, "the route's landmarks are not found");
  await page.waitForTimeout(300);
  await tools.screenshot("study-route");
  await tools.click(await tools.find("Button", "Another study…"));

  // A plan of one's own takes the place of the shipped one.
  await tools.click(await tools.find(null, "The plan as text (TOML)"));
  const field = await tools.find(null, "Plan of the study").catch(() => tools.find("MultilineTextInput"));
  await tools.click(field);
  await write(page, tools, plan.replace("recognised = [1", "recognized = [1"));
  const refused = await tools.waitFor((s) => /cross\.recognized/.test(s.study.refusal ?? ""), "the refusal");
  tools.check(refused.study.flights === null, "a plan with an error is flown");
  await write(page, tools, plan);
  await tools.waitFor((s) => s.study.flights === 72 && s.study.refusal === null, "the plan");

  const begun = Date.now();
  await tools.click(await tools.find("Button", "Fly 72 flights"));
  const some = await tools.waitFor((s) => s.study.study?.flown > 0, "the first flights", 90_000);
  tools.say(`first flights after ${((Date.now() - begun) / 1000).toFixed(1)} s`);
  tools.check(some.study.study.flown < 72, "nothing is seen before the end");
  const { study } = await tools.waitFor((s) => s.study.study.flown === 72 && !s.study.study.under_way, "all flights", 180_000);
  const { settings, failed } = study.study;
  tools.say(`72 flights of 30 s in ${((Date.now() - begun) / 1000).toFixed(1)} s; medians ${settings.map((it) => it.quantiles[2].toFixed(1)).join(", ")} m; ${failed.length} failed`);
  tools.check(settings.length === 3 && settings.every((it) => it.flights === 24), JSON.stringify(settings));
  tools.check(settings[0].quantiles[2] < settings[2].quantiles[2], "who recognises nothing errs most");
  tools.check(failed.length >= 10 && failed.length < 72, `${failed.length} failed`);
  await page.waitForTimeout(500);
  await tools.screenshot("study");

  // The worst of them, reached by the keyboard from the way of sorting before it.
  const worst = failed.toSorted((a, b) => b.largest - a.largest)[0];
  await tools.find("Button", new RegExp(`^Run ${worst.run}, `));
  for (let tabs = 0; tabs < 60; tabs += 1) {
    await page.keyboard.press("Tab");
    const focused = (await tools.a11y()).find((node) => node.focused);
    if (focused?.label?.startsWith(`Run ${worst.run}, `)) break;
    if (tabs === 59) throw new Error("the keyboard does not come to the failed flight");
  }
  const before = await tools.state();
  await page.keyboard.press("Enter");
  const open = await tools.waitFor((s) => s.study.study.open === worst.run && s.run_generation > before.run_generation && s.run_complete, "the flight in Replay", 60_000);
  tools.check(open.workspace === "Replay" && open.title === `Run ${worst.run} of the study “short”`, open.title);
  tools.check(open.study.study.flown === 72 && open.pictures === 0, "the study is gone, or there are pictures");
  await tools.find(null, /It has no camera pictures/);
  await page.waitForTimeout(1500);
  await tools.screenshot("study-failed-run");

  // It is that very flight: the comparison finds the errors of the row.
  await page.keyboard.press("Shift+C");
  const beside = await tools.waitFor((s) => s.compare.errors.some((row) => row.name === "This run" && row.rms > 0), "its errors");
  const shown = beside.compare.errors.find((row) => row.name === "This run");
  tools.say(`run ${worst.run}: largest error ${worst.largest} m in the study, ${shown.greatest} m in Replay`);
  tools.check(Math.abs(shown.greatest - worst.largest) < 1e-6 * worst.largest, `${shown.greatest} and ${worst.largest}`);
}

/** Writes lines over what stands in the field that has the keyboard. */
async function write(page, tools, text) {
  await page.keyboard.press("Control+A");
  await page.keyboard.press("Delete");
  for (const line of text.trim().split("\n")) {
    await page.keyboard.insertText(line);
    await tools.drawn();
    await page.keyboard.press("Enter");
    await tools.drawn();
  }
}
