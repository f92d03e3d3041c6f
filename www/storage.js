// Documents kept in this browser, all loaded before the app starts: in a database (IndexedDB), the
// user's own in files where there are any.
import { withPrivateFiles } from "./opfs.js";

const DATABASE = "pilotage";
const TABLE = "documents";

const done = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

async function openDatabase() {
  const request = indexedDB.open(DATABASE, 1);
  request.onupgradeneeded = () => request.result.createObjectStore(TABLE);
  return done(request);
}

/** Never fails: `isKept` says whether there is anywhere to keep documents; without, they live as long as the page. A tab
 * that `keeps` none changes nothing. */
export async function openStorage(keeps) {
  const storage = { loaded: new Map(), pending: 0, written: 0, untold: [], isKept: false, remove() {} };
  // Without a database, what only that can keep is refused.
  storage.put = storage.putFile = (key) => storage.untold.push(key);
  try {
    let database = await openDatabase();
    // Browsers close it where its data is deleted, some in the background, too.
    const watch = () => { const own = database; own.onclose = () => { if (own === database) storage.isKept = false; }; };
    let opening; // Promise of another connection.
    const refused = (key, error) => { storage.pending -= 1; storage.untold.push(key); console.warn(`could not store ${key}:`, error); };
    watch();
    const table = database.transaction(TABLE, "readonly").objectStore(TABLE);
    const [keys, values] = await Promise.all([done(table.getAllKeys()), done(table.getAll())]);
    keys.forEach((key, i) => storage.loaded.set(String(key), values[i] instanceof Blob ? values[i] : new Uint8Array(values[i])));
    const change = (key, deed) => {
      storage.pending += 1;
      try {
        const write = database.transaction(TABLE, "readwrite");
        deed(write.objectStore(TABLE));
        write.oncomplete = () => { storage.pending -= 1; storage.written += 1; storage.isKept = true; };
        write.onabort = () => refused(key, write.error);
        write.commit?.();
      } catch (error) { // The connection is closed: what is told is stored again by another one.
        refused(key, error);
        opening ??= openDatabase().then((fresh) => { database = fresh; watch(); }, () => {}).finally(() => { opening = undefined; });
      }
    };
    storage.put = (key, bytes) => change(key, (documents) => documents.put(bytes.buffer, key));
    storage.putFile = (key, file) => change(key, (documents) => documents.put(file, key));
    storage.remove = (key) => change(key, (documents) => documents.delete(key));
    storage.isKept = true;
  } catch (error) {
    console.warn("this browser has no database:", error);
  }
  await withPrivateFiles(storage, keeps);
  // That is told once for everything.
  if (!storage.isKept) storage.put = storage.putFile = () => {};
  return storage;
}
