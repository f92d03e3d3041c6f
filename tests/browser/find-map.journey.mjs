// A route found over what the map itself offers.
export const name = "a route is found over good places of the map, with progress, and can be stopped";
export const tags = ["maps", "plan"];

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction?.fine, "the prediction of the demo's route", 90_000);
  await page.keyboard.press("Shift+F");
  await tools.waitFor((s) => s.plan.find.pick === "From", "the choice of A");
  const { map } = await tools.state();
  const [left, top, right, bottom] = map.rect;
  const at = (x, y) => [left + x * (right - left), top + y * (bottom - top)];
  await page.mouse.click(...at(0.4, 0.6));
  await tools.waitFor((s) => s.plan.find.pick === "To", "the choice of B");
  await page.waitForTimeout(600); // or two clicks are a double click
  await page.mouse.click(...at(0.62, 0.42));
  await tools.waitFor((s) => s.plan.find.to, "both ends");
  await page.waitForTimeout(1000); // the hint that stood above the choices is gone then
  await tools.click(await tools.find(null, "any good place"));
  await page.waitForTimeout(500);
  await tools.click(await tools.find("Button", "Find the route"));
  await tools.waitFor((s) => s.plan.find.progress > 0.01, "progress", 60_000);
  await tools.click(await tools.find("Button", "Stop searching"));
  await tools.waitFor((s) => s.plan.find.progress === null, "the search to stop");
  await tools.click(await tools.find("Button", "Find the route"));
  const found = await tools.waitFor((s) => s.plan.find.surest || s.plan.find.trouble, "the route", 300_000);
  tools.check(!found.plan.find.trouble, found.plan.find.trouble);
  const { shortest, surest } = found.plan.find;
  tools.check(surest.time <= 1.3 * shortest.time * 1.05, `${surest.time} s after ${shortest.time} s`);
  await tools.find(null, /^Predicted with the landmarks in use/);
  await tools.screenshot("find-map");
}
