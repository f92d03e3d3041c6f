// Makes the pictures of the README, to be copied into docs; judges nothing.
// By hand: PILOTAGE_SHARP=1 node run.mjs figures-readme
export const name = "pictures of the README";
export const flies = true;

const settled = (s) => s.map.known && s.map.whole && s.run_complete && s.toasts.length === 0;

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_complete, "the demo's run", 200_000);
  await page.keyboard.press("Space");
  await tools.click(await tools.find("Tab", "Plan"));
  await tools.waitFor((s) => settled(s) && s.plan.prediction?.fine, "the prediction along the route", 120_000);
  await tools.drawn();
  await tools.screenshot("readme-plan");
  await tools.click(await tools.find("Tab", "Learn"));
  for (let stop = 0; stop < 5; stop += 1) {
    await tools.click(await tools.find("Button", "Next"));
    await page.waitForTimeout(1000); // the map follows
  }
  await tools.waitFor(settled, "the map");
  await page.waitForTimeout(1500);
  await tools.screenshot("readme-learn");
}
