// Stacked areas: forces by cause, from 0 up those above it, from 0 down those below, and the line of their sum.

const columnWidth = 2; // [px]; rows that stand closer are drawn as their mean

/** How many rows of forces.csv go into one column of the picture. */
function rowsInColumn(plot) {
  const [first, end] = plot.rowsInView(plot.shownQuantity().ship);
  return Math.max(1, Math.ceil((columnWidth * (end - first)) / Math.max(1, plot.host.clientWidth)));
}

/** Means of a column's rows, `size` of them each; groups begin at multiples of it, so that they stay when the plot moves. */
function meansOf(values, first, end, size) {
  const means = new Float64Array(Math.ceil(end / size) - Math.floor(first / size));
  for (let k = 0; k < means.length; ++k) {
    const from = (Math.floor(first / size) + k) * size;
    const to = Math.min(values.length, from + size);
    for (let row = from; row < to; ++row) means[k] += values[row] / (to - from);
  }
  return means;
}

/**
 * What is in view, as columns: of each shown cause its mean, how high and how low they stand together, their sum, and the times between
 * which each column stands [s].
 */
function stackOf(plot) {
  const { ship } = plot.shownQuantity();
  const rows = plot.run.forces[ship];
  const [first, end] = plot.rowsInView(ship);
  const size = rowsInColumn(plot);
  const shown = plot.shownCurves();
  const areas = shown.filter(({ kind }) => kind !== "sum").map((curve) => ({ curve, means: meansOf(rows[curve.column], first, end, size) }));
  const line = shown.find(({ kind }) => kind === "sum");
  const count = Math.max(0, Math.ceil(end / size) - Math.floor(first / size));
  const [high, low] = [new Float64Array(count), new Float64Array(count)];
  for (const { means } of areas) means.forEach((mean, k) => { (mean > 0 ? high : low)[k] += mean; });
  const times = rows.force_t_s;
  const startOf = (row) => (row > 0 ? times[row - 1] : 2 * times[0] - (times[1] ?? 2 * times[0]));
  const starts = Float64Array.from(high, (_, k) => startOf((Math.floor(first / size) + k) * size));
  const ends = Float64Array.from(high, (_, k) => times[Math.min(times.length, (Math.floor(first / size) + k + 1) * size) - 1]);
  return { areas, line: line ? meansOf(rows[line.column], first, end, size) : null, high, low, starts, ends, size };
}

/** Steps from left to right along values, into the path. */
function traceSteps({ starts, ends }, values, xOf, yOf, context) {
  values.forEach((value, k) => {
    context.lineTo(xOf(starts[k]), yOf(value));
    context.lineTo(xOf(ends[k]), yOf(value));
  });
}

/** The same back from right to left. */
function traceStepsBack({ starts, ends }, values, xOf, yOf, context) {
  for (let k = values.length - 1; k >= 0; --k) {
    context.lineTo(xOf(ends[k]), yOf(values[k]));
    context.lineTo(xOf(starts[k]), yOf(values[k]));
  }
}

/** Draws the areas and the line of the sum into a chart. */
function drawStack(plot, chart) {
  const stack = stackOf(plot);
  const { ctx, bbox } = chart;
  const xOf = (time) => chart.valToPos(time, "x", true);
  const yOf = (value) => chart.valToPos(value, "y", true);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  const tops = { up: new Float64Array(stack.high.length), down: new Float64Array(stack.high.length) };
  for (const { curve, means } of stack.areas) {
    ctx.fillStyle = plot.colours[`cause-${curve.kind}`];
    for (const [side, sign] of [["up", 1], ["down", -1]]) {
      const next = tops[side].map((top, k) => (means[k] * sign > 0 ? top + means[k] : top));
      ctx.beginPath();
      traceSteps(stack, next, xOf, yOf, ctx);
      traceStepsBack(stack, tops[side], xOf, yOf, ctx);
      ctx.fill();
      tops[side] = next;
    }
  }
  if (stack.line) {
    ctx.beginPath();
    traceSteps(stack, stack.line, xOf, yOf, ctx);
    for (const [width, colour] of [[3.5, plot.colours.panel], [1.5, plot.colours.ink]]) {
      ctx.lineWidth = width * devicePixelRatio;
      ctx.strokeStyle = colour;
      ctx.stroke();
    }
  }
  ctx.restore();
}
