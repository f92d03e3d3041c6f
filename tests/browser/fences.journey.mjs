// The fences of a plan: where nobody may fly becomes a no-fly area, and goes out again as a fence.
export const name = "exclusion fences of a plan become no-fly areas, and come out again";
export const tags = ["plan"];

export async function run(page, tools) {
  await tools.waitReady();
  const demo = await tools.waitFor((s) => s.flight !== null && s.run_steps > 0, "the demo", 120_000);
  const [latitude, longitude] = demo.origin;
  const place = (north, east) => [latitude + north / 111_200, longitude + east / (111_320 * Math.cos((latitude * Math.PI) / 180))];
  const corners = [[100, 100], [100, 220], [190, 160]].map(([north, east]) => place(north, east));
  const item = (north, east, i) => ({
    type: "SimpleItem", command: i ? 16 : 22, frame: 3, autoContinue: true, doJumpId: i + 1,
    params: [0, 0, 0, null, ...place(north, east), 60], AMSLAltAboveTerrain: null, Altitude: 60, AltitudeMode: 1,
  });
  const plan = {
    fileType: "Plan", version: 1, groundStation: "QGroundControl", rallyPoints: { points: [], version: 2 },
    geoFence: {
      version: 2,
      polygons: [{ version: 1, inclusion: false, polygon: corners }],
      circles: [{ version: 1, inclusion: false, circle: { center: place(-150, 0), radius: 40 } }],
    },
    mission: {
      version: 2, firmwareType: 12, vehicleType: 2, cruiseSpeed: 15, hoverSpeed: 5,
      plannedHomePosition: [...place(0, 0), 400], items: [item(0, 0, 0), item(0, 300, 1), item(300, 300, 2)],
    },
  };
  await page.setInputFiles("#files", [{ name: "fenced.plan", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(plan)) }]);
  const opened = await tools.waitFor((s) => s.plan.no_fly?.length === 2, "two no-fly areas", 60_000);
  tools.say(opened.plan.areas.map((area) => area.name).join(", "));
  await page.waitForTimeout(800);
  await tools.screenshot("fences");

  // The route leads over them: that is asked about before it is exported.
  const ask = async () => {
    await tools.click(await tools.find("Button", "Export"));
    await tools.click(await tools.find("Button", "Export the route as a QGroundControl plan"));
  };
  const warned = await tools.waitFor((s) => s.plan.no_fly_warnings?.length, "what leads over them", 30_000);
  tools.say(warned.plan.no_fly_warnings.join(" "));
  await ask();
  await tools.waitFor((s) => s.toasts.some((t) => /Export again/.test(t.text)), "the question", 10_000);
  const download = page.waitForEvent("download");
  await ask();
  const parts = [];
  for await (const part of await (await download).createReadStream()) parts.push(part);
  const fence = JSON.parse(Buffer.concat(parts).toString()).geoFence;
  const around = [...fence.polygons.filter((p) => !p.inclusion), ...fence.circles.filter((c) => !c.inclusion)];
  tools.check(around.length === 2, JSON.stringify(fence));
  const triangle = fence.polygons.find((p) => p.polygon.length === 3);
  const off = Math.max(...triangle.polygon.flatMap((corner, i) => corner.map((v, k) => Math.abs(v - corners[i][k]))));
  tools.check(off < 1e-7, `a corner moved by ${off}°`);

  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => s.plan.no_fly.length === 0, "one step back to take them away");
}
