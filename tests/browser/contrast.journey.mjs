// Every word on the panels and over five maps is told from what is behind it, in both themes: measured in the pixels.
import { geotiff } from "./geotiff.mjs";

export const name = "words have a contrast of 4.5 to 1 on panels and over five maps, in dark and light";
export const long = true;
export const tags = ["maps", "plan"];
export const screen = { sharpness: 2 };

const least = 4.5; // of words
const leastOfSigns = 3; // of what is a sign alone, by its width
const signWidth = 40; // CSS pixels
const hidden = 1.25; // less is not drawn: what shows itself under the pointer alone
const fade = 40; // CSS pixels at the lower end of a column, in which what goes on below fades away

/** Maps by the grey of their pixels. */
const maps = {
  white: () => [250, 250, 248],
  black: () => [6, 8, 10],
  grey: () => [128, 128, 128],
  checks: (x, y) => ((x >> 3) + (y >> 3)) % 2 ? [235, 230, 220] : [30, 40, 35],
};

/** The contrast of each node's words by WCAG: between the colour that most of its pixels have and the one of those left
 * that is farthest from it, of which there are as many as a stroke has. Measured on the page's canvas, or in a
 * `picture` of the window, which costs several times as much. */
async function contrasts(page, nodes, picture = null) {
  return page.evaluate(async ([picture, nodes, sharpness, signWidth]) => {
    const canvas = new OffscreenCanvas(innerWidth * sharpness, innerHeight * sharpness);
    const context = canvas.getContext("2d", { willReadFrequently: true });
    if (picture) {
      const bytes = Uint8Array.from(atob(picture), (letter) => letter.charCodeAt(0));
      context.drawImage(await createImageBitmap(new Blob([bytes], { type: "image/png" })), 0, 0);
    } else {
      const isPainted = await window.paintNow((painted) => {
        const { left, top, width, height } = painted.getBoundingClientRect();
        context.drawImage(painted, ...[left, top, width, height].map((v) => v * sharpness));
      });
      if (!isPainted) throw new Error("the page paints nothing");
    }
    const linear = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
    const luminance = (r, g, b) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    return nodes.map(({ rect }) => {
      const [left, top, right, bottom] = rect.map((v) => Math.round(v * sharpness));
      const [width, height] = [right - left, bottom - top];
      const { data } = context.getImageData(left, top, width, height);
      const counts = new Map();
      for (let i = 0; i < data.length; i += 4) {
        const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
        counts.set(colour, (counts.get(colour) ?? 0) + 1);
      }
      const parts = (colour) => [colour >> 16, (colour >> 8) & 255, colour & 255];
      const ordered = [...counts].sort((a, b) => b[1] - a[1]);
      const behind = luminance(...parts(ordered[0][0]));
      // Colours by their contrast, the strongest first, until they make up a stroke.
      const ratio = (l) => (Math.max(l, behind) + 0.05) / (Math.min(l, behind) + 0.05);
      const strong = ordered.map(([colour, count]) => [ratio(luminance(...parts(colour))), count]).sort((a, b) => b[0] - a[0]);
      const stroke = width <= signWidth * sharpness ? 5 : 12; // pixels
      let sum = 0;
      for (const [value, count] of strong) {
        sum += count;
        if (sum >= stroke) return value;
      }
      return 1;
    });
  }, [picture?.toString("base64"), nodes, screen.sharpness, signWidth]);
}

/** Fails unless what is measured on the canvas is what the window shows. */
async function checkCanvas(page, tools) {
  for (let tries = 0; ; tries += 1) {
    const nodes = await wordedNodes(tools);
    const [onCanvas, inWindow] = [await contrasts(page, nodes), await contrasts(page, nodes, await page.screenshot())];
    const other = nodes.filter((_, i) => Math.abs(onCanvas[i] - inWindow[i]) > 0.01);
    if (nodes.length > 0 && other.length === 0) return;
    tools.check(tries < 5, `the canvas is not what the window shows: ${nodes.length} nodes, ${JSON.stringify(other.slice(0, 5))}`);
  }
}

/** Nodes with words that people can use and see whole. */
async function wordedNodes(tools) {
  const worded = ["Label", "Button", "Tab", "Link", "CheckBox", "RadioButton", "TextRun"];
  return (await tools.a11y()).filter(({ role, label, value, disabled, rect: [left, top, right, bottom] }) => worded.includes(role)
    && !disabled && /[\p{L}\p{N}]{2}/u.test(label ?? value ?? "") && left >= 0 && top >= 0 && right <= 1440 && bottom <= 900 && right - left > 8 && bottom - top > 8);
}

export async function run(page, tools) {
  await tools.waitReady();
  await tools.openRun();
  await tools.waitFor((s) => s.time > 5, "a landmark to be recognised", 60_000);
  if ((await tools.state()).playing) await page.keyboard.press("Space");
  let checked = 0;
  const low = [];
  const judge = async (where) => {
    for (let [notice] = await tools.findAll("Button", "Dismiss notice"); notice; [notice] = await tools.findAll("Button", "Dismiss notice")) {
      await tools.click(notice);
      await tools.drawn();
    }
    await page.mouse.move(3, 890);
    await page.waitForTimeout(700);
    // What is still being tested grows on the page: a picture is good if everything is where it was before it.
    let nodes = await wordedNodes(tools);
    let values = await contrasts(page, nodes);
    for (let again = 0; again < 5; again += 1) {
      const after = await wordedNodes(tools);
      if (JSON.stringify(after) === JSON.stringify(nodes)) break;
      nodes = after;
      values = await contrasts(page, nodes);
    }
    const { map, workspace } = await tools.state();
    const columnEnd = workspace === "Plan" ? map.rect[3] : 835;
    nodes.forEach(({ role, label, value, rect: [left, , right, bottom] }, i) => {
      if (values[i] < hidden || (left > map.rect[2] && bottom > columnEnd - fade)) return;
      checked += 1;
      if (values[i] < (right - left <= signWidth ? leastOfSigns : least)) low.push(`${where}: ${role} "${label ?? value}" ${values[i].toFixed(2)}`);
    });
    await tools.screenshot(`contrast-${where.replaceAll(" ", "-")}`);
  };
  const everywhere = async (where) => {
    for (const theme of ["dark", "light"]) {
      if ((await tools.state()).dark !== (theme === "dark")) {
        await page.keyboard.press("Control+k");
        await tools.waitFor((s) => s.dialogs.palette, "the palette");
        await page.keyboard.type("theme");
        await tools.drawn();
        await page.keyboard.press("Enter");
        await tools.waitFor((s) => s.dark === (theme === "dark"), `the ${theme} theme`);
      }
      await judge(`${where} ${theme}`);
    }
  };
  await everywhere("replay");
  await checkCanvas(page, tools);
  await page.keyboard.press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction?.fine, "the plan", 90_000);
  await everywhere("plan");
  for (const [kind, pixel] of Object.entries(maps)) {
    const map = geotiff({ width: 700, height: 500, gsd: 0.5, east: 570_000, north: 5_190_000, pixel });
    await page.setInputFiles("#files", [{ name: `${kind}.tif`, mimeType: "image/tiff", buffer: Buffer.from(map) }]);
    await tools.waitFor((s) => s.map.name === `${kind}.tif` && s.map.tiles > 0, `the ${kind} map`, 60_000);
    await page.keyboard.press("n");
    await page.keyboard.press("Enter");
    await page.keyboard.press("Enter");
    await everywhere(kind);
  }
  tools.say(`${checked} words measured, ${low.length} below ${least}`);
  for (const line of low.slice(0, 40)) tools.say(line);
  tools.check(low.length === 0, `${low.length} of ${checked} below ${least}`);
}
