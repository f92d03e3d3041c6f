// After one visit the page works without its server, its lessons as well, under a sub-path as on any file server.
import { createServer } from "node:http";
import { existsSync, readFileSync, statSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

export const name = "the page works offline after the first visit, its list of towns and its lessons as well, under a sub-path";

const repository = fileURLToPath(new URL("../../", import.meta.url));
const folder = process.env.PILOTAGE_PAGE
  ?? ["dist", "target/page"].map((place) => join(repository, place)).find(existsSync);
const kinds = {
  ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".wasm": "application/wasm",
  ".css": "text/css", ".svg": "image/svg+xml", ".png": "image/png", ".webmanifest": "application/manifest+json",
};
const path = "/some/where/pilotage/";

/** A plain file server: the page's folder below a path, everything else missing; that of the lessons has a shorter address, to
 * which it leads, as some hosts have it. */
async function plainServer() {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    if (pathname === `${path}learn.html`) {
      response.writeHead(302, { location: `${path}learn` }).end();
      return;
    }
    const asked = pathname === `${path}learn` ? `${pathname}.html` : pathname;
    const inner = asked.startsWith(path) ? normalize(asked.slice(path.length) || "index.html") : "..";
    const file = join(folder, inner);
    if (inner.startsWith("..") || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end("not found");
      return;
    }
    response.writeHead(200, { "content-type": kinds[extname(file)] ?? "application/octet-stream" }).end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const stop = () => { server.closeAllConnections(); server.close(); };
  return { url: `http://127.0.0.1:${server.address().port}${path}`, stop };
}

export async function run(page, tools) {
  const server = await plainServer();
  try {
    tools.expectRequest(/^http:\/\/127\.0\.0\.1:\d+\//);
    await page.goto(`${server.url}?sw=1`);
    await tools.waitReady();
    await page.waitForFunction(() => navigator.serviceWorker.controller !== null, null, { timeout: 60_000 });
    await tools.waitFor((s) => s.run_steps > 0, "the workers, which are loaded after the page", 150_000);
    tools.expectMessage(/404 \(Not Found\)/);
    const other = await page.context().newPage();
    const answer = await other.goto(`${server.url}nothing.html`);
    tools.check(answer.status() === 404, `an address that is no file is answered with ${answer.status()}`);
    await other.close();
  } finally {
    server.stop();
  }
  await page.reload();
  await tools.waitReady();
  await tools.waitFor((s) => s.run_steps > 0, "the demo without a server: workers as well", 150_000);
  await tools.screenshot("offline");
  await page.keyboard.press("Shift+W");
  await tools.waitFor((s) => s.go_to.open, "the dialog that asks for a place");
  await tools.drawn();
  await page.keyboard.type("zur");
  await tools.waitFor((s) => s.go_to.offered[0]?.startsWith("Zürich, Switzerland"), "a town of the list, without a server");
  await tools.screenshot("offline-towns");
  await page.goto(`${server.url}learn.html?embed#landmark-corrects`);
  await page.waitForSelector("#lesson-title", { timeout: 60_000 });
  tools.check((await page.title()).endsWith(" · Pilotage"), `the lessons are "${await page.title()}"`);
  tools.check(await page.isVisible("#figure svg"), "the lesson has no figure");
}
