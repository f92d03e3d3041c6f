// A route over the demo: drawn, its corridor watched as a landmark is added, and that taken back.
export const name = "a route over the demo shows its corridor, which shrinks with a landmark and is wide again after undo; it is exported, and there again after a reload";
export const tags = ["plan"];

const fine = (s) => s.plan.prediction?.fine;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  const first = await tools.waitFor((s) => s.workspace === "Plan" && fine(s), "the prediction of the demo's route", 90_000);
  tools.say(`σ ${first.plan.prediction.worst_sigma.toFixed(1)} m, coarse in ${first.plan.prediction.coarse_took?.toFixed(0)} ms`);
  await tools.screenshot("plan");

  // A route of one's own through the south-west, where no landmark is.
  await page.keyboard.press("w");
  await tools.waitFor((s) => s.plan.drawing, "the tool that draws routes");
  const { map } = await tools.state();
  const [left, top, right, bottom] = map.rect;
  const at = (x, y) => ({ x: left + x * (right - left), y: top + y * (bottom - top) });
  for (const { x, y } of [at(0.34, 0.75), at(0.34, 0.3)]) {
    const count = (await tools.state()).plan.routes[1]?.way_points.length ?? 0;
    await page.mouse.click(x, y);
    await tools.waitFor((s) => s.plan.routes[1]?.way_points.length === count + 1, "one more way-point");
    await page.waitForTimeout(600); // or two clicks are a double click
  }
  await page.keyboard.press("Enter");
  const drawn = await tools.waitFor((s) => !s.plan.drawing && fine(s), "the prediction of the new route", 60_000);

  // A landmark on its way.
  await page.keyboard.press("n");
  await tools.waitFor((s) => s.map.picking, "the tool that draws landmarks");
  const half = 17 / map.metres_per_point;
  const middle = at(0.34, 0.5);
  await tools.drag({ x: middle.x - half - 2, y: middle.y - half }, { x: middle.x + half - 2, y: middle.y + half });
  const count = drawn.landmarks.length + 1;
  const aided = await tools.waitFor((s) => s.landmarks.length === count && fine(s)
    && s.plan.prediction.landmarks === count, "the prediction with the landmark", 60_000);
  tools.check(aided.plan.prediction.mean_width < 0.95 * drawn.plan.prediction.mean_width,
    `the corridor is ${aided.plan.prediction.mean_width} m wide after ${drawn.plan.prediction.mean_width} m`);
  await page.keyboard.press("Escape");
  await tools.screenshot("plan-landmark");

  await page.keyboard.press("Control+z");
  const undone = await tools.waitFor((s) => s.landmarks.length === count - 1 && fine(s)
    && s.plan.prediction.landmarks === count - 1, "the prediction after the undo", 60_000);
  tools.check(Math.abs(undone.plan.prediction.mean_width - drawn.plan.prediction.mean_width) < 1e-6,
    "the corridor is not what it was");

  // Exported, and all of it here again after a reload, to go on with.
  const download = page.waitForEvent("download");
  await tools.click(await tools.find("Button", "Export"));
  await tools.click(await tools.find("Button", "Export the route as a QGroundControl plan"));
  const file = await download;
  tools.check(file.suggestedFilename().endsWith(".plan"), `the file is called ${file.suggestedFilename()}`);
  const parts = [];
  for await (const part of await file.createReadStream()) parts.push(part);
  const items = JSON.parse(Buffer.concat(parts).toString()).mission.items;
  tools.check(items.length === 2 && items.every((i) => i.command === 16), "the plan has not the two way-points");
  await page.waitForTimeout(1500); // the app stores a moment after the last edit
  await page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
  await page.reload();
  await tools.waitReady();
  const back = await tools.waitFor((s) => s.workspace === "Plan" && s.plan.routes.length === 2 && fine(s),
    "the plan after the reload", 150_000);
  const same = (a, b) => Math.abs(a.north - b.north) < 1e-6 && Math.abs(a.east - b.east) < 1e-6;
  tools.check(back.plan.routes[1].way_points.every((w, i) => same(w, undone.plan.routes[1].way_points[i])),
    "a way-point moved over the reload");
  tools.check(back.landmarks.length === count - 1, "the landmarks are not the same after the reload");
  await page.keyboard.press("x");
  await tools.waitFor((s) => same(s.plan.routes.find((r) => r.id === s.plan.route).way_points[0],
    back.plan.routes.find((r) => r.id === s.plan.route).way_points.at(-1)), "the route to be turned around");
}
