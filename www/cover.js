// What lies over the app while it loads and when it cannot run.
const element = (id) => document.getElementById(id);

export function showStage(text, fraction) {
  element("stage").textContent = text;
  if (fraction === undefined) element("bar").removeAttribute("value");
  else element("bar").value = fraction;
}

export function uncover() {
  const cover = element("cover");
  cover.classList.add("leaving");
  setTimeout(() => { cover.hidden = true; element("loading").hidden = true; }, 300);
}

export function showTrouble(title, text, details) {
  const cover = element("cover");
  cover.hidden = false;
  cover.classList.remove("leaving");
  element("loading").hidden = true;
  element("trouble").hidden = false;
  element("trouble-title").textContent = title;
  element("trouble-text").textContent = text;
  element("trouble-details").hidden = !details;
  element("copy").hidden = !details;
  element("trouble-details").textContent = details ?? "";
  element("reload").onclick = () => location.reload();
  element("copy").textContent = "Copy the details";
  element("copy").onclick = async ({ target }) => {
    try {
      await navigator.clipboard.writeText(details);
      target.textContent = "Copied";
    } catch { // not allowed, or there is none: they are marked, to be copied by hand
      getSelection().selectAllChildren(element("trouble-details"));
    }
  };
  element("reload").focus();
}
