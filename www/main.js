// Starts the page: loads the program with a visible progress, hands it its services, and takes
// over with a readable message if it cannot run.
import init, { WebHandle } from "./pkg/pilotage_web.js";
import { openStorage } from "./storage.js";
import { openTab, keepOnlyIn, tellOf } from "./tabs.js";
import { shellServices, watchDrops } from "./shell.js";
import { showTrouble, showStage, uncover } from "./cover.js";
import { registerOffline } from "./offline.js";
import { offerMirror } from "./mirror.js";
import { fragment } from "./fragment.js";

const root = document.documentElement;

/** A file of the page; asked for again where the network fails for a moment. */
async function own(path) {
  for (let tries = 1; ; tries += 1) {
    try {
      return await fetch(new URL(path, import.meta.url), { credentials: "same-origin" });
    } catch (error) {
      if (tries === 3) throw error;
      await new Promise((resolve) => { setTimeout(resolve, 250 * tries); });
    }
  }
}

/** The program's bytes, with progress told as they come; still compiled while they stream in. */
async function program() {
  const response = await own("./pkg/pilotage_web_bg.wasm");
  if (!response.ok) throw new Error(`The program could not be loaded (${response.status} ${response.statusText}).`);
  const coded = response.headers.get("content-encoding");
  const total = coded ? 0 : Number(response.headers.get("content-length"));
  let received = 0;
  const counted = response.body.pipeThrough(new TransformStream({
    transform(chunk, out) {
      received += chunk.byteLength;
      showStage(`Loading the program: ${(received / 1e6).toFixed(1)} MB`, total ? received / total : undefined);
      out.enqueue(chunk);
    },
    flush() { showStage("Starting…"); },
  }));
  return new Response(counted, { headers: { "content-type": "application/wasm" } });
}

/** Has the small program of the workers compiled at once and others when they are first needed, each once for all of
 * its workers, and sent to each worker that asks. */
function prepareWorkers() {
  const programs = new Map();
  const compiled = (program) => {
    if (!programs.has(program)) {
      const module = WebAssembly.compileStreaming(own(`./pkg/pilotage_worker_${program}_bg.wasm`));
      module.catch(() => programs.delete(program)); // and ask again when it is needed again
      programs.set(program, module);
    }
    return programs.get(program);
  };
  compiled("flying").catch((error) => {
    showTrouble("Pilotage could not start", "The part of the program that computes could not be loaded. Load the page again.", String(error?.stack ?? error));
  });
  window.sendProgram = (worker, program, lock) => {
    compiled(program).then(
      (module) => worker.postMessage({ module, lock }),
      (error) => worker.dispatchEvent(new ErrorEvent("error", { message: `a part of the program could not be loaded: ${error?.message ?? error}`, cancelable: true })),
    );
  };
}

/** What the first jobs of a visit tell, and a picture of the demo's ground, both stored by the build: bytes by key. */
async function firstSeconds() {
  const file = async (name) => {
    const response = await own(`./first/${name}`);
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    return response.arrayBuffer();
  };
  const pixels = async () => {
    const picture = await createImageBitmap(new Blob([await file("ground.jpg")]));
    const canvas = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
    canvas.drawImage(picture, 0, 0);
    return new Uint8Array(canvas.getImageData(0, 0, picture.width, picture.height).data.buffer);
  };
  const seconds = async () => new Uint8Array(await file("seconds.bin"));
  const [told, ground] = await Promise.all([seconds(), pixels()]);
  return new Map([["first seconds", told], ["first ground", ground]]);
}

function hasGraphics() {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return Boolean(context);
}

/** What is stored, once no other tab is about to change it. */
async function openDocuments() {
  const tab = await openTab();
  const storage = await openStorage(tab.keeps);
  keepOnlyIn(tab, storage);
  return { tab, storage };
}

/** Stores at once what was edited last, before the tab is left; resolves once that is done. */
async function saveNow(app, storage) {
  app.store_now();
  for (let tries = 0; storage.pending > 0 && tries < 60; tries += 1) {
    await new Promise((resolve) => { setTimeout(resolve, 50); });
  }
}

/** Looks after the workers, and notices a panic of the program and the loss of the graphics card behind `canvas`, whose
 * context is not made anew; `isKept` tells whether documents are kept. */
function keepWatch(app, canvas, isKept) {
  const end = (state, title, cause, details) => {
    if (root.dataset.ready !== "1") return; // it has ended before
    clearInterval(timer);
    root.dataset.ready = state;
    const left = isKept()
      ? "Your documents are safe in this browser and will be here when the page has loaded again."
      : "What was changed here is not kept.";
    showTrouble(title, `${cause} ${left}`, details);
  };
  const timer = setInterval(() => {
    const panic = app.panic_message();
    if (panic === undefined) return app.tick();
    end("panicked", "Pilotage has stopped", "A fault in the program ended it.", panic);
  }, 500);
  canvas.addEventListener("webglcontextlost", () => {
    app.store_now();
    end("no-graphics", "The graphics card stopped drawing", "Its driver was started anew, or the browser took its memory away.");
  });
}

async function start() {
  const begun = performance.now();
  // Begun before anything else: it takes longest.
  const first = firstSeconds().catch((error) => { console.warn("the first seconds are computed:", error); return new Map(); });
  const loading = Promise.all([openDocuments(), first, init({ module_or_path: program() })]);
  loading.catch(() => {});
  prepareWorkers();
  if (!hasGraphics()) {
    root.dataset.ready = "no-graphics";
    showTrouble("This browser cannot draw the map", "Pilotage draws with WebGL 2, which is missing or switched off here. Switch on hardware acceleration in the browser's settings, or use a current version of Chrome, Edge, Firefox or Safari.");
    return;
  }
  const [{ tab, storage }, told] = await loading;
  const loaded = performance.now();
  for (const [id, words] of [["logs", WebHandle.log_endings()], ["flown", WebHandle.flown_files()], ["places", WebHandle.exchange_names()]]) {
    document.getElementById(id).textContent = words;
  }
  const app = new WebHandle();
  for (const [key, bytes] of told) app.remember(key, bytes);
  for (const [key, kept] of storage.loaded) {
    if (kept instanceof Blob) app.remember_file(key, kept);
    else app.remember(key, kept);
  }
  if (location.hash.length > 1) {
    // A view, or a stop of the tour: `#tour=gate`.
    const asked = fragment();
    const [key, value] = asked.startsWith("tour=") ? ["tour", asked.slice(5)] : ["link", asked];
    app.remember(key, new TextEncoder().encode(value));
    // Once followed, a reload is to bring back one's own work.
    history.replaceState(null, "", location.pathname + location.search);
  }
  // Entries of this visit have a place in the app as their state; any other is a link that people opened here.
  addEventListener("hashchange", () => { if (history.state === null) location.reload(); });
  addEventListener("popstate", ({ state }) => { if (state !== null) app.go_to(state); });
  storage.loaded.clear();
  const canvas = document.getElementById("app");
  const shell = shellServices(storage, app);
  await app.start(canvas, shell);
  window.app = app;
  window.page = { storage, boot: { load_ms: loaded - begun, start_ms: performance.now() - loaded, ready_ms: performance.now() } };
  watchDrops(app);
  tab.save = () => saveNow(app, storage);
  addEventListener("visibilitychange", () => { if (document.hidden) app.store_now(); });
  tellOf(tab, storage);
  keepWatch(app, canvas, () => tab.keeps && storage.isKept);
  canvas.focus();
  offerMirror(app, canvas);
  uncover();
  root.dataset.ready = "1";
  registerOffline();
}

start().catch((error) => {
  root.dataset.ready = "error";
  showTrouble("Pilotage could not start", "Load the page again. If that does not help, the browser may be too old or short of memory.", String(error?.stack ?? error));
  console.error(error);
});
