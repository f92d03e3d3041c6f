export const name = "the page starts and shows something";
export const tags = ["readers", "maps", "plan", "training"]; // whatever changed, the page has to start

export async function run(page, tools) {
  await tools.waitReady();
  const state = await tools.state();
  tools.check(state && typeof state === "object", "the program tells nothing about itself");
  const title = await page.title();
  tools.check(title.includes("Pilotage"), `the window is called "${title}"`);
  // Large logs are read by pieces: `www/files.js` knows them by what the program says here.
  const logs = await page.textContent("#logs");
  tools.check(logs.startsWith(".bin, "), `files that are dropped are told "${logs}"`);
  const [flown, places] = [await page.textContent("#flown"), await page.textContent("#places")];
  tools.check(flown.includes("gliders (.igc)"), `flights by themselves are "${flown}"`);
  tools.check(places.includes("WPML") && places.includes("GeoJSON"), `routes and landmarks are "${places}"`);
  await tools.screenshot("smoke");
}
