// What is on the page.

const HINTS = {
  draw: "Draw a closed curve: press, go around, let go.",
  move: "Drag a vertex; the verdict follows.",
  landmarks: "Click a vertex of one curve, then the one of the other that it has to become.",
};
const TOOLS = { draw: "Draw", move: "Move vertices", landmarks: "Landmarks" };
const KEYS = [
  ["Space", "next vertex (Shift: the one before)"],
  ["Arrows", "move it (Shift: further)"],
  ["Enter", "make it a landmark"],
  ["Delete", "remove its landmark, or the vertex"],
  ["Esc", "let go"],
  ["← →", "on the way, another root"],
  ["Ctrl Z", "undo (Shift: redo)"],
];

let pages = 0; // widgets that there are, for names that are not used twice

function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

function attributes(node, values) {
  for (const [name, value] of Object.entries(values)) node.setAttribute(name, value);
  return node;
}

const option = ([value, text, title = ""]) => make("option", { value, title }, text || value);
const options = (entries) => entries.map(option);
const group = (label, entries) => make("optgroup", { label }, ...options(entries));
const row = (name, title, ...nodes) => make("label", { title }, make("span", {}, name), ...nodes);

function layout(setup) {
  pages += 1;
  const ui = { page: `tween-${pages}`, ...bar(), ...panels(setup), ...choices(setup), ...files(setup) };
  const top = make("div", { className: "tween-grid" }, ui.source.whole, ui.morph.whole, ui.target.whole);
  const scrub = make("div", { className: "tween-scrub" }, ui.play, ui.slider);
  const below = make("div", { className: "tween-grid tween-below" }, ui.settings, ui.areas.whole, ui.sums.whole);
  ui.root = attributes(make("div", { className: "tween-playground" }), { role: "group", "aria-label": "playground" });
  ui.root.append(ui.bar, top, ui.landmarks, scrub, below, ui.footer);
  for (const name of ["source", "target"]) {
    const { words, canvas } = ui[name];
    words.id = `${ui.page}-${name}`;
    ui.keys.id = `${ui.page}-keys`;
    canvas.setAttribute("aria-describedby", `${words.id} ${ui.keys.id}`);
  }
  for (const radio of ui.tools) radio.name = `${ui.page}-tool`;
  // Or JupyterLab takes the keys: an arrow would move to another cell.
  const listening = ui.root.querySelectorAll("input, select, button, canvas[tabindex]");
  for (const node of listening) node.dataset.lmSuppressShortcuts = "true";
  for (const [name, color] of Object.entries(setup.colors)) ui.root.style.setProperty(`--tween-${name}`, color);
  return ui;
}

function bar() {
  const tools = Object.keys(TOOLS).map((value) => make("input", { type: "radio", value }));
  const labels = tools.map((radio) => make("label", {}, radio, make("span", {}, TOOLS[radio.value])));
  const choice = attributes(make("div", { className: "tween-tools" }, ...labels), {
    role: "radiogroup",
    "aria-label": "tool",
  });
  const hint = make("span", { className: "tween-hint" });
  const undo = make("button", { type: "button", title: "undo (Ctrl Z)" }, "Undo");
  const redo = make("button", { type: "button", title: "redo (Ctrl Shift Z)" }, "Redo");
  const entries = KEYS.map(([key, what]) => make("li", {}, make("b", {}, key), ` ${what}`));
  const keys = make("ul", { className: "tween-keys", hidden: true }, ...entries);
  const help = attributes(make("button", { type: "button" }, "Keys"), { "aria-expanded": "false" });
  help.onclick = () => {
    keys.hidden = !keys.hidden;
    help.setAttribute("aria-expanded", String(!keys.hidden));
  };
  const whole = make("div", { className: "tween-bar" }, choice, hint, undo, redo, help, keys);
  return { tools, hint, undo, redo, keys, bar: whole };
}

function panel(name, title, ...head) {
  const canvas = make("canvas");
  const words = make("p", { className: "tween-words" });
  const heading = make("div", { className: "tween-head" }, make("b", {}, title), ...head);
  const whole = make("section", { className: `tween-${name}` }, heading, make("div", { className: "tween-canvas" }, canvas), words);
  attributes(whole, { role: "group", "aria-label": title });
  attributes(canvas, { role: "img", "aria-label": title });
  return { canvas, words, whole, title };
}

function field(name, title, setup, own) {
  const letters = setup.letters.map((letter) => [letter]);
  const curves = setup.curves.map(([curve, about]) => [curve, curve.replaceAll("_", " "), about]);
  const changed = make("option", { value: "changed", hidden: true });
  const uploads = make("optgroup", { label: "files" });
  const groups = [uploads, group("gallery", curves), group("letters", letters)];
  const select = attributes(make("select", {}, ...options(own), changed, ...groups), {
    "aria-label": `${title}: choose a curve`,
  });
  const open = attributes(make("button", { type: "button", title: `${setup.suffixes}` }, "Open"), {
    "aria-label": `${title}: open a file`,
  });
  const input = make("input", { type: "file", accept: setup.suffixes, hidden: true });
  const parts = panel(name, title, select, open, input);
  attributes(parts.canvas, { role: "application", "aria-roledescription": "drawing field", tabindex: 0 });
  parts.words.setAttribute("role", "status");
  const note = attributes(make("p", { className: "tween-note", hidden: true }), { role: "alert" });
  parts.canvas.after(note);
  const mend = make("button", { type: "button", className: "tween-mend", hidden: true }, "Mend it");
  parts.whole.append(mend);
  return { ...parts, select, changed, uploads, open, input, note, mend };
}

function panels(setup) {
  const own = [["draw", "draw it"], ...(setup.given ? [["given", "the given curve"]] : [])];
  const time = make("output");
  const ui = {
    source: field("source", "From", setup, own),
    morph: panel("morph", "On the way", time),
    target: field("target", "To", setup, [["disk", "the disk"], ...own]),
    areas: panel("areas", "Areas of the triangles"),
    sums: panel("sums", "Largest sum of angles"),
    landmarks: attributes(make("ol", { className: "tween-landmarks" }), { "aria-label": "landmarks" }),
  };
  ui.morph.words.setAttribute("role", "status");
  attributes(ui.morph.canvas, { role: "application", "aria-roledescription": "picture", tabindex: 0 });
  return { ...ui, time };
}

function choices(setup) {
  const number = make("option", { value: "number" });
  const ui = {
    play: attributes(make("button", { type: "button", className: "tween-play" }, "▶"), { "aria-label": "play" }),
    slider: make("input", { type: "range", min: 0, step: 1, className: "tween-slider", ariaLabel: "time" }),
    path: make("select", {}, ...options(setup.paths)),
    triangulation: make("select", {}, ...options(setup.triangulations)),
    again: make("button", { type: "button", textContent: "another" }),
    spread: make("select", {}, ...options(setup.roots), number),
    guarantee: make("input", { type: "checkbox" }),
    numbered: number,
  };
  const settings = make(
    "section",
    { className: "tween-choices" },
    row("path", setup.help.path, ui.path),
    make("div", {}, row("triangles", setup.help.triangles, ui.triangulation), ui.again),
    row("root", setup.help.root, ui.spread),
    row("guarantee", setup.help.guarantee, ui.guarantee),
  );
  return { ...ui, settings: attributes(settings, { role: "group", "aria-label": "choices" }) };
}

function files(setup) {
  const kind = attributes(make("select", {}, ...options(setup.kinds)), { "aria-label": "kind of file" });
  const save = make("button", { type: "button", className: "tween-save", textContent: "Save here" });
  const download = make("button", { type: "button", className: "tween-download", textContent: "Download" });
  const message = make("output", { className: "tween-message" });
  return { kind, save, download, message, footer: make("div", { className: "tween-foot" }, kind, download, save, message) };
}

function tell(node, words, known, good) {
  node.textContent = words;
  node.dataset.verdict = known ? (good ? "yes" : "no") : "";
}

// One line on a field: what is wrong with a file, or what was chosen.
function note({ ui }, which, words, good = false) {
  const line = ui[which].note;
  line.hidden = !words;
  line.textContent = words;
  line.dataset.verdict = good ? "yes" : "no";
}
