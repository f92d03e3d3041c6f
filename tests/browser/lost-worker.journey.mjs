// A worker that dies, by a fault of its own or without a word, is replaced and its work done again.
export const name = "killing the worker is survived";
export const flies = true;

const stored = 150; // steps, more than the page shows of the demo before a worker has flown it

export async function run(page, tools) {
  tools.expectMessage(/asked to crash|unreachable|worker stopped/);
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 20, "the first seconds of the run", 150_000);
  const lose = async (deed) => {
    const { run_generation: generation } = await tools.state();
    await page.evaluate((method) => window.app[method](0), deed);
    const told = await tools.waitFor((s) => s.toasts.some((t) => /worker/i.test(t.title)), "a word about the lost worker", 60_000);
    tools.check(told.landmarks.length === before.landmarks.length, "landmarks were lost");
    tools.check(!told.run_complete, `the flight was over before ${deed}`);
    await tools.screenshot(`lost-worker-${deed}`);
    return generation;
  };
  // What is on the screen before the worker has flown it stays there, and another worker flies on from its end.
  await lose("crash_worker");
  await tools.waitFor((s) => s.run_steps > stored, "steps that only a worker can have flown", 120_000);
  await tools.click(await tools.find("Button", "Dismiss notice"));
  await tools.waitFor((s) => s.toasts.length === 0, "the word about the first worker to go");
  // What a worker has flown is flown anew.
  const generation = await lose("kill_worker");
  await tools.waitFor((s) => s.run_generation > generation && s.run_steps > 20, "the flight to begin anew", 120_000);
  const after = await tools.state();
  tools.check(after.landmarks.length === before.landmarks.length, "landmarks were lost");
}
