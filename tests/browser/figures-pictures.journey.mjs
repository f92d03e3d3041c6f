// Memory of the page over a flight of many camera pictures, by hand: PILOTAGE_PICTURES of them (2,000).
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { rendererMemory } from "./memory.mjs";

export const name = "memory of the page over a flight of many camera pictures";
export const tags = ["readers"];

const photos = join(fileURLToPath(new URL("../../", import.meta.url)), "../shared/data/caliterra/frames");
const count = Number(process.env.PILOTAGE_PICTURES ?? 2000);

export async function run(page, tools) {
  const folder = mkdtempSync(join(tmpdir(), "film-"));
  mkdirSync(join(folder, "frames"));
  const stored = readdirSync(photos).map((name) => readFileSync(join(photos, name)));
  const names = Array.from({ length: count }, (_, i) => `${String(i).padStart(5, "0")}.jpg`);
  let bytes = 0;
  names.forEach((name, i) => {
    const picture = stored[i % stored.length];
    bytes += picture.length;
    writeFileSync(join(folder, "frames", name), picture);
  });
  writeFileSync(join(folder, "frames.csv"), ["name,time", ...names.map((name, i) => `${name},${0.5 * i}`)].join("\n"));
  const rows = Array.from({ length: count }, (_, i) => `${0.5 * i},${0.1 * i},${30.0 + 1e-5 * i},-97.8,100`);
  writeFileSync(join(folder, "channels.csv"), ["time,heading,latitude,longitude,height", ...rows].join("\n"));
  const value = (column, unit) => ({ file: "channels.csv", time: { column: "time" }, value: { column, unit } });
  writeFileSync(join(folder, "flight.json"), JSON.stringify({
    pilotage_flight: 1,
    name: "many pictures",
    camera: { width: 1000, height: 750, focal_px: 800 },
    origin: { latitude_deg: 30, longitude_deg: -97.8 },
    start: { standard_deviation_m: 5, north_m: 0, east_m: 0 },
    channels: [
      { name: "heading", ...value("heading", "deg") },
      { name: "height_above_ground", ...value("height", "m") },
    ],
    frames: { file: "frames.csv", name: "name", time: { column: "time" }, directory: "frames" },
  }));
  try {
    await tools.waitReady();
    await tools.waitFor((s) => s.pictures > 2, "the demo", 200_000);
    const before = rendererMemory();
    const files = ["flight.json", "channels.csv", "frames.csv", ...names.map((name) => join("frames", name))];
    await page.setInputFiles("#files", files.map((name) => join(folder, name)));
    const opened = await tools.waitFor((s) => s.frames === count || s.toasts.some((t) => t.trouble), "the flight", 200_000);
    const trouble = opened.toasts.find((t) => t.trouble);
    tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
    let largest = 0;
    const watch = setInterval(() => { largest = Math.max(largest, rendererMemory()); }, 500);
    await tools.waitFor((s) => s.pictures === count, "all of its pictures to be taken", 600_000);
    const taken = rendererMemory();
    await page.keyboard.press("Home");
    await page.keyboard.press("Digit0"); // twenty times as fast
    await page.keyboard.press("Space");
    await page.waitForTimeout(Math.min(60_000, (0.5 * count * 1000) / 20 + 2000));
    const state = await tools.state();
    clearInterval(watch);
    tools.say(`${count} pictures, ${(bytes / 1e6).toFixed(0)} MB of files; process with all workers: ${before.toFixed(0)} MB with the demo, ` +
      `${taken.toFixed(0)} MB once all were taken, ${rendererMemory().toFixed(0)} MB after playing, ${largest.toFixed(0)} MB at most; drawn ${JSON.stringify(state.drawn?.camera)}`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
