// How a very large GeoTIFF behaves in the page: a small file whose tables point again and again at a few
// tiles, or the one that PILOTAGE_LARGE_MAP names, as
// `cargo run -p pilotage-tests --example large_map -- write FILE [--overviews]` makes it.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { repeatingGeotiff } from "./geotiff.mjs";
import { rendererMemory } from "./memory.mjs";

export const name = "a GeoTIFF of half a billion pixels opens, pans and stays small";
export const flies = 310; // steps of the demo
export const tags = ["maps"];
export const alone = true; // it judges time and the memory of the one page that there is

/** The size of the largest map of the thesis. */
const large = () => repeatingGeotiff({
  width: 22_167, height: 25_100, gsd: 0.15, east: 570_000, north: 5_190_000, tiles: 8,
  pixel: (tile, x, y) => [60 + 15 * tile + (x * 13 + y * 7) % 23, 90 + (x >> 5) * 4 + 6 * tile, 60 + (y >> 6) * 8 + (x * y) % 11],
});

export async function run(page, tools) {
  const named = process.env.PILOTAGE_LARGE_MAP;
  if (named) return look(page, tools, named);
  const folder = mkdtempSync(join(tmpdir(), "pilotage-large-"));
  try {
    const file = join(folder, "large.tif");
    writeFileSync(file, large());
    return await look(page, tools, file);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Megabytes that the page's process holds: once what nobody refers to is collected and they fall no more, after twenty seconds at most. */
async function settled(page) {
  let before = rendererMemory();
  for (let i = 0; i < 20; i += 1) {
    await page.requestGC();
    await page.waitForTimeout(1000);
    const now = rendererMemory();
    if (now < 450 && now > 0.98 * before) return now;
    before = now;
  }
  return before;
}

async function look(page, tools, file) {
  await tools.waitReady();
  await page.keyboard.press("Space"); // nothing is judged of what moves meanwhile
  await tools.waitFor((s) => !s.playing && (s.run_complete || s.run_steps > 300), "the demo", 200_000);
  await page.keyboard.press("Space");
  await tools.waitFor((s) => s.playing, "the flight to play");
  const idle = rendererMemory();
  const begun = Date.now();
  await page.setInputFiles("#files", file);
  await tools.waitFor((s) => s.map.name && file.endsWith(s.map.name) || s.toasts.some((t) => t.trouble), "the map to open", 100_000);
  const opened = Date.now() - begun;
  await tools.waitFor((s) => s.map.tiles > 0, "its first pixels", 100_000);
  const seen = Date.now() - begun;
  const state = await tools.waitFor((s) => s.map.whole, "all of the first view", 300_000);
  const whole = Date.now() - begun;
  await tools.screenshot("large-map");
  const [left, top, right, bottom] = state.map.rect;
  const at = (x, y) => ({ x: left + x * (right - left), y: top + y * (bottom - top) });
  // In close, then panned by hand.
  for (let i = 0; i < 22; i += 1) { await page.mouse.move(at(0.5, 0.5).x, at(0.5, 0.5).y); await page.mouse.wheel(0, -120); await page.waitForTimeout(60); }
  await tools.waitFor((s) => s.map.whole, "the close view", 100_000);
  const opening = rendererMemory();
  await page.evaluate(() => window.app.forget_cpu_ms());
  // The workers of what was open before have ended; what they and the compiler left the browser collects in its own time.
  let peak = await settled(page);
  for (let i = 0; i < 8; i += 1) {
    await tools.drag(at(0.8, 0.7), at(0.2, 0.3), 30);
    peak = Math.max(peak, rendererMemory());
  }
  const panned = JSON.parse(await page.evaluate(() => window.app.cpu_ms()));
  await tools.waitFor((s) => s.map.whole, "the view after panning", 100_000);
  peak = Math.max(peak, rendererMemory());
  await tools.screenshot("large-map-close");
  const near = (await tools.state()).map;
  for (const line of [
    `open after ${opened} ms, first pixels ${seen} ms, the whole view ${whole} ms`,
    `panning at ${near.metres_per_point.toFixed(2)} m per point: ${panned.kept} frames, app time median ${panned.median?.toFixed(1)} ms, 95 % ${panned.p95?.toFixed(1)} ms`,
    `resident memory of the page's process: ${idle.toFixed(0)} MB with the demo, ${opening.toFixed(0)} MB when the map is close, then at most ${peak.toFixed(0)} MB; wasm of the page ${((await page.evaluate(() => window.app.memory_bytes())) / 1e6).toFixed(0)} MB`,
  ]) tools.say(`${line}`);
  // Once more: what else keeps the machine busy may have passed, and nothing of the first may stay.
  const again = Date.now();
  await page.setInputFiles("#files", file);
  await tools.waitFor((s) => s.map.tiles > 0 && s.map.metres_per_point > 2 * near.metres_per_point, "the map to open again", 100_000);
  const quickest = Math.min(opened, Date.now() - again);
  await tools.waitFor((s) => s.map.whole, "all of it again", 300_000);
  const twice = rendererMemory();
  tools.say(`opened again: ${twice.toFixed(0)} MB`);
  tools.check(quickest < 2000, `it opened after ${quickest} ms`);
  tools.check(panned.median < 16.7, `${panned.median} ms of app time a frame`);
  tools.check(opening < 600, `${opening.toFixed(0)} MB when the map is close`);
  tools.check(Math.max(peak, twice) < 500, `${peak.toFixed(0)} MB with the map, ${twice.toFixed(0)} MB opened again`);
}
