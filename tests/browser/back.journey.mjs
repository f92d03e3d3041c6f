// The browser's Back and Forward lead through the workspaces and the stops of the tour, and stay on the page.
export const name = "Back and Forward of the browser move between workspaces and stops of the tour";

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.workspace === "Replay" && s.run_steps > 0, "the demo", 150_000);
  const begun = await page.evaluate(() => history.length);
  await page.keyboard.press("Shift+p");
  await tools.waitFor((s) => s.workspace === "Plan", "the plan");
  await tools.click(await tools.find("Tab", "Learn"));
  await tools.waitFor((s) => s.tour?.stop === 0, "the tour");
  await page.keyboard.press("PageDown");
  await tools.waitFor((s) => s.tour?.stop === 1, "its second stop");
  const pushed = await page.evaluate(() => history.length) - begun;
  tools.check(pushed === 3, `${pushed} entries were added`);
  const go = async (way, wanted, what) => {
    await page.evaluate((way) => history.go(way), way);
    await tools.waitFor(wanted, what);
  };
  await go(-1, (s) => s.tour?.stop === 0, "the first stop again");
  await go(-1, (s) => s.workspace === "Plan", "the plan again");
  await go(-1, (s) => s.workspace === "Replay", "where it began");
  await go(2, (s) => s.workspace === "Learn" && s.tour?.stop === 0, "the tour, forward");
  const after = await page.evaluate(() => history.length) - begun;
  tools.check(after === 3, `going back and forward made it ${after} entries`);
}
