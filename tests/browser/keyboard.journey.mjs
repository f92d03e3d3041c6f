// Not once is the pointer used: a landmark, a route, its export, a setting, the tour.
export const name = "everything is done by the keyboard: a landmark, a route and its export, a setting, the tour";
export const tags = ["plan"];

export async function run(page, tools) {
  await tools.waitReady();
  const demo = await tools.waitFor((s) => s.run_steps > 40, "the demo", 150_000);
  const press = async (...keys) => {
    for (const key of keys) {
      await page.keyboard.press(key);
      await tools.drawn();
    }
  };
  const command = async (words) => {
    await press("Control+k");
    await tools.waitFor((s) => s.dialogs.palette, "the palette");
    await page.keyboard.type(words);
    await tools.drawn();
    await press("Enter");
    await tools.waitFor((s) => !s.dialogs.palette, "the palette to close");
  };
  /** Goes to a control by Tab. */
  const focus = async (label) => {
    for (let tries = 0; tries < 150; tries += 1) {
      await press("Tab");
      const [node] = (await tools.shown()).filter((it) => it.focused);
      if (node && (label instanceof RegExp ? label.test(node.label ?? "") : node.label === label)) return node;
    }
    throw new Error(`Tab does not lead to ${label}`);
  };

  // A landmark drawn on the map, moved and made larger.
  await press("Shift+P");
  await tools.waitFor((s) => s.workspace === "Plan" && s.plan.prediction?.fine, "the plan", 90_000);
  await press("n");
  await tools.waitFor((s) => s.map.picking, "the tool that draws landmarks");
  await press("Enter");
  const drawn = await tools.waitFor((s) => s.landmarks.length === demo.landmarks.length + 1, "a landmark by Enter");
  await page.keyboard.type("Mill");
  await press("Enter");
  await tools.waitFor((s) => s.landmarks.at(-1).name === "Mill", "its name");
  tools.say(`a landmark of ${(drawn.landmarks.at(-1).north - drawn.landmarks.at(-1).south).toFixed(0)} m`);

  // A route, and its file.
  const routes = drawn.plan.routes.length;
  await press("Escape", "w");
  await tools.waitFor((s) => s.plan.drawing, "the tool that draws routes");
  await press("i", "i", "Enter");
  await tools.waitFor((s) => !s.plan.drawing && s.plan.routes.length === routes + 1 && s.plan.routes.at(-1).way_points.length === 2, "a route of two way-points");
  const download = page.waitForEvent("download");
  await command("export route qgroundcontrol plan");
  const file = await download;
  tools.check(file.suggestedFilename().endsWith(".plan"), file.suggestedFilename());
  await tools.screenshot("keyboard-plan");

  // A setting of the filter, by Tab and Space.
  await command("filter settings");
  await tools.waitFor((s) => s.dialogs.settings, "the settings");
  await focus("Draw the points anew after the process noise");
  const { redraw } = (await tools.state()).navigator;
  await press("Space");
  await tools.waitFor((s) => s.navigator.redraw !== redraw, "the setting");
  await command("filter settings");
  await tools.waitFor((s) => !s.dialogs.settings, "the settings to close");

  // The tour, forward and back.
  await command("tour");
  const begun = await tools.waitFor((s) => s.tour && s.workspace === "Learn", "the tour");
  await press("PageDown");
  await tools.waitFor((s) => s.tour.stop !== begun.tour.stop, "the next stop");
  await press("PageUp");
  await tools.waitFor((s) => s.tour.stop === begun.tour.stop, "the stop before");
}
