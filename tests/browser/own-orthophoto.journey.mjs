// From nothing but one's own picture: put on the ground by typed places, planned over, rehearsed, and exported.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "one's own orthophoto becomes the map by typed places; a route over it is rehearsed and exported as .plan";
export const tags = ["maps", "plan", "flying"];

const folder = join(fileURLToPath(new URL("../../", import.meta.url)), "../shared/data/brighton_beach");

/** Latitude and longitude of pixels, from the fit that stands beside the picture: [east, north] = gsd R [x, -y] + T on a
 * sphere of 6378137 m. */
function placesBy({ origin_lat: latitude, origin_lon: longitude, gsd, R, T }) {
  const degrees = 180 / Math.PI / 6378137;
  return ([x, y]) => {
    const [east, north] = [0, 1].map((i) => gsd * (R[i][0] * x - R[i][1] * y) + T[i]);
    return [latitude + north * degrees, longitude + east * degrees / Math.cos(latitude * Math.PI / 180)];
  };
}

export async function run(page, tools) {
  if (!existsSync(folder)) {
    tools.say("skipped: no shared data");
    return;
  }
  const begun = Date.now();
  const place = placesBy(JSON.parse(readFileSync(join(folder, "ortho_georef.json"))));
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.setInputFiles("#files", join(folder, "ortho.jpg"));
  const opened = await tools.waitFor((s) => s.georeferencer?.size, "the georeferencer", 60_000);
  const [width, height] = opened.georeferencer.size;
  await page.waitForTimeout(700);
  await tools.screenshot("own-1-georeferencer");

  // Four corners by typed coordinates, far from the demo's country.
  const corners = [[0.08, 0.08], [0.92, 0.1], [0.9, 0.92], [0.1, 0.9]].map(([x, y]) => [x * width, y * height]);
  for (const [i, [column, row]] of corners.entries()) {
    const { picture: [left, top, right, bottom], picture_center: center, pixels_per_point: scale } = (await tools.state()).georeferencer;
    await page.mouse.click((left + right) / 2 + (column - center[0]) / scale, (top + bottom) / 2 + (row - center[1]) / scale);
    await tools.waitFor((s) => s.georeferencer.pending[0], "the point in the picture");
    await tools.type("Coordinates of the place", place([column, row]).map((v) => v.toFixed(7)).join(", "));
    await page.keyboard.press("Enter");
    await tools.waitFor((s) => s.georeferencer?.points === i + 1 && !s.georeferencer.pending.includes(true), `${i + 1} points`);
    await page.waitForTimeout(500); // or two clicks are a double click
  }
  const { rms_metres: metres, epsg } = (await tools.waitFor((s) => s.georeferencer.rms_metres !== null, "a fit")).georeferencer;
  tools.say(`EPSG:${epsg}, ${metres.toFixed(2)} m RMS over four typed places`);
  tools.check(epsg === 32615 && metres < 1, `EPSG:${epsg}, ${metres} m`);
  await tools.screenshot("own-2-points");
  await tools.click(await tools.find("Button", /Use as (the )?map/));
  const mapped = await tools.waitFor((s) => !s.georeferencer?.size && s.map.tiles > 0 && s.workspace === "Plan", "the picture as the map", 60_000);
  tools.check(mapped.landmarks.length === 0, "landmarks of the demo lie over it");
  await page.waitForTimeout(700);
  await tools.screenshot("own-3-map");

  // Two landmarks, and a route past them.
  const at = async (x, y) => {
    const { rect: [left, top, right, bottom] } = (await tools.state()).map;
    return { x: left + x * (right - left), y: top + y * (bottom - top) };
  };
  for (const [i, [x, y]] of [[0.38, 0.45], [0.6, 0.5]].entries()) {
    await page.keyboard.press("n");
    await tools.waitFor((s) => s.map.picking, "the tool that draws landmarks");
    await tools.drag(await at(x - 0.035, y - 0.05), await at(x + 0.035, y + 0.05));
    await tools.waitFor((s) => s.landmarks.length === i + 1, `landmark ${i + 1}`);
    await page.keyboard.press("Escape");
    await tools.drawn();
  }
  await page.keyboard.press("w");
  await tools.waitFor((s) => s.plan.drawing, "the tool that draws routes");
  await tools.drawn();
  for (const [i, [along, down]] of [[0.28, 0.4], [0.5, 0.52], [0.72, 0.5]].entries()) {
    const { x, y } = await at(along, down);
    await page.mouse.click(x, y);
    await tools.waitFor((s) => s.plan.routes.at(-1)?.way_points.length === i + 1, `way-point ${i + 1}`);
    await page.waitForTimeout(600); // or two clicks are a double click
  }
  await page.keyboard.press("Enter");
  const planned = await tools.waitFor((s) => !s.plan.drawing && s.plan.prediction?.fine, "the prediction of the route", 90_000);
  await tools.screenshot("own-4-route");

  // Flown in the simulation over that picture, once its landmarks were tested, then taken along.
  await tools.waitFor((s) => s.plan.measured.length === 2 && s.plan.prediction?.fine, "both landmarks to be tested", 120_000);
  await tools.click(await tools.find(null, "Route"));
  await tools.click(await tools.find("Button", "Settings of the rehearsal"));
  await tools.click(await tools.find("CheckBox", "with pictures"));
  await tools.drawn();
  await page.keyboard.press("Escape");
  await tools.click(await tools.find("Button", "Rehearse this route"));
  const flown = await tools.waitFor((s) => s.plan.rehearsal.flown === 20 && s.plan.rehearsal.progress === null, "twenty flights", 120_000);
  const { rehearsal } = flown.plan;
  tools.check(rehearsal.trouble === null && rehearsal.current, JSON.stringify(rehearsal));
  tools.say(`20 flights: ${(100 * rehearsal.inside_corridor).toFixed(0)} % inside, ${rehearsal.rms.toFixed(1)} m RMS, ${rehearsal.predicted_rms.toFixed(1)} m predicted`);
  await tools.screenshot("own-5-rehearsal");
  const download = page.waitForEvent("download");
  await tools.click(await tools.find("Button", "Export"));
  await tools.click(await tools.find("Button", "Export the route as a QGroundControl plan"));
  const parts = [];
  for await (const part of await (await download).createReadStream()) parts.push(part);
  const { items } = JSON.parse(Buffer.concat(parts).toString()).mission;
  const [south, north] = [46.8415, 46.8440];
  tools.check(items.length === planned.plan.routes.at(-1).way_points.length && items.every(({ params }) =>
    south < params[4] && params[4] < north && -91.996 < params[5] && params[5] < -91.992), JSON.stringify(items));
  tools.say(`from the picture to the exported plan in ${((Date.now() - begun) / 1000).toFixed(0)} s`);
}
