// What the journeys need of the repository: the page's server, `xtask serve` on a free port, and the run of the demo.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

const repository = fileURLToPath(new URL("../../", import.meta.url));

/** The first of `places` (below the repository) that exists, or a failure that says what to do. */
function existing(places, advice) {
  const found = places.map((place) => repository + place).find(existsSync);
  if (!found) throw new Error(`${places.join(", ")}: not there; ${advice}`);
  return found;
}

/** The demo as the native program has flown it. */
export function demoRun() {
  return process.env.PILOTAGE_RUN ?? existing(["target/demo.run"], "`cargo xtask test --only journeys` flies it");
}

/** Starts a server; resolves to its `url` (with a slash at the end) and a way to `stop` it. */
export async function startServer() {
  const program = process.env.PILOTAGE_SERVER
    ?? existing(["target/tool/xtask", "target/tool/xtask.exe"], "`cargo xtask serve` builds it");
  const page = process.env.PILOTAGE_PAGE
    ?? existing(["dist", "target/page"], "`cargo xtask serve` builds it");
  const server = spawn(program, ["serve", "--no-build", "--port", "0", "--dist", page], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  const url = await new Promise((resolve, reject) => {
    let printed = "";
    server.stdout.on("data", (bytes) => {
      printed += bytes;
      const address = printed.match(/http:\/\/[\d.:]+\//);
      if (address) resolve(address[0]);
    });
    server.on("error", reject);
    server.on("exit", (code) => reject(new Error(`the server ended with ${code}: ${printed}`)));
  });
  return { url, stop: () => server.kill() };
}
