// Keeps the page for use without a network. On a loopback address, where it is being developed,
// only with ?sw=1, so that a stale copy never hides a change.
const loopback = ["localhost", "127.0.0.1", "[::1]"].includes(location.hostname);
const asked = new URLSearchParams(location.search).get("sw") === "1";

export function registerOffline() {
  if (!("serviceWorker" in navigator) || (loopback && !asked)) return;
  navigator.serviceWorker.register("./sw.js").catch((error) => console.warn("not available offline:", error));
}
