// Prints what the page costs; judges nothing.
export const name = "figures of the page";

export async function run(page, tools) {
  await tools.waitReady();
  const boot = await page.evaluate(() => window.page.boot);
  const transfer = await page.evaluate(() => performance.getEntriesByType("resource")
    .filter((r) => r.name.endsWith(".wasm")).map((r) => [r.transferSize, r.decodedBodySize]));
  const flown = await tools.waitFor((s) => s.run_complete || s.run_steps > 400, "a good part of the run", 60_000).catch(() => tools.state());
  await page.evaluate(() => window.app.forget_cpu_ms());
  await page.waitForTimeout(6000);
  const cpu = JSON.parse(await page.evaluate(() => window.app.cpu_ms()));
  const memory = await page.evaluate(() => window.app.memory_bytes());
  const timing = JSON.parse(await page.evaluate(() => window.app.navigator_ms?.() ?? "null"));
  const n = (value, digits = 1) => value == null ? "–" : value.toFixed(digits);
  const lines = [
    `ready after ${n(boot.ready_ms, 0)} ms (program ${n(boot.load_ms, 0)}, start ${n(boot.start_ms, 0)})`,
    `wasm ${transfer.map(([sent, whole]) => `${n(sent / 1e6, 2)} MB sent, ${n(whole / 1e6, 2)} MB`).join("; ")}`,
    `page thread per frame: median ${n(cpu.median)} ms, 95 % ${n(cpu.p95)} ms over ${cpu.kept} frames`,
    `memory of the page ${n(memory / 1e6, 0)} MB with ${flown.run_steps} steps and ${flown.pictures} pictures`,
    `navigator per camera frame: ${timing ? `predict ${n(timing.predict, 2)}, see ${n(timing.see, 2)}, update ${n(timing.update, 2)} ms, median of ${timing.frames}` : "unknown"}`,
  ];
  for (const line of lines) console.log(`        ${line}`);
}
