// A Chromium with an empty profile, drawing in software so that it runs on a machine without screen.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { chromium } from "playwright-core";

const names = ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome"];

/** Size of the window in CSS pixels: the one the page is designed for. */
export const viewport = { width: 1440, height: 900 };

const switches = [
  "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
  "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

function program() {
  const folders = (process.env.PATH ?? "").split(delimiter);
  const found = process.env.PILOTAGE_CHROMIUM
    ?? names.flatMap((name) => folders.map((folder) => join(folder, name))).find(existsSync);
  if (!found) throw new Error("no Chromium found; install it or name it in PILOTAGE_CHROMIUM");
  return found;
}

/** Launches the browser; `close` ends it and throws its profile away. */
export async function launch() {
  const profile = mkdtempSync(join(tmpdir(), "pilotage-"));
  const remove = () => rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  try {
    const context = await chromium.launchPersistentContext(profile, {
      executablePath: program(), headless: true, viewport, args: switches,
    });
    const close = async () => { await context.close(); remove(); };
    return { context, page: context.pages()[0] ?? await context.newPage(), close };
  } catch (error) {
    remove();
    throw error;
  }
}
