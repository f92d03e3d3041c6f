// What was read, guessed and passed, kept in this browser.
const key = "pilotage.lessons.progress";

/** What is kept: by lesson `guess`, `shown` and `passed`. */
export function readProgress() {
  try {
    return JSON.parse(localStorage.getItem(key)) ?? {};
  } catch {
    return {};
  }
}

/** Keeps what happened in a lesson beside what is kept of it. */
export function keepProgress(lesson, what) {
  const all = readProgress();
  all[lesson] = { ...all[lesson], ...what };
  try { localStorage.setItem(key, JSON.stringify(all)); } catch { /* not kept then; the lesson goes on */ }
}

/** Marks the lessons of the contents by what is kept of them. */
export function markContents(article, all) {
  for (const link of article.querySelectorAll("a[data-lesson]")) {
    const own = all[link.dataset.lesson];
    if (!own) continue;
    const mark = document.createElement("em");
    mark.textContent = own.passed ? "passed" : "begun";
    mark.className = own.passed ? "passed" : "begun";
    link.append(" ", mark);
  }
}
