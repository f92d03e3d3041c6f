// What axe-core finds wrong with a page for whoever cannot see it, or sees it badly.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const axe = readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");

/** Fails if axe finds anything serious or critical on the page, or has not seen the buttons of `buttons`. */
export async function inspect(page, tools, where, buttons = "#mirror button:not([role])") {
  if (!(await page.evaluate(() => Boolean(window.axe)))) await page.evaluate(axe);
  const found = await page.evaluate(async (wanted) => {
    const { violations, passes } = await window.axe.run(document);
    const named = passes.find(({ id }) => id === "button-name")?.nodes.length ?? 0;
    const all = document.querySelectorAll(wanted).length;
    if (named < all) throw new Error(`axe saw ${named} buttons of ${all}`);
    return violations.map(({ id, impact, help, nodes }) => ({ id, impact, help, nodes: nodes.map(({ html }) => html.slice(0, 200)) }));
  }, buttons);
  for (const { id, impact, help, nodes } of found) tools.say(`axe, ${where}: ${impact} ${id}: ${help} (${nodes.map((html) => html.slice(0, 60)).join(", ")})`);
  const grave = found.filter(({ impact }) => impact === "serious" || impact === "critical");
  tools.check(grave.length === 0, `axe, ${where}: ${JSON.stringify(grave, null, 1).slice(0, 3000)}`);
}
