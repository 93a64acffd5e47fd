// The face of the playground: fields to draw in, choices, a slider, two plots.
// Geometry is computed in Python (tween/sketch.py).  A field is `box` units wide and high, there and here, y up.

export default { render };

const COMPILING = "Computing …  What is done for the first time is compiled first; that may take a minute.";

function render({ model, el }) {
  const { box, colors } = model.get("setup");
  const ui = layout(model.get("setup"));
  const strokes = { source: null, target: null }; // what is being drawn
  let frame = 0;
  let timer = null;
  let patience = null;
  el.append(ui.root);

  const ask = (options, shapes = {}) => {
    const before = model.get("options");
    ui.root.classList.add("tween-busy");
    model.set("options", { ...before, ...options, asked: before.asked + 1 });
    for (const [which, shape] of Object.entries(shapes)) model.set(which, shape);
    model.save_changes();
    clearTimeout(patience);
    patience = setTimeout(() => tell(ui.morph.words, COMPILING, false), 2500);
  };
  const anyRoot = { root: "disk-center" }; // a number belongs to the triangles that there were

  // Shapes

  const showField = (which) => {
    const shape = model.get("shapes")[which];
    const ctx = surface(ui[which].canvas, box, box);
    const color = shape.ok ? colors[which] : colors.failure;
    if (strokes[which]) return drawStroke(ctx, strokes[which], colors[which]);
    fill(ctx, shape.points, shape.triangles, () => color);
    outline(ctx, shape.points, color, 1.6);
  };
  const showShapes = () => {
    for (const which of ["source", "target"]) {
      const shape = model.get("shapes")[which];
      tell(ui[which].words, shape.words, shape.points.length > 0, shape.ok);
      ui[which].select.value = model.get(which).name || "draw";
      showField(which);
    }
  };
  for (const which of ["source", "target"]) {
    ui[which].select.onchange = () => ask(anyRoot, { [which]: { name: ui[which].select.value } });
    followPointer(ui[which].canvas, box, {
      move: (stroke) => (strokes[which] = stroke),
      end: (stroke) => {
        strokes[which] = null;
        if (stroke.length > 2) ask(anyRoot, { [which]: { stroke } });
      },
      show: () => showField(which),
    });
  }

  // The morph

  const showFrame = () => {
    const footage = model.get("footage");
    const last = footage.frames.length - 1;
    frame = Math.max(0, Math.min(frame, last));
    ui.slider.max = Math.max(1, last);
    ui.slider.value = frame;
    ui.slider.disabled = ui.play.disabled = last < 1;
    ui.time.textContent = last < 1 ? "" : `t = ${(frame / last).toFixed(2)}`;
    drawFrame(surface(ui.morph.canvas, box, box), footage, frame, colors);
    drawAreas(surface(ui.areas.canvas), footage, frame);
    drawSums(surface(ui.sums.canvas), footage, frame, colors);
    ui.areas.words.textContent = last < 1 ? "" : areasInWords(footage.areas[frame]);
    ui.sums.words.textContent = last < 1 ? "" : sumsInWords(footage.sums[frame], footage.worst[frame]);
  };
  const showMorph = () => {
    const footage = model.get("footage");
    if (footage.asked !== model.get("options").asked) return;
    clearTimeout(patience);
    ui.root.classList.remove("tween-busy");
    tell(ui.morph.words, footage.words, footage.frames.length > 0, footage.valid);
    showFrame();
  };
  const stop = () => {
    clearInterval(timer);
    timer = null;
    ui.play.textContent = "▶";
  };
  const step = () => {
    if (frame + 1 >= model.get("footage").frames.length) return stop();
    frame += 1;
    showFrame();
  };
  ui.play.onclick = () => {
    if (timer) return stop();
    if (frame + 1 >= model.get("footage").frames.length) frame = -1;
    timer = setInterval(step, 40);
    ui.play.textContent = "❚❚";
  };
  ui.slider.oninput = () => {
    stop();
    frame = Number(ui.slider.value);
    showFrame();
  };
  ui.morph.canvas.onclick = (event) => {
    const root = triangleAt(model.get("footage"), frame, placeOf(event, ui.morph.canvas, box));
    if (root >= 0) ask({ root });
  };

  // Choices

  const showOptions = () => {
    const { path, triangulation, root, guarantee } = model.get("options");
    const number = typeof root === "number";
    ui.path.value = path;
    ui.triangulation.value = triangulation;
    ui.again.hidden = triangulation !== "random";
    ui.numbered.hidden = !number;
    ui.numbered.textContent = `triangle ${root}`;
    ui.spread.value = number ? "number" : root;
    ui.guarantee.checked = guarantee;
  };
  ui.path.onchange = () => ask({ path: ui.path.value });
  ui.triangulation.onchange = () => ask({ ...anyRoot, triangulation: ui.triangulation.value });
  ui.again.onclick = () => ask({ ...anyRoot, seed: model.get("options").seed + 1 });
  ui.spread.onchange = () => ask({ root: ui.spread.value });
  ui.guarantee.onchange = () => ask({ guarantee: ui.guarantee.checked });

  // Files

  const wish = (where) => {
    ui.message.textContent = "Saving …";
    model.set("wish", { kind: ui.kind.value, where, asked: (model.get("wish").asked || 0) + 1 });
    model.save_changes();
  };
  ui.save.onclick = () => wish("folder");
  ui.download.onclick = () => wish("browser");
  const showFile = () => {
    const { name, data, words } = model.get("file");
    ui.message.textContent = words;
    if (data) offer(name, data);
  };

  const listeners = { shapes: showShapes, footage: showMorph, options: showOptions, file: showFile };
  for (const [name, show] of Object.entries(listeners)) model.on(`change:${name}`, show);
  const watcher = new ResizeObserver(() => (showShapes(), showFrame()));
  watcher.observe(ui.root);
  showOptions();
  showMorph();
  return () => {
    stop();
    clearTimeout(patience);
    watcher.disconnect();
    for (const [name, show] of Object.entries(listeners)) model.off(`change:${name}`, show);
  };
}

// What is on the page

function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

function layout(setup) {
  const option = ([value, text, title = ""]) => make("option", { value, title }, text || value);
  const options = (entries) => entries.map(option);
  const group = (label, entries) => make("optgroup", { label }, ...options(entries));
  const shapes = (own) => {
    const letters = setup.letters.map((letter) => [letter]);
    const curves = setup.curves.map(([name, title]) => [name, name.replaceAll("_", " "), title]);
    return make("select", {}, ...options(own), group("gallery", curves), group("letters", letters));
  };
  const panel = (name, title, hint = "", head = "") => {
    const canvas = make("canvas");
    const words = make("p", { className: "tween-words" });
    words.setAttribute("role", "status");
    canvas.setAttribute("aria-label", title);
    const heading = make("header", {}, make("b", {}, title), make("small", {}, hint), head);
    const whole = make("section", { className: `tween-${name}` }, heading, canvas, words);
    return { canvas, words, whole, select: head };
  };
  const own = [["draw", "draw it"], ...(setup.given ? [["given", "the given curve"]] : [])];
  const numbered = make("option", { value: "number" });
  const ui = {
    source: panel("source", "From", "draw, or choose", shapes(own)),
    morph: panel("morph", "On the way", "", make("output")),
    target: panel("target", "To", "draw, or choose", shapes([["disk", "the disk"], ...own])),
    areas: panel("areas", "Areas of the triangles"),
    sums: panel("sums", "Largest sum of angles at a vertex"),
    play: make("button", { className: "tween-play", title: "play", textContent: "▶" }),
    slider: make("input", { type: "range", min: 0, step: 1, className: "tween-slider", ariaLabel: "time" }),
    path: make("select", {}, ...options(setup.paths)),
    triangulation: make("select", {}, ...options(setup.triangulations)),
    again: make("button", { textContent: "another" }),
    spread: make("select", {}, ...options(setup.roots), numbered),
    guarantee: make("input", { type: "checkbox" }),
    kind: make("select", { ariaLabel: "kind of file" }, ...options(setup.kinds)),
    save: make("button", { className: "tween-save", textContent: "Save here" }),
    download: make("button", { className: "tween-download", textContent: "Download" }),
    message: make("output", { className: "tween-message" }),
    numbered,
  };
  ui.time = ui.morph.select;
  const row = (name, ...nodes) => make("label", { title: setup.help[name] }, make("span", {}, name), ...nodes);
  const choices = make(
    "section",
    { className: "tween-choices" },
    row("path", ui.path),
    row("triangles", ui.triangulation, ui.again),
    row("root", ui.spread),
    row("guarantee", ui.guarantee),
  );
  const scrub = make("div", { className: "tween-scrub" }, ui.play, ui.slider);
  const files = make("footer", {}, ui.kind, ui.save, ui.download, ui.message);
  const top = [ui.source.whole, ui.morph.whole, ui.target.whole];
  const grid = (...nodes) => make("div", { className: "tween-grid" }, ...nodes);
  ui.root = make("div", { className: "tween-playground" });
  ui.root.append(grid(...top), scrub, grid(choices, ui.areas.whole, ui.sums.whole), files);
  // Or JupyterLab takes the keys: an arrow would move to another cell.
  for (const node of ui.root.querySelectorAll("input, select, button")) node.dataset.lmSuppressShortcuts = "true";
  for (const [name, color] of Object.entries(setup.colors)) ui.root.style.setProperty(`--tween-${name}`, color);
  return ui;
}

function tell(node, words, known, good) {
  node.textContent = words;
  node.dataset.verdict = known ? (good ? "yes" : "no") : "";
}

function offer(name, data) {
  const url = URL.createObjectURL(new Blob([data]));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

// The pointer: mouse, pen or finger

function placeOf(event, canvas, box) {
  const { left, bottom, width, height } = canvas.getBoundingClientRect();
  return [Math.round(((event.clientX - left) / width) * box), Math.round(((bottom - event.clientY) / height) * box)];
}

function followPointer(canvas, box, { move, end, show }) {
  let stroke = null;
  canvas.onpointerdown = (event) => {
    if (event.button || !event.isPrimary) return;
    canvas.setPointerCapture(event.pointerId);
    stroke = [placeOf(event, canvas, box)];
    event.preventDefault();
  };
  canvas.onpointermove = (event) => {
    if (!stroke || !event.isPrimary) return;
    const events = event.getCoalescedEvents?.() ?? [];
    for (const each of events.length ? events : [event]) stroke.push(placeOf(each, canvas, box));
    move(stroke);
    show();
  };
  canvas.onpointerup = canvas.onpointercancel = (event) => {
    if (!stroke || !event.isPrimary) return;
    end(stroke);
    stroke = null;
    show();
  };
}
