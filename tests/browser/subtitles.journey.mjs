// DJI's subtitles dropped beside their film are a flight: position, height and gimbal, and the film's frames at its times.
// GoPro's film has its places within itself. A film that the browser cannot decode is told by its name.
import { randomBytes } from "node:crypto";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { filmed } from "./films.mjs";
import { gopro } from "./gpmf.mjs";

export const name = "subtitles beside their film become a flight with its frames, so do places within a film, and a bag of ROS is refused by its name";
export const tags = ["readers"];

/** Subtitles of `count` tenths of a second, as DJI writes them, along a way to the north. */
function subtitles(count) {
  const time = (i) => `00:00:${String(Math.floor(i / 10)).padStart(2, "0")},${i % 10}00`;
  const cue = (i) => `${i + 1}\n${time(i)} --> ${time(i + 1)}\n<font size="28">FrameCnt: ${i}, DiffTime: 100ms\n`
    + `[iso: 100] [latitude: ${(47.3 + 5e-6 * i).toFixed(7)}] [longitude: 8.5000000] [rel_alt: 60.000 abs_alt: 480.000] `
    + `[gb_yaw: 0.5 gb_pitch: -90.0 gb_roll: 0.0] </font>\n\n`;
  return Array.from({ length: count }, (_, i) => cue(i)).join("");
}

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const folder = mkdtempSync(join(tmpdir(), "subtitles-"));
  const bag = join(folder, "flight.bin");
  writeFileSync(bag, "#ROSBAG V2.0\nE\0\0\0\x07\0\0\0op=\x03");
  await page.setInputFiles("#files", [bag]);
  const refused = await tools.waitFor((s) => s.toasts.some((t) => t.trouble), "that the bag is refused", 30_000);
  const words = refused.toasts.find((t) => t.trouble).text;
  tools.check(words.includes("flight.bin: it is a bag of ROS 1"), words);
  await tools.screenshot("refused");
  const { film, duration } = await filmed(page, tools, 3);
  const beside = join(folder, "down.SRT");
  writeFileSync(beside, subtitles(Math.ceil(10 * duration) + 20));
  await page.setInputFiles("#files", [film, beside]);
  const flown = await tools.waitFor((s) => s.flight === "down" && s.frames > 0 && s.pictures > 0, "the flight of the film", 90_000);
  const wanted = duration / 0.5; // one every half second
  tools.check(flown.frames >= wanted - 1 && flown.frames <= wanted + 2, `${flown.frames} frames of ${duration} s`);
  await page.waitForTimeout(800);
  await tools.screenshot("subtitles");

  // A film of noise, alone and beside its subtitles, which are a flight without it.
  const isTold = (film) => (s) => s.toasts.some((t) => t.trouble && t.title === `No frame was taken of ${film}` && t.text.includes("cannot decode"));
  const noise = (name) => ({ name, mimeType: "video/mp4", buffer: randomBytes(5000) });
  await page.setInputFiles("#files", [noise("alone.mp4")]);
  await tools.waitFor(isTold("alone.mp4"), "what is said of a film of noise", 30_000);
  await page.setInputFiles("#files", [noise("noise.mp4"), { name: "noise.SRT", mimeType: "text/plain", buffer: Buffer.from(subtitles(40)) }]);
  await tools.waitFor((s) => s.flight === "noise" && isTold("noise.mp4")(s), "the flight of its subtitles, and what is said of the film", 60_000);

  // No picture in it can be decoded: it is a flight all the same.
  await page.setInputFiles("#files", [{ name: "GX010001.MP4", mimeType: "video/mp4", buffer: gopro(20) }]);
  const places = await tools.waitFor((s) => s.flight === "GX010001" && s.log?.read, "the flight of the film itself", 90_000);
  tools.check(isTold("GX010001.MP4")(places), "nobody is told that its frames are missing");
  tools.check(Math.abs(places.origin[0] - 47.3) < 1e-6 && Math.abs(places.origin[1] - 8.5) < 1e-6, `it begins at ${places.origin}`);
  await page.waitForTimeout(800);
  await tools.screenshot("places-in-film");
}
