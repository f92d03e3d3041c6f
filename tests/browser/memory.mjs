// How much memory the page takes.
import { readFileSync } from "node:fs";

/** Resident megabytes of the page's process with all its workers, where the system tells it. */
export function rendererMemory() {
  let largest = 0;
  for (const id of readFileSync("/proc/self/task/" + process.pid + "/children", "utf8").trim().split(" ")) largest = Math.max(largest, below(id));
  return largest;
}

function below(id) {
  try {
    const status = readFileSync(`/proc/${id}/status`, "utf8");
    const line = readFileSync(`/proc/${id}/cmdline`, "utf8");
    const own = line.includes("--type=renderer") ? Number(status.match(/VmRSS:\s+(\d+)/)?.[1] ?? 0) / 1024 : 0;
    const children = readFileSync(`/proc/${id}/task/${id}/children`, "utf8").trim().split(" ").filter(Boolean);
    return Math.max(own, ...children.map(below));
  } catch {
    return 0;
  }
}
