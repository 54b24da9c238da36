// Rows that lie off the plot's scale: counted in words, and marked at its edge.

/** Counts the rows in view that lie off the scale, and names the largest of each curve. */
function countOffScale(plot) {
  const ranges = plot.axisRanges();
  const all = { count: 0, words: [] };
  for (const { curve, times, values } of plot.inView()) {
    if (!isLoad(curve)) continue;
    const off = rowsOffScale(times, values, ranges[curve.scale]);
    if (off.count === 0) continue;
    all.count += off.count;
    all.words.push(`${curve.label} to ${valueWords(off.largest, curve.base)} at ${Number(off.time.toFixed(3))} s`);
  }
  return all.count > 0 ? all : null;
}

/** Of stacked areas over how long each column is the mean, where that is more than a row. */
function meanWords(plot) {
  const size = plot.shownQuantity().isStack ? rowsInColumn(plot) : 1;
  return size > 1 ? `drawn as means over ${shortNumber(size * plot.run.info.forces_interval_s)} s` : "";
}

function showOffScale(plot) {
  plot.off = countOffScale(plot);
  const means = meanWords(plot);
  plot.offScale.hidden = plot.off === null && means === "";
  const words = (off) => [means, off].filter(Boolean).join("; ");
  plot.offScale.replaceChildren(
    make("span", { class: "long" }, words(plot.off && `\u25b2 off the scale: ${plot.off.words.join("; ")}`)),
    make("span", { class: "short" }, words(plot.off && `\u25b2 ${plot.off.count} values off the scale`)));
}

/** A mark at the edge for rows off the scale, one for each few pixels. */
function drawOffScale(plot, chart) {
  if (!plot.off) return;
  for (const { curve, ship, times, values } of plot.inView()) {
    if (!isLoad(curve)) continue;
    chart.ctx.fillStyle = curveStyle(curve, ship, plot.run.forces.length, plot.colours).stroke.slice(0, 7);
    drawEdgeMarks(chart, times, values, chart.scales[curve.scale]);
  }
}

function drawEdgeMarks(chart, times, values, { min, max }) {
  const { ctx, bbox } = chart;
  const size = 4 * devicePixelRatio;
  const marked = new Set();
  values.forEach((value, row) => {
    if (value >= min && value <= max) return;
    const side = value > max ? 1 : -1;
    const x = chart.valToPos(times[row], "x", true);
    const key = side * (1 + Math.floor(x / size));
    if (marked.has(key) || x < bbox.left) return;
    marked.add(key);
    const y = side > 0 ? bbox.top : bbox.top + bbox.height;
    ctx.beginPath();
    ctx.moveTo(x, y);
    ctx.lineTo(x - size, y + 1.5 * side * size);
    ctx.lineTo(x + size, y + 1.5 * side * size);
    ctx.fill();
  });
}
