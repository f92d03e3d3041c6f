// A lesson that is read: its guess, its controls, the parts of its figure, its terms.
import { keepProgress, readProgress } from "./progress.js";

/** The lesson that is open on the page. */
export class Reader {
  constructor(program) {
    this.program = program;
    this.name = "";
    this.article = null;
    this.passes = false;
    for (const input of document.querySelectorAll("#depth input")) {
      input.addEventListener("change", () => this.depth(input.value));
    }
    this.depth(storedDepth());
    const article = document.getElementById("article");
    article.addEventListener("input", (event) => this.input(event.target));
    article.addEventListener("click", (event) => this.click(event.target.closest("button")));
    for (const kind of ["pointerover", "focusin"]) article.addEventListener(kind, (event) => this.point(event.target));
    for (const kind of ["pointerout", "focusout"]) article.addEventListener(kind, () => this.point(null));
  }

  /** Opens a lesson into the page. */
  open(name, article, figure) {
    this.name = name;
    this.article = article;
    this.figure = figure;
    article.innerHTML = this.program.open(name);
    // A choice that stands in two places is two groups: in one, the browser would let only the last be chosen.
    for (const [place, choice] of article.querySelectorAll("fieldset.control").entries()) {
      for (const input of choice.querySelectorAll("input")) input.name += `-${place}`;
    }
    article.dataset.lesson = name;
    this.apply("");
    const { guess, shown } = readProgress()[name] ?? {};
    this.veil(guess === undefined && !shown);
    if (guess !== undefined) this.answer(guess);
  }

  /** Leaves the lesson: what the page shows now is no lesson of its own. */
  close() {
    this.article = null;
    this.watcher?.disconnect();
  }

  /** Hides the figure until its reader has guessed, asked for the answer or read on. */
  veil(hidden) {
    this.figure.classList.toggle("veiled", hidden);
    this.watcher?.disconnect();
    if (!hidden) return;
    this.watcher = new IntersectionObserver((seen) => {
      if (seen.some((it) => it.isIntersecting || it.boundingClientRect.top < 0)) this.veil(false);
    }, { rootMargin: "0px 0px -60% 0px" });
    this.watcher.observe(document.getElementById("story"));
  }

  /** Shows the mathematics or leaves it out. */
  depth(value) {
    document.body.dataset.depth = value;
    const input = document.querySelector(`#depth input[value="${value}"]`);
    if (input) input.checked = true;
    try { localStorage.setItem("pilotage.lessons.depth", value); } catch { /* not kept then */ }
  }

  /** Sets controls, `name=number,…`, and shows what that changes; told by the browser's own clock as "lesson". A lesson is
   * passed by its reader's `own` change from what does not pass to what does, and not where a button led. */
  apply(controls, own = false) {
    const begin = performance.now();
    const patch = JSON.parse(this.program.set(controls));
    this.figure.innerHTML = patch.figure;
    for (const [name, text] of patch.values) {
      for (const output of this.all(`[data-value="${name}"]`)) output.textContent = text;
    }
    for (const [name, passes, text] of patch.checks) {
      for (const output of this.all(`[data-check="${name}"]`)) {
        output.textContent = text;
        output.classList.toggle("passed", passes);
      }
    }
    for (const [name, number, text] of patch.controls) this.showControl(name, number, text);
    performance.measure("lesson", { start: begin, end: performance.now() });
    const passes = patch.checks.length > 0 && patch.checks.every(([, each]) => each);
    if (own && passes && !this.passes) keepProgress(this.name, { passed: true });
    this.passes = passes;
  }

  all(selector) { return this.article.querySelectorAll(selector); }

  showControl(name, number, text) {
    for (const output of this.all(`[data-control-value="${name}"]`)) output.textContent = text;
    for (const input of this.all(`input[data-control="${name}"]`)) {
      if (input.type === "radio") {
        input.checked = Number(input.value) === number;
      } else {
        input.value = number;
        input.setAttribute("aria-valuetext", text);
      }
    }
  }

  input(target) {
    if (!this.article) return;
    if (target.name === "guess") {
      this.article.querySelector(".commit").disabled = false;
    } else if (target.dataset.control) {
      this.apply(`${target.dataset.control}=${target.value}`, true);
    }
  }

  click(button) {
    if (!button) return;
    if (button.classList.contains("term")) {
      showMeaning(button);
    } else if (!this.article) {
      // Of no lesson that is open.
    } else if (button.dataset.set) {
      this.apply(button.dataset.set);
    } else if (button.classList.contains("commit")) {
      const chosen = Number(this.article.querySelector("input[name=guess]:checked").value);
      keepProgress(this.name, { guess: chosen });
      this.answer(chosen, true);
    } else if (button.classList.contains("reveal")) {
      this.answer(null, true);
    }
  }

  /** Shows the answer to the guess; `chosen` is what was guessed, or nothing. */
  answer(chosen, now = false) {
    const fieldset = this.article.querySelector("fieldset.guess");
    const right = Number(fieldset.dataset.right);
    for (const input of fieldset.querySelectorAll("input")) {
      input.disabled = true;
      input.checked = Number(input.value) === chosen;
      input.closest("label").classList.toggle("right", Number(input.value) === right);
    }
    fieldset.querySelector(".buttons").hidden = true;
    this.veil(false);
    const answer = this.article.querySelector(".answer");
    answer.hidden = false;
    const words = answer.querySelector(".verdict");
    words.hidden = chosen === null;
    if (chosen !== null) words.textContent = chosen === right ? words.dataset.rightWords : words.dataset.wrongWords;
    if (now && chosen === null) keepProgress(this.name, { shown: true });
  }

  /** Lights what a symbol stands for, and tells a term's meaning; nothing puts all out. */
  point(target) {
    const symbol = target?.closest?.("[data-symbol]")?.dataset.symbol;
    for (const lit of document.querySelectorAll(".lit")) lit.classList.remove("lit");
    if (symbol) {
      for (const part of document.querySelectorAll(`[data-part="${symbol}"], [data-symbol="${symbol}"]`)) part.classList.add("lit");
    }
    const term = target?.closest?.(".term");
    if (term) showMeaning(term);
    else document.getElementById("meaning").hidden = true;
  }
}

function storedDepth() {
  try {
    return localStorage.getItem("pilotage.lessons.depth") === "mathematics" ? "mathematics" : "story";
  } catch {
    return "story";
  }
}

/** Shows what a term means beside it. */
function showMeaning(term) {
  const box = document.getElementById("meaning");
  box.textContent = term.dataset.meaning;
  box.hidden = false;
  term.setAttribute("aria-describedby", "meaning");
  const at = term.getBoundingClientRect();
  const width = box.offsetWidth;
  box.style.left = `${Math.max(8, Math.min(at.left, innerWidth - width - 8))}px`;
  const above = at.top - box.offsetHeight - 8;
  box.style.top = `${above > 8 ? above : at.bottom + 8}px`;
}
