// Photos that say where and when they were taken are a flight by themselves, and are looked over as logs are.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "photos that say where they were taken open with an overview and plots, and say what they lack";
export const tags = ["readers"];

const folder = join(fileURLToPath(new URL("../../", import.meta.url)), "../shared/data/caliterra");

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const photos = ["IMG_9360_original.jpg", "IMG_9400_original.jpg"].map((name) => join(folder, name));
  await page.setInputFiles("#files", photos);
  const opened = await tools.waitFor((s) => s.log?.read && s.log.format === "Photos", "the photos to open", 120_000);
  tools.check(opened.log.messages === photos.length && opened.side_tab === "log", JSON.stringify(opened.log));
  // Two photos say no heading: that they cannot be flown by airspeed is said, and takes nothing away.
  const flown = await tools.waitFor((s) => s.log.unnavigable, "why they are not flown", 60_000);
  tools.check(/heading/.test(flown.log.unnavigable), flown.log.unnavigable);
  tools.say(`${flown.log.messages} photos; ${flown.log.unnavigable}`);
  tools.check(flown.log.panels.flat().includes("GPS height"), JSON.stringify(flown.log.panels));
  // They are on no map of another flight, with their places and pictures.
  const seen = await tools.waitFor((s) => s.flight && s.pictures === photos.length, "the photos themselves", 20_000);
  tools.check(seen.landmarks.length === 0, JSON.stringify(seen.landmarks));
  await page.waitForTimeout(800);
  await tools.screenshot("photos");
}
