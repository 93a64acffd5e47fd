// Pictures on a canvas: shapes, why one bounds no disk, morphs.

const INK = "#262626";

function surface(canvas, width = canvas.clientWidth, height = canvas.clientHeight) {
  const sharp = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * sharp;
  canvas.height = canvas.clientHeight * sharp;
  const ctx = canvas.getContext("2d");
  ctx.setTransform(canvas.width / width, 0, 0, -canvas.height / height, 0, canvas.height);
  ctx.lineJoin = ctx.lineCap = "round";
  return Object.assign(ctx, { pixel: width / canvas.clientWidth, size: [width, height] });
}

function trace(ctx, points, indices) {
  ctx.beginPath();
  for (const i of indices) ctx.lineTo(points[2 * i], points[2 * i + 1]);
}

function fill(ctx, points, triangles, color) {
  // Layers add up: no seam within one, and where two overlap it is darker.
  ctx.globalCompositeOperation = "lighter";
  ctx.globalAlpha = 0.3;
  for (let i = 0; i < triangles.length; i += 3) {
    ctx.fillStyle = color(i / 3);
    trace(ctx, points, triangles.slice(i, i + 3));
    ctx.fill();
  }
  ctx.globalCompositeOperation = "source-over";
  ctx.globalAlpha = 1;
}

function outline(ctx, points, color, width) {
  trace(ctx, points, Array.from({ length: points.length / 2 }, (_, i) => i));
  ctx.closePath();
  ctx.strokeStyle = color;
  ctx.lineWidth = width * ctx.pixel;
  ctx.stroke();
}

function dot(ctx, [x, y], color, radius) {
  ctx.beginPath();
  ctx.arc(x, y, radius * ctx.pixel, 0, 7);
  ctx.fillStyle = color;
  ctx.fill();
}

function drawStroke(ctx, stroke, color) {
  line(ctx, stroke, color, 1.6);
  dot(ctx, stroke[0], color, 3.5);
}

function ring(ctx, [x, y], color, radius) {
  ctx.beginPath();
  ctx.arc(x, y, radius * ctx.pixel, 0, 7);
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.6 * ctx.pixel;
  ctx.stroke();
}

function drawVertices(ctx, points, color) {
  for (let i = 0; i < points.length; i += 2) dot(ctx, [points[i], points[i + 1]], color, 1.7);
}

// A landmark: its number in a dot.
function drawMark(ctx, [x, y], number, color) {
  if (x === undefined) return;
  dot(ctx, [x, y], "white", 9);
  dot(ctx, [x, y], color, 8);
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(ctx.pixel, -ctx.pixel); // letters are drawn y down
  ctx.font = "bold 10px system-ui, sans-serif";
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillStyle = "white";
  ctx.fillText(number, 0, 0.5);
  ctx.restore();
}

// As tween.plot.draw_explanation does.
function drawWhy(ctx, points, why, colors) {
  ctx.globalAlpha = 0.18;
  area(ctx, [why.mended], colors.tree);
  ctx.globalAlpha = 0.45;
  for (const rings of why.negative) area(ctx, rings, colors.failure);
  ctx.globalAlpha = 1;
  outline(ctx, why.mended, colors.tree, 3.2);
  outline(ctx, points, INK, 1.1);
  dashed(ctx, why.surplus, colors.failure, 2, [1, 3.5]);
  dashed(ctx, why.lost, colors.failure, 1.8, [5, 3.5]);
  for (let i = 0; i < why.places.length; i += 2) dot(ctx, [why.places[i], why.places[i + 1]], INK, 2);
  for (let i = 0; i < why.tiny.length; i += 2) ring(ctx, [why.tiny[i], why.tiny[i + 1]], colors.pivot, 6);
}

function area(ctx, rings, color) {
  ctx.beginPath();
  for (const points of rings) {
    for (let i = 0; i < points.length; i += 2) ctx[i ? "lineTo" : "moveTo"](points[i], points[i + 1]);
    ctx.closePath();
  }
  ctx.fillStyle = color;
  ctx.fill("evenodd");
}

function dashed(ctx, polygons, color, width, dashes) {
  ctx.setLineDash(dashes.map((length) => length * ctx.pixel));
  for (const points of polygons) outline(ctx, points, color, width);
  ctx.setLineDash([]);
}

function drawFrame(ctx, footage, f, colors, marks) {
  if (!footage.frames.length) return;
  const points = footage.frames[f];
  const triangles = footage.stages[footage.stage[f]];
  fill(ctx, points, triangles, (i) => footage.colors[i]);
  ctx.strokeStyle = "rgb(115 115 115 / 45%)";
  ctx.lineWidth = 0.5 * ctx.pixel;
  for (let i = 0; i < triangles.length; i += 3) {
    trace(ctx, points, [...triangles.slice(i, i + 3), triangles[i]]);
    ctx.stroke();
  }
  outline(ctx, points, INK, 1.2);
  if (footage.root >= 0) dot(ctx, middle(points, triangles, footage.root), colors.pivot, 3.5);
  const at = (v) => [points[2 * v], points[2 * v + 1]];
  footage.marks.forEach((v, k) => drawMark(ctx, at(v), `${k + 1}`, marks[k % marks.length]));
  const v = footage.worst[f];
  if (footage.sums[f] >= 2 * Math.PI) dot(ctx, at(v), colors.failure, 3.5);
}

function middle(points, triangles, i) {
  const mean = (axis) => [0, 1, 2].reduce((sum, s) => sum + points[2 * triangles[3 * i + s] + axis] / 3, 0);
  return [mean(0), mean(1)];
}

function triangleAt(footage, f, [x, y]) {
  if (!footage.frames.length) return -1;
  const points = footage.frames[f];
  const triangles = footage.stages[footage.stage[f]];
  const left = (i, j) =>
    (points[2 * j] - points[2 * i]) * (y - points[2 * i + 1]) -
      (points[2 * j + 1] - points[2 * i + 1]) * (x - points[2 * i]) >= 0;
  for (let i = triangles.length / 3 - 1; i >= 0; i -= 1) {
    const [a, b, c] = triangles.slice(3 * i, 3 * i + 3);
    if (left(a, b) && left(b, c) && left(c, a)) return i;
  }
  return -1;
}

function line(ctx, places, color, width) {
  ctx.strokeStyle = color;
  ctx.lineWidth = width * ctx.pixel;
  ctx.beginPath();
  for (const [x, y] of places) ctx.lineTo(x, y);
  ctx.stroke();
}

function label(ctx, text, [x, y], color) {
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(1, -1); // letters are drawn y down
  ctx.font = "11px system-ui, sans-serif";
  ctx.textAlign = "right";
  ctx.fillStyle = color;
  ctx.fillText(text, 0, 0);
  ctx.restore();
}
