// One tab of this browser keeps documents at a time: two would overwrite each other. Another one says so, keeps
// nothing, and takes over when it is asked to.
const DOCUMENTS = "pilotage documents";
const TAKE = "pilotage takes over";
/** How often a tab asks, a tenth of a second apart, that another one may just be leaving, or has to save first. */
const leaving = 10;
const giving = 40;

/** Asks once for the documents, which this tab then holds until it ends, gives way or is robbed of them (`lost` is
 * called); resolves to what gives them back, or to null where another tab has them. Throws where tabs cannot ask, as
 * with the data of sites blocked. */
function ask(options, lost) {
  return new Promise((resolve, reject) => {
    const held = (lock) => {
      if (lock === null) {
        resolve(null);
        return undefined;
      }
      return new Promise((release) => { resolve(release); });
    };
    navigator.locks.request(DOCUMENTS, options, held).then(lost, (error) => { reject(error); lost(); });
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

/** Whether this tab was loaded anew to take over; asked once. */
function takesOver() {
  try {
    const takes = sessionStorage.getItem(TAKE) !== null;
    sessionStorage.removeItem(TAKE);
    return takes;
  } catch { // the data of sites is blocked
    return false;
  }
}

/** Lets a tab have the documents or not. `tab.keeps` says which, `tab.changed` is called when that changes, and
 * `tab.save` before it gives way. Where tabs cannot ask each other, each has them. */
export async function openTab() {
  const tab = { keeps: true, changed() {}, async save() {}, takeOver() {} };
  if (!navigator.locks || !globalThis.BroadcastChannel) return tab;
  try {
    await share(tab);
  } catch (error) {
    console.info("tabs cannot ask each other:", error);
    tab.keeps = true;
  }
  return tab;
}

/** Lets a tab have what no other one has. */
async function share(tab) {
  const lost = () => {
    if (!tab.keeps) return;
    tab.keeps = false;
    tab.changed();
  };
  const channel = new BroadcastChannel(DOCUMENTS);
  const takes = takesOver();
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
}

/** Has `storage` keep nothing while its tab has no documents. */
export function keepOnlyIn(tab, storage) {
  for (const deed of ["put", "putFile", "remove"]) {
    const own = storage[deed];
    storage[deed] = (...given) => { if (tab.keeps) own(...given); };
  }
}

/** Says that what is changed here is not kept, while that is so: because of another tab, or of this browser. */
export function tellOf(tab, storage) {
  const notice = document.getElementById("other-tab");
  const [words, button] = [notice.querySelector("span"), notice.querySelector("button")];
  button.onclick = () => tab.takeOver();
  if (!storage.isKept) {
    words.textContent = "This browser keeps nothing of this page: save the mission as a file.";
    button.textContent = "Close";
    button.onclick = () => { notice.hidden = true; };
    notice.hidden = false;
    return;
  }
  const show = () => { notice.hidden = tab.keeps; };
  tab.changed = show;
  show();
}
