// What a newcomer sees: the built-in flight, playing by itself.
export const name = "the demo plays on load: time advances, steps and pictures stream, landmarks are matched";

export async function run(page, tools) {
  await tools.waitReady();
  const first = await tools.waitFor((s) => s.run_steps > 0 && s.pictures > 0, "the first steps and pictures", 120_000);
  tools.check(first.playing, "the flight does not play by itself");
  const later = await tools.waitFor((s) => s.time > first.time + 2 && s.run_steps > first.run_steps,
    "the time to advance and more steps to stream", 120_000);
  tools.check(later.step !== null, "no step under the cursor");
  await tools.waitFor((s) => s.accepted > 0, "a landmark to be accepted", 120_000);
  await tools.waitFor((s) => s.map.known && s.map.tiles > 0, "the map", 60_000);
  const summary = page.locator("#summary");
  await summary.filter({ hasText: "Time" }).waitFor({ state: "attached", timeout: 30_000 });
  await tools.screenshot("demo");
}
