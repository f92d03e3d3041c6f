// Serves the page without a network after the first visit. `cargo xtask dist` fills in the two names.
const BUILD = "__BUILD_ID__";
const FILES = __FILES__;
const CACHE = `pilotage-${BUILD}`;
const here = (path) => new URL(path, self.registration.scope).href;
/** A kept file as a browser takes it for a page, too: not as the end of a redirection, such as servers that shorten addresses make. */
const whole = (kept) => (kept?.redirected ? new Response(kept.body, kept) : kept);

self.addEventListener("install", (event) => {
  const wanted = new Set(["./", ...FILES].map(here));
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll([...wanted].map((url) => new Request(url, { cache: "no-cache" })))));
});

self.addEventListener("activate", (event) => {
  const old = (names) => names.filter((name) => name.startsWith("pilotage-") && name !== CACHE);
  event.waitUntil(caches.keys().then((names) => Promise.all(old(names).map((name) => caches.delete(name)))).then(() => self.clients.claim()));
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || !request.url.startsWith(self.registration.scope)) return;
  event.respondWith(caches.open(CACHE).then(async (cache) => {
    const kept = async (asked) => whole(await cache.match(asked, { ignoreSearch: true, ignoreVary: true }));
    const { origin, pathname } = new URL(request.url);
    return await kept(request) ?? fetch(request).catch(async (error) => {
      const page = request.mode === "navigate" && await kept(`${origin}${pathname}.html`); // by its address as servers shorten it
      if (page) return page;
      throw error;
    });
  }));
});
