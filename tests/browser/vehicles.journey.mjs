// A telemetry log in which two airplanes report: the first flies, the other one's track is shown, and it can be flown.
import { tlog } from "./tlog.mjs";

export const name = "a telemetry log of two vehicles shows both tracks, flies the one that is chosen, and does so after a reload";
export const tags = ["readers"];

export async function run(page, tools) {
  await tools.waitReady();
  const buffer = tlog([
    { system: 1, latitude: 47.0, longitude: 8.0, heading: 0.5 * Math.PI },
    { system: 9, latitude: 47.01, longitude: 8.002, heading: 0 },
  ]);
  await page.setInputFiles("#files", [{ name: "two.tlog", mimeType: "application/octet-stream", buffer }]);
  const flown = (system) => (s) => s.log?.read && s.log.vehicle === system && s.run_complete;
  const first = await tools.waitFor(flown(1), "the first vehicle to be flown", 60_000);
  tools.check(JSON.stringify(first.log.vehicles) === "[1,9]", `vehicles ${first.log.vehicles}`);
  tools.check(JSON.stringify(first.log.tracks) === '[["Autopilot",300],["System 9",300]]', JSON.stringify(first.log.tracks));
  tools.check(Math.abs(first.origin[0] - 47.0) < 1e-6 && Math.abs(first.origin[1] - 8.0) < 1e-6, `it begins at ${first.origin}`);
  await page.waitForTimeout(800);
  await tools.screenshot("vehicles-first");

  await tools.click(await tools.find("ComboBox", "Vehicle that flies"));
  await tools.click(await tools.find(null, "System 9"));
  const other = await tools.waitFor(flown(9), "the other vehicle to be flown", 60_000);
  tools.check(JSON.stringify(other.log.tracks) === '[["Autopilot",300],["System 1",300]]', JSON.stringify(other.log.tracks));
  tools.check(Math.abs(other.origin[0] - 47.01) < 1e-6 && Math.abs(other.origin[1] - 8.002) < 1e-6, `it begins at ${other.origin}`);
  await page.waitForTimeout(800);
  await tools.screenshot("vehicles-other");

  await page.reload();
  await tools.waitReady();
  const again = await tools.waitFor(flown(9), "the chosen vehicle after a reload", 60_000);
  tools.check(again.flight === other.flight, `after the reload ${again.flight} was open`);
}
