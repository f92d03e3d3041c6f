// Tiles of maps of the web: fetched when the user opened such a map, kept in the browser's cache, and
// downloaded for an area so that it is there without a network.
const CACHE = "tiles-of-pilotage";
const AT_A_TIME = 4;

const underWay = new Map();

/** A tile as `request` has it, asked for once however many wait for it. */
function tile(cache, address) {
  const asked = underWay.get(address) ?? request(cache, address).finally(() => underWay.delete(address));
  underWay.set(address, asked);
  return asked;
}

/** The bytes of a tile, none of them where the server has none, and whether the server gave them now; throws where it cannot be had. */
async function request(cache, address) {
  const kept = await cache?.match(address);
  if (kept) return { bytes: new Uint8Array(await kept.arrayBuffer()), isNew: false };
  const answer = await fetch(address, { credentials: "omit", referrerPolicy: "origin" });
  if (answer.status === 404 || answer.status === 204) return { bytes: new Uint8Array(0), isNew: true };
  if (!answer.ok) throw new Error(`the server answers ${answer.status} ${answer.statusText}`);
  await cache?.put(address, answer.clone());
  return { bytes: new Uint8Array(await answer.arrayBuffer()), isNew: true };
}

const open = () => globalThis.caches?.open(CACHE).catch(() => undefined);

/** Tiles at the addresses, null for those that cannot be had; why the first of these cannot, and whether the server gave one now. */
export async function fetchTiles(addresses) {
  const cache = await open();
  let problem = null;
  const came = await Promise.all(addresses.map((address) => tile(cache, address).catch((error) => {
    problem ??= `${new URL(address).host}: ${navigator.onLine === false ? "there is no network" : error.message}`;
    return null;
  })));
  return { tiles: came.map((it) => it?.bytes ?? null), problem, isNew: came.some((it) => it?.isNew) };
}

let download = null;

/** Puts an area's tiles into the cache; those that are there already are passed over. */
export async function downloadTiles(addresses) {
  const own = { all: addresses.length, done: 0, failed: 0, over: false, stopped: false };
  download = own;
  const cache = await open();
  const waiting = addresses[Symbol.iterator]();
  const work = async () => {
    for (const address of waiting) {
      if (own.stopped) return;
      try {
        if (!cache) throw new Error("this browser keeps no cache");
        if (!(await cache.match(address))) await tile(cache, address);
      } catch {
        own.failed += 1;
      }
      own.done += 1;
    }
  };
  await Promise.all(Array.from({ length: AT_A_TIME }, work));
  own.over = true;
}

/** What became of the download so far; an empty list if there is none. */
export function downloadState() {
  return download ? [download.done, download.all, download.failed, Number(download.over)] : [];
}

/** Ends it; what has come stays, so that it can go on later. */
export function stopDownload() {
  if (download) download.stopped = true;
}
