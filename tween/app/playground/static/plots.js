// The two plots: areas of triangles, and sums of angles.

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
