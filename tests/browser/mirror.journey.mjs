// Screen reader support is turned on by keyboard; then every control is found by role and name outside of the canvas,
// used there, and in step with the app, and axe finds nothing serious.
import { inspect } from "./axe.mjs";

export const name = "a screen reader finds and uses every control";

/** Waits until the mirror has an element for each named node and no element that nothing stands for. */
async function waitInStep(page, tools, where) {
  const end = Date.now() + 30_000;
  let wrong;
  do {
    await page.waitForTimeout(300);
    const nodes = (await tools.a11y()).filter(({ role }) => role !== "TextRun" && role !== "ScrollBar");
    const elements = await page.evaluate(() => [...document.querySelectorAll("#mirror [id]")].map((element) => ({
      id: element.id.slice(1), words: element.getAttribute("aria-label") ?? element.textContent, html: element.outerHTML.slice(0, 200),
    })));
    const named = new Set(nodes.map(({ id }) => id));
    const mirrored = new Set(elements.map(({ id }) => id));
    wrong = {
      missing: nodes.filter(({ id }) => !mirrored.has(id)),
      // Sliders and number fields beside a label have their name from it.
      unknown: elements.filter(({ id, html }) => !named.has(id) && !/<input|role="(dialog|listbox)"/.test(html)),
      nameless: elements.filter(({ words }) => words.trim() === ""),
    };
    if (Object.values(wrong).every((list) => list.length === 0)) return tools.say(`${where}: ${elements.length} elements`);
  } while (Date.now() < end);
  throw new Error(`${where}: the mirror is not in step: ${JSON.stringify(wrong).slice(0, 2000)}`);
}

const click = (locator) => locator.evaluate((element) => element.click());

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.workspace === "Replay" && s.run_steps > 40, "the demo", 150_000);
  tools.check(await page.locator("#mirror *").count() === 0, "there are elements before anybody asked for them");

  await page.keyboard.press("Tab");
  const button = page.getByRole("button", { name: "Turn on screen reader support" });
  tools.check(await button.evaluate((element) => element === document.activeElement), "the first Tab does not reach the button");
  await inspect(page, tools, "before");
  await page.keyboard.press("Enter");
  const tab = (label) => page.getByRole("tab", { name: label, exact: true });
  await tab("Plan").waitFor();
  await waitInStep(page, tools, "Replay");
  await inspect(page, tools, "Replay");

  // A tab is clicked as a screen reader does.
  await click(tab("Plan"));
  await tools.waitFor((s) => s.workspace === "Plan", "the plan");
  await page.locator("[role=tab][aria-selected=true]").and(tab("Plan")).waitFor();
  await waitInStep(page, tools, "Plan");
  await inspect(page, tools, "Plan");

  // Tab and Enter of the keyboard: the app's focus follows the page's.
  await tab("Replay").focus();
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => s.workspace === "Replay", "the flight, by Enter");
  await page.keyboard.press("Tab");
  tools.check(await tab("Plan").evaluate((element) => element === document.activeElement), "Tab does not lead to the next control");
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan", "the plan, by its shortcut");
  await click(tab("Replay"));
  await tools.waitFor((s) => s.workspace === "Replay", "the flight again");

  // Time is a slider.
  const pause = page.getByRole("button", { name: "Pause" });
  if ((await tools.state()).playing) await click(pause);
  const { span } = await tools.waitFor((s) => !s.playing && s.span, "a flight at rest");
  const time = page.getByRole("slider", { name: "Time", exact: true });
  await time.fill(String(span[0] + 3));
  const { time: before } = await tools.waitFor((s) => Math.abs(s.time - span[0] - 3) < 1e-3, "the time that was set");
  await time.press("ArrowUp");
  await tools.waitFor((s) => s.time > before, "the next frame");

  // A number is written into its field.
  await click(page.getByRole("button", { name: "Filter settings" }));
  const alpha = page.getByRole("spinbutton", { name: "α" });
  await alpha.waitFor();
  await waitInStep(page, tools, "settings");
  await inspect(page, tools, "settings");
  await alpha.fill("0.5");
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => Math.abs(s.navigator.alpha - 0.5) < 1e-6, "the number that was written");
  const steps = page.getByRole("slider", { name: "β" });
  const beta = Number(await steps.inputValue());
  await steps.focus();
  await page.keyboard.press("ArrowUp");
  await page.waitForFunction(([element, beta]) => Number(element.value) > beta, [await steps.elementHandle(), beta]);

  // A list of choices opens and takes one.
  await click(page.getByRole("combobox", { name: "Estimator" }));
  await page.getByRole("option", { name: "Extended Kalman filter" }).waitFor();
  await inspect(page, tools, "a list of choices");
  await click(page.getByRole("option", { name: "Extended Kalman filter" }));
  await page.getByRole("combobox", { name: "Estimator" }).filter({ hasText: "Extended Kalman filter" }).waitFor();
  await click(page.getByRole("button", { name: "Filter settings" }));

  // A text is typed where the app put its focus, and Enter runs what it found.
  await page.getByRole("button", { name: "Find a command" }).focus();
  await page.keyboard.press("Enter");
  const field = page.getByRole("textbox", { name: "Find a command" });
  await page.waitForFunction((element) => element === document.activeElement, await field.elementHandle());
  await page.keyboard.type("simulate", { delay: 30 });
  await page.getByRole("button", { name: /Simulate/ }).first().waitFor();
  await inspect(page, tools, "the palette");
  await page.keyboard.press("Enter");
  await tools.waitFor((s) => s.simulate.open && !s.dialogs.palette, "the simulation");
  await page.getByRole("dialog", { name: "Simulate a flight" }).getByRole("spinbutton", { name: "Seed" }).waitFor();
  await waitInStep(page, tools, "a dialog");
  await inspect(page, tools, "a dialog");
  await page.getByRole("spinbutton", { name: "Seed" }).focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await tools.waitFor((s) => !s.simulate.open, "the dialog to be left");
  await click(tab("Learn"));
  await tools.waitFor((s) => s.workspace === "Learn", "the tour");
  await waitInStep(page, tools, "Learn");
  await inspect(page, tools, "Learn");

  // The mouse still goes to the canvas.
  await tools.click(await tools.find("Tab", "Plan"));
  await tools.waitFor((s) => s.workspace === "Plan", "the plan, by the mouse");

  // The next visit has it, too, until it is turned off.
  await page.reload();
  await tools.waitReady();
  await tab("Plan").waitFor();
  const off = page.getByRole("button", { name: "Turn off screen reader support" });
  await off.focus();
  await page.keyboard.press("Enter");
  tools.check(await page.locator("#mirror *").count() === 0, "elements stay when it is turned off");
}
