// An elevation model dropped on a plan: the plan counts from its ground from then on, and says so.
import { drop } from "./drop.mjs";
import { geotiff } from "./geotiff.mjs";

export const name = "a plan takes the height of the ground from an elevation model that is dropped on it, names it, and keeps altitudes in the frame that is chosen";
export const tags = ["maps", "plan"];

const fine = (s) => s.plan.prediction?.fine;

// Around the demo's origin, 45° N 30° W, in longitude and latitude and above EGM96: a hill over 300 m.
const [columns, rows, gsd] = [150, 120, 0.0004];
const [west, north] = [-30.02, 45.028];
const hill = (x, y) => [Math.round(300 + 70 * Math.exp(-((x - 60) ** 2 + (y - 68) ** 2) / 60))];
const degrees = [3, [1, 1, 0, 4, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326, 4096, 0, 1, 5773]];

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && fine(s), "the prediction of the demo's route", 90_000);
  await tools.find(null, /^Ground: level at 0 m AMSL, no elevation model is open\.$/);

  const heights = geotiff({ width: columns, height: rows, gsd, east: west, north, pixel: hill, heights: true, tags: { 34735: degrees } });
  await drop(page, [{ name: "hill.tif", buffer: heights }]);
  const opened = await tools.waitFor((s) => s.terrain || s.toasts.some((t) => t.trouble), "the heights", 60_000);
  const trouble = opened.toasts.find((t) => t.trouble);
  tools.check(!trouble, `${trouble?.title}: ${trouble?.text}`);
  tools.check(opened.terrain.datum === "EGM96", `heights count from ${opened.terrain.datum}`);
  await tools.find(null, "hill.tif, heights above EGM96");

  // In another frame the first way-point is as high as before, counted from the sea.
  const first = (s) => s.plan.routes[0].way_points[0];
  await tools.click(await tools.find("Button", /^Way-point 1: /));
  await tools.click(await tools.find(null, "What the altitude counts from"));
  await tools.click(await tools.find("Button", "AMSL"));
  const amsl = await tools.waitFor((s) => first(s).frame === "AMSL", "the altitude above mean sea level");
  // What stands above the way-points in the column changes with the prediction.
  const climbing = await tools.waitFor(fine, "the prediction from that altitude", 60_000);
  await page.waitForTimeout(300);
  const ground = first(amsl).altitude - first(opened).altitude;
  tools.check(ground > 299 && ground < 371, `the ground below the first way-point is ${ground} m high`);
  await tools.find(null, new RegExp(` m above ground at ${ground.toFixed(0)} m AMSL$`));
  // What is said above it may push it out of the column.
  const [, , right, bottom] = amsl.map.rect;
  for (let tries = 0; tries < 20; tries += 1) {
    const { rect } = await tools.find("Button", "This altitude for all way-points");
    if (rect[3] < bottom - 20) break;
    await page.mouse.move(right + 100, bottom - 200);
    await page.mouse.wheel(0, 120);
    await page.waitForTimeout(200);
  }
  await tools.click(await tools.find("Button", "This altitude for all way-points"));
  const level = await tools.waitFor((s) => s.plan.routes[0].way_points.every((w) => w.frame === "AMSL") && fine(s), "the prediction at that altitude", 60_000);
  tools.say(`σ ${opened.plan.prediction.worst_sigma.toFixed(1)} m over level ground, ${climbing.plan.prediction.worst_sigma.toFixed(1)} m from that altitude, ${level.plan.prediction.worst_sigma.toFixed(1)} m over the hill`);
  tools.check(level.plan.prediction.mean_width !== opened.plan.prediction.mean_width, "the hill changes nothing of the prediction");

  await tools.screenshot("plan-ground");
}
