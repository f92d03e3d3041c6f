// Frames of a film, taken by the browser's own decoder: JPEG files and a table of their times.

const FILM = /\.(mp4|m4v|mov|webm|mkv)$/i; // the program's advice on films names these
/** Seconds between two frames, and how many frames are taken of a film at most. */
const INTERVAL = 0.5, MOST = 1200;
/** Milliseconds to wait for a frame before the film counts as unreadable. */
const PATIENCE = 20_000;

export const isFilm = (path) => FILM.test(path);

/** Whether a film has a track of places (GoPro's, `gpmd`), by its index. */
export async function tellsPlaces(film) {
  for (let at = 0; at + 16 <= film.size;) {
    const head = new DataView(await film.slice(at, at + 16).arrayBuffer());
    let size = head.getUint32(0);
    if (size === 0) size = film.size - at;
    if (size === 1) size = Number(head.getBigUint64(8));
    if (size < 8) return false;
    if (head.getUint32(4) === 0x6d6f6f76) { // moov
      return (await film.slice(at, at + Math.min(size, 1 << 26)).text()).includes("gpmd");
    }
    at += size;
  }
  return false;
}

const NO_DECODER = "This browser cannot decode it: it is damaged, or of a kind for which there is no decoder here, as is often so with H.265. Convert it to H.264, or open it in another browser.";

/** Waits for an event of the film, or throws what went wrong with it, in words. */
function next(film, event) {
  return new Promise((resolve, reject) => {
    const end = (act) => (value) => { clearTimeout(timer); film.onerror = null; act(value); };
    const refuse = end(() => reject(new Error(film.error ? "It is damaged or breaks off there." : `Nothing came of it for ${PATIENCE / 1000} s.`)));
    const timer = setTimeout(refuse, PATIENCE);
    film.addEventListener(event, end(resolve), { once: true });
    film.onerror = refuse;
  });
}

/** Opens a film for its frames, or throws why that cannot be, in words. */
async function open(film, address) {
  Object.assign(film, { muted: true, preload: "auto", src: address });
  await next(film, "loadeddata").catch(() => { throw new Error(NO_DECODER); });
  if (film.videoWidth === 0) throw new Error(NO_DECODER); // only its sound can be played
  if (!Number.isFinite(film.duration)) { // a recording whose head does not say how long it is
    film.currentTime = 1e9;
    await next(film, "seeked");
  }
}

/** A line above the page that tells how far it is, with a button that ends it. */
function progress(name) {
  const line = document.getElementById("film");
  const stop = line.querySelector("button");
  const told = { isStopped: false, tell(text) { line.querySelector("span").textContent = `${name}: ${text}`; }, end() { line.hidden = true; } };
  stop.onclick = () => { told.isStopped = true; };
  line.hidden = false;
  return told;
}

/** Seconds at which the frame that is shown begins: before the moment that was asked for, by up to a frame. */
function timeOf(film) {
  if (!globalThis.VideoFrame) return film.currentTime;
  const frame = new VideoFrame(film);
  frame.close();
  return frame.timestamp / 1e6;
}

let before = Promise.resolve(); // the film that was asked for last

/** The frames of a film: [path, picture] of each, and [path, bytes] of `frames.csv` beside them, and what it `lack`s, if
 * anything, and why. What was taken before a stop or a fault stays. The browser keeps the pictures, outside the memory of the page.
 * One film after the other: there is one line that tells of it, and one decoder is enough. */
export function framesOf(path, file) {
  const own = before.then(() => taken(path, file));
  before = own.catch(() => {});
  return own;
}

async function taken(path, file) {
  const told = progress(path);
  const film = document.createElement("video");
  const address = URL.createObjectURL(file);
  const frames = [];
  let table = "time,file\n", count = 0, lack;
  try {
    await open(film, address);
    const step = Math.max(INTERVAL, film.duration / MOST);
    count = Math.ceil(film.duration / step);
    const canvas = new OffscreenCanvas(film.videoWidth, film.videoHeight);
    const context = canvas.getContext("2d");
    let last = -Infinity;
    for (let i = 0; i * step < film.duration && !told.isStopped; i += 1) {
      told.tell(`frame ${i + 1} of ${count}`);
      film.currentTime = i * step;
      await next(film, "seeked");
      const time = timeOf(film);
      if (time <= last) continue; // a film with fewer frames than are asked for
      last = time;
      context.drawImage(film, 0, 0);
      const jpeg = await canvas.convertToBlob({ type: "image/jpeg", quality: 0.92 });
      const frame = `frame-${String(i).padStart(5, "0")}.jpg`;
      frames.push([`${path}.frames/${frame}`, jpeg]);
      table += `${time.toFixed(3)},${frame}\n`;
    }
  } catch (error) {
    const what = frames.length === 0 ? "No frame was taken" : `Only ${frames.length} of ${count} frames were taken`;
    lack = { what, why: error.message };
  } finally {
    told.end();
    URL.revokeObjectURL(address);
    film.removeAttribute("src");
  }
  if (frames.length > 0) frames.push([`${path}.frames/frames.csv`, new TextEncoder().encode(table)]);
  return { frames, lack };
}
