// Films that the browser records of itself.
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

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

/** A file of such a film, and how long it lasts. */
export async function filmed(page, tools, seconds) {
  const film = join(mkdtempSync(join(tmpdir(), "film-")), "down.webm");
  let taken = await recorded(page, seconds);
  if (taken.duration < 1) taken = await recorded(page, 3 * seconds); // a busy machine records a part of the time only
  const { bytes, duration } = taken;
  tools.check(duration > 1, `a film of ${duration} s was recorded`);
  writeFileSync(film, Buffer.from(bytes));
  return { film, duration };
}
