// A GeoTIFF, and an elevation model beside it, dropped on the page.
import { drop } from "./drop.mjs";
import { country, geotiff } from "./geotiff.mjs";

export const name = "a GeoTIFF and heights open by drop: they lie where they should, and stay after a reload";
export const tags = ["maps"];

const [width, height, gsd] = [1600, 1200, 0.5];

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.flight !== null, "the demo", 150_000);
  const map = geotiff({ width, height, gsd, east: 570_000, north: 5_190_000, pixel: country(width, height) });
  const hill = (x, y) => [Math.round(200 + 80 * Math.exp(-((x - 20) ** 2 + (y - 15) ** 2) / 60))];
  const heights = geotiff({ width: 40, height: 30, gsd: 30, east: 569_900, north: 5_190_100, pixel: hill, heights: true });
  await drop(page, [{ name: "county.tif", buffer: map }, { name: "heights.tif", buffer: heights }]);
  const opened = await tools.waitFor((s) => s.map.name === "county.tif" || s.toasts.some((t) => t.trouble), "the map", 60_000);
  const trouble = opened.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  const shown = await tools.waitFor((s) => s.map.tiles > 0 && s.map.whole && s.terrain, "its pixels and heights", 60_000);
  await page.waitForTimeout(500);

  // pyproj: 570400 5189700 in EPSG:32615 is 46.857115° N, 92.076453° W, where a grid metre is
  // 1.0003 m on the ground and grid north 0.674° off.
  const [south, west, north, east] = shown.map.bounds;
  const near = (value, wanted, within, what) => tools.check(Math.abs(value - wanted) < within, `${what}: ${value} instead of ${wanted}`);
  near(shown.origin[0], 46.857115, 2e-6, "latitude of the middle");
  near(shown.origin[1], -92.076453, 2e-6, "longitude of the middle");
  near(east - west, width * gsd + height * gsd * Math.sin(0.0117), 3, "metres from west to east");
  near(north - south, height * gsd + width * gsd * Math.sin(0.0117), 3, "metres from south to north");
  near(shown.map.gsd, gsd, 0.001, "metres per pixel");
  tools.check(shown.workspace === "Plan" && shown.landmarks.length === 0, "the plan is not a new one");
  const [low, high] = shown.terrain.extremes;
  tools.check(low >= 199 && high <= 281 && high > 260, `heights from ${low} to ${high}`);
  tools.check(shown.terrain.center > 200, `the middle is ${shown.terrain.center} m high`);
  const [left, top, right, bottom] = shown.map.rect;
  await page.mouse.move((left + right) / 2, (top + bottom) / 2);
  await page.waitForTimeout(300);
  await tools.screenshot("geotiff");

  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.landmarks.length === before.landmarks.length, "the mission before, after an undo");
  await page.keyboard.press("Control+y");
  await tools.waitFor((s) => s.landmarks.length === 0, "the new plan again");

  await page.waitForTimeout(2500); // what is open is stored a moment after it changed
  await page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
  await page.reload();
  await tools.waitReady();
  const again = await tools.waitFor((s) => s.map.tiles > 0 && s.map.whole && s.terrain, "the map after a reload", 60_000);
  tools.check(again.map.name === "county.tif" && again.terrain.name === "heights.tif", `after the reload ${again.map.name} was open`);
  near(again.origin[0], shown.origin[0], 1e-9, "latitude of the middle after the reload");
}
