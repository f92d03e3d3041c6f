// The mission brief as it comes out of the browser's print.
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

export const name = "the mission brief is one printed page with map, legs, landmarks and prediction";

const folder = process.env.PILOTAGE_SCREENSHOTS ?? fileURLToPath(new URL("../../target/screenshots", import.meta.url));

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  await page.keyboard.press("Shift+p");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction?.fine, "the prediction", 90_000);
  await page.evaluate(() => { window.print = () => { window.printed = true; document.getElementById("brief").removeAttribute("hidden"); }; });
  await page.keyboard.press("Control+p");
  await page.waitForFunction(() => window.printed, null, { timeout: 60_000 });
  await page.evaluate(() => { document.getElementById("brief").hidden = false; });
  await page.emulateMedia({ media: "print" });
  const text = await page.evaluate(() => document.getElementById("brief").innerText);
  for (const words of ["Predicted error of position", "largest σ", "Legs", "Landmarks", "Assumed", "Wind from"]) {
    tools.check(text.includes(words), `"${words}" is not on the page`);
  }
  const pdf = await page.pdf({ preferCSSPageSize: true });
  const pages = (pdf.toString("latin1").match(/\/Type\s*\/Page\b(?!s)/g) ?? []).length;
  writeFileSync(`${folder}/brief.pdf`, pdf);
  tools.check(pages === 1, `the brief has ${pages} pages`);
  await tools.screenshot("brief");
}
