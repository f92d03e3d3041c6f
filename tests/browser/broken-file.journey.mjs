// Files that are broken or of no use are refused with their name and what is wrong with them.
import { closeSync, ftruncateSync, mkdtempSync, openSync, renameSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { zip } from "./zip.mjs";

export const name = "a broken file is refused with its name and cause, and nothing is lost";
export const tags = ["readers"];

async function choose(page, files) {
  await page.setInputFiles("#files", files);
}

const file = (name, text) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(text) });

/** A flight whose table of airspeeds is damaged in its fourth line. */
const damaged = [
  ["trip/flight.json", JSON.stringify({
    pilotage_flight: 1,
    name: "Trip",
    camera: { width: 640, height: 480, horizontal_fov_deg: 60 },
    start: { north_m: 0, east_m: 0, standard_deviation_m: 3 },
    channels: ["airspeed", "heading"].map((name) => ({
      name, file: "air.csv", time: { column: "t" }, value: { column: name, unit: name === "airspeed" ? "m/s" : "deg" },
    })),
    frames: { file: "frames.csv", name: "name", time: { column: "t" } },
  })],
  ["trip/air.csv", "t,airspeed,heading\n0,16,310\n0.1,16,310\n0.2,sixteen,310\n"],
  ["trip/frames.csv", "name,t\na.jpg,0\n"],
];

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 20, "the first seconds of the run", 150_000);
  await tooLarge(page, tools);
  const padding = ["trip/padding.bin", Buffer.alloc(17e6)]; // with which the zip stays where it is, and is read there
  const cases = [
    [[file("flight.json", "{\n  \"pilotage_flight\": one\n}")], /flight\.json.*line 2/s],
    [[file("damaged.zip", zip(damaged))], /air\.csv.*line 4.*sixteen/s],
    [[file("damaged-large.zip", zip([...damaged, padding]))], /damaged-large\.zip.*air\.csv.*line 4.*sixteen/s],
    [[file("wandered.zip", "this is no zip file")], /wandered\.zip/],
    [[file("notes.txt", "dear diary")], /notes\.txt.*flight\.json/s],
    [[file("last.run", "PILOTAGE RUN 1\nbroken")], /last\.run/],
  ];
  for (const [files, expected] of cases) {
    await choose(page, files);
    const told = (s) => s.toasts.find((t) => t.trouble && expected.test(`${t.title} ${t.text}`));
    const state = await tools.waitFor(told, `a message like ${expected}`, 60_000);
    tools.say(`${told(state).title}: ${told(state).text}`);
    tools.check(state.landmarks.length === before.landmarks.length, "landmarks were lost");
    tools.check(state.flight === before.flight, "the flight was lost");
    tools.check(state.run_steps >= before.run_steps && state.run_generation === before.run_generation, "the run was lost");
  }
  await tools.screenshot("broken-file");
}

/** A zip that is too large to be read at once is refused by its size, before anything of it is read. */
async function tooLarge(page, tools) {
  const folder = mkdtempSync(join(tmpdir(), "pilotage-large-zip-"));
  try {
    const path = join(folder, "campaign.zip");
    const sparse = openSync(path, "w");
    ftruncateSync(sparse, 1.25 * 2 ** 30);
    closeSync(sparse);
    const begun = Date.now();
    await page.setInputFiles("#files", path);
    const told = (s) => s.toasts.find((t) => t.trouble && /campaign\.zip/.test(t.title));
    const { title, text } = told(await tools.waitFor(told, "a word about the size", 10_000));
    const memory = await page.evaluate(() => window.app.memory_bytes());
    tools.say(`${title}: ${text} (${((Date.now() - begun) / 1000).toFixed(1)} s, ${(memory / 1e6).toFixed(0)} MB)`);
    tools.check(/1\.3 GiB.*Unpack it/.test(text), text);
    tools.check(memory < 100e6, `the page took ${(memory / 1e6).toFixed(0)} MB`);
    // A film of GoPro in all directions is read by pieces; this one is looked into and found to be none.
    const film = join(folder, "GS010001.360");
    renameSync(path, film);
    await page.setInputFiles("#files", film);
    const of = (s) => s.toasts.find((t) => t.trouble && `${t.title} ${t.text}`.includes("GS010001.360"));
    const about = of(await tools.waitFor(of, "a word about the film", 30_000));
    tools.say(`${about.title}: ${about.text}`);
    tools.check(!about.text.includes("GiB"), about.text);
  } finally {
    rmSync(folder, { recursive: true });
  }
}
