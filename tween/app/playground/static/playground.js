// The face of the playground: what is asked, undone, shown, played and saved.
// Joined with layout.js, fields.js, drawing.js and plots.js by tween/app/playground/widget.py.  Geometry is computed in
// Python.  A field is `box` units wide and high, there and here, y up.

export default { render };

const COMPILING = "Computing …  What is done for the first time is compiled first; that may take a minute.";
const FIELDS = ["source", "target"];
const UNDONE = ["path", "triangulation", "root", "guarantee", "seed", "landmarks"];
const LARGEST_FILE = 8e6; // what a message to the kernel may hold
const anyRoot = { root: "disk-center" }; // a number belongs to the triangles that there were
const anew = { ...anyRoot, landmarks: [] }; // as do landmarks to the vertices

function render({ model, el }) {
  const setup = model.get("setup");
  const desk = { model, setup, ui: layout(setup), box: setup.box, colors: setup.colors, tool: "draw", frame: 0 };
  // What is done at the moment, and what was done before and can be had again.
  Object.assign(desk, { strokes: {}, chosen: {}, pending: null, moving: null, past: [], future: [], tag: null });
  el.append(desk.ui.root);
  const listeners = {
    shapes: () => showShapes(desk),
    footage: () => showMorph(desk),
    options: () => showOptions(desk),
    uploads: () => showUploads(desk),
    file: () => showFile(desk),
  };
  for (const [name, show] of Object.entries(listeners)) model.on(`change:${name}`, show);
  for (const which of FIELDS) connectField(desk, which);
  for (const connect of [connectTools, connectMorph, connectOptions, connectFiles]) connect(desk);
  const watcher = new ResizeObserver(() => (showShapes(desk), showFrame(desk)));
  watcher.observe(desk.ui.root);
  fillMenus(desk, model.get("uploads").curves || []);
  showOptions(desk);
  if (model.get("footage").frames) showMorph(desk);
  else say(desk, {}, {}); // nothing is known yet
  return () => {
    stop(desk);
    clearTimeout(desk.patience);
    clearTimeout(desk.settling);
    watcher.disconnect();
    for (const [name, show] of Object.entries(listeners)) model.off(`change:${name}`, show);
  };
}

// What is asked of Python

function say(desk, options, shapes) {
  const before = desk.model.get("options");
  const now = { ...before, dragging: false, ...options, asked: before.asked + 1 };
  desk.model.set("options", now);
  for (const [which, wish] of Object.entries(shapes)) desk.model.set(which, wish);
  desk.model.save_changes();
  clearTimeout(desk.patience);
  if (now.dragging) return now.asked;
  desk.ui.root.classList.add("tween-busy");
  desk.patience = setTimeout(() => tell(desk.ui.morph.words, COMPILING, false), 2500);
  return now.asked;
}

function ask(desk, options, shapes = {}) {
  settle(desk);
  remember(desk);
  for (const which of FIELDS) note(desk, which, "");
  return say(desk, options, shapes);
}

// Undo and redo

function snapshot({ model }) {
  const options = model.get("options");
  const kept = Object.fromEntries(UNDONE.map((name) => [name, options[name]]));
  return { options: kept, source: model.get("source"), target: model.get("target") };
}

function remember(desk, tag = null) {
  if (tag && tag === desk.tag) return; // one step with the one before
  desk.past.push(snapshot(desk));
  desk.future = [];
  desk.tag = tag;
  showHistory(desk);
}

function travel(desk, from, to) {
  if (!from.length) return;
  settle(desk);
  to.push(snapshot(desk));
  const { options, source, target } = from.pop();
  Object.assign(desk, { tag: null, pending: null, moving: null, chosen: {} });
  for (const which of FIELDS) note(desk, which, "");
  say(desk, options, { source, target });
  showHistory(desk);
}

const undo = (desk) => travel(desk, desk.past, desk.future);
const redo = (desk) => travel(desk, desk.future, desk.past);

function showHistory({ ui, past, future }) {
  const focused = ui.root.getRootNode().activeElement;
  if (focused === ui.undo && !past.length) ui.source.canvas.focus(); // what is disabled hears no keys
  if (focused === ui.redo && !future.length) ui.undo.focus();
  ui.undo.disabled = !past.length;
  ui.redo.disabled = !future.length;
}

function connectTools(desk) {
  const { ui } = desk;
  ui.undo.onclick = () => undo(desk);
  ui.redo.onclick = () => redo(desk);
  for (const radio of ui.tools) radio.onchange = () => take(desk, radio.value);
  ui.root.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    if (key !== "z" && key !== "y") return;
    event.preventDefault();
    event.stopPropagation();
    if (key === "y" || event.shiftKey) redo(desk);
    else undo(desk);
  });
  showHistory(desk);
  take(desk, desk.tool);
}

function take(desk, tool) {
  desk.tool = desk.ui.root.dataset.tool = tool;
  desk.pending = null;
  for (const radio of desk.ui.tools) radio.checked = radio.value === tool;
  desk.ui.hint.textContent = HINTS[tool];
  showShapes(desk);
}

// The morph

function showFrame(desk) {
  const { ui, box, colors, model } = desk;
  const footage = model.get("footage");
  if (!footage.frames) return;
  const last = footage.frames.length - 1;
  const known = last > 0;
  desk.frame = Math.max(0, Math.min(desk.frame, last));
  const f = desk.frame;
  ui.slider.max = Math.max(1, last);
  ui.slider.value = f;
  ui.slider.disabled = ui.play.disabled = !known;
  ui.time.textContent = known ? `t = ${(f / last).toFixed(2)}` : "";
  ui.slider.setAttribute("aria-valuetext", ui.time.textContent);
  drawFrame(surface(ui.morph.canvas, box, box), footage, f, colors, desk.setup.landmarks);
  drawAreas(surface(ui.areas.canvas), footage, f);
  drawSums(surface(ui.sums.canvas), footage, f, colors);
  ui.areas.words.textContent = known ? areasInWords(footage.areas[f]) : "";
  ui.sums.words.textContent = known ? sumsInWords(footage.sums[f], footage.worst[f]) : "";
  for (const name of ["morph", "areas", "sums"]) {
    const words = known ? `${ui.time.textContent}: ${ui[name].words.textContent}` : "nothing yet";
    const keys = name === "morph" ? "; arrow keys choose the root" : "";
    ui[name].canvas.setAttribute("aria-label", `${ui[name].title}, ${words}${keys}`);
  }
}

function showMorph(desk) {
  const footage = desk.model.get("footage");
  if (!footage.frames || footage.asked !== desk.model.get("options").asked) return;
  clearTimeout(desk.patience);
  desk.ui.root.classList.remove("tween-busy");
  tell(desk.ui.morph.words, footage.words, !footage.waiting, footage.valid);
  showFrame(desk);
}

function stop(desk) {
  clearInterval(desk.timer);
  desk.timer = null;
  desk.ui.play.textContent = "▶";
  desk.ui.play.setAttribute("aria-label", "play");
}

function step(desk) {
  if (desk.frame + 1 >= desk.model.get("footage").frames.length) return stop(desk);
  desk.frame += 1;
  showFrame(desk);
}

function connectMorph(desk) {
  const { ui, model, box } = desk;
  ui.play.onclick = () => {
    if (desk.timer) return stop(desk);
    if (desk.frame + 1 >= model.get("footage").frames.length) desk.frame = -1;
    desk.timer = setInterval(() => step(desk), 40);
    ui.play.textContent = "❚❚";
    ui.play.setAttribute("aria-label", "pause");
  };
  ui.slider.oninput = () => {
    stop(desk);
    desk.frame = Number(ui.slider.value);
    showFrame(desk);
  };
  ui.morph.canvas.onclick = (event) => {
    const root = triangleAt(model.get("footage"), desk.frame, placeOf(event, ui.morph.canvas, box));
    if (root >= 0) ask(desk, { root });
  };
  ui.morph.canvas.onkeydown = (event) => {
    const { order, root } = model.get("footage");
    const along = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!along || !order) return;
    event.preventDefault();
    remember(desk, "root");
    const asked = model.get("options").root;
    const place = order.indexOf(typeof asked === "number" ? asked : root);
    say(desk, { root: order[(place + along + order.length) % order.length] }, {});
  };
}

// Choices

function showOptions(desk) {
  const { ui, model } = desk;
  const { path, triangulation, root, guarantee, landmarks } = model.get("options");
  const number = typeof root === "number";
  ui.path.value = path;
  ui.triangulation.value = triangulation;
  ui.again.hidden = triangulation !== "random";
  ui.numbered.hidden = !number;
  ui.numbered.textContent = `triangle ${root}`;
  ui.spread.value = number ? "number" : root;
  ui.guarantee.checked = guarantee;
  showLandmarks(desk, landmarks);
}

function connectOptions(desk) {
  const { ui, model } = desk;
  ui.path.onchange = () => ask(desk, { path: ui.path.value });
  ui.triangulation.onchange = () => ask(desk, { ...anyRoot, triangulation: ui.triangulation.value });
  ui.again.onclick = () => ask(desk, { ...anyRoot, seed: model.get("options").seed + 1 });
  ui.spread.onchange = () => ask(desk, { root: ui.spread.value });
  ui.guarantee.onchange = () => ask(desk, { guarantee: ui.guarantee.checked });
}

// Files

function connectFiles(desk) {
  const { ui, model } = desk;
  const wish = (where) => {
    ui.message.textContent = "Saving …";
    model.set("wish", { kind: ui.kind.value, where, asked: (model.get("wish").asked || 0) + 1 });
    model.save_changes();
  };
  ui.save.onclick = () => wish("folder");
  ui.download.onclick = () => wish("browser");
}

function showFile({ ui, model }) {
  const { name, data, words } = model.get("file");
  ui.message.textContent = words;
  if (!data) return;
  const url = URL.createObjectURL(new Blob([data]));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

async function handIn(desk, which, file) {
  if (!file) return;
  if (file.size > LARGEST_FILE) {
    return note(desk, which, `${file.name} has ${(file.size / 1e6).toFixed(1)} MB, more than the 8 that can be handed in.`);
  }
  const data = new DataView(await file.arrayBuffer());
  const { model } = desk;
  note(desk, which, `Reading ${file.name} …`, true);
  model.set("upload", { which, name: file.name, data, asked: (model.get("upload").asked || 0) + 1 });
  model.save_changes();
}

function showUploads(desk) {
  const { which, asked } = desk.model.get("upload");
  const uploads = desk.model.get("uploads");
  fillMenus(desk, uploads.curves);
  if (asked !== uploads.asked) return;
  if (uploads.chosen) ask(desk, anew, { [which]: { name: uploads.chosen } });
  note(desk, which, uploads.words, Boolean(uploads.chosen));
  showShapes(desk);
}

function fillMenus({ ui }, names) {
  for (const which of FIELDS) {
    ui[which].uploads.hidden = !names.length;
    ui[which].uploads.replaceChildren(...names.map((name) => make("option", { value: name }, name)));
  }
}
