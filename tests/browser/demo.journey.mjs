// What a newcomer sees: the built-in flight, playing by itself.
export const name = "the demo plays on load: time advances, steps and pictures stream, landmarks are matched";
export const flies = 210; // steps of the demo

export async function run(page, tools) {
  await tools.waitReady();
  const first = await tools.waitFor((s) => s.run_steps > 0 && s.pictures > 0, "the first steps and pictures", 120_000);
  tools.check(first.playing, "the flight does not play by itself");
  const later = await tools.waitFor((s) => s.time > first.time + 2 && s.run_steps > first.run_steps,
    "the time to advance and more steps to stream", 120_000);
  tools.check(later.step !== null, "no step under the cursor");
  await tools.waitFor((s) => s.accepted > 0, "a landmark to be accepted", 120_000);
  // What was shown at once is what the workers compute, to the last digit; what differs is an error on the console, too.
  const stored = async () => JSON.parse(await page.evaluate(() => window.app.first_seconds()));
  for (let known = later; known.run_steps < 200 && !known.run_complete;) known = await tools.waitFor((s) => s.run_steps > known.run_steps || s.run_complete, "more steps");
  const { compared, different } = await stored();
  tools.check(compared > 90 && different === 0, `${different} of ${compared} stored pieces come out otherwise: \`cargo xtask first-seconds\``);
  await tools.waitFor((s) => s.map.known && s.map.tiles > 0, "the map", 60_000);
  const summary = page.locator("#summary");
  await summary.filter({ hasText: "Time" }).waitFor({ state: "attached", timeout: 30_000 });
  await tools.screenshot("demo");
}
