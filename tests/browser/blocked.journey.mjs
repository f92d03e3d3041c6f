// A browser that keeps no data of any site: the page starts all the same, and says that nothing is kept.
export const name = "with the data of sites blocked the page starts and says that nothing is kept";
export const forgetful = true;

export async function run(page, tools) {
  await tools.open();
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 120_000 });
  const ready = await page.evaluate(() => document.documentElement.dataset.ready);
  tools.check(ready === "1", `the page did not start: ${await page.evaluate(() => document.body.innerText)}`);
  const isBlocked = await page.evaluate(() => { try { return !sessionStorage; } catch { return true; } });
  tools.check(isBlocked, "the browser is not as it should be for this journey");
  const told = await page.textContent("#other-tab span");
  tools.check(await page.isVisible("#other-tab") && told.startsWith("This browser keeps nothing"), `it says: ${told}`);
  await tools.waitFor((s) => s.run_steps > 20, "the demo", 120_000);
  tools.check(!(await tools.state()).toasts.some((toast) => toast.trouble), "storage that is not there is trouble");
  await page.click("#other-tab button");
  tools.check(!await page.isVisible("#other-tab"), "the notice does not go");
}
