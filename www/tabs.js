// One tab of this browser keeps documents at a time: two would overwrite each other. Another one says so, keeps
// nothing, and takes over when it is asked to.
const DOCUMENTS = "pilotage documents";
const TAKE = "pilotage takes over";
/** Milliseconds for a tab that is just being left, and for one that is asked to save and give way. */
const leaving = 1000;
const giving = 4000;

/** Asks for the documents, which this tab then holds until it ends, gives way or is robbed of them (`lost` is called);
 * resolves to whether it has them, after `wait` milliseconds at the latest. */
function hold(options, wait, lost) {
  return new Promise((resolve) => {
    const late = new AbortController();
    const timer = wait && setTimeout(() => late.abort(), wait);
    const held = () => {
      clearTimeout(timer);
      return new Promise((release) => { resolve(release); });
    };
    navigator.locks.request(DOCUMENTS, wait ? { ...options, signal: late.signal } : options, held)
      .then(lost, () => { resolve(null); lost(); });
  });
}

/** Lets a tab have the documents or not. `tab.keeps` says which, `tab.changed` is called when that changes, and
 * `tab.save` before it gives way. */
export async function openTab() {
  const tab = { keeps: true, changed() {}, async save() {}, takeOver() {} };
  if (!navigator.locks || !globalThis.BroadcastChannel) return tab;
  const lost = () => {
    if (!tab.keeps) return;
    tab.keeps = false;
    tab.changed();
  };
  const channel = new BroadcastChannel(DOCUMENTS);
  const takes = sessionStorage.getItem(TAKE) !== null;
  sessionStorage.removeItem(TAKE);
  tab.keeps = false;
  if (takes) channel.postMessage("give way");
  let release = await hold({}, takes ? giving : leaving, lost);
  if (!release && takes) release = await hold({ steal: true }, 0, lost);
  tab.keeps = release !== null;
  channel.addEventListener("message", async () => {
    if (!tab.keeps) return;
    await tab.save();
    lost();
    release();
  });
  tab.takeOver = () => {
    sessionStorage.setItem(TAKE, "");
    location.reload();
  };
  return tab;
}

/** Has `storage` keep nothing while its tab has no documents. */
export function keepOnlyIn(tab, storage) {
  for (const deed of ["put", "putFile", "remove"]) {
    const own = storage[deed];
    storage[deed] = (...given) => { if (tab.keeps) own(...given); };
  }
}

/** Says that what is changed here is not kept, while that is so. */
export function tellOf(tab) {
  const notice = document.getElementById("other-tab");
  notice.querySelector("button").onclick = () => tab.takeOver();
  const show = () => { notice.hidden = tab.keeps; };
  tab.changed = show;
  show();
}
