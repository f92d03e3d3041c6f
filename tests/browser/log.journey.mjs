// A flight log dropped on the page: read in a worker, looked over, its fields plotted, its flight flown.
import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "logs of ArduPilot and PX4 open by drop: overview, fields over time; what is none is refused";
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const data = join(repository, "../shared/data");

async function open(page, tools, file, wanted) {
  await page.setInputFiles("#files", [file]);
  const opened = await tools.waitFor(
    (s) => (s.log?.file === wanted && s.log.read) || s.toasts.some((t) => t.trouble),
    `${wanted} to be read`, 60_000);
  const trouble = opened.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  return opened.log;
}

export async function run(page, tools) {
  if (!existsSync(data)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  const bin = await open(page, tools, join(data, "ardupilot_bin/test.BIN"), "test.BIN");
  tools.say(`${bin.topics} topics, ${bin.messages} messages, ${bin.parameters} parameters; ${bin.findings.join("; ")}`);
  tools.check(bin.format === "Dataflash" && bin.parameters > 700, JSON.stringify(bin));
  const before = await tools.waitFor((s) => s.log.panels.length > 0 && s.log.fields > 0, "its first fields", 20_000);
  await tools.click(await tools.find(null, "Fields of the log"));
  await tools.type("Search fields of the log", "gyrz");
  await tools.click(await tools.find(null, /^IMU\.GyrZ in a new plot$/));
  const more = await tools.waitFor((s) => s.log.panels.some((p) => p.some((f) => /^IMU\.GyrZ$/.test(f))), "a plot of the gyroscope");
  await tools.waitFor((s) => s.log.fields > bin.fields && s.log.points > 0, "its samples");
  tools.check(more.log.panels.length === before.log.panels.length + 1, JSON.stringify(more.log.panels));
  await page.waitForTimeout(800);
  await tools.screenshot("log-dataflash");

  const ulg = await open(page, tools, join(data, "px4_ulog/sample.ulg"), "sample.ulg");
  tools.say(`${ulg.topics} topics, ${ulg.messages} messages; ${ulg.findings.join("; ")}`);
  tools.check(ulg.format === "Ulog" && ulg.topics > 10, JSON.stringify(ulg));
  await page.waitForTimeout(800);
  await tools.screenshot("log-ulog");

  const folder = mkdtempSync(join(tmpdir(), "log-"));
  const none = join(folder, "letter.bin");
  writeFileSync(none, "Dear engineer, this is no log.\n".repeat(40));
  await page.setInputFiles("#files", [none]);
  const refused = await tools.waitFor((s) => s.toasts.find((t) => t.trouble), "the letter to be refused", 20_000);
  const said = refused.toasts.find((t) => t.trouble);
  tools.check(said.text.includes("letter.bin") && refused.log.file === "sample.ulg", JSON.stringify(said));
  tools.say(`${said.title}: ${said.text}`);
}
