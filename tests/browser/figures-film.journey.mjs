// How much memory the page takes over a flight of 2,000 camera pictures, while somebody looks through all of it.
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { rendererMemory } from "./memory.mjs";

export const name = "a flight of 2,000 pictures is looked through within bounded memory";
export const alone = true;

const PICTURES = 2000;
const STEP = 0.5; // seconds between two pictures
const PLACES = 100; // at which somebody looks

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const idle = rendererMemory();
  const folder = mkdtempSync(join(tmpdir(), "many-pictures-"));
  try {
    const { files, bytes } = await flight(page, folder);
    let peak = 0;
    const watched = (condition) => (s) => { peak = Math.max(peak, rendererMemory()); return condition(s); };
    const before = (await tools.state()).flight;
    await page.setInputFiles("#files", files);
    const opened = await tools.waitFor(watched((s) => (s.flight && s.flight !== before) || s.toasts.some((t) => t.trouble)), "the flight to open", 300_000);
    const trouble = opened.toasts.find((t) => t.trouble);
    tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
    await tools.waitFor(watched((s) => s.run_complete && s.pictures === PICTURES), "its pictures", 300_000);
    const flown = peak;
    if ((await tools.state()).playing) await page.keyboard.press("Space");
    const { timeline: [left, top, right, bottom], span: [begin, end] } = await tools.waitFor((s) => !s.playing, "the pause");
    const seen = new Set();
    for (let i = 0; i < PLACES; i += 1) {
      const wanted = begin + (end - begin) * (i + 0.5) / PLACES;
      await page.mouse.click(left + (right - left) * (wanted - begin) / (end - begin), (top + bottom) / 2);
      const there = (s) => Math.abs(s.time - wanted) < 2 && s.drawn.camera.cursor === s.time && s.time - s.drawn.camera.content < 2 * STEP;
      seen.add((await tools.waitFor(watched(there), `the picture at ${wanted} s`, 60_000)).drawn.camera.content);
    }
    await tools.screenshot("many-pictures");
    tools.check(seen.size === PLACES, `${seen.size} pictures were seen`);
    for (const line of [
      `${PICTURES} pictures of 640 x 480, ${(bytes / 1e6).toFixed(0)} MB; ${seen.size} looked at over ${(end - begin).toFixed(0)} s`,
      `resident memory of the page with its workers: ${idle.toFixed(0)} MB over the demo, ${flown.toFixed(0)} MB at most until all was flown, ${peak.toFixed(0)} MB at most`,
    ]) tools.say(line);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** A folder of a flight, straight and level, with 2,000 pictures of noise that repeat after forty. */
async function flight(page, folder) {
  const pictures = await page.evaluate(async () => {
    const canvas = Object.assign(document.createElement("canvas"), { width: 640, height: 480 });
    const pen = canvas.getContext("2d");
    const made = [];
    for (let k = 0; k < 40; k += 1) {
      const image = pen.createImageData(640, 480);
      for (let i = 0; i < image.data.length; i += 1) image.data[i] = i % 4 === 3 ? 255 : 128 + 60 * (Math.random() - 0.5);
      pen.putImageData(image, 0, 0);
      const blob = await new Promise((done) => canvas.toBlob(done, "image/jpeg", 0.8));
      made.push([...new Uint8Array(await blob.arrayBuffer())]);
    }
    return made;
  });
  mkdirSync(join(folder, "frames"));
  const rows = ["file,time,heading,lat,lon,height"];
  const files = [];
  let bytes = 0;
  for (let i = 0; i < PICTURES; i += 1) {
    const file = `${String(i).padStart(4, "0")}.jpg`;
    const picture = Buffer.from(pictures[i % pictures.length]);
    bytes += picture.length;
    files.push(join(folder, "frames", file));
    writeFileSync(files[i], picture);
    rows.push(`${file},${i * STEP},0,${47 + i * 5e-5},8,100`);
  }
  const time = { column: "time" };
  const channel = (channelName, column, unit) => ({ name: channelName, file: "frames.csv", time, value: { column, unit } });
  const described = {
    pilotage_flight: 1,
    name: "Many pictures",
    origin: { latitude_deg: 47, longitude_deg: 8 },
    camera: { width: 640, height: 480, focal_px: 600 },
    start: { standard_deviation_m: 3 },
    channels: [
      channel("heading", "heading", "deg"),
      channel("height_above_ground", "height", "m"),
      { name: "gps", file: "frames.csv", time, latitude: { column: "lat" }, longitude: { column: "lon" } },
    ],
    frames: { file: "frames.csv", name: "file", directory: "frames", time },
  };
  for (const [file, text] of [["frames.csv", rows.join("\n")], ["flight.json", JSON.stringify(described)]]) {
    files.push(join(folder, file));
    writeFileSync(files.at(-1), text);
  }
  return { files, bytes };
}
