// A film dropped beside a log: the browser decodes it, its frames stand at their times beside the plots.
import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "a film beside a log becomes the frames of its flight";
export const tags = ["readers"];

const repository = fileURLToPath(new URL("../../", import.meta.url));
const log = join(repository, "../shared/data/px4_ulog/sample-small.ulg");

/** A film of about `seconds`, recorded by the browser itself, and how long it came to be: a busy machine drops its end. */
const recorded = (page, seconds) => page.evaluate(async (length) => {
  const canvas = Object.assign(document.createElement("canvas"), { width: 320, height: 240 });
  const pen = canvas.getContext("2d");
  const recorder = new MediaRecorder(canvas.captureStream(15), { mimeType: "video/webm" });
  const parts = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const ended = new Promise((done) => { recorder.onstop = done; });
  recorder.start();
  const begun = performance.now();
  await new Promise((done) => {
    const draw = () => {
      const now = (performance.now() - begun) / 1000;
      pen.fillStyle = `hsl(${90 * now}, 60%, 40%)`;
      pen.fillRect(0, 0, 320, 240);
      pen.fillStyle = "white";
      pen.fillText(now.toFixed(2), 20, 40);
      if (now < length) setTimeout(draw, 50);
      else done();
    };
    draw();
  });
  recorder.stop();
  await ended;
  const blob = new Blob(parts);
  const video = Object.assign(document.createElement("video"), { muted: true, src: URL.createObjectURL(blob) });
  const event = (kind) => new Promise((done) => video.addEventListener(kind, done, { once: true }));
  await event("loadeddata");
  video.currentTime = 1e9; // its head does not say how long it is
  await event("seeked");
  return { bytes: [...new Uint8Array(await blob.arrayBuffer())], duration: video.duration };
}, seconds);

export async function run(page, tools) {
  if (!existsSync(log)) {
    tools.say("skipped: no shared data");
    return;
  }
  await tools.waitReady();
  await tools.waitFor((s) => s.flight !== null, "the demo", 120_000);
  const film = join(mkdtempSync(join(tmpdir(), "film-")), "down.webm");
  let taken = await recorded(page, 3);
  if (taken.duration < 1) taken = await recorded(page, 9); // a busy machine records a part of the time only
  const { bytes, duration } = taken;
  tools.check(duration > 1, `a film of ${duration} s was recorded`);
  writeFileSync(film, Buffer.from(bytes));
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
