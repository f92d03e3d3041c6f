// A picture without a place, put on the ground beside a map of the same country.
import { readFileSync } from "node:fs";
import { country, geotiff } from "./geotiff.mjs";
import { png } from "./png.mjs";

export const name = "a picture without a place is put on the ground by points, saved, and becomes the map";
export const long = true;
export const tags = ["maps"];

// The map: half-metre pixels. The picture: the same from its corner on, in pixels of a metre.
const [east, north] = [570_000, 5_190_000];
const look = country(1600, 1200);
const map = () => geotiff({ width: 1600, height: 1200, gsd: 0.5, east, north, pixel: look });
const picture = () => png(800, 600, (x, y) => look(2 * x, 2 * y));

/** Metres north and east of the map's middle, of a place in UTM zone 15: turned by the meridians'
 * convergence there (0.67389° by pyproj), stretched by the scale of the grid (0.999661). */
function ground([x, y]) {
  const [dx, dy] = [x - (east + 400), y - (north - 300)];
  const turn = 0.67389 * Math.PI / 180;
  return [(dy * Math.cos(turn) - dx * Math.sin(turn)) / 0.999661, (dx * Math.cos(turn) + dy * Math.sin(turn)) / 0.999661];
}

export async function run(page, tools) {
  const file = (title, buffer) => ({ name: title, mimeType: "application/octet-stream", buffer: Buffer.from(buffer) });
  await tools.waitReady();
  await tools.waitFor((s) => s.flight !== null, "the demo", 150_000);
  await page.setInputFiles("#files", [file("county.tif", map())]);
  await tools.waitFor((s) => s.map.name === "county.tif" && s.map.tiles > 0, "the map", 60_000);
  await page.setInputFiles("#files", [file("photo.png", picture())]);
  await tools.waitFor((s) => s.georeferencer?.size, "the georeferencer", 60_000);
  await tools.waitFor((s) => s.toasts.length === 0, "the notices to go, which lie over the map", 30_000);

  const inPicture = async ([column, row]) => {
    const { picture: [left, top, right, bottom], picture_center: center, pixels_per_point: scale } = (await tools.state()).georeferencer;
    await page.mouse.click((left + right) / 2 + (column - center[0]) / scale, (top + bottom) / 2 + (row - center[1]) / scale);
  };
  const onMap = async (place) => {
    const { rect: [left, top, right, bottom], center, metres_per_point: scale } = (await tools.state()).map;
    const [n, e] = ground(place);
    await page.mouse.click((left + right) / 2 + (e - center[1]) / scale, (top + bottom) / 2 - (n - center[0]) / scale);
  };
  const count = (n) => tools.waitFor((s) => s.georeferencer?.points === n && !s.georeferencer.pending.includes(true), `${n} points`);
  const placeOf = ([column, row]) => [east + column, north - row];

  // Three points on both sides, then two by typed coordinates.
  const corners = [[120, 90], [700, 80], [640, 520]];
  for (const [i, pixel] of corners.entries()) {
    await inPicture(pixel);
    await tools.waitFor((s) => s.georeferencer.pending[0], "the point in the picture");
    await page.waitForTimeout(500); // or two clicks are a double click
    await onMap(placeOf(pixel));
    await count(i + 1);
    await page.waitForTimeout(500);
  }
  for (const [i, pixel] of [[100, 500], [400, 300]].entries()) {
    await inPicture(pixel);
    await tools.waitFor((s) => s.georeferencer.pending[0], "the point in the picture");
    await tools.type("Coordinates of the place", placeOf(pixel).join(" "));
    await page.keyboard.press("Enter");
    await count(4 + i);
    await page.waitForTimeout(500);
  }
  const picked = await tools.waitFor((s) => s.georeferencer.rms_left_out, "the error of points left out");
  const { rms_pixels: pixels, rms_metres: metres, rms_left_out: left, epsg } = picked.georeferencer;
  tools.say(`RMS ${pixels.toFixed(2)} px, ${metres.toFixed(2)} m, left out ${left.toFixed(2)} m`);
  tools.check(epsg === 32615, `the plane is EPSG:${epsg}`);
  tools.check(metres < 1.5 && left < 4, "the points do not fit");
  await tools.screenshot("georeference");

  await tools.click(await tools.find("CheckBox", "Point 5"));
  await tools.waitFor((s) => s.georeferencer.on === 4, "a point switched off");
  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.georeferencer.on === 5, "the point on again, by undo");
  await tools.click(await tools.find("Tab", "projective"));
  await tools.waitFor((s) => s.georeferencer.rms_metres < metres + 1e-9, "the softer transform");
  await tools.click(await tools.find("Tab", "similarity"));
  await tools.waitFor((s) => s.georeferencer.rms_metres >= metres - 1e-9, "the stiffer transform");
  await tools.click(await tools.find("Tab", "affine"));

  const kml = `<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>Barn</name><Point><coordinates>-92.0765,46.8571,0</coordinates></Point></Placemark></Document></kml>`;
  await page.setInputFiles("#files", [file("places.kml", kml)]);
  await tools.waitFor((s) => s.georeferencer.places === 1, "the place of the KML");
  // The place is given to a point of the picture; the table then has a row of numbers for it, and the
  // place, which has nothing to do with that point, the largest of them.
  await inPicture([250, 250]);
  await tools.waitFor((s) => s.georeferencer.pending[0], "the point in the picture");
  await tools.click(await tools.find("Button", "Barn"));
  await count(6);
  await tools.waitFor((s) => s.georeferencer.rms_metres > 10, "the error of the place");
  await page.waitForTimeout(500);
  const nodes = await tools.a11y();
  const box = nodes.find((n) => n.role === "CheckBox" && n.label === "Point 6");
  tools.check(box, "the table has no row for the sixth point");
  const beside = (row) => nodes.filter((n) => n.role === "Label" && /^\d+\.\d\d$/.test(n.value ?? "") && n.rect[0] > row.rect[2] && Math.abs((n.rect[1] + n.rect[3]) - (row.rect[1] + row.rect[3])) < 12).map((n) => Number(n.value));
  const rows = [1, 2, 3, 4, 5, 6].map((i) => beside(nodes.find((n) => n.label === `Point ${i}`)));
  tools.check(rows.every((row) => row.length >= 2), `the rows of the table: ${JSON.stringify(rows)}`);
  tools.check(rows[5][1] === Math.max(...rows.map((row) => row[1])), `the place does not stand out: ${JSON.stringify(rows)}`);
  await tools.screenshot("georeference-residuals");
  await page.keyboard.press("Control+z");
  await count(5);

  // Exact points from a file of QGIS; its saved world file then is exact as well.
  const lines = [...corners, [100, 500]].map((p) => `${placeOf(p).join(",")},${p[0]},${-p[1]},1,0,0,0`);
  const points = ["#CRS: EPSG:32615", "mapX,mapY,sourceX,sourceY,enable,dX,dY,residual", ...lines, ""].join("\n");
  await page.setInputFiles("#files", [file("photo.points", points)]);
  await tools.waitFor((s) => s.georeferencer.points === 4 && s.georeferencer.rms_metres < 1e-6, "the points of the file");
  await tools.waitFor((s) => s.toasts.length === 0, "the notices to go, which lie over the buttons", 30_000);
  const saved = [];
  page.on("download", (download) => saved.push(download));
  await tools.click(await tools.find("Button", "Save world file"));
  for (let i = 0; i < 100 && saved.length < 2; i += 1) await page.waitForTimeout(50);
  const read = async (title) => readFileSync(await saved.find((d) => d.suggestedFilename() === title).path(), "utf8");
  const numbers = (await read("photo.pgw")).trim().split("\n").map(Number);
  const wanted = [1, 0, 0, -1, east + 0.5, north - 0.5];
  tools.check(numbers.every((value, i) => Math.abs(value - wanted[i]) < 1e-6), `the world file holds ${numbers}`);
  tools.check(/UTM_Zone_15N/.test(await read("photo.prj")), "the .prj does not name the zone");

  // Four exact points determine the perspective, which is the same place here.
  await tools.click(await tools.find("Tab", "projective"));
  const projective = await tools.waitFor((s) => s.georeferencer.rms_metres < 1e-6, "the projective fit");
  tools.check(projective.georeferencer.points === 4, "a point was lost");
  await page.waitForTimeout(500);
  await tools.click(await tools.find("Button", "Use as the map"));
  const used = await tools.waitFor((s) => !s.georeferencer && s.map.name === "photo.png" && s.map.tiles > 0 && s.map.whole, "the picture as the map", 30_000);
  const [south, west, top, right] = used.map.bounds;
  tools.check(Math.abs(right - west - 807.3) < 2 && Math.abs(top - south - 609.6) < 2, `it lies at ${used.map.bounds}`);
  await page.waitForTimeout(500);
  await tools.screenshot("georeference-used");
}
