// The user's own documents as files of the browser's private file system: each is written beside the
// old one and takes its place by renaming, so that a crash or a full disk loses at most the last edit.
// Opened files stay in IndexedDB, and everything where there is no such file system.
const FOLDER = "documents";
const UNFINISHED = ".unfinished";
const isOpenedFile = (key) => /^files? /.test(key);

async function openFolder() {
  const handles = globalThis.FileSystemFileHandle?.prototype;
  if (!handles?.createWritable || !handles.move) return undefined;
  const root = await navigator.storage.getDirectory();
  return root.getDirectoryHandle(FOLDER, { create: true });
}

/** What is stored; what was being written when the page ended is thrown away and named, unless another tab is just writing it. */
async function load(folder, storage, keeps) {
  const entries = [];
  for await (const entry of folder.entries()) entries.push(entry);
  for (const [name, handle] of entries) {
    try {
      if (name.endsWith(UNFINISHED)) {
        if (!keeps) continue;
        storage.interrupted.push(decodeURIComponent(name.slice(0, -UNFINISHED.length)));
        await folder.removeEntry(name);
      } else {
        const file = await handle.getFile();
        storage.loaded.set(decodeURIComponent(name), new Uint8Array(await file.arrayBuffer()));
      }
    } catch (error) { // such as one that the page before still holds: the others are read all the same
      console.info(`could not read ${name}:`, error);
    }
  }
}

async function write(folder, name, bytes) {
  const fresh = await folder.getFileHandle(name + UNFINISHED, { create: true });
  try {
    const stream = await fresh.createWritable();
    await stream.write(bytes);
    await stream.close();
    await fresh.move(name);
  } catch (error) {
    await folder.removeEntry(name + UNFINISHED).catch(() => {});
    throw error;
  }
}

/** Never fails: without private files the storage stays as it came. */
export async function withPrivateFiles(storage, keeps) {
  storage.interrupted = [];
  const inDatabase = new Set(storage.loaded.keys());
  let folder;
  try {
    folder = await openFolder();
    if (!folder) return;
    await load(folder, storage, keeps);
  } catch (error) {
    console.info("documents are not kept in files:", error);
    return;
  }
  storage.isKept = true;
  const { put, remove } = storage;
  let last = Promise.resolve();
  const change = (key, deed) => {
    storage.pending += 1;
    // The folder itself is gone where people or the browser deleted the data of the page.
    const again = async (error) => {
      if (error.name !== "NotFoundError") throw error;
      folder = await openFolder();
      return deed();
    };
    last = last.then(deed).catch(again).then(
      () => { storage.written += 1; storage.isKept = true; if (inDatabase.delete(key)) remove(key); },
      (error) => { storage.untold.push(key); console.warn(`could not store ${key}:`, error); },
    ).finally(() => { storage.pending -= 1; });
  };
  storage.put = (key, bytes) => {
    if (isOpenedFile(key)) put(key, bytes);
    else change(key, () => write(folder, encodeURIComponent(key), bytes));
  };
  storage.remove = (key) => {
    if (isOpenedFile(key)) remove(key);
    else change(key, () => folder.removeEntry(encodeURIComponent(key)).catch(() => {}));
  };
}
