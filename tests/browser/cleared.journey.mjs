// The data of the page is deleted while it is open, by people or by the browser: the page goes on, and keeps what is edited next.
export const name = "a page whose data is deleted while it is open goes on, says what is not kept, and keeps what is edited then";

export async function run(page, tools) {
  await tools.waitReady();
  const { origin, plan } = await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.waitForFunction(() => window.page.storage.pending === 0);
  const session = await page.context().newCDPSession(page);
  await session.send("Storage.clearDataForOrigin", { origin: new URL(tools.address).origin, storageTypes: "all" });
  await page.waitForFunction(() => !window.page.storage.isKept, null, { timeout: 30_000 });
  const side = 1201;
  await page.setInputFiles("#files", [{ name: "N47E008.hgt", mimeType: "application/octet-stream", buffer: Buffer.alloc(2 * side * side) }]);
  const refused = (s) => s.toasts.find((t) => t.trouble && /could not keep everything/.test(t.title));
  tools.say(refused(await tools.waitFor(refused, "a word that the file is not kept", 60_000)).text);
  tools.check(await page.evaluate(() => window.app.panic_message()) === undefined, "the program has stopped");
  tools.check(!await page.isVisible("#cover"), "the page is covered");

  const line = [0, 1, 2].map((i) => `${i}\t${Number(i === 0)}\t3\t16\t0\t0\t0\t0\t${origin[0] + 0.001 * i}\t${origin[1]}\t90\t1`);
  const text = ["QGC WPL 110", ...line, ""].join("\n");
  await page.setInputFiles("#files", [{ name: "trip.waypoints", mimeType: "text/plain", buffer: Buffer.from(text) }]);
  const count = plan.routes.length + 1;
  await tools.waitFor((s) => s.plan.routes.length === count, "the route", 60_000);
  /** Names of the page's files; null where the browser cannot tell (some never can again until the page is loaded anew). */
  const files = () => Promise.race([page.evaluate(async () => {
    const root = await navigator.storage.getDirectory();
    const names = [];
    try {
      for await (const name of (await root.getDirectoryHandle("documents", { create: true })).keys()) names.push(name);
    } catch (error) {
      if (error.name === "InvalidStateError") return null;
      throw error;
    }
    return names;
  }), new Promise((done) => setTimeout(done, 4000, null))]);
  let untold = 0; // looks in a row
  for (let i = 0, names = []; i < 240 && !names?.includes("session"); i += 1) {
    names = await files();
    untold = names ? 0 : untold + 1;
    if (untold === 4) {
      tools.check(await page.evaluate(() => window.app.panic_message()) === undefined, "the program has stopped");
      tools.say("this browser gives its file system back to no page whose data was deleted: what is kept then was not looked at");
      return;
    }
    await page.waitForTimeout(250);
  }
  // The file that was refused is stored again after eight seconds, by another connection.
  const stored = () => page.evaluate(() => new Promise((resolve, reject) => {
    const opening = indexedDB.open("pilotage");
    opening.onerror = () => reject(opening.error);
    opening.onsuccess = () => {
      const asked = opening.result.transaction("documents").objectStore("documents").getAllKeys();
      asked.onsuccess = () => { opening.result.close(); resolve(asked.result); };
    };
  }));
  for (let i = 0; i < 240 && !(await stored()).some((key) => key.startsWith("files of ")); i += 1) await page.waitForTimeout(250);
  await page.waitForFunction(() => window.page.storage.isKept && window.page.storage.pending === 0, null, { timeout: 60_000 });
  await page.reload();
  await tools.waitReady();
  const after = await tools.waitFor((s) => s.run_steps > 0 && s.plan.routes.length === count, "the route after the page was loaded again", 150_000);
  tools.check(!after.toasts.some((t) => t.trouble), `trouble: ${after.toasts.map((t) => t.title)}`);
}
