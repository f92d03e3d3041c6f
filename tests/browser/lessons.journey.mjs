// Not once is the pointer used: a course from its first lesson to its last, each with its guess, its control and its
// own turn; axe finds nothing serious, and what was passed is kept. A choice shows in each place where it stands.
import { inspect } from "./axe.mjs";

export const name = "a whole course is learned by the keyboard";
export const tags = ["lessons"];

export async function run(page, tools) {
  await page.goto(`${tools.address}learn.html`);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  await inspect(page, tools, "contents", "#bar > button");
  const course = await page.evaluate(() => [...document.querySelectorAll(".course-list")][0].id);
  const lessons = await page.evaluate((id) => [...document.querySelectorAll(`#${id} a[data-lesson]`)].map((it) => it.dataset.lesson), course);
  const focused = () => page.evaluate(() => document.activeElement?.outerHTML.slice(0, 300) ?? "");
  /** Goes on by Tab until what has the keyboard matches a selector. */
  const tabTo = async (selector) => {
    for (let tries = 0; tries < 80; tries += 1) {
      if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector)) return;
      await page.keyboard.press("Tab");
    }
    throw new Error(`Tab does not lead to ${selector}; it is at ${await focused()}`);
  };
  await tabTo(`a[data-lesson="${lessons[0]}"]`);
  await page.keyboard.press("Enter");
  for (const [index, lesson] of lessons.entries()) {
    await page.waitForFunction((wanted) => document.getElementById("article").dataset.lesson === wanted, lesson);
    tools.check(await page.evaluate(() => document.querySelector("#figure").classList.contains("veiled")), `${lesson}: the figure tells the answer before the guess`);
    await tabTo("fieldset.guess input");
    await page.keyboard.press("Space");
    await tabTo("button.commit");
    await page.keyboard.press("Enter");
    const verdict = await page.textContent(".answer .verdict");
    tools.check(verdict.length > 3 && await page.isVisible(".answer"), `${lesson}: no answer to a guess`);
    tools.check(!(await page.evaluate(() => document.querySelector("#figure").classList.contains("veiled"))), `${lesson}: the figure stays hidden`);
    await tabTo("#your-turn input[data-control]");
    const before = await page.innerHTML("#figure");
    await page.keyboard.press("ArrowRight");
    tools.check(await page.innerHTML("#figure") !== before, `${lesson}: the figure does not follow its control`);
    await tabTo("#your-turn button.passes");
    await page.keyboard.press("Enter");
    const checks = await page.$$eval("#your-turn .check", (all) => all.map((it) => it.classList.contains("passed")));
    tools.check(checks.length > 0 && checks.every(Boolean), `${lesson}: what is shown as passing does not pass`);
    if (index === 0) {
      await inspect(page, tools, lesson, "#bar > button");
      await tools.screenshot("lesson");
    }
    if (index + 1 < lessons.length) {
      await tabTo("#next");
      await page.keyboard.press("Enter");
    }
  }
  const times = await page.evaluate(() => performance.getEntriesByName("lesson").map(({ duration }) => duration).sort((a, b) => a - b));
  tools.say(`${lessons.length} lessons; from a control to the picture ${times[Math.floor(times.length / 2)].toFixed(1)} ms in the middle, ${times.at(-1).toFixed(1)} ms at most, of ${times.length}`);
  await page.goto(`${tools.address}learn.html`);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  const marks = await page.$$eval(`#${course} a[data-lesson] em`, (all) => all.length);
  tools.check(marks === lessons.length, `${marks} of ${lessons.length} lessons are marked in the contents`);
  await tools.screenshot("lessons");
  await everyChoiceShows(page, tools);
}

/** In every lesson of every course, each choice shows what is chosen, wherever it stands. */
async function everyChoiceShows(page, tools) {
  const all = await page.$$eval("a[data-lesson]", (links) => links.map((link) => link.dataset.lesson));
  let choices = 0;
  for (const lesson of all) {
    await page.evaluate((wanted) => { location.hash = wanted; }, lesson);
    await page.waitForFunction((wanted) => document.getElementById("article").dataset.lesson === wanted, lesson);
    const chosen = await page.$$eval("fieldset.control", (sets) => sets.map((set) => set.querySelectorAll(":checked").length));
    tools.check(chosen.every((count) => count === 1), `${lesson}: of its choices ${chosen} are shown as chosen`);
    choices += chosen.length;
  }
  tools.check(choices > 10, `only ${choices} choices were looked at`);
}
