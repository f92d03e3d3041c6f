// A lesson is presented by keys: one step at a time, the answer before what follows it, lights, and notes in a second
// window that follows; then the handout of its course. What a button shows is not the reader's own turn.
export const name = "a lesson is presented, with notes in a second window";
export const tags = ["lessons"];

export async function run(page, tools) {
  await page.goto(`${tools.address}learn.html#landmark-corrects`);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  const shown = () => page.$$eval("#article > *", (all) => all.filter((it) => it.offsetParent !== null).map((it) => it.id || it.localName));
  const press = async (key) => { await page.keyboard.press(key); await page.waitForTimeout(50); };
  await ownTurn(page, tools);
  const opened = page.context().waitForEvent("page");
  await press("n");
  const notes = await opened;
  await notes.waitForSelector("#notes", { state: "visible" });
  tools.check(await notes.textContent("#where") === "", "the notes tell a step before the presentation");
  await page.bringToFront();
  await press("p");
  await page.waitForSelector("body.presenting");
  tools.check(String(await shown()) === "header", `the first slide is ${await shown()}`);
  await notes.waitForFunction(() => /\(1 \D+ [1-9]\d*\)/.test(document.getElementById("where").textContent));
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
  // Its numbers are as the lessons begin: no control changes them, neither of this visit nor of a fresh one.
  const moved = () => page.evaluate(() => {
    const { innerHTML } = document.getElementById("article");
    for (const input of document.querySelectorAll(".sheet input[type=range]")) {
      input.value = input.max;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.value = input.defaultValue;
    }
    const all = [...document.querySelectorAll(".sheet input, .sheet button:is([data-set], .commit, .reveal)")];
    const live = all.filter((it) => it.offsetParent && !it.disabled).length;
    return { changed: document.getElementById("article").innerHTML !== innerHTML, live };
  });
  const { changed, live } = await moved();
  tools.check(!changed && live === 0, `the handout has ${live} live controls; its numbers ${changed ? "changed" : "stay"}`);
  await page.reload();
  await page.waitForFunction((rows) => document.querySelectorAll(".sheet figure svg").length === rows, minutes.length - 1);
  tools.check(!(await moved()).changed, "a fresh handout changes");
}

/** A mistake that a button shows does not pass the lesson, nor does what is shown as passing; the reader's own setting does. */
async function ownTurn(page, tools) {
  const hasPassed = () => page.evaluate(() => Boolean(JSON.parse(localStorage.getItem("pilotage.lessons.progress") ?? "{}")["landmark-corrects"]?.passed));
  const set = (number) => page.$eval("#your-turn input[data-control=look]", (input, to) => {
    input.value = to;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, number);
  await page.$eval("button[data-set='look=1']", (button) => button.click());
  tools.check(!await hasPassed(), "the lesson is passed by the mistake that it shows");
  await page.$eval("#your-turn button.passes", (button) => button.click());
  await set(2.5);
  tools.check(!await hasPassed(), "the lesson is passed beside the setting that it shows");
  await set(20);
  await set(3);
  tools.check(await hasPassed(), "the lesson is not passed by its reader");
  await page.evaluate(() => localStorage.removeItem("pilotage.lessons.progress"));
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
