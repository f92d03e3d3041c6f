// What the app asks of the browser: files in and out, storage, words for screen readers.
import { readDropped, readChosen } from "./files.js";
import { startFilm, stopFilm } from "./film.js";
import { fetchTiles, downloadTiles, downloadState, stopDownload } from "./tiles.js";

/** Shows a page to the browser's print alone; a sheet made by script, as the page allows no other. */
async function printPage(style, body) {
  const page = document.getElementById("brief");
  page.innerHTML = body;
  for (const time of page.querySelectorAll("time")) time.textContent = `${new Date().toISOString().slice(0, 16).replace("T", " ")} UTC`;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(`@media print { ${style} }`);
  document.adoptedStyleSheets = [sheet];
  await Promise.all([...page.querySelectorAll("img")].map((image) => image.decode().catch(() => {})));
  page.hidden = false;
  print();
  page.hidden = true;
}

/** Offers a blob as a download. */
function save(name, blob) {
  const address = URL.createObjectURL(blob);
  const link = Object.assign(document.createElement("a"), { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

/** What `paint` puts onto a canvas of so many pixels, as a PNG picture. */
function painted(width, height, paint) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  paint(canvas.getContext("2d"));
  return new Promise((done, fail) => {
    const take = (blob) => (blob ? done(blob) : fail(new Error(`a picture of ${width} by ${height} pixels is too large for it`)));
    canvas.toBlob(take, "image/png");
  });
}

/** An SVG drawing as a PNG picture of so many pixels. */
async function drawn(svg, width, height) {
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const picture = Object.assign(new Image(), { src: address });
    await picture.decode();
    return await painted(width, height, (to) => to.drawImage(picture, 0, 0, width, height));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** Bytes of a file that lies beside the page's program. */
async function fetchOwn(file) {
  const response = await fetch(new URL(file, import.meta.url), { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${file}: ${response.status}`);
  return new Uint8Array(await response.arrayBuffer());
}

/** Does `work` whose end the app does not await, and tells if it fails that a file of that name was not saved. */
async function saving(app, name, work) {
  try {
    await work();
  } catch (error) {
    app.tell_trouble(`${name} was not saved`, `The browser could not make it: ${error?.message || error}`);
  }
}

/** Gives the app what is read of files, and tells what is not. */
async function open(app, reading) {
  try {
    const { paths, contents, troubles } = await reading;
    if (paths.length) app.open_files(paths, contents);
    for (const [title, text] of troubles) app.tell_trouble(title, text);
  } catch (error) {
    console.error(error);
    app.tell_trouble("The files were not opened", `The page could not read them: ${error?.message || error}`);
  }
}

export function shellServices(storage, app) {
  const input = document.getElementById("files");
  const summary = document.getElementById("summary");
  const canvas = document.getElementById("app");
  input.addEventListener("change", () => {
    const reading = readChosen([...input.files]);
    input.value = "";
    canvas.focus();
    open(app, reading);
  });
  input.addEventListener("cancel", () => canvas.focus());
  return {
    askForFiles() { input.click(); },
    saveFile(name, bytes) {
      save(name, new Blob([bytes], { type: "application/octet-stream" }));
    },
    savePicture(name, svg, width, height) {
      saving(app, name, async () => save(name, await drawn(svg, width, height)));
    },
    savePixels(name, pixels, width, height) {
      saving(app, name, async () => {
        const picture = new ImageData(pixels, width, height);
        save(name, await painted(width, height, (to) => to.putImageData(picture, 0, 0)));
      });
    },
    startFilm: () => startFilm(canvas),
    stopFilm(name) {
      saving(app, name, async () => save(name, await stopFilm()));
    },
    store(key, bytes) { storage.put(key, bytes); },
    fetchOwn,
    fetchTiles,
    downloadTiles,
    downloadState,
    stopDownload,
    storeFile(key, file) { storage.putFile(key, file); },
    forget(key) { storage.remove(key); },
    failedStores() { return storage.untold.splice(0); },
    interruptedSaves() { return storage.interrupted.splice(0); },
    print(style, body) { printPage(style, body); },
    async copyLink(fragment) {
      const link = `${location.href.split("#")[0]}#${fragment}`;
      try {
        // Behind the frame that asks for it, even where there is no clipboard: the page waits as long as the prompt is open.
        await (navigator.clipboard?.writeText(link) ?? Promise.reject(new Error("no clipboard")));
        return true;
      } catch { // not allowed, or there is none, as without https
        prompt("This browser did not let the link be copied. Copy it from here:", link);
        return false;
      }
    },
    showPlace(place, replaces) {
      try {
        if (replaces) history.replaceState(place, "");
        else history.pushState(place, "");
      } catch { /* a browser takes so many within a time */ }
    },
    ownServer() { return location.origin; },
    prefersStillness() { return matchMedia("(prefers-reduced-motion: reduce)").matches; },
    isTouchedFirst() { return matchMedia("(pointer: coarse)").matches; },
    prefersLight() { return matchMedia("(prefers-color-scheme: light)").matches; },
    announce(text) { summary.textContent = text; },
  };
}

/** Files and folders dropped anywhere on the page go to the app. */
export function watchDrops(app) {
  const hint = document.getElementById("drop");
  const withFiles = (event) => event.dataTransfer?.types.includes("Files");
  let hiding;
  const take = (event) => { event.preventDefault(); event.stopImmediatePropagation(); };
  const over = (event) => {
    if (!withFiles(event)) return;
    take(event);
    event.dataTransfer.dropEffect = "copy";
    hint.hidden = false;
    clearTimeout(hiding);
    hiding = setTimeout(() => { hint.hidden = true; }, 400);
  };
  addEventListener("dragenter", over, true);
  addEventListener("dragover", over, true);
  addEventListener("drop", (event) => {
    if (!withFiles(event)) return;
    take(event);
    hint.hidden = true;
    open(app, readDropped(event.dataTransfer));
  }, true);
}
