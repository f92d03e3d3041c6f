// The first ten seconds of a first visit, looked at five times a second: nothing untrue is ever on the screen.
export const name = "nothing untrue is on the screen in the first ten seconds of a first visit";
export const tags = ["flying"];
export const alone = true;

/** Words that are untrue while the demo is opened and flown. */
const untrue = /no run yet|no flight yet|not tested|nothing is open|no map|no landmark yet|cannot be/i;

export async function run(page, tools) {
  const begun = Date.now();
  await tools.open();
  const since = () => (Date.now() - begun) / 1000;
  const first = {};
  const note = (what, holds) => { if (holds && !(what in first)) first[what] = since(); };
  let pictures = 0;
  for (let next = 0; since() < 10; next += 0.2) {
    if (since() < next) await page.waitForTimeout(1000 * (next - since()));
    // What is on the page beside the canvas: the cover until the program has drawn.
    const cover = await page.evaluate(() => ({ text: document.body.innerText, ready: document.documentElement.dataset.ready ?? "" }));
    tools.check(!untrue.test(cover.text), `at ${since().toFixed(1)} s the page says ${cover.text}`);
    const app = await page.evaluate(() => {
      if (!window.app?.state) return null; // the canvas alone is there
      window.app.enable_a11y?.();
      return { state: JSON.parse(window.app.state() || "{}"), nodes: JSON.parse(window.app.a11y() || "[]") };
    });
    await page.screenshot({ path: tools.pictureAt(`first-visit-${String(pictures).padStart(2, "0")}`) });
    pictures += 1;
    if (!app?.state.workspace) continue;
    const said = app.nodes.map(({ label, value }) => label ?? value ?? "");
    const wrong = said.find((text) => untrue.test(text));
    tools.check(!wrong, `at ${since().toFixed(1)} s it says "${wrong}"`);
    note("the page", cover.ready);
    note("a map", app.state.map?.tiles > 0);
    note("a step of the flight", app.state.run_steps > 0);
    note("a picture of the camera", app.state.pictures > 0);
    // What the figures say is what the run holds.
    const { time, span, run_steps: steps } = app.state;
    tools.check(steps === 0 || (time >= span[0] - 1e-9 && time <= span[1] + 1e-9), `the time ${time} lies outside of ${span}`);
  }
  tools.say(`${pictures} pictures; ${Object.entries(first).map(([what, at]) => `${what} after ${at.toFixed(1)} s`).join(", ")}`);
  tools.check("a map" in first && "a step of the flight" in first, "there was no map or no flight within ten seconds");
}
