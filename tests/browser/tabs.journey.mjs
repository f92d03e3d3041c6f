// Two tabs on one store: the second says so and keeps nothing, then takes over with what was edited last in the first.
export const name = "a second tab keeps nothing until it takes over, and then has what was edited last in the first";

const ready = (tab) => tab.waitForFunction(() => document.documentElement.dataset.ready === "1" && window.app, null, { timeout: 120_000 });
const state = async (tab) => JSON.parse(await tab.evaluate(() => window.app.state()));
const isTold = (tab) => tab.evaluate(() => !document.getElementById("other-tab").hidden);

async function waitFor(tab, condition, what) {
  const end = Date.now() + 60_000;
  while (!condition(await state(tab))) {
    if (Date.now() > end) throw new Error(`waited in vain for ${what}`);
    await tab.waitForTimeout(100);
  }
  return state(tab);
}

export async function run(page, tools) {
  await tools.waitReady();
  const { landmarks } = await tools.waitFor((s) => s.run_steps > 40, "the demo", 150_000);
  tools.check(!await isTold(page), "a single tab speaks of another");

  // What this tab is just writing is left alone by others.
  const writes = (tab, create) => tab.evaluate(async (given) => {
    const folder = await (await navigator.storage.getDirectory()).getDirectoryHandle("documents", { create: true });
    return folder.getFileHandle("other.unfinished", given).then(() => true, () => false);
  }, { create });
  await writes(page, true);
  const second = await page.context().newPage();
  await second.goto(tools.address);
  await ready(second);
  tools.check(await isTold(second), "the second tab does not say that another is open");
  tools.check(!await isTold(page), "the first tab gave way unasked");
  tools.check(await writes(page, false), "the second tab threw away what the first is writing");
  await page.evaluate(async () => (await (await navigator.storage.getDirectory()).getDirectoryHandle("documents")).removeEntry("other.unfinished"));
  await second.screenshot({ path: tools.pictureAt("second-tab") });

  // An edit in the second tab is kept nowhere.
  await waitFor(second, (s) => s.run_steps > 0 && s.landmarks.length > 0, "the demo in the second tab");
  await second.keyboard.press("Shift+P");
  await waitFor(second, (s) => s.workspace === "Plan", "the plan in the second tab");
  await second.waitForTimeout(2500);
  const written = await second.evaluate(() => window.page.storage.written + window.page.storage.pending);
  tools.check(written === 0, `the second tab stored ${written} times`);

  // An edit in the first tab, and at once the second takes over: the edit is there.
  await page.bringToFront();
  const { map } = await tools.state();
  const [left, top, right, bottom] = map.rect;
  await page.keyboard.press("n");
  await tools.waitFor((s) => s.map.picking, "the tool that draws landmarks");
  const middle = { x: (left + right) / 2, y: (top + bottom) / 2 + 60 };
  await tools.drag({ x: middle.x - 40, y: middle.y - 40 }, { x: middle.x + 40, y: middle.y + 40 });
  const edited = await tools.waitFor((s) => s.landmarks.length > landmarks.length, "the new landmark");
  await second.bringToFront();
  await Promise.all([second.waitForEvent("load"), second.click("#other-tab button")]);
  await ready(second);
  tools.check(!await isTold(second), "the tab that took over still says that it keeps nothing");
  await waitFor(second, (s) => s.landmarks.length === edited.landmarks.length, "what was edited last in the first tab");
  tools.check(await isTold(page), "the first tab does not say that it keeps nothing any more");

  // A closed tab leaves the documents to the next one.
  await second.close();
  await page.bringToFront();
  await Promise.all([page.waitForEvent("load"), page.click("#other-tab button")]);
  await tools.waitReady();
  tools.check(!await isTold(page), "the last tab says that another is open");
  await tools.waitFor((s) => s.landmarks.length === edited.landmarks.length, "the edit after all of it");
}
