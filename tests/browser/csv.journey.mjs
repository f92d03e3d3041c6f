// Tables of a flight dropped on the page: what their columns mean is asked, the flight is looked over and flown, any
// column is plotted, and it is there again.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "CSV tables of a flight open by drop: their columns are guessed, looked over, plotted, and flown";
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const folder = join(repository, "../shared/data/inertialnav_x8");

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const kinds = ["ATT", "GPS", "IMU", "NTUN", "MAG"];
  await page.setInputFiles("#files", kinds.map((kind) => join(folder, `TestLog2_${kind}.csv`)));
  const asked = await tools.waitFor((s) => s.columns || s.toasts.some((t) => t.trouble), "the question", 120_000);
  const trouble = asked.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  const { tables, lacks } = asked.columns;
  const used = tables.filter((t) => t.used).map((t) => t.file).sort();
  tools.check(used.join() === "TestLog2_ATT.csv,TestLog2_GPS.csv,TestLog2_IMU.csv,TestLog2_NTUN.csv", used.join());
  tools.check(lacks === null, lacks);
  const roles = (file) => Object.fromEntries(tables.find((t) => t.file === file).columns.map((c) => [c.name, `${c.role} ${c.unit}`]));
  const gps = roles("TestLog2_GPS.csv");
  tools.check(gps.T === "time ms" && gps.Lat === "latitude deg", JSON.stringify(gps));
  await tools.click(await tools.find(null, "Columns of TestLog2_GPS.csv"));
  await page.waitForTimeout(500);
  await tools.screenshot("csv-columns");

  await tools.click(await tools.find("Button", "Open flight"));
  const flown = await tools.waitFor(
    (s) => (s.flight !== before.flight && s.run_complete) || s.toasts.some((t) => t.trouble),
    "the flight to be navigated", 150_000);
  const failed = flown.toasts.find((t) => t.trouble);
  tools.check(!failed, `${failed?.title}: ${failed?.text}`);
  const log = flown.log;
  tools.check(log?.read && log.format === "Tables" && log.topics === 4, JSON.stringify(log));
  tools.check(flown.side_tab === "log" && log.panels.flat().includes("Roll"), `${flown.side_tab}, ${JSON.stringify(log.panels)}`);
  tools.say(`${log.topics} tables, ${log.messages} rows; ${log.findings.join("; ")}`);
  await tools.find(null, /^In the air/);
  await tools.find(null, "TestLog2_ATT.Roll");
  await page.waitForTimeout(800);
  await tools.screenshot("csv-flight");

  // A column that a flight has no place for.
  await tools.click(await tools.find(null, "Fields of the log"));
  await tools.type("Search fields of the log", "erroryaw");
  await tools.click(await tools.find(null, /^TestLog2_ATT\.ErrorYaw in a new plot$/));
  const plotted = await tools.waitFor(
    (s) => s.log.panels.some((p) => p.includes("TestLog2_ATT.ErrorYaw")) && s.log.fields > log.fields && s.log.points > log.points,
    "a plot of the column", 20_000);
  tools.check(plotted.log.panels.length === log.panels.length + 1, JSON.stringify(plotted.log.panels));
  await tools.click(await tools.find(null, "Colour the track by TestLog2_ATT.ErrorYaw"));
  await tools.waitFor((s) => s.log.track_by === "TestLog2_ATT.ErrorYaw", "the coloured track");
  await page.waitForTimeout(800);
  await tools.screenshot("csv-column");

  await page.waitForFunction(() => window.page.storage.pending === 0 && window.page.storage.written > 0, null, { timeout: 30_000 });
  await page.waitForTimeout(2500); // the app stores the files, then what is open
  await page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
  await page.reload();
  await tools.waitReady();
  const again = await tools.waitFor((s) => s.run_complete, "the flight to be navigated again", 150_000);
  tools.check(again.flight === flown.flight, `after the reload ${again.flight} was open`);
  tools.check(again.log?.read && again.log.topics === 4, `after the reload: ${JSON.stringify(again.log)}`);
}
