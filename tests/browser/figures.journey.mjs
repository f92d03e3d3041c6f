// Prints what the page costs; judges nothing.
export const name = "figures of the page";
export const alone = true;
export const flies = true;

const steps = 72_000; // an hour at 20 Hz; with 14 plotted series, a million samples
const frames = 60;

export async function run(page, tools) {
  // Without the accessibility tree, which only the journeys ask for.
  await tools.open();
  await page.waitForFunction(() => document.documentElement.dataset.ready === "1", null, { timeout: 120_000 });
  const boot = await page.evaluate(() => window.page.boot);
  const transfer = await page.evaluate(() => performance.getEntriesByType("resource")
    .filter((r) => r.name.endsWith(".wasm")).map((r) => [r.transferSize, r.decodedBodySize]));
  // When each was drawn first, the picture with its pixels; none waits for another.
  const things = {
    ground: (s) => s.map.known && s.map.ground, tile: (s) => s.map.tiles > 0,
    match: (s) => s.accepted > 0, picture: (s) => s.drawn.camera !== null,
  };
  const drawn = {};
  for (const end = Date.now() + 90_000; Object.keys(drawn).length < 4 && Date.now() < end;) {
    const [now, state] = await page.evaluate(() => [performance.now(), window.app.state()]);
    for (const [name, is] of Object.entries(things)) if (is(JSON.parse(state))) drawn[name] ??= now;
    await page.waitForTimeout(20);
  }
  const flown = await tools.waitFor((s) => s.run_complete, "the whole run", 120_000).catch(() => tools.state());
  const timing = JSON.parse(await page.evaluate(() => window.app.navigator_ms()));
  const short = await cost(page, 25);
  const long = await page.evaluate((n) => window.app.repeat_laps(n), steps);
  await page.waitForTimeout(3000);
  const whole = await cost(page, frames);
  // Software rasterising shows three frames a second, each with a new camera picture. At a tenth of the
  // speed a picture lasts for as many frames as it does at full speed on a screen of 30 a second.
  await page.keyboard.press("1");
  const slow = await cost(page, 30);
  await page.keyboard.press("f");
  await page.waitForTimeout(2000);
  const fitted = await cost(page, 25);
  await tools.screenshot("figures-long-flight");
  const memory = await page.evaluate(() => window.app.memory_bytes());
  const n = (value, digits = 1) => value == null ? "–" : value.toFixed(digits);
  const told = (c) => `median ${n(c.median)}, 95 % ${n(c.p95)}, mean ${n(c.mean)} ms over ${c.count} frames`;
  const lines = [
    `ready after ${n(boot.ready_ms, 0)} ms (program ${n(boot.load_ms, 0)}, start ${n(boot.start_ms, 0)})`,
    `on screen after: picture of the map ${n(drawn.ground, 0)} ms, its first tile ${n(drawn.tile, 0)} ms, a match ${n(drawn.match, 0)} ms, the camera picture ${n(drawn.picture, 0)} ms`,
    `wasm ${transfer.map(([sent, size]) => `${n(sent / 1e6, 2)} MB sent, ${n(size / 1e6, 2)} MB`).join("; ")}`,
    `processor time of the page's thread per frame, ${flown.run_steps} steps: ${told(short)}`,
    `the same, ${long} steps: ${told(whole)}`,
    `the same, as many frames between two pictures as 30 a second have: ${told(slow)}`,
    `the same, all of the flight on the map: ${told(fitted)}`,
    `memory of the page ${n(memory / 1e6, 0)} MB with ${long} steps and ${flown.pictures} pictures`,
    `navigator per camera frame: predict ${n(timing.predict, 2)}, see ${n(timing.see, 2)}, update ${n(timing.update, 2)} ms, median of ${timing.frames}`,
  ];
  for (const line of lines) tools.say(`${line}`);
}

/** Milliseconds that frames cost the page's thread: its own time, not that of the rasteriser in
 * another process, and not the time it waits for a processor. */
async function cost(page, least) {
  const devtools = await page.context().newCDPSession(page);
  const times = [];
  devtools.on("Tracing.dataCollected", ({ value }) => {
    for (const event of value) {
      if (event.name === "FireAnimationFrame" && event.tdur !== undefined) times.push(event.tdur / 1e3);
    }
  });
  const count = async () => JSON.parse(await page.evaluate(() => window.app.cpu_ms())).frames;
  const first = await count();
  await devtools.send("Tracing.start", { transferMode: "ReportEvents", traceConfig: { includedCategories: ["devtools.timeline"] } });
  const end = Date.now() + 25_000;
  while (await count() < first + least && Date.now() < end) await page.waitForTimeout(250);
  const complete = new Promise((resolve) => devtools.once("Tracing.tracingComplete", resolve));
  await devtools.send("Tracing.end");
  await complete;
  await devtools.detach();
  times.sort((a, b) => a - b);
  const at = (share) => times[Math.round((times.length - 1) * share)];
  return { median: at(0.5), p95: at(0.95), mean: times.reduce((a, b) => a + b, 0) / times.length, count: times.length };
}
