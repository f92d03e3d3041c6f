// Tiles of maps of the web: fetched when the user opened such a map, kept in the browser's caches, and
// downloaded for an area so that it is there without a network.

// Tiles of areas that were downloaded: they stay.
const AREAS = "tiles-of-pilotage";
// Tiles that were looked at, in two generations with a number each. Once the younger is full the older is thrown away, and
// what is used of the older goes over to the younger: what was used longest ago goes first.
const SEEN = "tiles-seen-in-pilotage-";
const MOST_SEEN = 200_000_000;
// Bytes of a generation stand in it under an address that no server has.
const BYTES = "https://pilotage.invalid/bytes";
const AT_A_TIME = 4;

const underWay = new Map();
let counting = Promise.resolve();
let uncounted = 0;

const numbersOf = (names) => names.filter((name) => name.startsWith(SEEN)).map((name) => Number(name.slice(SEEN.length))).sort((a, b) => a - b);

/** The caches: that of areas, and the two generations. Undefined where the browser keeps none. */
async function open(storage = globalThis.caches, most = MOST_SEEN) {
  try {
    const numbers = numbersOf(await storage.keys());
    const number = numbers.at(-1) ?? 1;
    const [areas, younger, older] = await Promise.all([AREAS, SEEN + number, SEEN + (number - 1)].map((name) => storage.open(name)));
    return { storage, half: most / 2, number, areas, younger, older };
  } catch {
    return undefined;
  }
}

/** Counts bytes that came into the younger generation; begins another one once it is full. */
async function count(kept, bytes) {
  const { storage, number, younger } = kept;
  const before = await (await younger.match(BYTES))?.text();
  const all = Number(before ?? 0) + bytes;
  await younger.put(BYTES, new Response(String(all)));
  if (all < kept.half) return;
  const past = numbersOf(await storage.keys()).filter((it) => it < number);
  await Promise.all(past.map((it) => storage.delete(SEEN + it)));
  Object.assign(kept, { number: number + 1, older: younger, younger: await storage.open(SEEN + (number + 1)) });
}

/** Keeps a tile that was looked at, where there is room. What came meanwhile is counted together, and nobody waits for it. */
async function keep(kept, address, bytes) {
  try {
    // Without the answer's headers: some forbid that it is kept.
    await kept.younger.put(address, new Response(bytes));
  } catch {
    return;
  }
  uncounted += bytes.length;
  counting = counting.then(async () => {
    const came = uncounted;
    uncounted = 0;
    if (came > 0) await count(kept, came);
  }).catch(() => undefined);
}

/** The bytes of a tile that is kept, if it is. */
async function keptTile(kept, address) {
  const found = await kept.areas.match(address) ?? await kept.younger.match(address);
  if (found) return new Uint8Array(await found.arrayBuffer());
  const { older } = kept;
  const used = await older.match(address);
  if (!used) return undefined;
  const bytes = new Uint8Array(await used.arrayBuffer());
  await older.delete(address);
  await keep(kept, address, bytes);
  return bytes;
}

/** What `work` does about a tile, once however many ask for that tile meanwhile. */
function once(address, work) {
  const going = underWay.get(address) ?? work().finally(() => underWay.delete(address));
  underWay.set(address, going);
  return going;
}

/** The bytes of a tile as its server gives them, none of them where it has none; throws where it cannot be had. */
async function fromServer(address) {
  const answer = await fetch(address, { credentials: "omit", referrerPolicy: "origin" });
  if (answer.status === 404 || answer.status === 204) return new Uint8Array(0);
  if (!answer.ok) throw new Error(`the server answers ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** The bytes of a tile to look at, and whether the server gave them now. */
const tile = (kept, address) => once(address, async () => {
  const found = kept && await keptTile(kept, address);
  if (found) return { bytes: found, isNew: false };
  const bytes = await fromServer(address);
  // It is shown all the same where there is no room.
  if (kept && bytes.length > 0) await keep(kept, address, bytes);
  return { bytes, isNew: true };
});

/** Tiles at the addresses, null for those that cannot be had; why the first of these cannot, and whether the server gave one now. */
export async function fetchTiles(addresses, storage = globalThis.caches, most = MOST_SEEN) {
  const kept = await open(storage, most);
  let problem = null;
  const came = await Promise.all(addresses.map((address) => tile(kept, address).catch((error) => {
    problem ??= `${new URL(address).host}: ${navigator.onLine === false ? "there is no network" : error.message}`;
    return null;
  })));
  return { tiles: came.map((it) => it?.bytes ?? null), problem, isNew: came.some((it) => it?.isNew) };
}

/** Puts a tile into the cache of areas; throws where it cannot be had or kept. */
async function downloadTile(kept, address) {
  if (await kept.areas.match(address)) return;
  // Whoever looks at it just now keeps it in another cache.
  while (underWay.has(address)) await underWay.get(address).catch(() => undefined);
  const { refusal } = await once(address, async () => {
    const found = await keptTile(kept, address);
    const bytes = found ?? await fromServer(address);
    const refusal = bytes.length > 0 ? await kept.areas.put(address, new Response(bytes)).catch((error) => error) : undefined;
    if (!refusal) await kept.younger.delete(address);
    return { bytes, isNew: !found, refusal };
  });
  if (refusal) throw refusal;
}

let download = null;

/** Puts an area's tiles into the cache until there is no room for more; those that are there already are passed over. */
export async function downloadTiles(addresses, storage = globalThis.caches, most = MOST_SEEN) {
  const own = { all: addresses.length, done: 0, failed: 0, over: false, full: false, stopped: false };
  download = own;
  const kept = await open(storage, most);
  const waiting = addresses[Symbol.iterator]();
  const work = async () => {
    for (const address of waiting) {
      if (own.stopped || own.full) return;
      try {
        if (!kept) throw new Error("this browser keeps no cache");
        await downloadTile(kept, address);
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
