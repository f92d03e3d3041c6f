// Dragging the time moves whatever shows a time.
export const name = "scrubbing moves every view";
export const flies = 210; // steps of the demo

export async function run(page, tools) {
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 200 && s.pictures > 20, "some seconds of the run", 150_000);
  await page.keyboard.press("Space");
  await tools.waitFor((s) => !s.playing, "the pause after the space key");

  let before = null;
  for (const seconds of [8, 5]) {
    const { timeline: [left, top, right, bottom], span: [begin, end], time } = await tools.state();
    const place = (t) => ({ x: left + (right - left) * (t - begin) / (end - begin), y: (top + bottom) / 2 });
    await tools.drag(place(time), place(seconds));
    const state = await tools.waitFor((s) => Math.abs(s.time - seconds) < 1, `the cursor near ${seconds} s`);
    tools.check(Math.abs(state.step.time - state.time) < 0.2, "the step shown is not the one under the cursor");
    const shown = await tools.a11y();
    const text = (node) => node.value ?? node.label ?? "";
    const slider = shown.find((n) => n.role === "Slider" && n.label === "Time");
    tools.check(slider && Math.abs(slider.number - state.time) < 0.1, `the timeline shows ${slider?.number}, not ${state.time}`);
    const clocks = [-0.05, 0, 0.05].map((d) => `0:0${Math.max(0, state.time - begin + d).toFixed(1)}`);
    tools.check(shown.some((n) => clocks.some((clock) => text(n).includes(clock))), `nothing on screen says ${clocks[1]}`);
    await tools.screenshot(`scrub-${seconds}`);
    before = await everyView(tools, before);
  }

  const paused = await tools.state();
  await page.keyboard.press("ArrowRight");
  const after = await tools.waitFor((s) => s.time > paused.time, "the next camera frame");
  tools.check(after.time - paused.time <= 0.51, `one frame is ${after.time - paused.time} s long`);
}

/** Every view has drawn the cursor's time, and something of that time, other than `before`. */
async function everyView(tools, before) {
  const shown = {};
  for (const [tab, views] of [["Match", ["map", "camera", "match"]], ["Filter", ["inspector", "plots", "timeline"]]]) {
    await tools.click(await tools.find("Tab", tab));
    for (const view of views) {
      const { drawn, time } = await tools.waitFor((s) => s.drawn[view]?.cursor === s.time, `${view} to draw the new time`);
      const { content } = drawn[view];
      tools.check(content <= time + 1e-6 && content > time - 3, `${view} shows ${content} s at ${time} s`);
      tools.check(content !== before?.[view], `${view} still shows what it showed before`);
      shown[view] = content;
    }
  }
  return shown;
}
