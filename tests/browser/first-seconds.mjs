// Runs the page's own program without a page: `node first-seconds.mjs PAGE` takes requests to a worker on its
// standard input, each behind its length (four bytes, the lowest first), has the small program of the page in the
// folder PAGE do them one after the other, and writes what it says to its standard output in the same form.
import { readFileSync, writeSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const folder = join(resolve(process.argv[2]), "pkg");
const { initSync, worker } = await import(pathToFileURL(join(folder, "pilotage_worker_flying.js")));
initSync({ module: new WebAssembly.Module(readFileSync(join(folder, "pilotage_worker_flying_bg.wasm"))) });

const program = worker((bytes) => {
  const length = Buffer.alloc(4);
  length.writeUInt32LE(bytes.length);
  for (const part of [length, bytes]) for (let at = 0; at < part.length;) at += writeSync(1, part, at);
});
const requests = readFileSync(0);
for (let at = 0; at < requests.length;) {
  const length = requests.readUInt32LE(at);
  program.receive(new Uint8Array(requests.subarray(at + 4, at + 4 + length)));
  while (program.turn());
  at += 4 + length;
}
