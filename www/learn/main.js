// The page of lessons: which lesson or step the address names, and the parts of the page that act on it.
import init, { LessonPage } from "../pkg/pilotage_lesson_page.js";
import { fragment } from "../fragment.js";
import { Reader } from "./reader.js";
import { readProgress, markContents } from "./progress.js";
import { offerMenu } from "./menu.js";
import { offerPresenter, followPresenter } from "./presenter.js";

const parts = new URLSearchParams(location.search);
const find = (id) => document.getElementById(id);

/** The address' fragment: what it names, and the step of it. */
function place() {
  const [name = "", step = ""] = fragment().split("/");
  return { name, step };
}

/** What the page shows, by what the address names. */
class Page {
  constructor(program) {
    this.program = program;
    this.words = JSON.parse(program.words());
    this.courses = JSON.parse(program.list());
    this.lessons = this.courses.flatMap(([, lessons]) => lessons);
    this.reader = new Reader(program);
    this.open = null;
  }

  /** Shows what the address names; a step of the lesson that is open is gone to. */
  show({ first = false } = {}) {
    const { name, step } = place();
    if (this.lessons.includes(name)) {
      const fresh = this.open !== name;
      if (fresh) this.openLesson(name);
      this.goTo(step, !first && fresh);
    } else if (step === "plan" && this.isCourse(name)) {
      this.openText("plan", this.program.plan(name));
    } else if (step === "handout" && this.isCourse(name)) {
      this.openHandout(name);
    } else if (document.getElementById(name)?.closest("#article")) {
      document.getElementById(name).focus();
    } else {
      this.openText("contents", this.program.contents());
      markContents(find("article"), readProgress());
      if (this.isCourse(name)) find(name)?.scrollIntoView();
    }
  }

  isCourse(name) { return this.courses.some(([own]) => own === name); }

  openLesson(name) {
    this.open = name;
    document.body.dataset.shows = "lesson";
    find("figure").hidden = false;
    this.reader.open(name, find("article"), find("figure"));
    document.title = `${find("lesson-title").textContent} · Pilotage`;
    const at = this.lessons.indexOf(name);
    this.onward("previous", this.lessons[at - 1], "← ");
    this.onward("next", this.lessons[at + 1], "", " →");
    find("onward").hidden = parts.has("embed");
  }

  onward(id, name, before, after = "") {
    const link = find(id);
    link.hidden = !name;
    if (!name) return;
    link.href = `#${name}`;
    link.textContent = `${before}${this.title(name)}${after}`;
  }

  /** The contents as elements that nobody sees, made once. */
  get contents() {
    this.made ??= parsed(this.program.contents());
    return this.made;
  }

  title(lesson) {
    return this.contents.querySelector(`a[data-lesson="${lesson}"] b`).textContent;
  }

  openText(kind, html) {
    this.open = null;
    this.reader.close();
    document.body.dataset.shows = kind;
    find("figure").hidden = true;
    find("onward").hidden = true;
    find("article").innerHTML = html;
    document.title = `${find("lesson-title").textContent} · Pilotage`;
    window.scrollTo(0, 0);
  }

  /** All lessons of a course one after the other, each with its figure, to be printed: with nothing to be set or guessed. */
  openHandout(course) {
    const [, lessons] = this.courses.find(([name]) => name === course);
    this.openText("handout", "<h1 id=\"lesson-title\" tabindex=\"-1\"></h1>");
    find("lesson-title").textContent = `${this.contents.querySelector(`#${course} h2`).textContent}: ${this.words["handout-title"]}`;
    const button = Object.assign(document.createElement("button"), { textContent: this.words.print, className: "print-all" });
    button.addEventListener("click", () => print());
    find("lesson-title").after(button);
    for (const lesson of lessons) {
      const own = document.createElement("article");
      own.className = "sheet";
      own.innerHTML = this.program.open(lesson);
      for (const id of own.querySelectorAll("[id]")) id.removeAttribute("id");
      for (const input of own.querySelectorAll("input")) input.disabled = true;
      const figure = document.createElement("figure");
      figure.innerHTML = JSON.parse(this.program.set("")).figure;
      own.querySelector("header").after(figure);
      find("article").append(own);
    }
  }

  goTo(step, focus) {
    const target = step && find(step)?.querySelector("h2");
    if (step === "mathematics") this.reader.depth("mathematics");
    if (target) {
      target.focus({ preventScroll: true });
      target.scrollIntoView({ block: "start" });
    } else {
      window.scrollTo(0, 0);
      if (focus) find("lesson-title").focus({ preventScroll: true });
    }
  }
}

/** Says the words of the page in the language of the lessons. */
function sayWords(words) {
  for (const element of document.querySelectorAll("[data-word]")) element.textContent = words[element.dataset.word];
  for (const element of document.querySelectorAll("[data-word-label]")) element.setAttribute("aria-label", words[element.dataset.wordLabel]);
  find("figure").dataset.veil = words.veil;
}

/** HTML as elements that nobody sees. */
function parsed(html) {
  const whole = document.createElement("template");
  whole.innerHTML = html;
  return whole.content;
}

async function start() {
  const bytes = fetch(new URL("../pkg/pilotage_lesson_page_bg.wasm", import.meta.url), { credentials: "same-origin" });
  await init({ module_or_path: bytes });
  const program = new LessonPage();
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(program.style());
  document.adoptedStyleSheets = [sheet];
  if (parts.has("embed")) document.body.classList.add("embedded");
  const page = new Page(program);
  sayWords(page.words);
  window.addEventListener("hashchange", () => page.show());
  offerMenu(page);
  if (parts.has("notes")) followPresenter(page);
  else offerPresenter(page);
  page.show({ first: true });
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
  const stage = document.createElement("p");
  stage.setAttribute("role", "alert");
  stage.textContent = `The lessons could not be opened: ${error?.message ?? error}. Load the page again.`;
  find("article").replaceChildren(stage);
});
