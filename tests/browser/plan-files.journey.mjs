// Files of other programs dropped on the plan: what is not understood is kept, what is missing told.
export const name = "a .plan with unknown commands and a KML with missing styles are read, and say what they lack";
export const tags = ["plan"];

const file = (name, text) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(text) });

/** A command of a plan. */
const item = (command, params, jump) => ({
  type: "SimpleItem", autoContinue: true, command, doJumpId: jump, frame: 3, params, AltitudeMode: 1, Altitude: params[6], AMSLAltAboveTerrain: null,
});

/** A plan around a place, with a camera trigger and a command that nobody knows. */
const plan = ([latitude, longitude]) => JSON.stringify({
  fileType: "Plan", version: 1, groundStation: "QGroundControl",
  geoFence: {
    circles: [], version: 2,
    polygons: [{ inclusion: false, version: 1, polygon: [[0, 0], [0.001, 0], [0.001, 0.002]].map(([n, e]) => [latitude + n, longitude + e]) }],
  }, rallyPoints: { points: [], version: 2 },
  mission: {
    version: 2, firmwareType: 3, vehicleType: 1, cruiseSpeed: 15, hoverSpeed: 5, globalPlanAltitudeMode: 1,
    plannedHomePosition: [latitude, longitude, 100],
    items: [
      item(22, [15, 0, 0, null, latitude, longitude, 80], 1),
      item(206, [25, 0, 1, 0, 0, 0, 0], 2),
      item(31000, [1, 2, 3, 4, 0, 0, 0], 3),
      item(16, [0, 0, 0, null, latitude + 0.003, longitude + 0.001, 90], 4),
      item(16, [0, 0, 0, null, latitude + 0.003, longitude + 0.004, 90], 5),
    ],
  },
});

const kml = ([latitude, longitude]) => `<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document>
<Placemark><name>Silo</name><styleUrl>#silver</styleUrl><Polygon><outerBoundaryIs><LinearRing><coordinates>
${[[0, 0], [4e-4, 0], [4e-4, 3e-4], [0, 3e-4], [0, 0]].map(([x, y]) => `${longitude + x},${latitude + y},0`).join(" ")}
</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>
<Placemark><name>Lane</name><styleUrl>http://example.org/s.kml#lane</styleUrl><LineString><coordinates>
${longitude},${latitude},0 ${longitude + 2e-3},${latitude},0</coordinates></LineString></Placemark>
</Document></kml>`;

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  const told = (pattern) => (s) => s.toasts.find((t) => pattern.test(`${t.title} ${t.text}`));
  const open = async (name, text, pattern) => {
    await page.setInputFiles("#files", [file(name, text)]);
    const state = await tools.waitFor(told(pattern), `a word like ${pattern}`, 60_000);
    tools.say(`${told(pattern)(state).title}: ${told(pattern)(state).text}`);
    return state;
  };

  const others = (await tools.openRun()).plan.routes.length;
  const planned = await open("field.plan", plan(before.origin), /Added 1 route and 1 no-fly area from field\.plan.*kept but not understood.*31000/s);
  tools.check(planned.workspace === "Plan", "the plan is not shown");
  tools.check(planned.plan.routes.length === others + 1 && planned.plan.routes.at(-1).way_points.length === 3, "the route is not as it was");
  tools.check(planned.plan.routes.at(-1).way_points[1].altitude === 90, "an altitude was lost");
  tools.check(planned.plan.no_fly.at(-1) === 3, `the fence is no area: ${planned.plan.no_fly}`);
  await tools.screenshot("plan-unknown-commands");

  // What was not understood is written again.
  const ask = async () => {
    await page.keyboard.press("Control+k");
    await tools.waitFor((s) => s.dialogs.palette, "the palette");
    await page.keyboard.type("export the route as a qgroundcontrol plan");
    await page.keyboard.press("Enter");
  };
  // The route leads over the fence: that is asked about first.
  await ask();
  await tools.waitFor((s) => s.toasts.some((t) => /Export again/.test(t.text)), "the question", 10_000);
  const download = page.waitForEvent("download");
  await ask();
  const stream = await (await download).createReadStream();
  let text = "";
  for await (const part of stream) text += part;
  const commands = JSON.parse(text).mission.items.map((i) => i.command);
  const fences = JSON.parse(text).geoFence.polygons;
  tools.check(fences.length === 1 && fences[0].polygon.length === 3 && !fences[0].inclusion, `the fences are ${JSON.stringify(fences)}`);
  tools.check(commands.join() === "22,206,31000,16,16", `the commands are ${commands}`);

  const marked = await open("places.kml", kml(before.origin), /Added 1 route and 1 landmark from places\.kml.*style `silver` is missing/s);
  tools.check(marked.landmarks.at(-1).name === "Silo", "the landmark has lost its name");
  tools.check(marked.plan.routes.length === others + 2, "the line is no route");
  await tools.screenshot("plan-missing-styles");

  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.plan.routes.length === others + 1, "the KML to be gone");

  await open("far.plan", plan([before.origin[0] + 20, before.origin[1]]), /far\.plan was not opened.*Open a map of that place/s);
  tools.check((await tools.state()).plan.routes.length === others + 1, "the plan from far away was added");
}
