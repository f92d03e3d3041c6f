// Landmarks labelled in the pictures of the demo; saved as COCO, kept over a reload, read back.
import { drop } from "./drop.mjs";

export const name = "pictures are labelled, an undone label is gone, and labels come back after a reload and from their file";
export const flies = 210; // steps of the demo
export const tags = ["readers", "training"];

const boxes = (s) => s.labels.flatMap((l) => l.boxes);

/** Drags a box in the picture at the cursor; again should the picture not have been there yet, since its pixels come
 * from a worker. */
async function label(tools, part) {
  const before = boxes(await tools.state()).length;
  const dragged = (s) => boxes(s).length === before + 1;
  for (let tries = 0; tries < 6; tries += 1) {
    await tools.drawn();
    const { labelling: { picture: [left, top, right, bottom] } } = await tools.state();
    const at = (x, y) => ({ x: left + x * (right - left), y: top + y * (bottom - top) });
    await tools.drag(at(part, 0.3), at(part + 0.2, 0.55));
    const state = await tools.waitFor(dragged, "the box that was dragged", 4000).catch(() => null);
    if (state) return state;
  }
  return tools.waitFor(dragged, "the box that was dragged");
}

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps >= 200, "the first seconds of the run", 150_000);
  await page.keyboard.press("k");
  await tools.waitFor((s) => s.labelling?.picture && !s.playing && s.drawn !== null, "the picture to label");
  await page.keyboard.press("Home"); // where all pictures are there that follow
  await tools.waitFor((s) => s.time < 0.5, "the first picture");

  // Two pictures by hand, one of them taken back and made again.
  const first = await label(tools, 0.2);
  await page.keyboard.press("ArrowRight");
  await tools.waitFor((s) => s.time > first.time, "the next picture");
  await page.waitForTimeout(500); // its pixels come from a worker
  await label(tools, 0.5);
  await page.keyboard.press("Control+z");
  await tools.waitFor((s) => boxes(s).length === 1, "the second label to be gone");
  await page.keyboard.press("Control+Shift+z");
  const made = await tools.waitFor((s) => boxes(s).length === 2, "it to be back");
  await tools.screenshot("labels");

  // A proposal where the true pose sees a landmark, in some picture of the flight.
  let proposed = null;
  const { landmarks: { length: count } } = made;
  for (let tried = 0; tried < 20 * count && !proposed; tried += 1) {
    if (tried % count === 0) {
      for (let up = 1; up < count; up += 1) await page.keyboard.press("ArrowUp");
      await page.keyboard.press("ArrowRight");
    } else {
      await page.keyboard.press("ArrowDown");
    }
    await page.keyboard.press("q");
    await tools.drawn();
    proposed = (await tools.state()).labelling.proposal;
  }
  tools.check(proposed, "no landmark is proposed anywhere");
  await tools.screenshot("labels-proposal");
  await page.keyboard.press("Enter");
  const three = await tools.waitFor((s) => boxes(s).length === 3, "the proposal to be a label");
  tools.check(three.labels.some((l) => l.boxes.some((b) => b[1].join() === proposed[0].join())), "the label is not the proposal");
  await page.keyboard.press("Delete");
  await tools.waitFor((s) => boxes(s).length === 2, "it to be deleted");

  // Saved as COCO.
  const download = page.waitForEvent("download");
  await page.keyboard.press("Control+k");
  await tools.waitFor((s) => s.dialogs.palette, "the palette");
  await page.keyboard.type("export the labels as coco");
  await page.keyboard.press("Enter");
  const stream = await (await download).createReadStream();
  const parts = [];
  for await (const part of stream) parts.push(part);
  const coco = JSON.parse(Buffer.concat(parts).toString());
  tools.check(coco.annotations.length === 2 && coco.images.length === 2, "two labels were not saved");

  // Kept over a reload.
  await page.waitForTimeout(1500); // the app stores a moment after the last edit
  await page.waitForFunction(() => window.page.storage.pending === 0, null, { timeout: 30_000 });
  await page.reload();
  await tools.waitReady();
  const back = await tools.waitFor((s) => boxes(s).length > 0, "the labels after the reload", 60_000);
  tools.check(JSON.stringify(back.labels) === JSON.stringify(made.labels), `${JSON.stringify(back.labels)} came back`);

  // Read back from the file, moved by ten pixels.
  for (const one of coco.annotations) one.bbox[0] += 10;
  await drop(page, [{ name: "moved.json", buffer: Buffer.from(JSON.stringify(coco)) }]);
  const told = await tools.waitFor((s) => s.toasts.find((t) => /Added 2 labels in 2 pictures from moved\.json/.test(t.title)), "a word on the file", 60_000);
  const moved = boxes(told).map((b) => b[1][0]);
  tools.check(moved.every((x, i) => Math.abs(x - 10 - boxes(made)[i][1][0]) < 1e-9), `the boxes are at ${moved}`);
}
