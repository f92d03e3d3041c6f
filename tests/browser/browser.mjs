// A Chromium with an empty profile, drawing in software so that it runs on a machine without screen.
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
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
/** Where nobody judges how smoothly the page moves, a graphics card in software draws the canvas alone: it takes a
 * second to get ready for the window around it. */
const calmSwitches = ["--disable-gpu-compositing"];

function program() {
  const folders = (process.env.PATH ?? "").split(delimiter);
  const found = process.env.PILOTAGE_CHROMIUM
    ?? names.flatMap((name) => folders.map((folder) => join(folder, name))).find(existsSync);
  if (!found) throw new Error("no Chromium found; install it or name it in PILOTAGE_CHROMIUM");
  return found;
}

/** Pixels of the canvas for one of the page's, each way, where nobody asked for pictures to look at: filling them is
 * a third of what journeys cost without a graphics card. */
const coarse = 0.5;
/** Frames a second of journeys that do not judge how smoothly the page moves. */
const calm = 8;
/** Milliseconds for which a frame that nobody looks at stays on the screen: the program makes all of its frames, but
 * without a graphics card the cores that it computes with fill their pixels, which was a third of what journeys cost. */
const unseen = process.env.CI ? 10_000 : 2000;
/** Steps after which the demo's flight rests in journeys that do not say how many they need. */
const enough = 60;

/** Launches the browser; `close` ends it and throws its profile away. `smooth` pages paint as often and as finely as
 * they do for people, others only what a screenshot shows or a frame now and then, unless every frame is to be `painted`;
 * the demo is flown until it `flies` that many steps, all of them if that is true, and what nobody asks for is left undone unless it is to be done
 * `ahead`; `screen` is what is not usual about it: `width`, `height`, whether it is for `touch`, and
 * pixels for each of the page's, `sharpness`; a browser that is `forgetful` keeps no data of any site. */
export async function launch({ smooth = false, flies = enough, ahead = false, painted = false, screen = {}, forgetful = false } = {}) {
  const profile = mkdtempSync(join(tmpdir(), "pilotage-"));
  if (forgetful) {
    mkdirSync(join(profile, "Default"));
    writeFileSync(join(profile, "Default/Preferences"), JSON.stringify({ profile: { default_content_setting_values: { cookies: 2 } } }));
  }
  const remove = () => rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  try {
    const { width, height, touch = false, sharpness } = { ...viewport, ...screen };
    const deviceScaleFactor = sharpness ?? (smooth || process.env.PILOTAGE_SHARP ? 1 : coarse);
    const context = await chromium.launchPersistentContext(profile, {
      executablePath: program(), headless: true, viewport: { width, height }, deviceScaleFactor, args: smooth ? switches : [...switches, ...calmSwitches], colorScheme: "dark",
      hasTouch: touch, isMobile: touch,
    });
    if (!smooth) await context.addInitScript(paintSeldom, { rate: calm, unseen: painted ? 0 : unseen });
    if (!smooth && !painted) context.on("page", paintForPictures).pages().forEach(paintForPictures);
    if (deviceScaleFactor !== 1) await context.addInitScript(measureByRatio);
    if (flies !== true) await context.addInitScript(restFlight, flies);
    if (!ahead) await context.addInitScript(leaveAhead);
    const close = async () => { await context.close(); remove(); };
    return { context, page: context.pages()[0] ?? await context.newPage(), profile, close };
  } catch (error) {
    remove();
    throw error;
  }
}

/** Runs in the page before anything else of it: the size of the canvas in pixels of the screen knows nothing of the
 * ratio that is pretended, so that the page has to go by the ratio. */
function measureByRatio() {
  delete ResizeObserverEntry.prototype.devicePixelContentBoxSize;
}

/** Has `page` paint what it shows before a screenshot is taken of it. */
function paintForPictures(page) {
  const screenshot = page.screenshot.bind(page);
  page.screenshot = async (options) => {
    await page.evaluate(() => window.paintNow?.());
    return screenshot(options);
  };
}

/** Runs in the page before anything else of it: lets it make no more than `rate` frames a second, and paint one only
 * if the last is on the screen for `unseen` milliseconds or `window.paintNow` is asked for it, which has somebody `look`
 * at the canvas while it holds what was painted. */
function paintSeldom({ rate, unseen }) {
  let painted = -Infinity; // when
  let paints = true; // in the frame that is made
  let canvas = null; // on which this frame was painted
  const lookers = []; // who wait to see a frame painted
  const { prototype } = window.WebGL2RenderingContext;
  for (const name of ["clear", "drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
    const draw = prototype[name];
    prototype[name] = function drawSeldom(...what) {
      if (!paints) return;
      draw.apply(this, what);
      canvas = this.canvas;
    };
  }
  const begin = (now) => {
    paints = lookers.length > 0 || now - painted >= unseen;
    if (paints) painted = now;
  };
  const own = { request: window.requestAnimationFrame.bind(window), cancel: window.cancelAnimationFrame.bind(window) };
  const pending = new Map(); // what is asked for, by number: how to call it off
  let numbers = 0;
  let last = -Infinity;
  window.requestAnimationFrame = (callback) => {
    const number = (numbers += 1);
    const paint = () => {
      const frame = own.request((now) => {
        pending.delete(number);
        last = performance.now();
        begin(last);
        canvas = null;
        callback(now);
        if (canvas) lookers.splice(0).forEach((look) => look(canvas));
      });
      pending.set(number, () => own.cancel(frame));
    };
    const wait = last + 1000 / rate - performance.now();
    if (wait <= 0) {
      paint();
    } else {
      const timer = setTimeout(paint, wait);
      pending.set(number, () => clearTimeout(timer));
    }
    return number;
  };
  window.cancelAnimationFrame = (number) => {
    pending.get(number)?.();
    pending.delete(number);
  };
  window.paintNow = async (whoLooks) => {
    const frame = () => new Promise((done) => { window.requestAnimationFrame(done); });
    const showAnew = () => window.dispatchEvent(new Event("pageshow")); // what the program takes for a reason to do so
    showAnew();
    for (let frames = 0; frames < 2; frames += 1) await frame(); // in which everything finds its place
    let isPainted = false;
    lookers.push((painted) => { isPainted = true; whoLooks?.(painted); });
    showAnew();
    for (let frames = 0; frames < 8 && !isPainted; frames += 1) await frame();
    lookers.length = 0; // a page without a canvas, or whose graphics card is gone, paints nothing
    await frame();
    return isPainted;
  };
}

/** Runs in the page, too: lets the demo's flight rest once that many steps of it are flown. */
function restFlight(steps) {
  const timer = setInterval(() => {
    if (typeof window.app?.state !== "function") return; // before, it is the canvas of that name
    const { flight, run_steps: flown } = JSON.parse(window.app.state());
    if (flight !== null && flight !== "distinct-400ft-wind") return clearInterval(timer);
    if (flown < steps) return;
    window.app.rest_flight();
    clearInterval(timer);
  }, 250);
}

/** Runs in the page, too: has it leave undone what nobody asked for. */
function leaveAhead() {
  const timer = setInterval(() => {
    if (typeof window.app?.leave_ahead !== "function") return;
    window.app.leave_ahead();
    clearInterval(timer);
  }, 20);
}
