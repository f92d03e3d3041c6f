// Roads of OpenStreetMap dropped on the page, one more drawn on the map, and both taken back.
export const name = "roads of an .osm file join the mission, one more is drawn beside them, and undo takes them out";
export const tags = ["plan"];

/** A street with a track that leaves it, a stream, and a street of which the file lacks a point, around a place. */
const osm = ([latitude, longitude]) => `<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6">
${[[0, 0], [0.002, 0], [0.002, 0.003], [0.004, 0]].map(([n, e], i) => `<node id="${i + 1}" lat="${latitude + n}" lon="${longitude + e}"/>`).join("\n")}
<way id="10"><nd ref="1"/><nd ref="2"/><nd ref="4"/><tag k="highway" v="residential"/><tag k="name" v="Mill Lane"/></way>
<way id="11"><nd ref="2"/><nd ref="3"/><tag k="highway" v="track"/></way>
<way id="12"><nd ref="1"/><nd ref="3"/><nd ref="99"/><tag k="highway" v="residential"/></way>
<way id="13"><nd ref="3"/><nd ref="4"/><tag k="waterway" v="stream"/></way>
</osm>`;

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 0 && s.map.known, "the demo", 150_000);
  const file = { name: "town.osm", mimeType: "application/octet-stream", buffer: Buffer.from(osm(before.origin)) };
  await page.setInputFiles("#files", [file]);
  const count = before.roads.count;
  const opened = await tools.waitFor((s) => s.roads.count === count + 3, "the roads of the file");
  const told = opened.toasts.find((it) => /Added 3 roads from town\.osm/.test(it.title));
  tools.check(told, "nobody says how many roads were added");
  tools.check(/2 residential, 1 track/.test(told.text), `the classes are not told: ${told.text}`);
  tools.check(/no roads: 1/.test(told.text), `the stream is not told of: ${told.text}`);
  tools.say(`${told.title}: ${told.text}`);

  await page.keyboard.press("Shift+Y");
  await tools.waitFor((s) => s.roads.on, "the tool for roads");
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => s.roads.drawing === 0, "a road to be drawn");
  const [left, top, right, bottom] = opened.map.rect;
  for (const [index, dx] of [-140, -60].entries()) {
    await page.mouse.click((left + right) / 2 + dx, (top + bottom) / 2 + 90 + 20 * index);
    await tools.waitFor((s) => s.roads.drawing === index + 1, "another point");
  }
  await page.keyboard.press("Enter");
  const drawn = await tools.waitFor((s) => s.roads.count === count + 4, "the drawn road");
  tools.check(drawn.roads.selected?.course.length === 2, "the drawn road is not selected");
  await tools.screenshot("roads");

  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.roads.count === count + 3, "the drawn road to be gone");
  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.roads.count === count, "the roads of the file to be gone");
}
