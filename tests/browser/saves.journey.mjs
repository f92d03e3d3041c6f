// The autosave: a write that fails is told and tried again; one that breaks off loses the last edit at most.
export const name = "a full disk or a crash in the middle of a save loses at most the last edit, and says so";

const idle = (page) => page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 90_000 });

/** Opens the `count`-th route beside the `others` of the demo, so that there is an edit to save. */
async function addRoute(page, tools, others, count) {
  const { origin } = await tools.state();
  const line = [0, 1].map((i) => `${i}\t0\t3\t16\t0\t0\t0\t0\t${origin[0] + 0.001 * (i + count)}\t${origin[1]}\t90\t1`);
  const home = `0\t1\t0\t16\t0\t0\t0\t0\t${origin[0]}\t${origin[1]}\t0\t1`;
  const text = ["QGC WPL 110", home, ...line, ""].join("\n");
  await page.setInputFiles("#files", [{ name: `trip-${count}.waypoints`, mimeType: "text/plain", buffer: Buffer.from(text) }]);
  return tools.waitFor((s) => s.plan.routes.length === others + count, `route ${count}`, 60_000);
}

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  const others = (await tools.state()).plan.routes.length;
  await addRoute(page, tools, others, 1);
  await page.waitForFunction(() => window.page.storage.written > 0, null, { timeout: 90_000 });
  await idle(page);
  const files = () => page.evaluate(async () => {
    const root = await navigator.storage.getDirectory();
    const names = [];
    for await (const name of (await root.getDirectoryHandle("documents")).keys()) names.push(name);
    return names;
  });
  // How the page was left is stored as well, and may come first.
  for (let i = 0; i < 120 && !(await files()).includes("session"); i += 1) await page.waitForTimeout(250);
  tools.check((await files()).includes("session"), `the session is no file of its own: ${await files()}`);
  await idle(page);

  // A full disk: what was stored before stays, and once there is room again the edit is stored too.
  await page.evaluate(() => {
    const { prototype } = FileSystemWritableFileStream;
    window.closeFile = prototype.close;
    prototype.close = function close() { return this.abort().then(() => { throw new DOMException("no room", "QuotaExceededError"); }); };
  });
  await addRoute(page, tools, others, 2);
  const refused = (s) => s.toasts.find((t) => t.trouble && /could not keep everything/.test(t.title));
  tools.say(`${refused(await tools.waitFor(refused, "a word that it could not be stored", 90_000)).text}`);
  await tools.screenshot("save-refused");
  tools.check(!(await files()).some((f) => f.endsWith(".unfinished")), "half a file was left behind");
  const { written } = await page.evaluate(() => ({ written: window.page.storage.written }));
  await page.evaluate(() => { FileSystemWritableFileStream.prototype.close = window.closeFile; });
  await page.waitForFunction((before) => window.page.storage.written > before && window.page.storage.pending === 0, written, { timeout: 90_000 });
  // One file that the page before still holds keeps nothing from the others.
  await page.evaluate(async () => {
    const root = await navigator.storage.getDirectory();
    await (await root.getDirectoryHandle("documents")).getFileHandle("held.unfinished", { create: true });
  });
  await page.addInitScript(() => {
    const { prototype } = FileSystemDirectoryHandle;
    const { removeEntry } = prototype;
    prototype.removeEntry = function remove(name) {
      if (name.startsWith("held")) return Promise.reject(new DOMException("held", "NoModificationAllowedError"));
      return removeEntry.call(this, name);
    };
  });
  await page.reload();
  await tools.waitReady();
  await tools.waitFor((s) => s.plan.routes.length === others + 2, "both routes after the reload", 150_000);

  // A crash between writing and renaming: the edit before is there, and the break is told.
  await page.evaluate(() => {
    const { prototype } = FileSystemFileHandle;
    const { move } = prototype;
    prototype.move = function moveTo(name) { return name === "session" ? new Promise(() => {}) : move.call(this, name); };
  });
  await addRoute(page, tools, others, 3);
  const begun = async () => (await files()).includes("session.unfinished");
  for (let i = 0; i < 480 && !(await begun()); i += 1) await page.waitForTimeout(250);
  tools.check(await begun(), "the save that shall break off did not begin");
  await page.waitForTimeout(1500);
  await page.reload();
  await tools.waitReady();
  const broken = (s) => s.toasts.find((t) => t.trouble && /broken off/.test(t.title));
  const after = await tools.waitFor((s) => broken(s) && s.plan.routes.length > others, "the visit after the crash", 150_000);
  tools.say(`${broken(after).text}`);
  tools.check(after.plan.routes.length === others + 2, `${after.plan.routes.length} routes are there instead of ${others + 2}`);
}
