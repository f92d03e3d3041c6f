// A worker that dies, by a fault of its own or without a word, is replaced and its work done again.
export const name = "killing the worker is survived";
export const flies = true;

export async function run(page, tools) {
  tools.expectMessage(/asked to crash|unreachable|worker stopped/);
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 20, "the first seconds of the run", 150_000);
  const isOver = (deed) => tools.say(`the flight was over after ${deed}: nothing was done behind it`);
  for (const deed of ["crash_worker", "kill_worker"]) {
    const generation = (await tools.state()).run_generation;
    await page.evaluate((method) => window.app[method](0), deed);
    const told = await tools.waitFor((s) => s.toasts.some((t) => /worker/i.test(t.title)), "a word about the lost worker", 60_000);
    tools.check(told.landmarks.length === before.landmarks.length, "landmarks were lost");
    await tools.screenshot(`lost-worker-${deed}`);
    if (told.run_complete) return isOver(deed);
    const anew = await tools.waitFor((s) => s.run_generation > generation || s.run_complete, "the flight to begin anew", 120_000);
    await tools.waitFor((s) => s.run_steps > 20, "steps to stream again", 120_000);
    if (anew.run_complete) return isOver(deed);
  }
  const after = await tools.state();
  tools.check(after.landmarks.length === before.landmarks.length, "landmarks were lost");
}
