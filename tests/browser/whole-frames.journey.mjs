// A recorded flight out of a zip, navigated by whole pictures: no landmark, its turned pictures noticed.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { zip } from "./zip.mjs";

export const name = "a recorded flight opens from a zip and is navigated by whole pictures laid on its map, and its overview tells the lag";
export const long = true;
export const tags = ["readers", "maps"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const folder = join(repository, "../shared/data/brighton_beach");
const flight = join(repository, "tests/flights/brighton/flight.json");

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 20, "the demo", 150_000);
  const layout = { ...JSON.parse(readFileSync(flight, "utf8")), data: undefined };
  delete layout.frames.stored_turn_deg;
  const files = [["flight.json", JSON.stringify(layout)]];
  for (const name of ["frames.csv", "ortho.jpg", "ortho_georef.json"]) files.push([name, readFileSync(join(folder, name))]);
  for (const name of readdirSync(join(folder, "frames"))) files.push([`frames/${name}`, readFileSync(join(folder, "frames", name))]);
  await page.setInputFiles("#files", [{ name: "brighton.zip", mimeType: "application/zip", buffer: zip(files) }]);
  await tools.waitFor((s) => (s.flight && s.flight !== before.flight) || s.toasts.some((t) => t.trouble), "the flight to open", 120_000);
  const opened = await tools.waitFor((s) => s.flight && s.flight !== before.flight, "the flight");
  const trouble = opened.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);

  // It came without a mission: its pictures are laid on the map that came with it, and people are told.
  await tools.waitFor((s) => s.toasts.some((t) => /laid on the map as a whole/.test(t.text)), "by what it is navigated", 60_000);
  const flown = await tools.waitFor((s) => s.run_complete && s.laid >= 17, "the flight by whole pictures", 200_000);
  tools.say(`${flown.laid} of ${flown.frames} pictures laid on the map`);
  await tools.click(await tools.find(null, "Filter settings"));
  await tools.find(null, "Lay whole pictures on the map");
  await page.waitForTimeout(800);
  await tools.screenshot("whole-frames");

  // Nobody asked for it: the overview tells what the pictures say of the camera's clock.
  const told = await tools.waitFor((s) => s.log?.findings.some((f) => /lag|stamped/.test(f)), "the lag in the overview", 60_000);
  tools.say(`${told.log.findings.join("; ")}`);
  await tools.click(await tools.find(null, "Close"));
  await tools.click(await tools.find(null, "Log", 10_000));
  await tools.find(null, /Pictures are stamped|No lag between/);
  await page.waitForTimeout(500);
  await tools.screenshot("lag-in-overview");
}
