// One tab of this browser keeps documents at a time: two would overwrite each other. Another one says so, keeps
// nothing, and takes over when it is asked to.
const DOCUMENTS = "pilotage documents";
const TAKE = "pilotage takes over";
/** How often a tab asks, a tenth of a second apart, that another one may just be leaving, or has to save first. */
const leaving = 10;
const giving = 40;

/** Asks once for the documents, which this tab then holds until it ends, gives way or is robbed of them (`lost` is
 * called); resolves to what gives them back, or to null where another tab has them. */
function ask(options, lost) {
  return new Promise((resolve) => {
    const held = (lock) => {
      if (lock === null) {
        resolve(null);
        return undefined;
      }
      return new Promise((release) => { resolve(release); });
    };
    navigator.locks.request(DOCUMENTS, options, held).then(lost, () => { resolve(null); lost(); });
  });
}

/** Asks that often; by number and not by the clock, which runs on while a busy machine keeps the answer. */
async function hold(times, lost) {
  for (let time = 0; time < times; time += 1) {
    const release = await ask({ ifAvailable: true }, lost);
    if (release) return release;
    await new Promise((resolve) => { setTimeout(resolve, 100); });
  }
  return null;
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
  let release = await hold(takes ? giving : leaving, lost);
  if (!release && takes) release = await ask({ steal: true }, lost);
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
