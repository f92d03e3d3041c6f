// Photos of a drone over a satellite map of another date: dropped together, each is laid by itself.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { drop } from "./drop.mjs";

export const name = "photos dropped with a map of another date are laid on it one by one, with their probability";
export const tags = ["readers", "maps"];

const folder = join(fileURLToPath(new URL("../../", import.meta.url)), "../shared/data/fengyuan");
const photos = ["DJI_001.jpg", "DJI_003.jpg", "DJI_005.jpg"];

/** The photos' table: a row by the name of its file. */
function table() {
  const [head, ...lines] = readFileSync(join(folder, "frames.csv"), "utf8").trim().split(/\r?\n/).map((line) => line.split(","));
  return new Map(lines.map((line) => [line[0], Object.fromEntries(head.map((key, i) => [key, line[i]]))]));
}

/** A photo as the drone stored it: its place, height and attitude in XMP, the angles of the gimbal all zero. */
function withPose(jpeg, row) {
  const say = (key, value) => `drone-dji:${key}="${value}"`;
  const properties = [
    say("GpsLatitude", row.latitude_deg), say("GpsLongitude", row.longitude_deg),
    say("RelativeAltitude", `+${row.height_above_takeoff_m}`), say("FlightYawDegree", row.flight_yaw_deg),
    say("FlightPitchDegree", row.flight_pitch_deg), say("FlightRollDegree", row.flight_roll_deg),
    say("GimbalYawDegree", "0.0"), say("GimbalPitchDegree", "0.0"), say("GimbalRollDegree", "0.0"),
    'drone-dji:CalibratedFocalLength="728.0"',
  ];
  const xmp = `<x:xmpmeta><rdf:Description ${properties.join(" ")}/></x:xmpmeta>`;
  const body = Buffer.concat([Buffer.from("http://ns.adobe.com/xap/1.0/\0", "latin1"), Buffer.from(xmp)]);
  const length = Buffer.alloc(2);
  length.writeUInt16BE(body.length + 2);
  return Buffer.concat([jpeg.subarray(0, 2), Buffer.from([0xff, 0xe1]), length, body, jpeg.subarray(2)]);
}

/** Where the middle of a photo lies by its receiver and by how far the camera looks ahead, [latitude, longitude]. */
function middle(row) {
  const ahead = row.height_above_takeoff_m * Math.tan((row.camera_ahead_deg * Math.PI) / 180);
  const yaw = (row.flight_yaw_deg * Math.PI) / 180;
  return [
    Number(row.latitude_deg) + (ahead * Math.cos(yaw)) / 110_760,
    Number(row.longitude_deg) + (ahead * Math.sin(yaw)) / 101_500,
  ];
}

const metres = ([a, b], [c, d]) => Math.hypot((a - c) * 110_760, (b - d) * 101_500);

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 20, "the demo", 150_000);
  const rows = table();
  const read = (name) => readFileSync(join(folder, name));
  const map = ["map.jpg", "map.jgw", "map.prj"].map((name) => ({ name, buffer: read(name) }));
  const posed = photos.map((name) => ({ name, buffer: withPose(read(`frames/${name}`), rows.get(name)) }));
  await drop(page, [...map, ...posed]);
  const done = (s) => s.photos?.rows.length === photos.length && !s.photos.at_work;
  const laid = await tools.waitFor((s) => done(s) || s.toasts.some((t) => t.trouble), "the photos to be laid", 200_000);
  const trouble = laid.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  tools.check(laid.side_tab === "photos", laid.side_tab);
  for (const row of laid.photos.rows) {
    tools.check(row.place !== null, `${row.name}: ${row.refused}`);
    const error = metres(row.place, middle(rows.get(row.name)));
    tools.say(`${row.name}: ${error.toFixed(1)} m from its receiver, ± ${row.deviation.toFixed(1)} m, probability ${row.probability.toFixed(4)}, ${(row.milliseconds / 1000).toFixed(2)} s`);
    tools.check(error < 15 && row.probability > 0.95, `${row.name}: ${error} m, ${row.probability}`);
    tools.check(/angles are all zero/.test(row.assumed), row.assumed);
  }
  await tools.waitFor((s) => s.photos.chosen === 0 && s.photos.draped, "the first photo over the map");
  await tools.waitFor((s) => s.map.whole && s.map.tiles > 0, "the map", 60_000);
  await page.waitForTimeout(1500);
  await tools.screenshot("photos-on-map");

  await tools.click((await tools.findAll("Button", /^DJI_003\.jpg: /))[0]);
  await tools.waitFor((s) => s.photos.chosen === 1 && s.photos.draped, "the second photo over the map");
  await tools.click(await tools.find(null, "Over the map: See-through"));
  await page.waitForTimeout(1500);
  await tools.screenshot("photos-see-through");

  // Where headings are known to 15 degrees they take less time.
  const field = await tools.find("SpinButton", "40.0°");
  await tools.click(field);
  await page.keyboard.press("Control+a");
  await page.keyboard.type("15");
  await page.keyboard.press("Enter");
  await tools.click(await tools.find("Button", "Lay again"));
  await tools.waitFor((s) => s.photos.at_work, "the photos to be laid again");
  const again = await tools.waitFor(done, "that", 100_000);
  const times = again.photos.rows.map((row) => (row.milliseconds / 1000).toFixed(2));
  tools.say(`within 15 degrees: ${times.join(", ")} s`);
  tools.check(again.photos.rows.every((row) => row.place !== null), JSON.stringify(again.photos.rows));
}
