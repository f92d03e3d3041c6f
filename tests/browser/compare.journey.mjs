// A run is kept, another flight is flown, and both are compared from take-off on.
export const name = "a kept run is compared with the run of another flight, on the map and in numbers";
export const long = true;
export const tags = ["readers"];
export const flies = true;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.openRun();
  await tools.waitFor((s) => s.toasts.length === 0, "the notices to go, which lie over the buttons", 30_000);
  await page.keyboard.press("Shift+C");
  await tools.waitFor((s) => s.side_tab === "compare", "the comparison");
  const rows = (s) => s.compare.errors;
  const first = await tools.waitFor((s) => rows(s).some((r) => r.name === "This run" && r.rms > 0), "errors of the run");
  const own = rows(first).find((r) => r.name === "This run");
  await tools.click(await tools.find(null, "Keep this run"));
  const kept = await tools.waitFor((s) => s.compare.kept.length === 1, "the run to be kept");
  const name = kept.compare.kept[0].name;
  await tools.click(await tools.find(null, "Keep it smoothed"));
  const two = await tools.waitFor((s) => s.compare.kept.length === 2 && rows(s).length > rows(first).length + 1, "the smoothed run");
  const smoothed = rows(two).find((r) => r.name.endsWith(", smoothed"));
  tools.say(`RMS ${own.rms.toFixed(2)} m in flight, ${smoothed.rms.toFixed(2)} m smoothed`);
  tools.check(smoothed.rms < own.rms, "all that was measured knows no more than what was measured so far");
  await tools.waitFor((s) => s.toasts.length === 0, "the notices of what was kept to go", 30_000);
  await tools.click(await tools.find(null, `Let go of ${smoothed.name}`));
  await tools.waitFor((s) => s.compare.kept.length === 1 && rows(s).length === rows(two).length - 1, "the smoothed run to go");
  await page.waitForTimeout(300);

  await tools.click(await tools.find(null, "Fly by all estimators"));
  const { compare } = await tools.waitFor((s) => s.compare.contest?.length === 6, "every estimator in flight and smoothed", 250_000);
  await page.waitForTimeout(500);
  await tools.screenshot("compare-estimators");

  // The run that journeys open in place of flying is what the page flies by the same estimator.
  tools.check(Math.abs(compare.contest[0] - own.rms) < 1e-6, `the run of the native program differs: ${JSON.stringify([compare.contest, own.rms])}`);

  await tools.choose("Open", "Simulate a flight…");
  await tools.click(await tools.find(null, "Fly"));
  await tools.waitFor((s) => s.run_generation > kept.run_generation && s.run_complete, "another flight", 150_000);
  await tools.click(await tools.find(null, "Times: From take-off"));
  const both = await tools.waitFor((s) => rows(s).find((r) => r.name === name)?.rms != null, "the kept run among the rows");
  const again = rows(both).find((r) => r.name === name);
  tools.say(`${name}: ${own.rms.toFixed(2)} m RMS of its own truth, ${again.rms.toFixed(1)} m of the other flight's`);
  await page.waitForTimeout(500);
  await tools.screenshot("compare");

  await tools.click(await tools.find(null, `Compare with ${name}`));
  await tools.waitFor((s) => rows(s).find((r) => r.name === name)?.rms === null, "the kept run as the reference");
  await tools.click(await tools.find(null, `Let go of ${name}`));
  await tools.waitFor((s) => s.compare.kept.length === 0, "the kept run to go");
}
