// A quadcopter indoors: the hall of the thesis is chosen, flown by its posters, and known to within a hand's breadth.
export const name = "the hall is chosen like any scenario and its quadcopter is known to 0.15 m RMS, never 2 ft off";

/** Two feet, metres: what the thesis allows. */
const TWO_FEET = 0.6096;

export async function run(page, tools) {
  await tools.waitReady();
  const demo = await tools.waitFor((s) => s.run_steps > 0, "the demo", 120_000);
  await tools.choose("Open", "Simulate a flight…");
  await tools.click(await tools.find(null, "Quadcopter in a hall"));
  await page.waitForTimeout(400);
  await tools.screenshot("hall-chosen");
  await tools.click(await tools.find(null, "Fly"));
  const flown = await tools.waitFor(
    (s) => s.flight === "indoor-hall" && s.run_generation > demo.run_generation && s.run_complete, "the hall to be flown", 150_000);
  tools.check(flown.landmarks.every((l) => l.name.startsWith("poster")), JSON.stringify(flown.landmarks.map((l) => l.name)));
  tools.check(flown.accepted > 50, `${flown.accepted} posters found`);
  await tools.waitFor((s) => s.map.known && s.map.tiles > 0, "the floor", 60_000);
  await page.waitForTimeout(800);
  await tools.screenshot("hall");
  await page.keyboard.press("Shift+C");
  const own = (s) => s.compare.errors.find((r) => r.name === "This run");
  const { rms, greatest } = own(await tools.waitFor((s) => own(s)?.rms > 0, "errors of the run"));
  tools.say(`${flown.accepted} posters found; ${rms.toFixed(3)} m RMS, at most ${greatest.toFixed(2)} m`);
  tools.check(rms <= 0.15 && greatest <= TWO_FEET, `${rms} m RMS, ${greatest} m`);
}
