// Prints what landmarks proposed over a square mile, and one measured on an orthophoto, cost; judges
// nothing.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "figures of suggestions over a square mile";
export const alone = true;
export const flies = true;

const repository = fileURLToPath(new URL("../../", import.meta.url));
const ortho = join(repository, "../shared/data/brighton_beach");
const flights = join(repository, "tests/flights/brighton");
const metresPerDegree = 111_320;
const seconds = (since) => ((Date.now() - since) / 1e3).toFixed(1);

/** Lines to and fro over 1.6 km by 1.6 km, a picture apart, as latitude, longitude. */
function lines([latitude, longitude]) {
  const place = (north, east) => [
    latitude + north / metresPerDegree,
    longitude + east / (metresPerDegree * Math.cos(latitude * Math.PI / 180)),
  ];
  return Array.from({ length: 12 }, (_, i) => {
    const east = -800 + 145 * i;
    return i % 2 ? [place(800, east), place(-800, east)] : [place(-800, east), place(800, east)];
  }).flat();
}

const plan = (places) => JSON.stringify({
  fileType: "Plan", version: 1, groundStation: "QGroundControl",
  geoFence: { circles: [], polygons: [], version: 2 }, rallyPoints: { points: [], version: 2 },
  mission: {
    version: 2, firmwareType: 3, vehicleType: 1, cruiseSpeed: 19, hoverSpeed: 5, globalPlanAltitudeMode: 1,
    plannedHomePosition: [...places[0], 0],
    items: places.map(([latitude, longitude], i) => ({
      type: "SimpleItem", autoContinue: true, command: 16, doJumpId: i + 1, frame: 3,
      params: [0, 0, 0, null, latitude, longitude, 122], AltitudeMode: 1, Altitude: 122, AMSLAltAboveTerrain: null,
    })),
  },
});

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_complete, "the demo's run", 200_000);
  await page.keyboard.press("Space");
  const buffer = Buffer.from(plan(lines(before.origin)));
  await page.setInputFiles("#files", [{ name: "mile.plan", mimeType: "application/json", buffer }]);
  const routes = before.plan.routes.length;
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.routes.length > routes, "the route over a square mile", 60_000);
  await tools.showLandmarks();
  await page.waitForTimeout(25000);
  await tools.click(await tools.find("Button", /^Suggest \d+ landmarks for this route$/));
  const begun = Date.now();
  const found = await tools.waitFor((s) => s.plan.suggested.list.length > 0 || s.plan.suggested.trouble, "suggestions", 300_000);
  const { list, trouble } = found.plan.suggested;
  tools.say(`${list.length} suggested over 1.6 km by 1.6 km in ${seconds(begun)} s ${trouble ?? ""}`);
  await tools.screenshot("figures-suggest");

  if (!existsSync(ortho)) return;
  const files = [join(ortho, "ortho.jpg"), join(ortho, "ortho_georef.json"), join(flights, "mission.geojson")];
  await page.setInputFiles("#files", files);
  await tools.waitFor((s) => s.map.name === "ortho.jpg" && s.map.tiles > 0 && s.landmarks.length === 10, "the orthophoto", 100_000);
  await tools.waitFor((s) => s.plan.suggested.list.length === 0, "the proposals for the other map gone");
  await tools.showLandmarks();
  for (const [i, landmark] of (await tools.state()).landmarks.slice(0, 3).entries()) {
    const row = (await tools.findAll(null, new RegExp(`^${landmark.name}: `)))[0];
    await tools.click(row);
    await page.waitForTimeout(2500);
    await page.keyboard.press("d");
    const measuring = Date.now();
    await tools.waitFor((s) => s.plan.measured.length > i, "the landmark measured", 120_000);
    tools.say(`${landmark.name} of the orthophoto measured in ${seconds(measuring)} s`);
  }
  await tools.screenshot("figures-measured");
}
