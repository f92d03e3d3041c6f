// A film dropped beside a log: the browser decodes it, its frames stand at their times beside the plots.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { delayOfFrames, filmed } from "./films.mjs";

export const name = "a film beside a log becomes the frames of its flight";
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const log = join(repository, "../shared/data/px4_ulog/sample-small.ulg");

export async function run(page, tools) {
  if (!existsSync(log)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const { film, duration } = await filmed(page, tools, 3);
  const delay = await delayOfFrames(page);
  tools.check(Math.abs(delay) < 0.03, `frames are told ${delay.toFixed(3)} s late`); // they are 0.1 s apart
  await page.setInputFiles("#files", [log, film]);
  const opened = await tools.waitFor((s) => s.log?.read || s.toasts.some((t) => t.trouble), "the log", 90_000);
  const trouble = opened.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  const flown = await tools.waitFor((s) => s.frames > 0 && s.pictures > 0, "its frames", 60_000);
  tools.say(`${flown.frames} frames of a film of ${duration.toFixed(2)} s`);
  const wanted = duration / 0.5; // one every half second
  tools.check(flown.frames >= wanted - 1 && flown.frames <= wanted + 2, `${flown.frames} frames of ${duration} s`);
  await page.waitForTimeout(800);
  await tools.screenshot("film");
}
