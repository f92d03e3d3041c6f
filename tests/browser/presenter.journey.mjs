// A lesson is presented by keys: one step at a time, the answer before what follows it, lights, and notes in a second
// window that follows; then the handout of its course.
export const name = "a lesson is presented, with notes in a second window";
export const tags = ["lessons"];

export async function run(page, tools) {
  await page.goto(`${tools.address}learn.html#landmark-corrects`);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  const shown = () => page.$$eval("#article > *", (all) => all.filter((it) => it.offsetParent !== null).map((it) => it.id || it.localName));
  const press = async (key) => { await page.keyboard.press(key); await page.waitForTimeout(50); };
  await press("p");
  await page.waitForSelector("body.presenting");
  tools.check(String(await shown()) === "header", `the first slide is ${await shown()}`);
  const opened = page.context().waitForEvent("page");
  await press("n");
  const notes = await opened;
  await notes.waitForSelector("#notes", { state: "visible" });
  await page.bringToFront();
  await press("ArrowRight");
  tools.check(String(await shown()) === "guess" && !(await page.isVisible(".answer")), `after it comes ${await shown()}`);
  await press("ArrowRight");
  tools.check(String(await shown()) === "guess" && await page.isVisible(".answer"), "the answer does not come before what follows");
  await press("PageDown");
  tools.check(String(await shown()) === "story", `then comes ${await shown()}`);
  await notes.waitForFunction(() => document.getElementById("where").textContent.startsWith(document.getElementById("story-heading").textContent));
  await press("s");
  tools.check(await page.isVisible("#light.spotlight"), "no spotlight");
  await press("l");
  tools.check(await page.isVisible("#light.laser"), "no pointer");
  await press("l");
  const fits = await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight);
  tools.check(fits, "a slide is larger than the window");
  await tools.screenshot("presenter");
  await press("PageUp");
  tools.check(String(await shown()) === "guess", `back is ${await shown()}`);
  // From the last step on to the next lesson.
  const lesson = await page.evaluate(() => location.hash);
  for (let steps = 0; steps < 20 && await page.evaluate((own) => location.hash === own, lesson); steps += 1) await press("ArrowRight");
  const next = await page.evaluate(() => location.hash.slice(1));
  await notes.waitForFunction((wanted) => location.hash === `#${wanted}`, next);
  await press("Escape");
  tools.check(!(await page.isVisible("body.presenting")), "Escape does not end the presentation");
  await notes.close();
  await wholeEquations(page, tools, press);

  const course = await page.evaluate(() => document.querySelector(".course a").hash.slice(1));
  await page.goto(`${tools.address}learn.html#${course}/plan`);
  await page.waitForSelector(".plan");
  const minutes = await page.$$eval(".plan tbody td:first-child", (all) => all.map((it) => Number(it.textContent)));
  // A long course fills two presentations, each from its beginning to the questions or the next one.
  const begins = minutes.filter((it) => it === 0).length;
  const goesOn = (it, i) => i === 0 || it === 0 || it > minutes[i - 1];
  tools.check(minutes[0] === 0 && begins === 2 && Math.abs(minutes.at(-1) - 40) < 3 && minutes.every((it, i) => it < 45 && goesOn(it, i)), `the plan's minutes are ${minutes}`);
  await page.evaluate((own) => { location.hash = `${own}/handout`; }, course);
  await page.waitForFunction((rows) => document.querySelectorAll(".sheet figure svg").length === rows, minutes.length - 1);
  tools.say(`a handout of ${minutes.length - 1} lessons`);
}

/** By its equations, too, no slide of a lesson has more in it than is seen, in a window of a small projector. */
async function wholeEquations(page, tools, press) {
  const { width, height } = page.viewportSize();
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.goto(`${tools.address}learn.html#camera-chain`);
  await page.waitForFunction(() => document.getElementById("article").dataset.lesson === "camera-chain");
  await page.click("label:has(input[value=mathematics])");
  await press("p");
  await page.waitForSelector("body.presenting");
  for (let steps = 0; steps < 12 && !(await page.isVisible("#mathematics")); steps += 1) await press("ArrowRight");
  const cut = await page.$$eval("#mathematics math[display=block]", (all) => all.map((it) => it.scrollWidth - it.clientWidth));
  tools.check(cut.length > 0 && cut.every((pixels) => pixels <= 0), `of equations on a slide ${cut} px are cut off`);
  await tools.screenshot("presenter-equations");
  await press("Escape");
  await page.click("label:has(input[value=story])");
  await page.setViewportSize({ width, height });
}
