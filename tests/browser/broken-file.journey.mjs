// Files that are broken or of no use are refused with their name and what is wrong with them.
export const name = "a broken file is refused with its name and cause, and nothing is lost";

async function choose(page, files) {
  await page.setInputFiles("#files", files);
}

const file = (name, text) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(text) });

export async function run(page, tools) {
  await tools.waitReady();
  const before = await tools.waitFor((s) => s.run_steps > 20, "the first seconds of the run", 150_000);
  const cases = [
    [[file("flight.json", "{\n  \"pilotage_flight\": one\n}")], /flight\.json.*line 2/s],
    [[file("wandered.zip", "this is no zip file")], /wandered\.zip/],
    [[file("notes.txt", "dear diary")], /notes\.txt.*flight\.json/s],
    [[file("last.run", "PILOTAGE RUN 1\nbroken")], /last\.run/],
  ];
  for (const [files, expected] of cases) {
    await choose(page, files);
    const told = (s) => s.toasts.find((t) => t.trouble && expected.test(`${t.title} ${t.text}`));
    const state = await tools.waitFor(told, `a message like ${expected}`, 60_000);
    console.log(`        ${told(state).title}: ${told(state).text}`);
    tools.check(state.landmarks.length === before.landmarks.length, "landmarks were lost");
    tools.check(state.flight === before.flight, "the flight was lost");
    tools.check(state.run_steps >= before.run_steps && state.run_generation === before.run_generation, "the run was lost");
  }
  await tools.screenshot("broken-file");
}
