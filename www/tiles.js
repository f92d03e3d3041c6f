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

/** The bytes of a tile, none of them where the server has none, whether the server gave them now, and why they could not be kept, if so; throws
 * where it cannot be had. */
async function request(cache, address) {
  const kept = await cache?.match(address);
  if (kept) return { bytes: new Uint8Array(await kept.arrayBuffer()), isNew: false };
  const answer = await fetch(address, { credentials: "omit", referrerPolicy: "origin" });
  if (answer.status === 404 || answer.status === 204) return { bytes: new Uint8Array(0), isNew: true };
  if (!answer.ok) throw new Error(`the server answers ${answer.status} ${answer.statusText}`);
  const bytes = new Uint8Array(await answer.arrayBuffer());
  // Without the answer's headers: some forbid that it is kept.
  const refusal = await cache?.put(address, new Response(bytes)).catch((error) => error);
  return { bytes, isNew: true, refusal };
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

/** Puts an area's tiles into the cache until there is no room for more; those that are there already are passed over. */
export async function downloadTiles(addresses) {
  const own = { all: addresses.length, done: 0, failed: 0, over: false, full: false, stopped: false };
  download = own;
  const cache = await open();
  const waiting = addresses[Symbol.iterator]();
  const work = async () => {
    for (const address of waiting) {
      if (own.stopped || own.full) return;
      try {
        if (!cache) throw new Error("this browser keeps no cache");
        const { refusal } = await cache.match(address) ? {} : await tile(cache, address);
        if (refusal) throw refusal;
      } catch (error) {
        own.failed += 1;
        own.full ||= error.name === "QuotaExceededError";
      }
      own.done += 1;
    }
  };
  await Promise.all(Array.from({ length: AT_A_TIME }, work));
  own.over = true;
}

/** What became of the download so far, at its end 1, or 2 where there was no room for all; an empty list if there is none. */
export function downloadState() {
  return download ? [download.done, download.all, download.failed, download.over ? 1 + Number(download.full) : 0] : [];
}

/** Ends it; what has come stays, so that it can go on later. */
export function stopDownload() {
  if (download) download.stopped = true;
}
