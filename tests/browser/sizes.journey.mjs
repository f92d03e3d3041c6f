// Windows of other sizes than the usual one, in the dark and in the light.
export const name = "the page opens at 1024×700 and on a narrow tablet";

export async function run(page, tools) {
  for (const [width, height] of [[1024, 700], [768, 1024]]) {
    await page.setViewportSize({ width, height });
    await tools.open();
    await tools.waitReady();
    const state = await tools.waitFor((s) => s.run_steps > 20 && s.map.tiles > 0, "the demo", 150_000);
    const [left, top, right, bottom] = state.map.rect;
    tools.check(left >= 0 && top >= 0 && right <= width + 1 && bottom <= height + 1, `the map lies at ${state.map.rect}`);
    tools.check((right - left) * (bottom - top) > 0.2 * width * height, "hardly anything is left for the map");
    await tools.screenshot(`size-${width}x${height}`);
  }
  const { dark } = await tools.state();
  await page.keyboard.press("Control+k");
  await tools.waitFor((s) => s.dialogs.palette, "the command palette");
  await page.keyboard.type("dark or light");
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => s.dark !== dark, "the other theme");
  await tools.screenshot("size-768x1024-light");
}
