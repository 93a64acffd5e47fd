// The two fields: drawing, moving vertices, landmarks, by pointer and by keys.

const REACH = { mouse: 12, pen: 14, touch: 24 }; // pixels from a vertex
const STEP = 4; // of an arrow key, in units of the field

const clamped = (number, box) => Math.max(0, Math.min(box, Math.round(number)));
const nameOf = (wish) => (wish.of ? nameOf(wish.of) : wish.name || "draw");
// Vertices go by the numbers that they had before any was moved: what is moved may turn clockwise, and is renumbered.
const rowOf = ({ rows }, v) => (rows ? rows[v] : v);
const shownAs = ({ rows }, row) => (rows ? rows.indexOf(row) : row);
const shapeOf = (desk, which) => desk.model.get("shapes")[which] || { points: [], triangles: [], words: "" };

// What is shown

function showShapes(desk) {
  const { ui, model, moving } = desk;
  const shapes = model.get("shapes");
  if (moving?.done && shapes.asked >= moving.done) desk.moving = null;
  for (const which of FIELDS) {
    const shape = shapeOf(desk, which);
    const wish = model.get(which);
    const { words, mend, select, changed } = ui[which];
    const advice = shape.why ? ` ${shape.why.advice}` : "";
    tell(words, shape.words + advice, shape.points.length > 0, shape.ok);
    mend.hidden = !shape.why?.mended.length;
    changed.hidden = !wish.of;
    changed.textContent = `${nameOf(wish) === "draw" ? "drawn" : nameOf(wish)}, changed`;
    select.value = wish.of ? "changed" : nameOf(wish);
    ui[which].canvas.setAttribute("aria-label", `${ui[which].title}: field to draw in${chosenInWords(desk, which)}`);
    showField(desk, which);
  }
}

function chosenInWords(desk, which) {
  const v = desk.chosen[which];
  const n = shapeOf(desk, which).points.length / 2;
  return v === undefined || v >= n ? "" : `; vertex ${v} of ${n}`;
}

function pointsOf(desk, which) {
  const shape = shapeOf(desk, which);
  const { moving } = desk;
  if (moving?.which !== which) return shape.points;
  return shape.points.toSpliced(2 * shownAs(shape, moving.row), 2, ...moving.place);
}

function showField(desk, which) {
  const { ui, box, colors, strokes, tool } = desk;
  const ctx = surface(ui[which].canvas, box, box);
  if (strokes[which]) return drawStroke(ctx, strokes[which], colors[which]);
  const shape = shapeOf(desk, which);
  const points = pointsOf(desk, which);
  fill(ctx, points, shape.triangles, () => (shape.ok ? colors[which] : colors.failure));
  if (shape.why) drawWhy(ctx, points, shape.why, colors);
  else outline(ctx, points, shape.ok || !points.length ? colors[which] : colors.failure, 1.6);
  if (tool !== "draw") drawVertices(ctx, points, INK);
  showMarks(desk, which, ctx, points);
}

function showMarks(desk, which, ctx, points) {
  const side = FIELDS.indexOf(which);
  const shape = shapeOf(desk, which);
  const at = (v) => [points[2 * v], points[2 * v + 1]];
  const pairs = desk.model.get("options").landmarks;
  const color = (k) => desk.setup.landmarks[k % desk.setup.landmarks.length];
  pairs.forEach((pair, k) => drawMark(ctx, at(shownAs(shape, pair[side])), `${k + 1}`, color(k)));
  if (desk.pending?.which === which) {
    drawMark(ctx, at(shownAs(shape, desk.pending.row)), `${pairs.length + 1}`, color(pairs.length));
  }
  const v = desk.chosen[which];
  if (v !== undefined && 2 * v < points.length) ring(ctx, at(v), INK, 8);
}

function showLandmarks(desk, pairs) {
  const { ui, setup } = desk;
  const items = pairs.map(([i, j], k) => {
    const mark = make("b", { textContent: k + 1 });
    mark.style.background = setup.landmarks[k % setup.landmarks.length];
    const drop = make("button", { type: "button", textContent: "×", title: "remove" });
    drop.setAttribute("aria-label", `remove landmark ${k + 1}, vertex ${i} to vertex ${j}`);
    drop.onclick = () => {
      ui.source.canvas.focus(); // as the button goes
      unmark(desk, k);
    };
    return make("li", {}, mark, `${i} → ${j}`, drop);
  });
  ui.landmarks.replaceChildren(...items);
  ui.landmarks.hidden = !pairs.length;
  for (const which of FIELDS) showField(desk, which);
}

// What is done

function connectField(desk, which) {
  const { ui, model } = desk;
  const { select, canvas, mend, open, input } = ui[which];
  select.onchange = () => {
    desk.chosen = {};
    if (select.value === "draw") take(desk, "draw");
    ask(desk, anew, { [which]: { name: select.value } });
  };
  mend.onclick = () => {
    canvas.focus(); // as the button goes
    ask(desk, anew, { [which]: { of: model.get(which), mended: 0 } });
  };
  open.onclick = () => input.click();
  input.onchange = () => {
    handIn(desk, which, input.files[0]);
    input.value = ""; // so that the same file can be handed in again
  };
  canvas.ondragover = (event) => event.preventDefault();
  canvas.ondrop = (event) => {
    event.preventDefault();
    handIn(desk, which, event.dataTransfer.files[0]);
  };
  canvas.onkeydown = (event) => pressed(desk, which, event);
  followPointer(desk, which, canvas);
}

function vertexAt(desk, which, [x, y], reach) {
  const points = pointsOf(desk, which);
  let best = null;
  let least = (reach * desk.box) / desk.ui[which].canvas.clientWidth;
  for (let v = 0; 2 * v < points.length; v += 1) {
    const distance = Math.hypot(points[2 * v] - x, points[2 * v + 1] - y);
    if (distance <= least) [best, least] = [v, distance];
  }
  return best;
}

function choose(desk, which, v) {
  desk.chosen = v === null ? {} : { [which]: v };
  showShapes(desk);
}

// A vertex on its way: the wish is that of before, with the vertex in another place.
function grasp(desk, which, v) {
  const { of, moved = [] } = desk.model.get(which).moved ? desk.model.get(which) : { of: desk.model.get(which) };
  const shape = shapeOf(desk, which);
  const place = shape.points.slice(2 * v, 2 * v + 2);
  desk.moving = { which, row: rowOf(shape, v), of, others: moved, place, steps: 0 };
}

function drag(desk, [x, y], tag) {
  const { moving, box } = desk;
  moving.place = [clamped(x, box), clamped(y, box)];
  moving.done = null;
  remember(desk, tag);
  note(desk, moving.which, "");
  say(desk, { ...anyRoot, dragging: true }, { [moving.which]: wishOf(moving) });
  showField(desk, moving.which);
}

function wishOf({ of, others, row, place }) {
  return { of, moved: [...others.filter(([other]) => other !== row), [row, ...place]] };
}

function letGo(desk) {
  const { moving } = desk;
  desk.tag = null;
  moving.done = say(desk, anyRoot, { [moving.which]: wishOf(moving) });
}

function settle(desk) {
  clearTimeout(desk.settling);
  desk.settling = null;
  if (desk.moving && !desk.moving.done) desk.moving = null;
}

// Landmarks

function pairAt(desk, which, v) {
  const row = rowOf(shapeOf(desk, which), v);
  const pairs = desk.model.get("options").landmarks;
  return { row, pairs, there: pairs.findIndex((pair) => pair[FIELDS.indexOf(which)] === row) };
}

function mark(desk, which, v) {
  const { row, pairs, there } = pairAt(desk, which, v);
  if (there >= 0) return unmark(desk, there);
  const { pending } = desk;
  if (!pending || pending.which === which) {
    desk.pending = pending?.row === row ? null : { which, row };
    return showShapes(desk);
  }
  desk.pending = null;
  const pair = which === "target" ? [pending.row, row] : [row, pending.row];
  ask(desk, { ...anyRoot, triangulation: "matched", landmarks: [...pairs, pair] });
}

function unmark(desk, k) {
  ask(desk, { ...anyRoot, landmarks: desk.model.get("options").landmarks.toSpliced(k, 1) });
}

function remove(desk, which, v) {
  const { pairs, there } = pairAt(desk, which, v);
  if (there >= 0) return unmark(desk, there);
  if (isDisk(desk, which)) return;
  const shape = shapeOf(desk, which);
  const renumbered = (row) => shownAs(shape, row) - (shownAs(shape, row) > v);
  const landmarks = pairs.map((pair) => pair.map((row, side) => (FIELDS[side] === which ? renumbered(row) : row)));
  desk.chosen = { [which]: v % (shape.points.length / 2 - 1) };
  ask(desk, { ...anyRoot, landmarks }, { [which]: { of: desk.model.get(which), without: v } });
}

// Keys

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function pressed(desk, which, event) {
  const n = pointsOf(desk, which).length / 2;
  const v = desk.chosen[which];
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const known = v !== undefined && v < n;
  const next = event.shiftKey ? n - 1 : 1;
  const actions = {
    " ": () => n && choose(desk, which, known ? (v + next) % n : 0),
    Escape: () => lose(desk, which),
    Enter: () => known && mark(desk, which, v),
    Delete: () => known && remove(desk, which, v),
    Backspace: () => known && remove(desk, which, v),
  };
  if (event.key in ARROWS) actions[event.key] = () => known && nudge(desk, which, v, event);
  if (!(event.key in actions)) return;
  event.preventDefault();
  event.stopPropagation();
  actions[event.key]();
}

function nudge(desk, which, v, event) {
  if (isDisk(desk, which)) return;
  if (desk.moving?.which !== which || desk.moving.done) grasp(desk, which, v);
  const step = event.shiftKey ? 5 * STEP : STEP;
  const [x, y] = desk.moving.place;
  const [right, up] = ARROWS[event.key];
  drag(desk, [x + step * right, y + step * up], `keys ${which} ${desk.moving.row}`);
  clearTimeout(desk.settling);
  desk.settling = setTimeout(() => letGo(desk), 500);
}

function lose(desk, which) {
  desk.strokes[which] = null;
  Object.assign(desk, { pending: null, chosen: {}, tag: null });
  note(desk, which, "");
  showShapes(desk);
}

function isDisk(desk, which) {
  const disk = desk.model.get(which).name === "disk";
  if (disk) note(desk, which, "The disk follows the first curve; choose or draw another to change it.");
  return disk;
}

// The pointer: mouse, pen or finger

function placeOf(event, canvas, box) {
  const { left, bottom, width, height } = canvas.getBoundingClientRect();
  return [Math.round(((event.clientX - left) / width) * box), Math.round(((bottom - event.clientY) / height) * box)];
}

const HANDS = {
  draw: {
    down: (desk, which, place) => (desk.strokes[which] = [place]),
    move: (desk, which, places) => (desk.strokes[which]?.push(...places), showField(desk, which)),
    up: (desk, which) => {
      const stroke = desk.strokes[which];
      desk.strokes[which] = null;
      if (stroke?.length > 2) (desk.chosen = {}), ask(desk, anew, { [which]: { stroke } });
      showField(desk, which);
    },
  },
  move: {
    down: (desk, which, place, reach) => {
      settle(desk);
      const v = vertexAt(desk, which, place, reach);
      if (v !== null && !isDisk(desk, which)) grasp(desk, which, v);
      choose(desk, which, v);
    },
    move: (desk, which, places) => {
      if (desk.moving?.which !== which || desk.moving.done) return;
      if (!desk.moving.steps) desk.drags = (desk.drags || 0) + 1;
      desk.moving.steps += 1;
      drag(desk, places.at(-1), `drag ${desk.drags}`);
    },
    up: (desk) => {
      if (desk.moving?.steps) letGo(desk);
      else desk.moving = null;
    },
  },
  landmarks: {
    down: (desk, which, place, reach) => {
      const v = vertexAt(desk, which, place, 1.5 * reach);
      if (v === null) return;
      desk.chosen = { [which]: v };
      mark(desk, which, v);
    },
    move: () => {},
    up: () => {},
  },
};

function followPointer(desk, which, canvas) {
  let hand = null;
  canvas.onpointerdown = (event) => {
    if (event.button || !event.isPrimary) return;
    event.preventDefault();
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
    note(desk, which, "");
    hand = HANDS[desk.tool];
    hand.down(desk, which, placeOf(event, canvas, desk.box), REACH[event.pointerType] || REACH.mouse);
  };
  canvas.onpointermove = (event) => {
    if (!hand || !event.isPrimary) return;
    const events = event.getCoalescedEvents?.() ?? [];
    hand.move(desk, which, (events.length ? events : [event]).map((each) => placeOf(each, canvas, desk.box)));
  };
  canvas.onpointerup = canvas.onpointercancel = (event) => {
    if (!hand || !event.isPrimary) return;
    hand.up(desk, which);
    hand = null;
  };
}
