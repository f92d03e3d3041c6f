// Films that the browser records of itself.
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** A film of about `seconds`, ten frames each, recorded by the browser itself, and how long it came to be: a busy machine
 * drops its end. It stays in the page, as `film`. */
const recorded = (page, seconds) => page.evaluate(async (length) => {
  const canvas = Object.assign(document.createElement("canvas"), { width: 320, height: 240 });
  const pen = canvas.getContext("2d");
  const stream = canvas.captureStream(0);
  const recorder = new MediaRecorder(stream, { mimeType: "video/webm" });
  const parts = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const ended = new Promise((done) => { recorder.onstop = done; });
  recorder.start();
  const drawn = window.drawn = []; // when each frame was, in seconds
  const begun = performance.now();
  await new Promise((done) => {
    const draw = () => {
      const now = (performance.now() - begun) / 1000;
      pen.fillStyle = `hsl(${90 * now}, 60%, 40%)`;
      pen.fillRect(0, 0, 320, 240);
      pen.fillStyle = "white";
      pen.fillText(now.toFixed(2), 20, 40);
      for (let bit = 0; bit < 8; bit += 1) { // its number
        pen.fillStyle = drawn.length >> bit & 1 ? "white" : "black";
        pen.fillRect(40 * bit, 200, 40, 40);
      }
      drawn.push(now);
      stream.getVideoTracks()[0].requestFrame();
      if (now < length) setTimeout(draw, 100);
      else done();
    };
    draw();
  });
  recorder.stop();
  await ended;
  const blob = window.film = new Blob(parts);
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

/** By how much the page tells the frames of the film that it recorded last later than they were drawn, in seconds, in the
 * middle of them. */
export const delayOfFrames = (page) => page.evaluate(async () => {
  const { framesOf } = await import("./video.js");
  const { frames } = await framesOf("down.webm", window.film);
  const rows = new TextDecoder().decode(frames.pop()[1]).trim().split("\n").slice(1);
  const delays = [];
  let first;
  for (const [at, [, jpeg]] of frames.entries()) {
    const canvas = new OffscreenCanvas(320, 240).getContext("2d", { willReadFrequently: true });
    canvas.drawImage(await createImageBitmap(jpeg), 0, 0);
    let number = 0;
    for (let bit = 0; bit < 8; bit += 1) number |= (canvas.getImageData(40 * bit + 20, 220, 1, 1).data[0] > 128) << bit;
    const delay = Number(rows[at].split(",")[0]) - window.drawn[number];
    first ??= delay; // the film begins with its first frame
    delays.push(delay - first);
  }
  return delays.sort((a, b) => a - b)[Math.floor(delays.length / 2)];
});
