// Prints what planning costs; judges nothing.
export const name = "figures of planning";
export const alone = true;
export const flies = true;

const fine = (s) => s.plan.prediction?.fine;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_complete, "the demo's run", 200_000);
  await page.keyboard.press("Space");
  await page.keyboard.press("Shift+P");
  const first = await tools.waitFor((s) => s.workspace === "Plan" && fine(s), "the prediction of the demo's route", 90_000);
  const lines = [`whole prediction in ${first.plan.prediction.took.toFixed(0)} ms, ${first.plan.prediction.worlds} worlds`];

  // While a way-point is dragged, coarse predictions follow the mouse.
  const { map, plan } = first;
  const coarse = [];
  const computed = [];
  const [left, top, right, bottom] = map.rect;
  const dragged = plan.routes[0].way_points[1].screen;
  if (dragged) {
    await page.mouse.move(dragged[0], dragged[1]);
    await page.mouse.down();
    for (let i = 1; i <= 12; i += 1) {
      await page.mouse.move(Math.min(right - 60, dragged[0] + 6 * i), Math.max(top + 60, dragged[1] + 2 * i));
      await page.waitForTimeout(150);
      const { plan: now } = await tools.state();
      if (now.prediction?.coarse_took == null) continue;
      coarse.push(now.prediction.coarse_took);
      computed.push(now.prediction.coarse_computed);
    }
    await page.mouse.up();
    const whole = await tools.waitFor(fine, "the prediction after the drag", 60_000);
    lines.push(`coarse prediction while dragging ${spread(coarse)} until it was shown, ${spread(computed)} in the worker; whole one afterwards ${whole.plan.prediction.took.toFixed(0)} ms`);
  }

  // One landmark measured, with the ground of other days still to be laid out, then all of them.
  await tools.showLandmarks();
  await tools.click(await tools.find(null, /^dairy barn: /));
  await page.waitForTimeout(2000);
  for (const [key, wanted] of [["d", 1], ["Shift+D", 10]]) {
    const begun = Date.now();
    await page.keyboard.press(key);
    await tools.waitFor((s) => s.plan.measuring !== null, "the measurement to begin");
    await tools.waitFor((s) => s.plan.measuring === null, "the landmarks measured", 240_000);
    lines.push(`${wanted} measured in ${((Date.now() - begun) / 1e3).toFixed(1)} s`);
  }
  await tools.screenshot("figures-plan");
  for (const line of lines) tools.say(`${line}`);
}

function spread(values) {
  if (values.length === 0) return "none";
  const sorted = values.toSorted((a, b) => a - b);
  return `${sorted[0].toFixed(0)} to ${sorted.at(-1).toFixed(0)} ms (median ${sorted[sorted.length >> 1].toFixed(0)})`;
}
