// How a very large log behaves in the page: the one that PILOTAGE_LARGE_LOG names, as
// `cargo run --release -p pilotage-tests --example large_log -- write FILE` makes it.
import { statSync } from "node:fs";
import { rendererMemory } from "./memory.mjs";

export const name = "a log of half a gigabyte is plotted within seconds and stays within memory";
export const alone = true;
export const flies = true;

// Fields that are plotted until so many samples are on screen.
const FIELDS = ["gyrx", "gyry", "gyrz", "accx", "accy", "accz"];
const MANY = 1e7;

export async function run(page, tools) {
  const file = process.env.PILOTAGE_LARGE_LOG;
  if (!file) throw new Error("PILOTAGE_LARGE_LOG names no file");
  await tools.waitReady();
  await tools.waitFor((s) => s.run_complete, "the demo", 200_000);
  const idle = rendererMemory();
  let peak = idle;
  const begun = Date.now();
  await page.setInputFiles("#files", file);
  const handed = Date.now() - begun;
  const watched = async (condition, what) => {
    await tools.waitFor((s) => { peak = Math.max(peak, rendererMemory()); return condition(s); }, what, 200_000);
    return Date.now() - begun;
  };
  const wanted = file.split("/").pop();
  const plotted = await watched((s) => s.log?.file === wanted && s.log.points > 0, "a first plot");
  const whole = await watched((s) => s.log.read, "all of it");
  await watched((s) => s.log.fields > 0 && !s.job, "its fields");
  await tools.click(await tools.find(null, "Fields of the log"));
  for (const field of FIELDS) {
    if ((await tools.state()).log.points >= MANY) break;
    await tools.type("Search fields of the log", field);
    const rows = await tools.findAll(null, /^IMU.* in a new plot$/);
    const before = (await tools.state()).log.points;
    for (const row of rows.slice(0, 1)) await tools.click(row);
    await watched((s) => s.log.points > before, `the samples of ${field}`);
  }
  await page.evaluate(() => window.app.forget_cpu_ms());
  await page.keyboard.press("Shift+L");
  const state = await tools.state();
  const [left, top, right, bottom] = state.timeline;
  for (let i = 0; i < 6; i += 1) {
    await tools.drag({ x: left + 5, y: (top + bottom) / 2 }, { x: right - 5, y: (top + bottom) / 2 }, 30);
    peak = Math.max(peak, rendererMemory());
  }
  const frames = JSON.parse(await page.evaluate(() => window.app.cpu_ms()));
  await tools.screenshot("large-log");
  for (const line of [
    `${(statSync(file).size / 1e6).toFixed(0)} MB handed over in ${handed} ms, first plot after ${plotted} ms, whole after ${whole} ms`,
    `${state.log.messages} messages, ${state.log.points} samples plotted`,
    `dragging the cursor: ${frames.kept} frames, app time median ${frames.median?.toFixed(1)} ms, 95 % ${frames.p95?.toFixed(1)} ms`,
    `memory of the page and its workers: ${idle.toFixed(0)} MB before, at most ${peak.toFixed(0)} MB`,
  ]) tools.say(`${line}`);
  tools.check(peak < 3000, `${peak.toFixed(0)} MB of memory`);
}
