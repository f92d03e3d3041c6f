// A worker: holds an instance of its program and works in slices, listening in between.

let worker;
/** Messages that came before the program. */
const early = [];
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

function hear(data) {
  if (data === "crash") return worker.crash();
  worker.receive(data);
  schedule();
}

/** Serves the page with a program, once it sends it: `initSync` loads it, `make` makes a worker of it. */
export function serve(initSync, make) {
  onmessage = ({ data }) => {
    if (data.module) {
      initSync({ module: data.module });
      worker = make((bytes) => postMessage(bytes, [bytes.buffer]));
      // Held for as long as this worker lives; the page waits for it and so learns of its end.
      const held = navigator.locks?.request(data.lock, () => { postMessage("held"); return new Promise(() => {}); });
      held?.catch(() => {}); // without locks, the page has a timer
      early.splice(0).forEach(hear);
    } else if (worker) {
      hear(data);
    } else {
      early.push(data);
    }
  };
}
