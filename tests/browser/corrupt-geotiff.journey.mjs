// GeoTIFFs that cannot be used are refused with their name, the place and what would help.
import { country, geotiff } from "./geotiff.mjs";

export const name = "a GeoTIFF that is cut off, packed in an unknown way or without a place is told by name, and nothing is lost";
export const tags = ["maps"];

const recipe = { width: 300, height: 200, gsd: 0.5, east: 570_000, north: 5_190_000, pixel: country(300, 200) };
const whole = geotiff(recipe);

const cases = [
  ["cut-off.tif", whole.subarray(0, 90_000), /cut-off\.tif.*(damaged|cut off|beyond)/s],
  ["half-a-directory.tif", whole.subarray(0, whole.length - 170), /half-a-directory\.tif/],
  ["no-tiff.tif", Buffer.from("GIF89a, more or less"), /no-tiff\.tif: not a TIFF/],
  ["packed.tif", geotiff({ ...recipe, tags: { 259: [3, [50_002]] } }), /packed\.tif.*ompression/s],
  ["other-datum.tif", geotiff({ ...recipe, tags: { 34735: [3, [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 2000]] } }), /other-datum\.tif.*2000.*warp/s],
  ["world.tif", whole.subarray(0, 4), /world\.tif/],
];

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 20, "the first seconds of the run", 150_000);
  for (const [file, bytes, expected] of cases) {
    await page.setInputFiles("#files", [{ name: file, mimeType: "image/tiff", buffer: bytes }]);
    const told = (s) => s.toasts.find((t) => t.trouble && expected.test(`${t.title} ${t.text}`));
    const state = await tools.waitFor(told, `a message like ${expected}`, 60_000);
    tools.say(`${told(state).title}: ${told(state).text}`);
    tools.check(state.map.name === before.map.name, "the map was lost");
    tools.check(state.landmarks.length === before.landmarks.length && state.flight === before.flight, "the flight was lost");
    tools.check(state.run_steps >= before.run_steps && state.run_generation === before.run_generation, "the run was lost");
  }
  await tools.screenshot("corrupt-geotiff");

  // Without a place it can be put on the ground; closing that leaves everything as it was.
  const somewhere = geotiff({ ...recipe, tags: { 33550: null, 33922: null, 34735: null } });
  await page.setInputFiles("#files", [{ name: "somewhere.tif", mimeType: "image/tiff", buffer: somewhere }]);
  await tools.waitFor((s) => s.georeferencer?.size?.[0] === 300, "the georeferencer", 60_000);
  await tools.screenshot("corrupt-geotiff-unplaced");
  await tools.click(await tools.find("Button", "Close"));
  const closed = await tools.waitFor((s) => !s.georeferencer, "the georeferencer to close");
  tools.check(closed.map.name === before.map.name && closed.flight === before.flight, "the map or the flight was lost");

  // A strip that lies beyond the end of the file: the map opens, says so and shows the rest.
  const holed = geotiff({ ...recipe, tags: { 273: [4, [9_000_000]] } });
  await page.setInputFiles("#files", [{ name: "holed.tif", mimeType: "image/tiff", buffer: holed }]);
  const told = (s) => s.toasts.find((t) => t.trouble && /holed\.tif/.test(t.text));
  const state = await tools.waitFor(told, "a word on the part that is missing", 60_000);
  tools.say(`${told(state).title}: ${told(state).text}`);
}
