// Screen reader support: mirrors the app's accessibility tree into elements over the canvas that nobody sees, so that
// a screen reader finds every control, and hands what it does to them to the app.

const key = "screen reader support";
const between = 200; // milliseconds between two looks at the tree

/** ARIA roles of AccessKit's; what is missing here is a text, or a button if it can be clicked. */
const roles = {
  Tab: "tab", CheckBox: "checkbox", RadioButton: "radio", Switch: "switch", ComboBox: "combobox", Link: "link",
  MenuItem: "menuitem", ListBoxOption: "option", Image: "img", Canvas: "img", Heading: "heading", Status: "status",
  Alert: "alert", ProgressIndicator: "progressbar", Splitter: "separator", Dialog: "dialog", Window: "dialog",
  ListBox: "listbox", Menu: "menu", GenericContainer: "group", Pane: "group", Group: "group",
};
const holders = new Set(["dialog", "listbox", "menu", "group"]); // those that hold the nodes below them
const rows = { tab: "tablist", radio: "radiogroup" }; // what stands around such nodes in a row
const fields = { TextInput: "text", SearchInput: "text", MultilineTextInput: "text", SpinButton: "number", Slider: "range" };

/** A node of a line that `changed_a11y` tells. */
function parsed(line) {
  const [id, depth, kind, name, value, number, least, most, toggled, expanded, is, place] = JSON.parse(line);
  const [disabled, focusable, clickable, settable, increments, decrements, readOnly] = is;
  const input = fields[kind];
  const role = input ? null : roles[kind] ?? (clickable ? "button" : null);
  return { id, depth, kind, role, input, name, value, number, least, most, toggled, expanded, disabled, focusable, clickable, settable, increments, decrements, readOnly, place };
}

function made({ kind, role, input, clickable }) {
  if (kind === "MultilineTextInput") return document.createElement("textarea");
  if (input) return Object.assign(document.createElement("input"), { type: input });
  const native = clickable && !["img", "separator", "progressbar"].includes(role) && !holders.has(role);
  return native ? Object.assign(document.createElement("button"), { type: "button" }) : document.createElement("div");
}

/** Sets an attribute, or removes it where there is no value, if it differs. */
function put(element, name, value) {
  if (value === null || value === undefined) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

const finite = (number) => (Number.isFinite(number) ? Number(number.toPrecision(12)) : null);
const truth = { True: "true", False: "false", Mixed: "mixed" };
const toggles = { tab: "aria-selected", option: "aria-selected", checkbox: "aria-checked", radio: "aria-checked", switch: "aria-checked", button: "aria-pressed" };

/** Brings an element in step with its node. */
function dress(element, node) {
  const { role, input, name, value, number, place } = node;
  const text = role === null && !input;
  put(element, "role", element.tagName === "BUTTON" && role === "button" ? null : role);
  put(element, "aria-label", text ? null : name ?? (role === "listbox" ? "Choices" : null));
  put(element, "aria-disabled", node.disabled ? "true" : null);
  put(element, "tabindex", node.focusable && !["BUTTON", "INPUT", "TEXTAREA"].includes(element.tagName) ? 0 : null);
  if (toggles[role]) put(element, toggles[role], truth[node.toggled] ?? (role === "button" ? null : "false"));
  if (role === "heading") put(element, "aria-level", 2);
  if (role === "combobox") put(element, "aria-haspopup", "listbox");
  if (role === "combobox" || node.expanded !== null) put(element, "aria-expanded", node.expanded ?? false);
  if (input === "number" || input === "range") {
    put(element, "min", finite(node.least));
    put(element, "max", finite(node.most));
    put(element, "step", "any");
    put(element, "aria-valuetext", value);
    fill(element, String(finite(number) ?? ""));
  } else if (input) {
    element.readOnly = node.readOnly;
    fill(element, value ?? "");
  } else if (role === "separator" || role === "progressbar") {
    put(element, "aria-valuenow", finite(number));
    put(element, "aria-valuemin", finite(node.least));
    put(element, "aria-valuemax", finite(node.most));
  } else if (!holders.has(role)) {
    const words = [text ? name : null, value].filter(Boolean).join(" ");
    if (element.textContent !== words) element.textContent = words;
  }
  if (place === null || holders.has(role)) return;
  const [left, top, width, height] = place;
  Object.assign(element.style, { left: `${left}px`, top: `${top}px`, width: `${Math.max(1, width)}px`, height: `${Math.max(1, height)}px` });
}

const touched = new WeakMap(); // when a field was last written into by its user

/** Shows a value in a field, unless its user is just writing another. */
function fill(element, value) {
  const busy = element === document.activeElement && performance.now() - (touched.get(element) ?? -Infinity) < 1500;
  if (!busy && element.value !== value) element.value = value;
}

/** Has `parent` hold exactly `children`, moving only what stands elsewhere. */
function arrange(parent, children) {
  const wanted = new Set(children);
  for (const child of [...parent.children]) if (!wanted.has(child)) child.remove();
  let next = parent.firstElementChild;
  for (const child of children) {
    if (child === next) next = next.nextElementSibling;
    else parent.insertBefore(child, next);
  }
}

/** Mirrors the tree of `app` into `page`; resolves to what turns that on and off. */
function mirrorOf(app, canvas, page) {
  const shown = new Map(); // by id: { line, node, element }
  const rowsShown = new Map(); // by the id of its first node: the element around a row
  const nodes = new WeakMap(); // by element: its node
  let focused = null;
  const act = (node, action, text, number) => {
    if (!node.disabled) app.act(BigInt(node.id), action, text, number);
  };

  function update() {
    const told = app.changed_a11y();
    if (told === "") return;
    const [focus, ...lines] = told.split("\n");
    const current = new Set();
    const children = new Map([[page, []]]);
    const open = []; // holders around the next node: { depth, element, role }
    let row = null; // of the node before
    const stillRows = new Set();
    for (const line of lines) {
      const id = line.slice(2, line.indexOf('"', 2));
      let entry = shown.get(id);
      if (entry?.line !== line) entry = refreshed(id, line, entry);
      const { node, element } = entry;
      current.add(id);
      while (open.length && open.at(-1).depth >= node.depth) open.pop();
      const around = open.at(-1);
      let parent = around?.element ?? page;
      if (rows[node.role]) {
        if (row === null || row.role !== node.role || row.depth !== node.depth || row.parent !== parent) {
          row = { role: node.role, depth: node.depth, parent, element: rowsShown.get(id) ?? document.createElement("div") };
          put(row.element, "role", rows[node.role]);
          rowsShown.set(id, row.element);
          stillRows.add(id);
          children.get(parent).push(row.element);
          children.set(row.element, []);
        }
        parent = row.element;
      } else {
        row = null;
      }
      // What a list offers comes as buttons.
      if (around?.role === "listbox" && node.role === "button") {
        node.role = "option";
        put(element, "aria-pressed", null);
        dress(element, node);
      }
      children.get(parent).push(element);
      if (holders.has(node.role)) {
        open.push({ depth: node.depth, element, role: node.role });
        children.set(element, []);
      }
    }
    const had = page.contains(document.activeElement);
    for (const id of shown.keys()) if (!current.has(id)) shown.delete(id);
    for (const id of rowsShown.keys()) if (!stillRows.has(id)) rowsShown.delete(id);
    for (const [parent, list] of children) arrange(parent, list);
    for (const { node, element } of shown.values()) {
      // A dialog without a name is called by the first words in it.
      if (node.role === "dialog" && node.name === null) {
        const first = element.querySelector("[aria-label], div:not(:empty)");
        put(element, "aria-label", first?.getAttribute("aria-label") ?? first?.textContent ?? "Dialog");
      }
    }
    followFocus(focus, had);
  }

  function refreshed(id, line, before) {
    const node = parsed(line);
    const same = before?.node.kind === node.kind && before.node.clickable === node.clickable;
    const element = same ? before.element : made(node);
    element.id = `n${id}`;
    nodes.set(element, node);
    dress(element, node);
    const entry = { line, node, element };
    shown.set(id, entry);
    return entry;
  }

  /** Has the page's focus follow the app's where it is among the mirrored elements or on the bare canvas, never from
   * the field that takes what is typed into the canvas. What the page asks for is told back at once, however late the
   * app's next frame is. */
  function followFocus(focus, had) {
    const active = document.activeElement;
    const moved = focus !== focused;
    focused = focus;
    const lost = had && !page.contains(active);
    if (!lost && !(moved && (active === canvas || page.contains(active)))) return;
    const target = shown.get(focus)?.element;
    if (target && target !== active) target.focus({ preventScroll: true });
    else if (lost) page.focus({ preventScroll: true });
  }

  page.addEventListener("focusin", ({ target }) => {
    const node = nodes.get(target);
    if (!node || node.id === focused) return;
    focused = node.id;
    act(node, "Focus");
  });
  page.addEventListener("click", ({ target }) => {
    const node = nodes.get(target);
    if (node?.clickable && !node.input) act(node, "Click");
  });
  const set = (target) => {
    const node = nodes.get(target);
    if (node.input === "text") act(node, "SetValue", target.value);
    else if (Number.isFinite(target.valueAsNumber)) act(node, "SetValue", undefined, target.valueAsNumber);
  };
  page.addEventListener("input", ({ target }) => {
    touched.set(target, performance.now());
    if (nodes.get(target).input !== "number") set(target);
  });
  page.addEventListener("change", ({ target }) => {
    touched.delete(target);
    if (nodes.get(target).input === "number") set(target);
  });
  page.addEventListener("keydown", (event) => {
    const { target, key: pressed } = event;
    if (event.altKey || event.isComposing || pressed === "Tab") return;
    const node = nodes.get(target);
    const take = () => event.preventDefault();
    const steps = { ArrowUp: "Increment", ArrowRight: "Increment", ArrowDown: "Decrement", ArrowLeft: "Decrement" }[pressed];
    const along = pressed === "ArrowUp" || pressed === "ArrowDown";
    if (node && steps && (along || node.input !== "number") && (node.increments || node.decrements) && !event.ctrlKey && !event.metaKey) {
      take();
      touched.delete(target);
      return act(node, steps);
    }
    if (node?.input) {
      const leaves = pressed === "Escape" || (target.tagName === "INPUT" && (pressed === "Enter" || along));
      if (!leaves) return;
      if (pressed === "Enter") set(target);
    } else if (node?.clickable && (pressed === "Enter" || pressed === " ")) {
      if (target.tagName === "BUTTON") return; // clicks by itself
      take();
      return act(node, "Click");
    }
    const command = event.ctrlKey || event.metaKey;
    // The browser keeps its own keys.
    if (command ? ["k", "o", "p", "s", ","].includes(pressed.toLowerCase()) : !/^F\d/.test(pressed)) take();
    app.press(pressed, event.shiftKey, command);
  });

  let timer = null;
  return {
    on() {
      app.enable_a11y();
      canvas.tabIndex = -1;
      page.hidden = false;
      timer ??= setInterval(update, between);
    },
    off() {
      clearInterval(timer);
      timer = null;
      app.disable_a11y();
      shown.clear();
      rowsShown.clear();
      page.replaceChildren();
      page.hidden = true;
      canvas.tabIndex = 0;
    },
  };
}

/** Offers the support by the first button of the page, and turns it on if it was on in the last visit. */
export function offerMirror(app, canvas) {
  const button = document.getElementById("reader");
  const page = document.getElementById("mirror");
  const mirror = mirrorOf(app, canvas, page);
  const remember = (on) => {
    try {
      if (on) localStorage.setItem(key, "on");
      else localStorage.removeItem(key);
    } catch { /* then it is forgotten */ }
  };
  const remembered = () => {
    try { return localStorage.getItem(key) !== null; } catch { return false; }
  };
  const turn = (on) => {
    remember(on);
    button.textContent = `Turn ${on ? "off" : "on"} screen reader support`;
    if (on) mirror.on();
    else mirror.off();
    (on ? page : canvas).focus({ preventScroll: true });
  };
  // eframe's field that takes what is typed into the canvas is none to be found.
  const typed = canvas.parentNode.querySelector(":scope > input[type=text]");
  typed?.setAttribute("aria-label", "Typed into the app");
  if (typed) typed.tabIndex = -1;
  button.addEventListener("click", () => turn(page.hidden));
  button.hidden = false;
  // The canvas has the keyboard at first; a visit that begins with Tab is asked first.
  const first = (event) => {
    removeEventListener("keydown", first, true);
    removeEventListener("pointerdown", first, true);
    if (event.key !== "Tab" || !page.hidden) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    button.focus();
  };
  addEventListener("keydown", first, true);
  addEventListener("pointerdown", first, true);
  if (remembered()) turn(true);
}
