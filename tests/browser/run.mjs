// Walks every journey (*.journey.mjs) through the page, each in a browser of its own with an empty
// profile. `node run.mjs [WORD]` takes those whose file name contains the word; without a word those
// that judge something, which leaves out the figures. A journey exports the `tags` of the parts of the program
// that it walks through; PILOTAGE_TAGS names those that changed.
import { mkdirSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { launch } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { makeTools } from "./tools.mjs";
import { watch } from "./watch.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const pictures = process.env.PILOTAGE_SCREENSHOTS ?? join(here, "../../target/screenshots");
const longest = 400_000; // milliseconds for one journey, after which it counts as lost

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
let passed = 0;
let failed = 0;
let leftOut = 0;
for (const file of files) {
  const begun = Date.now();
  const seconds = () => `${((Date.now() - begun) / 1000).toFixed(1)} s`;
  let name = file;
  try {
    const journey = await import(pathToFileURL(join(here, file)));
    name = journey.name ?? file;
    if (tags.length > 0 && !(journey.tags ?? []).some((tag) => tags.includes(tag))) {
      leftOut += 1;
      continue;
    }
    await walk(journey, file.replace(/\.journey\.mjs$/, ""));
    passed += 1;
    console.log(`passed  ${name} (${seconds()})`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name} (${seconds()})\n        ${String(error.stack ?? error).replaceAll("\n", "\n        ")}`);
  }
}
server.stop();
if (leftOut > 0) console.log(`${leftOut} left out: they walk through nothing of what changed (${tags.join(", ")})`);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);

/** Makes one journey; fails with its own complaint or with what the page did wrong. */
async function walk(journey, shortName) {
  const atEnd = [];
  const { page, close } = await launch();
  atEnd.push(close);
  try {
    const watched = watch(page, server.url);
    const tools = makeTools({ page, address: server.url, pictures, watched, atEnd });
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
