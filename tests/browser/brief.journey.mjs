// The mission brief as it comes out of the browser's print.
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

export const name = "the mission brief is one printed page with map, legs, landmarks and prediction";
export const tags = ["plan"];

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
  for (const words of ["Predicted error of position", "largest error (1σ)", "Legs", "Landmarks", "Assumed", "Wind from", "Aircraft: cruise at", "N 4", " UTC"]) {
    tools.check(text.includes(words), `"${words}" is not on the page`);
  }
  const pages = async (title) => {
    const pdf = await page.pdf({ preferCSSPageSize: true });
    writeFileSync(`${folder}/${title}.pdf`, pdf);
    return (pdf.toString("latin1").match(/\/Type\s*\/Page\b(?!s)/g) ?? []).length;
  };
  tools.check(await pages("brief") === 1, `the brief has ${await pages("brief")} pages`);
  await tools.screenshot("brief");
  // Neither the map nor a thumbnail is empty: each has many colours.
  const colours = await page.evaluate(async () => {
    const images = [...document.querySelectorAll("#brief image, #brief img")];
    return Promise.all(images.map(async (shown) => {
      const image = new Image();
      image.src = shown.getAttribute("href") ?? shown.getAttribute("src");
      await image.decode();
      const canvas = new OffscreenCanvas(60, 40).getContext("2d");
      canvas.drawImage(image, 0, 0, 60, 40);
      const { data } = canvas.getImageData(0, 0, 60, 40);
      return new Set(Array.from({ length: 2400 }, (_, i) => data.slice(4 * i, 4 * i + 3).join())).size;
    }));
  });
  tools.check(colours.length > 1 && colours.every((count) => count > 100), `pictures of ${colours} colours`);

  // A survey of many legs stays on one page, and says how many it leaves out.
  await page.emulateMedia({ media: null });
  await page.evaluate(() => { document.getElementById("brief").hidden = true; window.printed = false; });
  const { origin } = await tools.state();
  const others = (await tools.state()).plan.routes.length;
  const line = Array.from({ length: 70 }, (_, i) => {
    const [north, east] = [Math.floor(i / 2) * 2e-4, (i + Math.floor(i / 2)) % 2 * 8e-3];
    return `${i + 1}\t0\t3\t16\t0\t0\t0\t0\t${origin[0] + north}\t${origin[1] + east}\t120\t1`;
  });
  const home = `0\t1\t0\t16\t0\t0\t0\t0\t${origin[0]}\t${origin[1]}\t0\t1`;
  await page.setInputFiles("#files", [{ name: "survey.waypoints", mimeType: "text/plain", buffer: Buffer.from(["QGC WPL 110", home, ...line, ""].join("\n")) }]);
  await tools.waitFor((s) => s.plan.routes.length === others + 1 && s.plan.routes.at(-1).way_points.length === 70, "the survey", 60_000);
  await page.waitForTimeout(1500);
  await page.locator("#app").focus();
  await page.keyboard.press("Control+p");
  await page.waitForFunction(() => window.printed, null, { timeout: 60_000 });
  await page.evaluate(() => { document.getElementById("brief").hidden = false; });
  await page.emulateMedia({ media: "print" });
  const long = await page.evaluate(() => document.getElementById("brief").innerText);
  tools.check(/survey/.test(long), "the survey is not what is printed");
  tools.check(/and \d+ more, up to way-point 69/.test(long), "the brief does not say that legs are left out");
  tools.check(await pages("brief-survey") === 1, "the brief of the survey has more pages");
  const cut = await page.evaluate(() => { const page = document.getElementById("brief"); return page.scrollHeight - page.clientHeight; });
  tools.say(`${cut} px of the survey's brief are cut off`);
  tools.check(cut < 2, `${cut} px of the brief are cut off`);
  await tools.screenshot("brief-survey");
}
