// A worker: holds a second instance of the page's module and works in slices, listening in between.
import { initSync, WorkerHandle } from "./pkg/pilotage_web.js";

let worker;
let scheduled = false;
const { port1, port2 } = new MessageChannel();
const schedule = () => {
  if (scheduled) return;
  scheduled = true;
  port2.postMessage(0);
};
port1.onmessage = () => {
  scheduled = false;
  if (worker.turn()) schedule();
};

onmessage = ({ data }) => {
  if (data.module) {
    initSync({ module: data.module });
    worker = new WorkerHandle((bytes) => postMessage(bytes, [bytes.buffer]));
    // Held for as long as this worker lives; the page waits for it and so learns of its end.
    navigator.locks?.request(data.lock, () => { postMessage("held"); return new Promise(() => {}); });
  } else if (data === "crash") {
    worker.crash();
  } else {
    worker.receive(data);
    schedule();
  }
};
