// A landmark of one's own, drawn on the map with the mouse; undone; kept over a reload.
export const name = "a drawn landmark changes the run, an undone edit is gone, and autosave survives a reload";

async function draw(page, tools, dx, dy) {
  const { map } = await tools.state();
  const [left, top, right, bottom] = map.rect;
  const middle = { x: (left + right) / 2 + dx, y: (top + bottom) / 2 + dy };
  const count = (await tools.state()).landmarks.length;
  if (!map.picking) await page.keyboard.press("n");
  await tools.waitFor((s) => s.map.picking, "the tool that draws landmarks");
  await tools.drag({ x: middle.x - 45, y: middle.y - 45 }, { x: middle.x + 45, y: middle.y + 45 });
  const state = await tools.waitFor((s) => s.landmarks.length === count + 1, "the new landmark");
  await page.keyboard.press("Escape");
  return state;
}

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 40, "the first seconds of the run", 150_000);
  await page.keyboard.press("Space");
  const before = await tools.waitFor((s) => !s.playing, "the pause");

  const drawn = await draw(page, tools, 20, 60);
  const again = await tools.waitFor((s) => s.run_generation > drawn.run_generation, "the run to begin again", 60_000);
  tools.check(again.run_landmarks === before.run_landmarks + 1, "the new run does not use the new landmark");
  const seen = await tools.waitFor((s) => s.distinctness, "a word on how distinct it is", 60_000);
  tools.say(`${seen.distinctness}`);
  await tools.screenshot("landmark");

  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.landmarks.length === before.landmarks.length, "the edit to be gone");
  await page.keyboard.press("Control+Shift+z");
  await tools.waitFor((s) => s.landmarks.length === before.landmarks.length + 1, "the edit to be back");
  const kept = (await tools.state()).landmarks.at(-1);

  await draw(page, tools, -120, -60);
  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.landmarks.length === before.landmarks.length + 1, "the second edit to be gone");

  await page.waitForFunction(() => window.page.storage.pending === 0 && window.page.storage.written > 0, null, { timeout: 30_000 });
  await page.waitForTimeout(1500); // the app stores a moment after the last edit
  await page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
  await page.reload();
  await tools.waitReady();
  const restored = await tools.waitFor((s) => s.landmarks.length > 0, "the mission after the reload", 60_000);
  tools.check(restored.landmarks.length === before.landmarks.length + 1, `${restored.landmarks.length} landmarks came back`);
  const back = restored.landmarks.at(-1);
  for (const side of ["north", "south", "east", "west"]) {
    tools.check(Math.abs(back[side] - kept[side]) < 1e-6, `its ${side} edge moved`);
  }
}
