// Reads what was dropped or chosen: files, and folders with everything in them. What cannot be read is told by its name.
import { framesOf, isFilm, tellsPlaces } from "./video.js";

/** Maps, heights and logs larger than this many bytes stay where they are; workers read pieces of them. */
const LARGE = 4 << 20;
/** Files that are more bytes than this together stay where they are as well. */
const MANY = 16 << 20;
/** Most bytes of a file that is not read by pieces: LARGEST_WHOLE of the workers. */
const WHOLE = 1 << 30;
/** Maps, and films of GoPro in all directions: their places are read, nobody decodes them. */
const PIECES = /\.(tiff?|pmtiles|hgt|360)$/i;
/** Endings of logs, as the program names them on the page once it is there. */
const logs = () => document.getElementById("logs").textContent.split(", ");
const isReadByPieces = (path) => PIECES.test(path) || logs().some((ending) => path.toLowerCase().endsWith(ending));

/** Titles and texts of what was not read, one for each cause, however many files it kept away. */
export function inWords(unread) {
  const causes = new Map(); // the first path of each, and how many there are
  for (const { path, what, why } of unread) {
    const cause = JSON.stringify([what, why]);
    const { first, more } = causes.get(cause) ?? { first: path, more: -1 };
    causes.set(cause, { first, more: more + 1 });
  }
  return [...causes].map(([cause, { first, more }]) => {
    const [what, why] = JSON.parse(cause);
    const others = more === 0 ? "" : ` and ${more} more file${more === 1 ? "" : "s"}`;
    return [`${what} of ${first}${others}`, why];
  });
}

const ofSystem = (error) => `The browser could not read it: ${String(error?.message || error).replace(/\.$/, "")}. It may have been moved, or lie in a cloud: copy it to this machine and open it again.`;

/** Why a file that is not read by pieces is none of use, if it is too large for that. */
function tooLarge(path, { size }) {
  if (size <= WHOLE || isReadByPieces(path) || isFilm(path)) return undefined;
  if (/\.(avi|wmv|mpe?g|flv|m2?ts|ts|3gp|ogv|vob)$/i.test(path)) return "Films of this kind are not read. Convert it to MP4 (H.264), and open that.";
  const advice = /\.(zip|tar|tgz|gz)$/i.test(path) ? "Unpack it, and open the folder." : "Open a part of it.";
  return `It has ${(size / WHOLE).toFixed(1)} GiB, and files of its kind are read at once, up to 1 GiB. ${advice}`;
}

/** Paths and contents of a list of files, one for one, and what of it could not be read besides `unread`. */
async function gather(list, unread = []) {
  const paths = [], contents = [];
  const areMany = list.reduce((sum, [path, file]) => sum + (isFilm(path) ? 0 : file.size), 0) > MANY;
  for (const [path, file] of list) {
    try {
      const why = tooLarge(path, file);
      if (why) { unread.push({ path, what: "Nothing was read", why }); continue; }
      if (isFilm(path)) {
        if (await tellsPlaces(file)) { paths.push(path); contents.push(file); }
        const { frames, lack } = await framesOf(path, file);
        for (const [frame, content] of frames) { paths.push(frame); contents.push(content); }
        if (lack) unread.push({ path, ...lack });
        continue;
      }
      const stays = areMany || (file.size > LARGE && isReadByPieces(path));
      contents.push(stays ? file : new Uint8Array(await file.arrayBuffer()));
      paths.push(path);
    } catch (error) {
      unread.push({ path, what: "Nothing was read", why: ofSystem(error) });
    }
  }
  return { paths, contents, troubles: inWords(unread) };
}

const entriesOf = (reader) => new Promise((resolve, reject) => reader.readEntries(resolve, reject));
const fileOf = (entry) => new Promise((resolve, reject) => entry.file(resolve, reject));

async function walk(entry, found, unread) {
  const path = entry.fullPath.replace(/^\//, "");
  if (path.split("/").some((part) => part.startsWith(".") || part === "__MACOSX")) return;
  try {
    if (entry.isFile) { found.push([path, await fileOf(entry)]); return; }
    const reader = entry.createReader();
    // A folder is told in portions; an empty one is the last.
    for (let some = await entriesOf(reader); some.length; some = await entriesOf(reader)) {
      for (const inner of some) await walk(inner, found, unread);
    }
  } catch (error) {
    unread.push({ path, what: "Nothing was read", why: ofSystem(error) });
  }
}

export async function readDropped(transfer) {
  // Entries must be taken before the first wait; the list is emptied afterwards.
  const items = [...transfer.items].filter((item) => item.kind === "file");
  const entries = items.map((item) => item.webkitGetAsEntry?.());
  const plain = items.map((item) => item.getAsFile());
  const found = [], unread = [];
  for (const [i, entry] of entries.entries()) {
    const before = found.length + unread.length;
    if (entry) await walk(entry, found, unread);
    else if (plain[i]) found.push([plain[i].name, plain[i]]);
    if (entry?.isDirectory && found.length + unread.length === before) {
      unread.push({ path: entry.name, what: "Nothing was read", why: "There is no file in it but hidden ones." });
    }
  }
  return gather(found, unread);
}

export function readChosen(files) {
  return gather([...files].map((file) => [file.webkitRelativePath || file.name, file]));
}
