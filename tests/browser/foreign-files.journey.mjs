// Files of other programs that are no flight log: each is refused by what it is and what to do with it. A zip of a log
// and a table opens.
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { zip } from "./zip.mjs";

export const name = "files of other programs are refused by their name, and a zip of a log and a table opens";
export const tags = ["readers"];

const log = join(fileURLToPath(new URL("../../", import.meta.url)), "../shared/data/ardupilot_bin/test.BIN");
const at = (offset, text) => Buffer.concat([Buffer.alloc(offset), Buffer.from(text, "latin1"), Buffer.alloc(64)]);

/** Name, content, and what has to be said of it. */
const rest = "\0".repeat(200);
const kinds = [
  ["secret.ulge", "ULogEnc\x01", "encrypted"],
  ["walk.db3", `SQLite format 3\0${rest}CREATE TABLE topics(id INTEGER, serialization_format TEXT)${rest}`, "ROS 2"],
  ["notes.db", `SQLite format 3\0${rest}CREATE TABLE a(b)${rest}`, "database of SQLite"],
  ["race.bfl", "H Product:Blackbox flight data recorder\n", "blackbox"],
  ["portrait.bin", "\xff\xd8\xff\xe1", "JPEG"],
  ["log.gz", "\x1f\x8b\x08", "gzip"],
  ["logs.tar", at(257, "ustar"), "tar"],
  ["FLY012.DAT", at(16, "BUILD"), "DJI aircraft"],
  ["clip.bin", "\0\0\0\x18ftypmp42", "film"],
  ["page.bin", "<!DOCTYPE html><html></html>\n", "web page"],
  ["values.parquet", "PAR1", "Parquet"],
  ["empty.bin", "", "empty"],
];

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const folder = mkdtempSync(join(tmpdir(), "foreign-"));
  for (const [file, content, words] of kinds) {
    const bytes = Buffer.isBuffer(content) ? content : Buffer.from(content, "latin1");
    const place = join(folder, file);
    writeFileSync(place, bytes);
    await page.setInputFiles("#files", [place]);
    const refused = await tools.waitFor((s) => s.toasts.some((t) => t.trouble && t.text.includes(file)), `${file} to be refused`, 30_000);
    const said = refused.toasts.find((t) => t.trouble && t.text.includes(file)).text;
    tools.check(said.toLowerCase().includes(words.toLowerCase()), `${file}: ${said}`);
    tools.check(refused.flight === before.flight, `${file} took the place of the flight`);
  }
  await tools.screenshot("foreign-files");
  if (!existsSync(log)) {
    tools.say("the zip was skipped: no shared data");
    return;
  }
  const both = join(folder, "flight.zip");
  writeFileSync(both, zip([["logs/test.BIN", readFileSync(log)], ["logs/weather.csv", Buffer.from("t,temperature\n0,21\n1,22\n")]]));
  await page.setInputFiles("#files", [both]);
  const opened = await tools.waitFor((s) => s.log?.read && s.log.file.endsWith("test.BIN"), "the log in the zip", 60_000);
  tools.check(opened.log.format === "Dataflash" && opened.log.topics > 10, JSON.stringify(opened.log));
}
