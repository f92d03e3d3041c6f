// What can be done with a lesson besides reading it: its figure as a file, print, links, embedding.

const find = (id) => document.getElementById(id);

/** Makes the menu of the page work. */
export function offerMenu(page) {
  const menu = find("menu");
  const more = find("more");
  const open = (opened) => {
    menu.hidden = !opened;
    more.setAttribute("aria-expanded", String(opened));
    if (opened) menu.querySelector("button:not([disabled])")?.focus();
  };
  more.addEventListener("click", () => {
    for (const id of ["save-figure", "embed", "again"]) find(id).disabled = !page.open;
    open(menu.hidden);
  });
  menu.addEventListener("click", () => open(false));
  menu.addEventListener("keydown", (event) => step(event, menu, () => { open(false); more.focus(); }));
  document.addEventListener("pointerdown", (event) => { if (!event.target.closest("#menu, #more")) open(false); });

  find("save-figure").addEventListener("click", () => save(`${page.open}.svg`, page.program.figure()));
  find("print").addEventListener("click", () => print());
  find("copy-link").addEventListener("click", () => copy(stepAddress(page), page.words, "link-copied"));
  find("embed").addEventListener("click", () => copy(embedCode(page), page.words, "code-copied"));
  find("again").addEventListener("click", () => page.reader.open(page.open, find("article"), find("figure")));
}

/** Arrow keys go through the menu, Escape leaves it. */
function step(event, menu, leave) {
  const items = [...menu.querySelectorAll("button:not([disabled])")];
  const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (by) {
    event.preventDefault();
    items[(items.indexOf(document.activeElement) + by + items.length) % items.length].focus();
  } else if (event.key === "Escape") {
    leave();
  }
}

/** Address of the step that is at the top of the window. */
export function stepAddress(page) {
  const address = new URL(location.href);
  address.search = "";
  if (page.open) address.hash = page.open + (stepInView() ? `/${stepInView()}` : "");
  return address.href;
}

/** Name of the step whose heading was scrolled past last, or nothing at the top. */
function stepInView() {
  const passed = [...document.querySelectorAll("#article > section[id]")].filter((it) => it.getBoundingClientRect().top < innerHeight / 3);
  return scrollY > 40 ? passed.at(-1)?.id : undefined;
}

let silence;

/** Says something for a few seconds, to those who see and to those who hear the page. */
export function tell(words) {
  find("status").textContent = words;
  clearTimeout(silence);
  silence = setTimeout(() => { find("status").textContent = ""; }, 6000);
}

function embedCode(page) {
  const address = new URL(location.href);
  address.search = "?embed";
  address.hash = page.open;
  return `<iframe src="${address.href}" width="960" height="640" title="${document.title.replace(/"/g, "&quot;")}"></iframe>`;
}

async function copy(text, words, said) {
  try {
    await navigator.clipboard.writeText(text);
    tell(words[said]);
  } catch {
    prompt(words["copy-this"], text);
  }
}

function save(name, text) {
  const address = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
