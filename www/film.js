// A film of the canvas, made by the browser's own encoder.
const kinds = [["video/webm;codecs=vp9", "webm"], ["video/webm;codecs=vp8", "webm"], ["video/webm", "webm"], ["video/mp4", "mp4"]];
const perSecond = 30; // pictures
const bits = 8e6; // per second

let recorder = null;

/** Begins a film of the canvas; the ending of its file's name, empty if this browser makes none. */
export function startFilm(canvas) {
  const kind = globalThis.MediaRecorder && kinds.find(([type]) => MediaRecorder.isTypeSupported(type));
  if (!kind || !canvas.captureStream) return "";
  const [mimeType, ending] = kind;
  try {
    const begun = new MediaRecorder(canvas.captureStream(perSecond), { mimeType, videoBitsPerSecond: bits });
    begun.parts = [];
    begun.addEventListener("dataavailable", ({ data, target }) => target.parts.push(data));
    begun.start(1000);
    recorder = begun;
    return ending;
  } catch (error) {
    console.warn("no film can be made:", error);
    return "";
  }
}

/** Ends the film that is being made and resolves to it as a blob, once its last part is there. */
export function stopFilm() {
  const ended = recorder;
  recorder = null;
  return new Promise((done, fail) => {
    if (!ended) throw new Error("no film was being made");
    const finish = () => {
      for (const track of ended.stream.getTracks()) track.stop();
      const film = new Blob(ended.parts, { type: ended.mimeType });
      if (film.size > 0) done(film);
      else fail(new Error("its encoder gave no picture"));
    };
    if (ended.state === "inactive") return finish(); // by a fault of its own
    ended.addEventListener("stop", finish);
    ended.stop();
  });
}
