// Walks every journey (*.journey.mjs) through the page, each in a browser of its own with an empty
// profile. `node run.mjs [WORD]` takes those whose file name contains the word; without a word those
// that judge something, which leaves out the figures. A journey exports the `tags` of the parts of the program
// that it walks through; PILOTAGE_TAGS names those that changed. Three walk at a time; one that exports `alone` has the
// machine for itself and paints as often as it can; one that exports `painted` has every frame painted, one that exports
// `flies` more of the demo flown than its beginning (that many steps, or true: all of it), one that exports `ahead` what
// nobody asked for done, one that exports `forgetful` a browser that keeps no data of any site; those that are `long` begin
// first; `screen` is another window than the usual one.
// If a single journey of several fails, it is walked once more by itself, and both walks are told.
import { mkdirSync, readdirSync } from "node:fs";
import { availableParallelism, cpus } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { launch } from "./browser.mjs";
import { meter } from "./cost.mjs";
import { startServer } from "./server.mjs";
import { makeTools } from "./tools.mjs";
import { watch } from "./watch.mjs";

// A journey that fails leaves promises behind, such as for downloads: what failed is told, not that nobody waits for them.
process.on("unhandledRejection", () => {});

const here = fileURLToPath(new URL(".", import.meta.url));
const pictures = process.env.PILOTAGE_SCREENSHOTS ?? join(here, "../../target/screenshots");
const longest = 400_000; // milliseconds for one journey, after which it counts as lost
const abreast = Number(process.env.PILOTAGE_ABREAST ?? Math.min(3, availableParallelism() + 1)); // journeys at a time: one waits while the others compute

const word = process.argv[2] ?? "";
const tags = (process.env.PILOTAGE_TAGS ?? "").split(",").filter(Boolean); // of the parts that changed; none: all
const asked = (file) => (word ? file.includes(word) : !file.startsWith("figures"));
const files = readdirSync(here).filter((file) => file.endsWith(".journey.mjs") && asked(file)).sort();
if (files.length === 0) {
  console.error(`no journey is called ${word}`);
  process.exit(2);
}
mkdirSync(pictures, { recursive: true });

const server = await startServer();
const results = []; // { file, journey, name, seconds, costs, error }
let leftOut = 0;
const together = []; // journeys that bear company; those that judge time or memory walk by themselves afterwards
const alone = [];
for (const file of files) {
  const journey = await import(pathToFileURL(join(here, file))).catch((error) => ({ run() { throw error; } }));
  if (tags.length > 0 && !(journey.tags ?? []).some((tag) => tags.includes(tag))) leftOut += 1;
  else (journey.alone ? alone : together).push({ file, journey });
}
together.sort((a, b) => Number(b.journey.long ?? false) - Number(a.journey.long ?? false)); // so that none is left for the end
const begun = Date.now();
const atBegin = coreTimes();
await Promise.all(Array.from({ length: abreast }, () => walkAll(together)));
await walkAll(alone);
const [failure, ...others] = results.filter(({ error }) => error);
if (failure && others.length === 0 && results.length > 1) {
  console.log(`one of ${results.length} failed: it is walked once more by itself`);
  results.splice(results.indexOf(failure), 1);
  await walkAll([{ file: failure.file, journey: failure.journey }]);
}
server.stop();

const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);
const costliestFirst = results.map(({ file, costs }) => ({ file, cost: sum(Object.values(costs)) })).sort((a, b) => b.cost - a.cost);
const longestFirst = results.toSorted((a, b) => b.seconds - a.seconds).slice(0, 10);
if (results.length > 1) {
  const { busy, all } = spent(atBegin, coreTimes());
  console.log(`the longest: ${longestFirst.map(({ file, seconds }) => `${short(file)} ${seconds.toFixed(0)} s`).join(", ")}`);
  const kinds = [...new Set(results.flatMap(({ costs }) => Object.keys(costs)))];
  const byKind = kinds.map((kind) => [kind, sum(results.map(({ costs }) => costs[kind] ?? 0))]).sort((a, b) => b[1] - a[1]);
  if (kinds.length > 0) console.log(`the costliest, in seconds of a core: ${costliestFirst.slice(0, 10).map(({ file, cost }) => `${short(file)} ${cost.toFixed(0)}`).join(", ")}`);
  if (kinds.length > 0) console.log(`by what spent them: ${byKind.map(([kind, cost]) => `${kind} ${cost.toFixed(0)}`).join(", ")}; ${sum(byKind.map(([, cost]) => cost)).toFixed(0)} in all`);
  console.log(`${((Date.now() - begun) / 1000).toFixed(0)} s, ${abreast} at a time, the cores ${(100 * busy / all).toFixed(0)} % busy`);
}
if (leftOut > 0) console.log(`${leftOut} left out: they walk through nothing of what changed (${tags.join(", ")})`);
const failed = results.filter(({ error }) => error).length;
const again = failure && failed === 0 ? `, ${short(failure.file)} at its second walk` : "";
console.log(`${results.length - failed} passed${again}, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);

/** `demo` of `demo.journey.mjs`. */
function short(file) {
  return file.replace(/\.journey\.mjs$/, "");
}

/** Walks what is in `queue`, one journey after the other, until nothing is left for this walker or another. */
async function walkAll(queue) {
  for (let next = queue.shift(); next; next = queue.shift()) {
    const { file, journey } = next;
    const name = journey.name ?? file;
    const start = Date.now();
    const said = [];
    const costs = {}; // seconds of cores, by kind
    const error = await walk(journey, short(file), said, costs).then(() => null, (complaint) => complaint);
    const seconds = (Date.now() - start) / 1000;
    results.push({ file, journey, name, seconds, costs, error });
    const told = `${error ? "FAILED" : "passed"}  ${name} (${seconds.toFixed(1)} s)`;
    const lines = error ? String(error.stack ?? error).split("\n") : [];
    console.log([told, ...[...said, ...lines].map((line) => `        ${line}`)].join("\n"));
  }
}

/** The time that the cores have spent since the machine started, core by core, in milliseconds. */
function coreTimes() {
  return cpus().map(({ times }) => ({ idle: times.idle, all: Object.values(times).reduce((sum, time) => sum + time, 0) }));
}

/** What was spent between two readings: `busy` milliseconds of `all`. */
function spent(before, after) {
  const sum = (times, key) => times.reduce((total, core) => total + core[key], 0);
  const all = sum(after, "all") - sum(before, "all");
  return { all, busy: all - (sum(after, "idle") - sum(before, "idle")) };
}

/** Makes one journey, which may have something `said` and tells what it `costs`; fails with its own complaint or with what
 * the page did wrong. */
async function walk(journey, shortName, said, costs) {
  const atEnd = [];
  const { page, profile, close } = await launch({ smooth: journey.alone, flies: journey.flies, ahead: journey.ahead, forgetful: journey.forgetful, painted: journey.painted, screen: journey.screen });
  atEnd.push(close);
  const costOf = meter(profile);
  try {
    const watched = watch(page, server.url);
    const tools = makeTools({ page, address: server.url, pictures, watched, atEnd, said, often: journey.alone });
    let failure = null;
    try {
      await withinTime(journey.run(page, tools));
    } catch (error) {
      failure = error;
      await page.screenshot({ path: join(pictures, `${shortName}-failed.png`), timeout: 5000 }).catch(() => {});
    }
    const complaints = watched.complaints();
    if (failure && complaints.length > 0) failure.stack += `\nand: ${complaints.join("\n")}`;
    if (failure) throw failure;
    if (complaints.length > 0) throw new Error(complaints.join("\n"));
  } finally {
    Object.assign(costs, costOf());
    for (const end of atEnd.reverse()) await end();
  }
}

async function withinTime(work) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`not finished after ${longest / 1000} s`)), longest);
  });
  try {
    return await Promise.race([work, late]);
  } finally {
    clearTimeout(timer);
  }
}
