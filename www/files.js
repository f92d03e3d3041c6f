// Reads what was dropped or chosen: files, and folders with everything in them.
import { framesOf, isFilm, tellsPlaces } from "./video.js";

/** Maps, heights and logs larger than this many bytes stay where they are; workers read pieces of them. */
const LARGE = 4 << 20;
/** Pictures that are more bytes than this together stay where they are as well. */
const MANY = 16 << 20;
const PICTURE = /\.(jpe?g|png)$/i;
const MAPS = /\.(tiff?|pmtiles|hgt)$/i;
/** Endings of logs, as the program names them on the page once it is there. */
const logs = () => document.getElementById("logs").textContent.split(", ");
const isReadByPieces = (path) => MAPS.test(path) || logs().some((ending) => path.toLowerCase().endsWith(ending));
async function gather(list) {
  const paths = [], contents = [];
  const pictures = list.filter(([path]) => PICTURE.test(path));
  const areMany = pictures.reduce((sum, [, file]) => sum + file.size, 0) > MANY;
  for (const [path, file] of list) {
    try {
      if (isFilm(path)) {
        if (await tellsPlaces(file)) { paths.push(path); contents.push(file); }
        for (const [frame, content] of await framesOf(path, file)) { paths.push(frame); contents.push(content); }
        continue;
      }
      const stays = (file.size > LARGE && isReadByPieces(path)) || (areMany && PICTURE.test(path));
      contents.push(stays ? file : new Uint8Array(await file.arrayBuffer()));
      paths.push(path);
    } catch (error) {
      console.warn(`could not read ${path}:`, error);
    }
  }
  return { paths, contents };
}

const entriesOf = (reader) => new Promise((resolve, reject) => reader.readEntries(resolve, reject));
const fileOf = (entry) => new Promise((resolve, reject) => entry.file(resolve, reject));

async function walk(entry, found) {
  const path = entry.fullPath.replace(/^\//, "");
  if (path.split("/").some((part) => part.startsWith(".") || part === "__MACOSX")) return;
  if (entry.isFile) { found.push([path, await fileOf(entry)]); return; }
  const reader = entry.createReader();
  // A folder is told in portions; an empty one is the last.
  for (let some = await entriesOf(reader); some.length; some = await entriesOf(reader)) {
    for (const inner of some) await walk(inner, found);
  }
}

export async function readDropped(transfer) {
  // Entries must be taken before the first wait; the list is emptied afterwards.
  const items = [...transfer.items].filter((item) => item.kind === "file");
  const entries = items.map((item) => item.webkitGetAsEntry?.());
  const plain = items.map((item) => item.getAsFile());
  const found = [];
  for (const [i, entry] of entries.entries()) {
    if (entry) await walk(entry, found);
    else if (plain[i]) found.push([plain[i].name, plain[i]]);
  }
  return gather(found);
}

export function readChosen(files) {
  return gather([...files].map((file) => [file.webkitRelativePath || file.name, file]));
}
