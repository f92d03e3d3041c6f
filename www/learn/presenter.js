// A lesson on a projector: one step at a time, a spotlight, a pointer, and notes in a second window.

import { tell as say } from "./menu.js";

const find = (id) => document.getElementById(id);
const channel = new BroadcastChannel("pilotage-lesson");

/** Lets the lesson be presented: P begins and ends, arrows go on and back, S and L light, N opens the notes. */
export function offerPresenter(page) {
  const show = { page, on: false, at: 0, steps: [] };
  find("present").addEventListener("click", () => begin(show));
  find("notes-window").addEventListener("click", () => openNotes(show));
  document.addEventListener("keydown", (event) => key(show, event));
  document.addEventListener("fullscreenchange", () => { if (!document.fullscreenElement && show.on && show.full) end(show); });
  document.addEventListener("pointermove", (event) => {
    find("light").style.setProperty("--x", `${event.clientX}px`);
    find("light").style.setProperty("--y", `${event.clientY}px`);
  });
  window.addEventListener("hashchange", () => { if (show.on && page.open !== show.lesson) collect(show, 0); });
  channel.addEventListener("message", ({ data }) => { if (data === "where?" && show.on) tell(show); });
}

function key(show, event) {
  const typing = event.target.matches?.("input:not([type=radio], [type=range]), textarea, select") && !show.on;
  if (event.ctrlKey || event.metaKey || event.altKey || typing) return;
  const does = {
    p: () => (show.on ? end(show) : begin(show)),
    n: () => openNotes(show),
    ...(show.on && {
      ArrowRight: () => go(show, 1), PageDown: () => go(show, 1), " ": () => go(show, 1),
      ArrowLeft: () => go(show, -1), PageUp: () => go(show, -1),
      Escape: () => end(show), s: () => light("spotlight"), l: () => light("laser"),
    }),
  }[event.key];
  // A slider keeps its arrows, a button its space.
  const own = event.target.matches?.("input[type=range]") && event.key.startsWith("Arrow");
  const pressed = event.target.matches?.("button, a") && event.key === " ";
  if (!does || own || pressed) return;
  event.preventDefault();
  does();
}

async function begin(show) {
  if (!show.page.open) location.hash = show.page.lessons[0];
  await new Promise((done) => { requestAnimationFrame(done); });
  show.on = true;
  find("menu").hidden = true;
  document.body.classList.add("presenting");
  collect(show, 0);
  say(show.page.words["present-keys"]);
  show.full = await document.documentElement.requestFullscreen?.().then(() => true, () => false);
}

function end(show) {
  show.on = false;
  document.body.classList.remove("presenting");
  find("light").hidden = true;
  for (const step of show.steps) step.classList.remove("slide");
  for (const equation of document.querySelectorAll("#article math[style]")) equation.style.fontSize = "";
  if (document.fullscreenElement) document.exitFullscreen();
}

/** Gathers the slides of the open lesson: its head, then its steps. */
function collect(show, at) {
  show.lesson = show.page.open;
  const mathematics = document.body.dataset.depth === "mathematics";
  show.steps = [...document.querySelectorAll("#article > header, #article > section:not(.sources)")]
    .filter((it) => mathematics || it.id !== "mathematics");
  show.at = at < 0 ? show.steps.length + at : at;
  slide(show);
}

function slide(show) {
  show.steps.forEach((step, index) => step.classList.toggle("slide", index === show.at));
  show.steps[show.at]?.querySelector("h1, h2")?.focus({ preventScroll: true });
  fit();
  window.scrollTo(0, 0);
  tell(show);
}

/** Letters as large as the slide leaves room for, from 32 to 17 points; equations that are wider yet, which nobody scrolls
 * on a projector, have smaller ones of their own. */
function fit() {
  for (let size = 32; size >= 17; size -= 1) {
    document.body.style.setProperty("--projected", `${size}px`);
    if (document.documentElement.scrollHeight <= innerHeight) break;
  }
  for (const equation of document.querySelectorAll(".slide math[display=block]")) {
    equation.style.fontSize = "";
    for (let size = 1; size > 0.4 && equation.scrollWidth > equation.clientWidth; size -= 0.05) {
      equation.style.fontSize = `${size}em`;
    }
  }
}

/** One step on or back: the answer of a guess comes before what follows it, and a lesson after the other. */
function go(show, by) {
  const hidden = show.steps[show.at]?.querySelector(".answer[hidden]");
  if (by > 0 && hidden) {
    show.page.reader.answer(null);
    fit();
    return;
  }
  const next = show.at + by;
  if (next >= 0 && next < show.steps.length) {
    show.at = next;
    slide(show);
    return;
  }
  const { lessons } = show.page;
  const other = lessons[lessons.indexOf(show.page.open) + by];
  if (!other) return;
  location.hash = other;
  show.page.show();
  collect(show, by > 0 ? 0 : -1);
}

function light(kind) {
  const own = find("light");
  own.hidden = !own.hidden && own.className === kind;
  own.className = kind;
}

function tell(show) {
  const heading = (step) => step?.querySelector("h1, h2")?.textContent ?? "";
  channel.postMessage({
    lesson: show.page.open, step: heading(show.steps[show.at]), next: heading(show.steps[show.at + 1]),
    at: show.at + 1, of: show.steps.length,
  });
}

function openNotes(show) {
  const address = new URL(location.href);
  address.search = "?notes";
  address.hash = show.page.open ?? "";
  window.open(address, "pilotage-notes", "width=720,height=560");
}

/** The window of the notes: shows those of the lesson that is presented, and where the presentation is. */
export function followPresenter(page) {
  document.body.classList.add("notes-window");
  const where = Object.assign(document.createElement("p"), { id: "where" });
  const clock = Object.assign(document.createElement("p"), { id: "clock" });
  find("page").prepend(where, clock);
  const begin = Date.now();
  setInterval(() => { clock.textContent = `${Math.floor((Date.now() - begin) / 60_000)} ${page.words.minutes}`; }, 1000);
  channel.addEventListener("message", ({ data }) => {
    if (!data.lesson) return;
    if (page.open !== data.lesson) {
      history.replaceState(null, "", `#${data.lesson}`);
      page.show();
    }
    where.textContent = `${data.step} (${data.at} ${page.words.of} ${data.of})${data.next ? `, ${page.words.then}: ${data.next}` : ""}`;
  });
  channel.postMessage("where?");
}
