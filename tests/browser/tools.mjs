// What a journey is made with. The page draws on a canvas, so it is read through two windows:
// `window.app.state()`, what the program holds, and `window.app.a11y()`, what it shows: a list of
// { role, label, value, rect: [left, top, right, bottom] in CSS pixels, … }.
import { join } from "node:path";
import { demoRun, startServer } from "./server.mjs";

const patience = 45_000; // milliseconds for anything but the start, on a machine that does other work, too
const patienceForStart = 120_000; // a busy machine without a graphics card is slow
const nobodyLooks = Boolean(process.env.CI); // at the pictures: taking them is a twelfth of what journeys cost
const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
const soonest = 50; // milliseconds after which the page is asked again
const latest = 250; // and after which it is asked at the latest, where something takes long: each answer costs milliseconds
const matches = (wanted, text) => text != null
  && (wanted instanceof RegExp ? wanted.test(text) : text === wanted);

/** The tools for one journey on `page`; pictures go to `pictures`, words to `said`, servers end by `atEnd`. One that
 * judges time asks the page as `often` as it can. */
export function makeTools({ page, address, pictures, watched, atEnd, said, often = false }) {
  /** Pauses between one question and the next, which become longer. */
  const patiently = () => {
    let milliseconds = soonest;
    return async () => {
      await pause(milliseconds);
      if (!often) milliseconds = Math.min(1.3 * milliseconds, latest);
    };
  };
  const tools = {
    /** Where the page is served, with a slash at the end. */
    address,

    /** Has a line printed below the journey's name when it is over. */
    say: (line) => said.push(line),

    /** Announces an error message (a pattern) that this journey provokes on purpose. */
    expectMessage: watched.expectMessage,

    /** Announces requests (a pattern) to other servers, such as for map tiles. */
    expectRequest: watched.expectRequest,

    /** Opens the page; `query` such as "?sw=1" is put behind its address. */
    open: (query = "") => page.goto(address + query, { timeout: patienceForStart }),

    /** Waits until the page is ready, after opening it if nothing is open. */
    async waitReady() {
      if (page.url() === "about:blank") await tools.open();
      await page.waitForFunction(() => document.documentElement.dataset.ready, null,
        { timeout: patienceForStart });
      const ready = await page.evaluate(() => document.documentElement.dataset.ready);
      if (ready !== "1") {
        const text = await page.evaluate(() => document.body.innerText);
        throw new Error(`the page did not become ready (${ready}): ${text}`);
      }
      const isAlone = await page.evaluate(() => document.getElementById("other-tab").hidden);
      if (!isAlone) throw new Error("a single tab says that another is open");
      await page.evaluate(() => window.app.enable_a11y?.());
    },

    /** Opens the run of the demo that was flown once for all journeys, and resolves to the state that shows it. */
    async openRun() {
      const before = await tools.waitFor((s) => s.run_steps > 0 && s.map.known, "the demo", patienceForStart);
      await page.setInputFiles("#files", demoRun());
      return tools.waitFor((s) => s.run_generation > before.run_generation && s.run_complete, "the demo's run");
    },

    /** What the program holds. */
    state: async () => JSON.parse(await page.evaluate(() => window.app.state())),

    /** What the program showed last, which may be a frame behind what it holds. */
    shown: async () => JSON.parse(await page.evaluate(() => window.app.a11y()) || "[]"),

    /** What the program shows, once all that it holds is drawn. */
    async a11y() {
      await tools.drawn();
      return tools.shown();
    },

    /** Waits until `condition(state)` holds and returns that state. */
    async waitFor(condition, what = String(condition), timeout = patience) {
      const end = Date.now() + timeout;
      const rest = patiently();
      let state;
      for (;;) {
        state = await tools.state();
        if (condition(state)) return state;
        if (Date.now() > end) break;
        await rest();
      }
      throw new Error(`waited in vain for ${what}; the state is ${shortened(state)}`);
    },

    /** Every node with this role and this label or value (texts or patterns; null is any). */
    async findAll(role, label = null) {
      const nodes = await tools.shown();
      return nodes.filter((node) => (role == null || node.role === role)
        && (label == null || matches(label, node.label) || matches(label, node.value)));
    },

    /** Waits until exactly one node has this role and this label or value. */
    async find(role, label = null, timeout = patience) {
      const end = Date.now() + timeout;
      const rest = patiently();
      let found = [];
      do {
        found = await tools.findAll(role, label);
        if (found.length === 1) return found[0];
        await rest();
      } while (Date.now() < end);
      const shown = (await tools.shown()).filter((node) => role == null || node.role === role)
        .map((node) => node.label ?? node.value);
      throw new Error(`${found.length} nodes are ${role} ${label}; shown: ${shortened(shown)}`);
    },

    /** The middle of a node in CSS pixels. */
    middle: ({ rect: [left, top, right, bottom] }) => ({ x: (left + right) / 2, y: (top + bottom) / 2 }),

    /** Shows the landmarks in the column of the plan: the tab is the rightmost of what is called so. */
    async showLandmarks() {
      const called = await tools.findAll(null, "Landmarks");
      await tools.click(called.toSorted((a, b) => b.rect[0] - a.rect[0])[0]);
    },

    /** Chooses from a menu of the top bar. */
    async choose(menu, item) {
      await tools.click(await tools.find("Button", menu));
      await tools.click(await tools.find("Button", item));
    },

    /** Waits until what was done is drawn: one frame takes it in, the next shows it; keys that came together take one
     * frame each. */
    async drawn() {
      for (let frames = 0; frames < 100; frames += 1) {
        await page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));
        if (!(await page.evaluate(() => window.app && JSON.parse(window.app.state() || "{}").input_waits))) return;
      }
    },

    /** Clicks the middle of a node, once it has come to rest: what stands above it may just have grown. */
    async click(node) {
      const key = ({ role, label, value }) => JSON.stringify([role, label, value]);
      for (let tries = 0; tries < 6; tries += 1) {
        await tools.drawn();
        const same = (await tools.shown()).filter((other) => key(other) === key(node));
        const moved = same.length === 1 && String(same[0].rect) !== String(node.rect);
        if (!moved) break;
        [node] = same;
      }
      const { x, y } = tools.middle(node);
      await page.mouse.click(x, y);
    },

    /** Types into a field that has come to rest, over what is there; again should a letter have been for nobody. */
    async type(label, text) {
      const field = () => tools.find("TextInput", label);
      const atRest = async () => {
        for (let before = await field(); ;) {
          await pause(50);
          await tools.drawn();
          const node = await field();
          if (String(node.rect) === String(before.rect)) return node;
          before = node;
        }
      };
      for (let tries = 0; tries < 6; tries += 1) {
        const node = await atRest();
        await tools.click(node);
        await tools.drawn();
        await page.keyboard.press("Control+a");
        await page.keyboard.type(text);
        await pause(300);
        if ((await field()).value === text) return;
      }
      throw new Error(`"${text}" cannot be typed into ${label}`);
    },

    /** Drags with the mouse from one place { x, y } to another, as a hand does: in steps, and never within one frame,
     * in which a press and its release are a click. */
    async drag(from, to, steps = 12) {
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await tools.drawn();
      await page.mouse.move(to.x, to.y, { steps });
      await tools.drawn();
      await page.mouse.up();
      await tools.drawn();
    },

    /** Keeps a picture of the window as `name`.png, where somebody may look at it. */
    screenshot: async (name) => nobodyLooks || page.screenshot({ path: tools.pictureAt(name), timeout: patienceForStart }),

    /** Where a picture of that name is kept. */
    pictureAt: (name) => join(pictures, `${name}.png`),

    /** Fails unless `condition` holds. */
    check(condition, complaint) {
      if (!condition) throw new Error(complaint);
    },

    /** Starts a second server, for a journey that wants to stop it; see `stop` and `url`. */
    async ownServer() {
      const server = await startServer();
      atEnd.push(server.stop);
      return server;
    },
  };
  return tools;
}

function shortened(value) {
  const text = JSON.stringify(value) ?? String(value);
  return text.length > 2000 ? `${text.slice(0, 2000)}…` : text;
}
