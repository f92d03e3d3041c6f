// A link to a step of a lesson opens it in a browser that knows nothing of the page, within two megabytes; its lesson
// can be embedded, and leads to its moment in the flight.
export const name = "a link to a step of a lesson works in a fresh browser, and leads into the flight";
export const tags = ["lessons"];

export async function run(page, tools) {
  let bytes = 0;
  const sizes = [];
  page.on("response", (response) => sizes.push(response.request().sizes().then((size) => { bytes += size.responseBodySize; }, () => {})));
  await page.goto(`${tools.address}learn.html#landmark-corrects/break-it`);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  const ready = await page.evaluate(() => performance.now());
  const heading = await page.evaluate(() => document.activeElement?.id);
  tools.check(heading === "break-it-heading", `the link leads to ${heading}`);
  await page.locator("#break-it button.set").click();
  tools.check((await page.textContent("#try-it [data-value=after]")).startsWith("0.995"), "the step's button does nothing");
  await Promise.all(sizes);
  tools.say(`usable after ${(ready / 1000).toFixed(2)} s, ${(bytes / 1e6).toFixed(2)} MB`);
  tools.check(bytes > 50_000 && bytes < 2e6, `${bytes} bytes`);

  await page.goto(`${tools.address}learn.html?embed#landmark-corrects`);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  tools.check(await page.isVisible("#figure svg") && !(await page.isVisible("#present")), "an embedded lesson is not one");
  await page.emulateMedia({ media: "print" });
  tools.check(await page.isVisible("#mathematics") && await page.isVisible(".answer") && !(await page.isVisible("#bar")), "a printed lesson lacks something");
  await page.emulateMedia({ media: "screen" });

  const stop = await page.getAttribute("a.flight", "href");
  await page.goto(new URL(stop, `${tools.address}learn.html`).href);
  await tools.waitReady();
  const state = await tools.waitFor((s) => s.workspace === "Learn" && s.tour, "the stop of the tour", 120_000);
  tools.check(state.tour.stop > 0, `the lesson leads to "${state.tour.title}"`);
}
