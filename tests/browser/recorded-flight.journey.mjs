// A recorded flight, opened as its author left it, with landmarks picked on its own map.
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "a recorded flight opens from its folder, is navigated, and is there again after a reload";
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const folder = join(repository, "../shared/data/brighton_beach");
const flights = join(repository, "tests/flights/brighton");

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const files = ["frames.csv", "ortho.jpg", "ortho_georef.json"].map((f) => join(folder, f));
  const pictures = readdirSync(join(folder, "frames")).map((f) => join(folder, "frames", f));
  const mission = existsSync(flights) ? readdirSync(flights).map((f) => join(flights, f)) : [];
  await page.setInputFiles("#files", [...files, ...pictures, ...mission]);
  const opened = await tools.waitFor((s) => (s.flight && s.flight !== before.flight) || s.toasts.some((t) => t.trouble), "the flight to open", 120_000);
  const trouble = opened.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  const flown = await tools.waitFor((s) => s.run_complete, "the flight to be navigated", 150_000);
  tools.check(flown.frames === 18, `${flown.frames} frames`);
  tools.check(flown.log?.read && flown.log.format === "Tables" && flown.side_tab === "log", JSON.stringify(flown.log));
  tools.say(`${flown.log.topics} tables, ${flown.log.messages} rows; ${flown.log.findings.join("; ")}`);
  tools.say(`${flown.landmarks.length} landmarks, ${flown.candidates} looked for, ${flown.accepted} accepted`);
  tools.check(flown.landmarks.length === 0 || flown.accepted >= 10, "hardly a landmark was accepted");
  await tools.waitFor((s) => s.map.tiles > 0, "its map", 60_000);
  await tools.waitFor((s) => !s.map.follow && s.map.metres_per_point < 0.6, "the map to be fitted to the flight", 10_000);
  await tools.screenshot("recorded-flight");

  await page.waitForFunction(() => window.page.storage.pending === 0 && window.page.storage.written > 0, null, { timeout: 30_000 });
  await page.waitForTimeout(2500); // the app stores the files, then what is open
  await page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
  await page.reload();
  await tools.waitReady();
  const again = await tools.waitFor((s) => s.run_complete, "the flight to be navigated again", 150_000);
  tools.check(again.flight === flown.flight && again.frames === 18, `after the reload ${again.flight} was open`);
  tools.check(again.accepted === flown.accepted, `${again.accepted} accepted after the reload, ${flown.accepted} before`);
}
