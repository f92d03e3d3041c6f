// A recorded flight whose pictures are stamped late and whose camera is turned: put beside its log in the page.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { zip } from "./zip.mjs";

export const name = "a camera that is late and turned is put beside its log: estimated, tried by hand, applied";
export const long = true;
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const folder = join(repository, "../shared/data/brighton_beach");
const flight = join(repository, "tests/flights/brighton/flight.json");
const LATE = 0.7;
const PICTURES = 14; // of the flight's 18, which whole-frames.journey.mjs lays on the map

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  await page.keyboard.press("Control+K");
  await tools.waitFor((s) => s.dialogs.palette, "the palette");
  await page.keyboard.type("camera to log");
  await page.waitForTimeout(500);
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => s.side_tab === "camera_log" && s.camera_log.missing, "the sheet that says what is missing");
  await page.waitForTimeout(500);
  await tools.screenshot("camera-missing");

  const layout = { ...JSON.parse(readFileSync(flight, "utf8")), data: undefined };
  layout.frames.time = { ...layout.frames.time, offset_s: LATE };
  layout.camera = { ...layout.camera, mount_deg: { roll: 0, pitch: 2, yaw: 4 } };
  const files = [["flight.json", JSON.stringify(layout)]];
  for (const name of ["ortho.jpg", "ortho_georef.json"]) files.push([name, readFileSync(join(folder, name))]);
  const [heads, ...rows] = readFileSync(join(folder, "frames.csv"), "utf8").trim().split("\n");
  const taken = rows.slice(0, PICTURES);
  files.push(["frames.csv", [heads, ...taken, ""].join("\n")]);
  for (const [name] of taken.map((row) => row.split(","))) files.push([`frames/${name}`, readFileSync(join(folder, "frames", name))]);
  await page.setInputFiles("#files", [{ name: "brighton.zip", mimeType: "application/zip", buffer: zip(files) }]);
  const opened = await tools.waitFor((s) => s.flight !== before.flight && s.run_complete, "the flight", 150_000);
  const [first] = opened.camera_log.frame_times;

  // Without a mission its pictures are laid on its map as they come.
  await tools.waitFor((s) => s.camera_log.missing === null, "pictures enough for an estimate");
  await page.waitForTimeout(500);
  await tools.screenshot("camera-whole-frames");
  await tools.click(await tools.find("Button", "Estimate"));
  const told = await tools.waitFor((s) => s.camera_log.estimate, "the estimate", 250_000);
  const { offset, yaw, pitch } = told.camera_log.estimate.told;
  const degrees = (it) => `${((180 / Math.PI) * it.value).toFixed(2)} ± ${((180 / Math.PI) * it.deviation).toFixed(2)}°`;
  tools.say(`${offset.value.toFixed(2)} ± ${offset.deviation.toFixed(2)} s, yaw ${degrees(yaw)}, pitch ${degrees(pitch)}`);
  tools.check(Math.abs(offset.value + LATE) < 3 * offset.deviation, "the time offset is wrong");
  await tools.waitFor((s) => s.camera_log.position_rms?.[1] < 0.6 * s.camera_log.position_rms[0], "residuals that shrink");
  await page.waitForTimeout(800);
  await tools.screenshot("camera-estimate");

  const slider = await tools.find("Slider", "Time offset");
  await tools.click(slider);
  const tried = await tools.waitFor(
    (s) => Math.abs(s.camera_log.by_hand.offset_s - s.camera_log.estimate.change.offset_s) > 0.2,
    "the hand away from the estimate",
  );
  const [, best, byHand] = tried.camera_log.position_rms;
  tools.say(`RMS ${best.toFixed(2)} m at the estimate, ${byHand.toFixed(2)} m at ${tried.camera_log.by_hand.offset_s.toFixed(2)} s`);
  tools.check(byHand > best, "a worse time is no worse");
  await page.waitForTimeout(500);
  await tools.screenshot("camera-by-hand");

  await tools.click(await tools.find("Button", "Use the estimate"));
  await tools.click(await tools.find("Button", "Apply"));
  const applied = await tools.waitFor(
    (s) => s.run_generation > tried.run_generation && s.run_complete && s.camera_log.position_rms,
    "the flight as it was put",
    250_000,
  );
  const moved = applied.camera_log.frame_times[0] - first;
  tools.say(`the pictures moved by ${moved.toFixed(2)} s; ${applied.laid} of ${applied.frames} lie on the map`);
  tools.check(Math.abs(moved + LATE) < 3 * offset.deviation, "the pictures did not move in time");
  await page.waitForTimeout(800);
  await tools.screenshot("camera-applied");
}
