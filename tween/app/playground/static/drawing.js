// Pictures on a canvas: shapes, morphs, plots.  Joined to playground.js by tween/widget.py.

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

function drawFrame(ctx, footage, f, colors) {
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
  const v = footage.worst[f];
  if (footage.sums[f] >= 2 * Math.PI) dot(ctx, [points[2 * v], points[2 * v + 1]], colors.failure, 3.5);
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

// Plots

const percent = (share) => `${(share / 100).toFixed(1)} %`;

function areasInWords(areas) {
  const total = areas.reduce((sum, area) => sum + area, 0);
  return `largest ${percent(Math.max(...areas))}, all ${percent(total)} of the first shape`;
}

function sumsInWords(sum, vertex) {
  return `${(sum / Math.PI).toFixed(3)} π at vertex ${vertex}; from 2 π on it is no disk`;
}

function drawAreas(ctx, footage, f) {
  if (!footage.frames.length) return;
  const [width, height] = ctx.size;
  const top = roundUp(Math.max(...footage.areas[f]));
  const step = width / footage.order.length;
  footage.order.forEach((triangle, place) => {
    ctx.fillStyle = footage.colors[triangle];
    ctx.fillRect(place * step, 0, Math.max(step - 0.6, 0.6), (footage.areas[f][triangle] / top) * (height - 16));
  });
  line(ctx, [[0, height - 16], [width, height - 16]], "#d0d0d0", 1);
  label(ctx, `${top / 100} %`, [width, height - 12], "#595959");
}

function roundUp(number) {
  const power = 10 ** Math.floor(Math.log10(Math.max(number, 1)));
  return power * [1, 2, 3, 5, 10].find((digit) => digit * power >= number);
}

function drawSums(ctx, footage, f, colors) {
  if (!footage.frames.length) return;
  const [width, height] = ctx.size;
  const limit = 2 * Math.PI;
  const last = footage.sums.length - 1;
  const least = Math.min(...footage.sums, 0.75 * limit);
  const most = Math.max(...footage.sums, limit);
  const place = (i, sum) => [4 + (i / last) * (width - 8), 6 + ((sum - least) / (most - least)) * (height - 22)];
  line(ctx, [place(0, limit), place(last, limit)], colors.failure, 1);
  label(ctx, "2 π", [width, place(0, limit)[1] + 4], colors.failure);
  line(ctx, footage.sums.map((sum, i) => place(i, sum)), INK, 1.4);
  dot(ctx, place(f, footage.sums[f]), footage.sums[f] < limit ? INK : colors.failure, 3.5);
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
