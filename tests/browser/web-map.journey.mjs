// Tiles of the web, a GeoTIFF and an archive of tiles at addresses, from a server of this journey's own.
import { createServer } from "node:http";
import { country, geotiff } from "./geotiff.mjs";
import { pmtiles } from "./pmtiles.mjs";
import { png } from "./png.mjs";

export const name = "tiles of the web are shown with their attribution, downloaded for an area, and there when the server is gone; a GeoTIFF and a PMTiles archive are read by ranges";
export const long = true;
export const tags = ["maps"];

const shade = (zoom, x, y) => [40 + ((x * 37) % 5) * 40, 60 + ((y * 53) % 5) * 35, (zoom * 29) % 256];

function serve(files) {
  const counts = { tiles: 0, ranges: 0, bytes: 0, asked: new Map() };
  let refuses = false;
  let passes = Infinity; // so many tiles are sent, the others wait until they are let through
  const held = [];
  const server = createServer((request, response) => {
    response.setHeader("Access-Control-Allow-Origin", "*");
    response.setHeader("Access-Control-Allow-Headers", "Range");
    if (request.method === "OPTIONS") return response.end();
    const tile = request.url.match(/^\/(\d+)\/(\d+)\/(\d+)\.png$/);
    if (tile) {
      counts.tiles += 1;
      counts.asked.set(request.url, 1 + (counts.asked.get(request.url) ?? 0));
      if (refuses) return response.writeHead(503).end();
      const [zoom, x, y] = tile.slice(1).map(Number);
      const body = png(256, 256, (c, r) => (c === 0 || r === 0 ? [255, 255, 255] : shade(zoom, x, y)));
      response.setHeader("Content-Type", "image/png");
      response.setHeader("Vary", "*"); // as some servers say, whose answers no browser keeps as they are
      passes -= 1;
      return passes >= 0 ? response.end(body) : held.push(() => response.end(body));
    }
    const map = files[request.url];
    if (map) {
      response.setHeader("Accept-Ranges", "bytes");
      const range = request.headers.range?.match(/bytes=(\d+)-(\d+)/);
      if (!range) return response.setHeader("Content-Length", map.length).end(request.method === "HEAD" ? undefined : map);
      const part = map.subarray(Number(range[1]), Number(range[2]) + 1);
      counts.ranges += 1;
      counts.bytes += part.length;
      response.writeHead(206, { "Content-Range": `bytes ${range[1]}-${range[2]}/${map.length}`, "Content-Length": part.length });
      return response.end(part);
    }
    response.writeHead(404).end();
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve({
    counts, address: `http://127.0.0.1:${server.address().port}`, close: () => server.close(), refuse() { refuses = true; },
    hold(after) { passes = after; },
    pass(count) { held.splice(0, count).forEach((send) => send()); },
    release() { passes = Infinity; held.splice(0).forEach((send) => send()); },
  })));
}

async function command(page, tools, words) {
  await page.keyboard.press("Control+k");
  await tools.waitFor((s) => s.dialogs.palette, "the command palette");
  await page.keyboard.type(words);
  await page.keyboard.press("Enter");
}

/** Opens a file at an address; what is there when all of it is shown. */
async function openFile(page, tools, address) {
  await command(page, tools, "map from the web");
  await tools.waitFor((s) => s.web_map.open, "the dialog");
  await tools.drawn();
  await tools.type("Address", address);
  await tools.find("TextInput", address);
  // The dialog is lower without the fields for tiles: its button stays where it is from then on.
  let place = null;
  for (let i = 0; i < 100; i += 1) {
    await tools.drawn();
    const button = tools.middle(await tools.find("Button", "Open the map"));
    if (place && place.x === button.x && place.y === button.y) break;
    place = button;
    await page.waitForTimeout(300);
  }
  await page.mouse.click(place.x, place.y);
  const file = address.slice(address.lastIndexOf("/"));
  return tools.waitFor((s) => s.map.name?.endsWith(file) && s.map.tiles > 0 && s.map.whole, address, 120_000);
}

/** With no room for more, tiles are shown all the same, and a download ends with its first tile in vain. */
async function fullStorage(page, tools, server) {
  const session = await page.context().newCDPSession(page);
  const { origin } = new URL(tools.address);
  await session.send("Storage.overrideQuotaForOrigin", { origin, quotaSize: 1 });
  const { map } = await tools.state();
  const [left, top, right, bottom] = map.rect;
  const at = (y) => ({ x: left + 0.12 * (right - left), y: top + y * (bottom - top) });
  const asked = server.counts.tiles;
  for (let i = 0; i < 3; i += 1) await tools.drag(at(0.75), at(0.25));
  await tools.waitFor((s) => s.map.center[0] < map.center[0] && server.counts.tiles > asked && s.map.whole, "tiles that cannot be kept", 60_000);
  await tools.screenshot("web-map-full");
  await command(page, tools, "map from the web");
  await tools.waitFor((s) => s.web_map.open, "the dialog");
  const before = server.counts.tiles;
  await tools.click(await tools.find("Button", "Download what is in sight"));
  const ended = (s) => s.web_map.download?.over && s.toasts.some((t) => t.trouble && t.title === "The area is not whole");
  const { web_map: { download }, toasts } = await tools.waitFor(ended, "the end of the download", 60_000);
  tools.say(`without room: ${download.done} of ${download.all} tiles, ${download.failed} in vain; ${toasts.find((t) => t.trouble).text}`);
  tools.check(download.done < download.all && download.failed > 0, `it went on without room: ${JSON.stringify(download)}`);
  tools.check(server.counts.tiles - before <= 8, `${server.counts.tiles - before} tiles were requested that nothing can keep`);
  await page.keyboard.press("Escape");
  await session.send("Storage.overrideQuotaForOrigin", { origin });
  for (let i = 0; i < 3; i += 1) await tools.drag(at(0.25), at(0.75));
}

/** What was looked at longest ago goes first once more is kept than may be; what is used and downloaded areas stay. */
async function bounded(page, tools) {
  const server = await serve({});
  const looked = (numbers, rooms) => page.evaluate(async ([address, all, room]) => {
    const { fetchTiles } = await import("./tiles.js");
    for (const i of all) await fetchTiles([`${address}/11/${i}/${i}.png`, `${address}/11/0/0.png`], caches, room);
    const names = (await caches.keys()).filter((name) => name.startsWith("tiles-seen-"));
    const kept = await Promise.all(names.map(async (name) => (await caches.open(name)).matchAll()));
    const bytes = await Promise.all(kept.flat().map(async (tile) => (await tile.blob()).size));
    return bytes.reduce((sum, it) => sum + it, 0);
  }, [server.address, numbers, rooms]);
  await page.evaluate(async (address) => (await import("./tiles.js")).downloadTiles([`${address}/12/1/1.png`]), server.address);
  const room = 20_000;
  const all = Array.from({ length: 200 }, (_, i) => i + 1);
  const bytes = await looked(all, room);
  tools.check(bytes <= 1.2 * room, `${bytes} bytes are kept of ${room}`);
  tools.say(`${bytes} bytes are kept where ${room} may be, after ${all.length} tiles`);
  const before = server.counts.tiles;
  await looked([200], room);
  await page.evaluate(async (address) => (await import("./tiles.js")).fetchTiles([`${address}/12/1/1.png`]), server.address);
  tools.check(server.counts.tiles === before, "what was used, or downloaded, was thrown away");
  await looked([1], room);
  tools.check(server.counts.tiles === before + 1, "what was used longest ago is still there");
  server.close();
}

export async function run(page, tools) {
  const side = 1200;
  const server = await serve({
    "/far.tif": geotiff({ width: side, height: side, gsd: 0.5, east: 570_000, north: 5_190_000, pixel: country(side, side) }),
    "/far.pmtiles": pmtiles(png(256, 256, country(256, 256))),
  });
  tools.expectRequest(/^http:\/\/127\.0\.0\.1:/);
  tools.expectMessage(/503|Failed to load resource/);
  try {
    await tools.waitReady();
    await tools.waitFor((s) => s.run_steps > 0 && s.map.tiles > 0, "the demo", 150_000);
    tools.check(server.counts.tiles === 0, "something was requested before anybody asked for it");
    await command(page, tools, "map from the web");
    await tools.waitFor((s) => s.web_map.open, "the dialog");
    await tools.type("Address", `${server.address}/{z}/{x}/{y}.png`);
    await tools.type("Attribution", "Map by the journey's own server");
    await tools.screenshot("web-map-dialog");
    await tools.click(await tools.find("Button", "Open the map"));
    const shown = await tools.waitFor((s) => s.map.name?.startsWith("127.0.0.1") && s.map.tiles > 3 && s.map.whole, "the tiles", 60_000);
    tools.check(shown.map.attribution === "Map by the journey's own server", "the attribution is not shown");
    tools.check(server.counts.tiles > 3, `${server.counts.tiles} tiles were requested`);
    await tools.find("Label", /the journey's own server/);
    await page.waitForTimeout(500);
    await tools.screenshot("web-map");

    await command(page, tools, "map from the web");
    await tools.waitFor((s) => s.web_map.open, "the dialog");
    await tools.screenshot("web-map-download");
    // Stopped on the way, it goes on later where it was: no tile is asked for twice.
    const asked = server.counts.tiles;
    server.hold(0);
    await tools.click(await tools.find("Button", "Download what is in sight"));
    // Tile by tile until some of them have come; the map itself may want a few, too.
    const letting = setInterval(() => server.pass(1), 150);
    await tools.waitFor((s) => s.web_map.download?.done > 2, "the first tiles", 60_000).finally(() => clearInterval(letting));
    await tools.click(await tools.find("Button", "Stop the download"));
    await page.waitForTimeout(2000);
    server.release();
    const stopped = await tools.waitFor((s) => s.web_map.download?.over, "the stop", 30_000);
    tools.check(stopped.web_map.download.done < stopped.web_map.download.all, `it was not stopped: ${JSON.stringify(stopped.web_map.download)}`);
    // What was asked for before the stop may still come, and the map itself may want a few for the view.
    let paused = -1;
    for (let i = 0; i < 20 && server.counts.tiles !== paused; i += 1) {
      paused = server.counts.tiles;
      await page.waitForTimeout(800);
    }
    tools.check(server.counts.tiles === paused, "tiles are requested after the stop");
    tools.check(paused - asked < stopped.web_map.download.all, `${paused - asked} tiles were requested in spite of the stop`);
    await page.mouse.move(20, 400); // the dialog is drawn anew, lower than while it showed progress
    await page.waitForTimeout(700);
    await tools.click(await tools.find("Button", "Download what is in sight"));
    const done = await tools.waitFor((s) => s.web_map.download?.over && s.web_map.download.done === s.web_map.download.all, "the download", 60_000);
    tools.check(done.web_map.download.failed === 0 && done.web_map.download.done > 4, JSON.stringify(done.web_map.download));
    const twice = [...server.counts.asked].filter(([, times]) => times > 1);
    tools.check(twice.length === 0, `asked for more than once: ${twice.join("; ")}`);
    tools.say(`stopped after ${stopped.web_map.download.done} of ${stopped.web_map.download.all} tiles`);
    tools.say(`${done.web_map.download.done} tiles downloaded, ${server.counts.tiles} requested in all`);
    await page.keyboard.press("Escape");
    await fullStorage(page, tools, server);
    // The server fails; the page is loaded again.
    server.refuse();
    const before = server.counts.tiles;
    await page.waitForTimeout(1500);
    await page.waitForFunction(() => window.page.storage.pending === 0);
    await page.reload();
    await tools.waitReady();
    await tools.waitFor((s) => s.map.name?.startsWith("127.0.0.1") && s.map.tiles > 3, "the tiles without the server", 60_000);
    tools.say(`${server.counts.tiles - before} requests after the reload`);

    const far = await openFile(page, tools, `${server.address}/far.tif`);
    tools.say(`${server.counts.ranges} ranges, ${(server.counts.bytes / 1e6).toFixed(1)} MB`);
    tools.check(server.counts.ranges > 1 && Math.abs(far.map.gsd - 0.5) < 1e-3, "the file was not read by ranges");
    await tools.screenshot("web-map-file");

    const ranges = server.counts.ranges;
    const archive = await openFile(page, tools, `${server.address}/far.pmtiles`);
    tools.check(server.counts.ranges > ranges, "the archive was not read by ranges");
    tools.check(archive.map.attribution === "© Whoever", `the attribution is ${archive.map.attribution}`);
    await tools.screenshot("web-map-archive");
    await bounded(page, tools);
  } finally {
    server.close();
  }
}
