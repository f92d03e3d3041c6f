// What a browser costs the processor, by what spends it, where the machine tells (Linux).
import { readdirSync, readFileSync } from "node:fs";

const often = 1000; // milliseconds between two readings; what ends in between is missed
const ticks = 100; // of a core in a second, as Linux tells them

const read = (path) => {
  try {
    return readFileSync(path, "utf8");
  } catch {
    return ""; // it has ended, or nothing is told
  }
};

const threadsOf = (id) => {
  try {
    return readdirSync(`/proc/${id}/task`);
  } catch {
    return [];
  }
};

/** Processes below this one. */
function below(id) {
  const children = read(`/proc/${id}/task/${id}/children`).split(" ").filter(Boolean);
  return children.flatMap((child) => [child, ...below(child)]);
}

/** A thread by what it is there for: `workers`, `compiling`, the `page`'s own, or those of a process of the browser. */
function kindOf(process, thread, name) {
  const kind = read(`/proc/${process}/cmdline`).match(/--type=([a-z]+)/)?.[1] ?? "browser";
  if (kind !== "renderer") return kind;
  if (name.includes("Worker")) return "workers";
  return thread === process ? "page" : name.startsWith("ThreadPool") ? "compiling" : "renderer";
}

/** Starts to read what the browser with this `profile` spends; whoever calls what it returns ends that and gets the
 * seconds of cores by kind. */
export function meter(profile) {
  const seen = new Map(); // by thread: [kind, seconds]
  const look = () => {
    const isBrowser = (id) => read(`/proc/${id}/cmdline`).includes(`--user-data-dir=${profile}`);
    const browser = below(process.pid).find(isBrowser);
    for (const id of browser ? [browser, ...below(browser)] : []) {
      for (const thread of threadsOf(id)) {
        const [, name, rest] = read(`/proc/${id}/task/${thread}/stat`).match(/\((.*)\) (.*)/) ?? [];
        if (!rest) continue;
        const [user, system] = rest.split(" ").slice(11, 13).map(Number);
        seen.set(thread, [kindOf(id, thread, name), (user + system) / ticks]);
      }
    }
  };
  const timer = setInterval(look, often);
  return () => {
    look();
    clearInterval(timer);
    const seconds = {};
    for (const [kind, used] of seen.values()) seconds[kind] = (seconds[kind] ?? 0) + used;
    return seconds;
  };
}
