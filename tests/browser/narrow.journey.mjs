// A phone held upright, touched; then a window zoomed to 200 %.
export const name = "on a phone and in a window at 200 % the map, every workspace and the next step are there";
export const tags = ["plan"];
export const screen = { width: 390, height: 844, touch: true, sharpness: 1 };

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 40, "the demo", 150_000);
  const within = async (width, height, least) => {
    const nodes = (await tools.a11y()).filter(({ role }) => role === "Button" || role === "Tab");
    const seen = nodes.filter(({ rect: [left, top, right, bottom] }) => left >= 0 && top >= 0 && right <= width && bottom <= height);
    const small = seen.filter(({ rect: [, top, , bottom] }) => bottom - top < least - 0.1);
    tools.check(small.length === 0, `too low for fingers: ${JSON.stringify(small.map(({ label, rect }) => [label, rect]))}`);
    return seen.map(({ label }) => label);
  };
  const tap = async (label, role = null) => {
    const { x, y } = tools.middle(await tools.find(role, label));
    await page.touchscreen.tap(x, y);
    await tools.drawn();
  };
  const places = ["Replay", "Plan", "Learn"];
  for (const place of [...places, "Replay"]) {
    await tap(place, "Tab");
    const state = await tools.waitFor((s) => s.workspace === place, `${place} by a tap`);
    await page.waitForTimeout(500);
    await tools.screenshot(`phone-${place.toLowerCase()}`);
    const labels = await within(390, 844, 44);
    for (const label of places) tools.check(labels.includes(label), `in ${place} there is no ${label}: ${labels}`);
    const [left, top, right, bottom] = state.map.rect;
    tools.check(right - left > 350 && bottom - top > 180, `in ${place} the map is ${right - left} x ${bottom - top}`);
  }
  // A finger moves the map, and a tap elsewhere selects nothing.
  const before = (await tools.state()).map;
  const [left, top, right, bottom] = before.rect;
  const [x, y] = [(left + right) / 2, (top + bottom) / 2];
  const touch = await page.context().newCDPSession(page);
  const send = (type, points) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await send("touchStart", [{ x, y }]);
  for (let i = 1; i <= 6; i += 1) {
    await send("touchMove", [{ x: x - 10 * i, y: y - 5 * i }]);
    await tools.drawn();
  }
  await send("touchEnd", []);
  await tools.waitFor((s) => Math.hypot(s.map.center[0] - before.center[0], s.map.center[1] - before.center[1]) > 5, "the map to follow the finger");

  await page.setViewportSize({ width: 720, height: 450 });
  await page.waitForTimeout(800);
  const { map } = await tools.state();
  await tools.screenshot("zoomed-200");
  tools.check(map.rect[3] - map.rect[1] > 200 && map.rect[2] - map.rect[0] > 400, `at 200 % the map is ${map.rect}`);
  const labels = await within(720, 450, 44);
  tools.check(places.every((label) => labels.includes(label)), `at 200 %: ${labels}`);
}
