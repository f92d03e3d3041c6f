// A page that loses its graphics card (a driver that is started anew, a phone that wants the memory) says so, and has kept all.
export const name = "a page whose graphics card is taken away says so, and what was edited is there when it is loaded again";

export async function run(page, tools) {
  await tools.waitReady();
  const { origin, plan } = await tools.waitFor((s) => s.run_steps > 0, "the demo", 150_000);
  const count = plan.routes.length + 1;
  const line = [0, 1, 2].map((i) => `${i}\t${Number(i === 0)}\t3\t16\t0\t0\t0\t0\t${origin[0] + 0.001 * i}\t${origin[1]}\t90\t1`);
  const text = ["QGC WPL 110", ...line, ""].join("\n");
  await page.setInputFiles("#files", [{ name: "trip.waypoints", mimeType: "text/plain", buffer: Buffer.from(text) }]);
  await tools.waitFor((s) => s.plan.routes.length === count, "the route", 60_000);
  await page.evaluate(() => document.getElementById("app").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext());
  await page.waitForSelector("#trouble", { state: "visible" });
  const told = await page.textContent("#trouble");
  tools.say(told.trim().replace(/\s+/g, " "));
  tools.check(/graphics card stopped drawing.*documents are safe.*Load the page again/s.test(told), `it says: ${told}`);
  await page.waitForTimeout(1500); // in which nothing else is told instead
  tools.check(await page.textContent("#trouble") === told, `it goes on to say: ${await page.textContent("#trouble")}`);
  await page.waitForFunction(() => window.page.storage.pending === 0);
  await tools.screenshot("lost-graphics");
  await Promise.all([page.waitForEvent("load"), page.click("#reload")]);
  await tools.waitReady();
  await tools.waitFor((s) => s.plan.routes.length === count, "the route after the page was loaded again", 150_000);
}
