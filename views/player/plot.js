// One plot: its legend, values beyond its scale, its chart and its pointers.

/** Sample of a curve for the legend: a line, or the colour of an area. */
function lineOf({ kind, isArea = false }) {
  return make("i", isArea
    ? { class: "line area", style: `background: var(--cause-${kind})` } : { class: `line ${kind}` });
}

/** Fills the plot's legend: a check box, a sample and a value for each curve; a single curve has only its value.
 * Returns a function that shows the values at a time [s]. Tests read the `data-` attributes. */
function fillPlotKey(run, plot, host, onChange) {
  const { ships } = run.info;
  const outputs = [];
  const curves = plot.curves();
  const rows = curves.map((curve) => {
    const isOfMany = plot.ships().length > 1;
    const values = plot.ships().map((ship) => {
      const output = make("output", { "data-column": curve.column, "data-ship": ships[ship].name });
      outputs.push({ curve, ship, output });
      const style = isOfMany ? `color: var(--ship-${ship % 5})` : "";
      return make("span", { class: "value", style }, isOfMany ? `${ships[ship].name} ` : "", output);
    });
    if (curves.length === 1) return make("div", { class: "curve" }, ...values);
    const box = make("input", { type: "checkbox", ...(plot.isFirst && { id: `curve-${curve.kind}` }) });
    box.checked = plot.isShown(curve);
    box.addEventListener("change", () => {
      plot.hidden[box.checked ? "delete" : "add"](curve.kind);
      onChange();
    });
    return make("label", { class: "curve" }, box, lineOf(curve), make("span", {}, curve.label), ...values);
  });
  host.replaceChildren(...rows);
  return (time) => {
    for (const { curve, ship, output } of outputs) {
      const at = plot.valueAt(ship, curve, time);
      output.textContent = at ? valueWords(at.value, curve.base, true) : "\u2013";
      output.dataset.value = at ? String(at.value) : "";
      output.dataset.time = at ? String(at.time) : "";
    }
  };
}

// Text above the plot about rows that are beyond its scale.

/** Counts the visible rows of loads, or columns of stacked areas, that are beyond the scale, and describes the largest
 * of each curve. Returns null if there are none. */
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

/** Says for stacked areas over which time each column is the mean, if a column has more than one row. */
function meanWords(plot) {
  const size = plot.shownQuantity().isStack ? rowsInColumn(plot) : 1;
  return size > 1 ? `drawn as means over ${shortNumber(size * plot.run.info.forces_interval_s)} s` : "";
}

/** Shows these texts above the plot; where it is narrow, the style sheet shows the short one. */
function showOffScale(plot) {
  plot.off = countOffScale(plot);
  const means = meanWords(plot);
  plot.offScale.hidden = plot.off === null && means === "";
  const words = (off) => [means, off].filter(Boolean).join("; ");
  plot.offScale.replaceChildren(
    make("span", { class: "long" }, words(plot.off && `off the scale: ${plot.off.words.join("; ")}`)),
    make("span", { class: "short" }, words(plot.off && `${plot.off.count} values off the scale`)));
}

// The chart in the form that uPlot expects: axes, curves and rows.

const axisSize = 46; // width of an axis of values [px]

function chartAxis({ colours }, scale, label, extra) {
  const font = "11px system-ui, sans-serif";
  return { scale, stroke: colours.muted, grid: { stroke: colours.line, width: 1 },
    ticks: { stroke: colours.line, width: 1, size: 4 },
    font, labelFont: font, label, labelSize: 16, gap: 3, ...extra };
}

/** Axis of a scale on a side of the chart: 3 is left, 1 is right. The scale "paper" is that of j/τ_c
 * (docs/glossary.md), which is much larger than the loads. */
function valueAxis(plot, scale, side) {
  const base = plot.shownCurves().find((curve) => curve.scale === scale)?.base ?? "";
  const unit = (chart) =>
    unitFor(Math.max(-chart.scales[scale].min, chart.scales[scale].max), base);
  const name = scale === "paper" ? "j/\u03c4c " : "";
  return chartAxis(plot, scale, (chart) => (unit(chart).name ? `${name}[${unit(chart).name}]` : ""), {
    side, size: axisSize, grid: { show: side === 3, stroke: plot.colours.line, width: 1 },
    values: (chart, splits) => splits.map((v) => minus(String(Number((v * unit(chart).factor).toPrecision(6))))),
  });
}

/** Curves in the order of drawing. The first curve is drawn last, over the others. */
const drawnCurves = (plot) => plot.shownCurves().reverse();

/** Series of uPlot. drawStack draws stacked areas instead. */
function chartSeries(plot, curves) {
  const paths = plot.shownQuantity().isStack ? { paths: () => null } : {};
  return plot.ships().flatMap((ship) => curves.map((curve) =>
    ({ scale: curve.scale, points: { show: false }, ...paths, ...curveStyle(curve, ship, plot.run.forces.length,
      plot.colours) })));
}

function chartOptions(plot) {
  const curves = drawnCurves(plot);
  // A chart that has been replaced calls this once more.
  const rangeOf = (scale) => () => plot.axisRanges()[scale] ?? [0, 1];
  const isPaper = plot.scales().includes("paper");
  const isPlain = plot.scales().includes("y");
  const placed = (chart) => plot.on.onPlaced(chart.over.offsetLeft, chart.over.offsetWidth);
  return {
    width: plot.host.clientWidth, height: plot.host.clientHeight,
    // [px]: top, right, bottom, left. Loads have room on top for the text about the scale. The ends of the time axes of
    // plots one below the other are aligned.
    padding: [plot.isOfLoads() ? 18 : 6, isPaper ? 0 : plot.on.hasPaperAxis() ? axisSize : 24, 0,
      isPlain ? 0 : axisSize],
    legend: { show: false }, cursor: { show: false },
    hooks: { ready: [placed], setSize: [placed],
      drawAxes: plot.shownQuantity().isStack ? [(chart) => drawStack(plot, chart)] : [] },
    scales: { x: { time: false, range: () => plot.span },
      ...Object.fromEntries(plot.scales().map((name) => [name, { range: rangeOf(name) }])) },
    axes: [chartAxis(plot, "x", undefined, { size: plot.isFirst ? 22 : 4, values: (_, splits) =>
      splits.map((t) => (plot.isFirst ? `${Number(t.toFixed(6))} s` : "")) }),
      ...(isPlain ? [valueAxis(plot, "y", 3)] : []), ...(isPaper ? [valueAxis(plot, "paper", 1)] : [])],
    series: [{}, ...chartSeries(plot, curves)],
  };
}

/** Curves of the selected ships over a common axis of times. */
function chartRows(plot) {
  const curves = drawnCurves(plot);
  const tables = plot.ships().map((ship) => plot.run.forces[ship]).map((rows) =>
    [rows.force_t_s, ...curves.map((curve) => rows[curve.column])]);
  if (tables.every(([times]) => times.length === 0)) return [[], ...tables.flatMap(() => curves.map(() => []))];
  return tables.length === 1
    ? tables[0] : uPlot.join(tables.map((columns) => columns.map((column) => Array.from(column))));
}

// Pointers on the plot. Dragging moves to a time, the wheel and two fingers zoom, Shift with dragging selects a part of
// the run, and a double click shows the whole run.

/** Moves and zooms the plot so that the times under two fingers stay under them. Fingers closer than 8 px count as 8 px
 * apart, so that the plot does not jump. */
function pinchPlot(plot, after, before) {
  const times = before.map(([px]) => plot.timeAt(px));
  const [a, b] = after.map(([px]) => px);
  const perPixel = Math.abs(times[1] - times[0]) / Math.max(8, Math.abs(b - a));
  const middle = (times[0] + times[1]) / 2 - ((a + b) / 2) * perPixel;
  plot.show(middle, middle + plot.chart.over.clientWidth * perPixel);
}

/** Scrolls the plot if the wheel is turned sideways or with Shift; otherwise zooms it about the pointer. */
function scrollOrZoomPlot(plot, range, event) {
  const length = plot.span[1] - plot.span[0];
  if (Math.abs(event.deltaX) > Math.abs(event.deltaY) || event.shiftKey) {
    // Some browsers give the turn of the wheel in lines, here of 33 px.
    const turned = (event.deltaX || event.deltaY) * (event.deltaMode === 1 ? 33 : 1);
    const way = (turned * length) / plot.chart.over.clientWidth;
    const move = Math.min(range[1] - plot.span[1], Math.max(range[0] - plot.span[0], way));
    if (plot.isZoomed()) event.preventDefault();
    plot.show(plot.span[0] + move, plot.span[1] + move);
    return;
  }
  if (event.deltaY > 0 && !plot.isZoomed()) return; // let the page scroll on
  event.preventDefault();
  const at = plot.timeAt(pointIn(plot.chart.over, event)[0]);
  const factor = Math.exp(wheelTurn(event));
  plot.show(at - factor * (at - plot.span[0]), at + factor * (plot.span[1] - at));
}

/** Connects the pointers to the plot. A part of the run narrower than 5 px is taken for a slip and not selected. */
function watchPlot(plot, range, { onTime, onPoint }) {
  const { over } = plot.chart;
  const chosen = make("div", { class: "chosen-span", hidden: "" }); // marks the part that is being selected
  const choose = (from, to) => {
    chosen.hidden = false;
    chosen.style.left = `${Math.min(from, to)}px`;
    chosen.style.width = `${Math.abs(from - to)}px`;
  };
  let from = null; // left end of that part [px]; null: none is being selected
  over.append(chosen);
  watchPointers(over, {
    start(event, [px], count) {
      if (event.shiftKey) from = px;
      else if (count === 1) onTime(plot.timeAt(px));
    },
    hover: (event, [px]) => onPoint(px),
    drag: ([px]) => (from === null ? onTime(plot.timeAt(px)) : choose(from, px)),
    pinch: (after, before) => pinchPlot(plot, after, before),
    end({ type, pointerType }, [px]) {
      if (pointerType === "touch") onPoint(null);
      const ends = [from ?? px, px].sort((a, b) => a - b).map(plot.timeAt);
      if (from !== null && type === "pointerup" && chosen.clientWidth > 4) plot.show(...ends);
      from = null;
      chosen.hidden = true;
    },
  });
  over.addEventListener("pointerleave", () => onPoint(null));
  over.addEventListener("dblclick", () => plot.show(...range));
  over.addEventListener("wheel", (event) => scrollOrZoomPlot(plot, range, event), { passive: false });
}

// The plot of loads over time, synchronous with the picture. uPlot draws it; the present time is a line over it.

const shortestSpan = 20; // least number of rows of forces.csv in view; it limits zooming

/** `on` has callbacks: `onTime` receives the requested time, `onPoint` the position of the pointer [px] (null:
 * outside), `onPlaced` the left end and the width of the time axis [px], to which the timeline is aligned, `onSpan` the
 * visible part of the run [s]. `hasPaperAxis` returns true if any of the plots has that axis on its right. A plot
 * without `quantity` is the first of the plots one below the other. */
class Plot {
  constructor(run, host, range, on, quantity) {
    Object.assign(this, { run, host, range, on });
    this.quantities = { ...plotQuantities(run), ...stackedQuantities(run) };
    this.quantity = quantity ?? Object.keys(this.quantities)[0];
    this.isFirst = quantity === undefined; // the first of the plots, which has the ids and the labels of the time axis
    this.hidden = new Set(run.info.splits_by_j_over_tau_c ? [] : ["paper"]); // kinds of curves that are hidden
    this.span = range; // visible part of the run [s]
    this.isFull = false; // true: the scale shows the largest value; false: without spikes
    this.off = null; // rows beyond the scale
    this.chart = null;
    this.widened = (ranges) => ranges; // extends the ranges of axes, so that two plots get the same scale
    this.colours = {};
    this.now = make("div", { class: "now-line" });
    const id = (name) => (this.isFirst ? { id: name } : {});
    this.offScale = make("div", { class: "off-scale", ...id("off-scale") });
    const words = make("div", { class: "reading-words" });
    this.pointed = make("div", { class: "reading", ...id("reading"), hidden: "" }, words);
    this.timeAt = (px) => {
      const share = Math.min(1, Math.max(0, px / this.chart.over.clientWidth));
      return this.span[0] + share * (this.span[1] - this.span[0]);
    };
  }

  shownQuantity() {
    return this.quantities[this.quantity];
  }

  curves() {
    return this.shownQuantity().curves;
  }

  /** Indices of the ships whose curves are shown. */
  ships() {
    const { ship } = this.shownQuantity();
    return ship === undefined ? [...this.run.forces.keys()] : [ship];
  }

  isShown(curve) {
    return this.curves().length === 1 || !this.hidden.has(curve.kind);
  }

  shownCurves() {
    return this.curves().filter((curve) => this.isShown(curve));
  }

  scales() {
    return [...new Set(this.shownCurves().map((curve) => curve.scale))];
  }

  isZoomed() {
    return this.span !== this.range;
  }

  /** Index of a ship's last row at or before the visible part, from which a line leads into it, and one past the last
   * visible row. */
  rowsInView(ship) {
    const times = this.run.forces[ship].force_t_s;
    return [Math.max(0, lastAtMost(times, this.span[0])), lastAtMost(times, this.span[1]) + 1];
  }

  /** Visible times and values of each curve and ship; for stacked areas their upper and lower limits. */
  inView() {
    if (this.shownQuantity().isStack) {
      const { high, low, line, ends } = stackOf(this);
      const [up, down] = this.shownQuantity().sums;
      return [[up, high], [down, low], ...(line ? [[this.curves().at(-1), line]] : [])].map(([curve, values]) =>
        ({ curve, ship: this.ships()[0], times: ends, values }));
    }
    return this.shownCurves().flatMap((curve) => this.ships().map((ship) => {
      const [rows, part] = [this.run.forces[ship], this.rowsInView(ship)];
      return { curve, ship, times: rows.force_t_s.subarray(...part), values: rows[curve.column].subarray(...part) };
    }));
  }

  isOfLoads() {
    return this.shownCurves().every(isLoad);
  }

  /** Ranges of the axes that this plot needs, by scale. */
  neededRanges() {
    const all = this.inView();
    const columnsOf = (scale) => all.filter(({ curve }) => curve.scale === scale).map(({ values }) => values);
    const rangeOf = (columns) => (this.isOfLoads() ? loadRange(columns, this.isFull) : wholeRange(columns));
    return Object.fromEntries(this.scales().map((name) => [name, rangeOf(columnsOf(name))]));
  }

  /** Ranges of the axes, by scale, for the visible values. Those of loads have 0 at the same height; other quantities
   * get a margin of 10 %. */
  axisRanges() {
    const needed = this.widened(this.neededRanges());
    const names = Object.keys(needed);
    const ranges = this.isOfLoads() ? alignedRanges(names.map((name) => needed[name])) : names.map((name) =>
      uPlot.rangeNum(...needed[name], 0.1, true));
    return Object.fromEntries(names.map((name, k) => [name, ranges[k]]));
  }

  /** Value of a ship's curve at a time, with the end of the row's interval. */
  valueAt(ship, curve, time) {
    const rows = this.run.forces[ship];
    const row = rowAt(rows, time);
    return row === null ? null : { time: rows.force_t_s[row], value: rows[curve.column][row] };
  }

  build(colours = this.colours) {
    this.colours = colours;
    this.chart?.destroy();
    this.chart = new uPlot(chartOptions(this), chartRows(this), this.host);
    this.chart.over.append(this.now, this.offScale, this.pointed);
    showOffScale(this);
    watchPlot(this, this.range, this.on);
    this.setTime(this.time ?? this.range[0]);
  }

  resize() {
    const [width, height] = [this.host.clientWidth, this.host.clientHeight];
    if (this.chart && width > 0
      && (this.chart.width !== width || this.chart.height !== height)) this.chart.setSize({ width, height });
  }

  /** Shows a part of the run, with at least some of its rows and at most all. */
  show(from, until) {
    if (!this.chart) return;
    const { range } = this;
    const length = Math.min(range[1] - range[0], Math.max(until - from,
      shortestSpan * this.run.info.forces_interval_s));
    const start = Math.min(range[1] - length, Math.max(range[0], (from + until - length) / 2));
    this.span = length >= range[1] - range[0] ? range : [start, start + length];
    this.chart.setScale("x", { min: this.span[0], max: this.span[1] });
    showOffScale(this);
    this.on.onSpan(this.span);
    this.placeNow();
  }

  setFull(isFull) {
    this.isFull = isFull;
    this.show(...this.span);
  }

  placeNow() {
    const [from, until] = this.span;
    this.now.hidden = this.time < from || this.time > until;
    const width = this.chart.bbox.width / uPlot.pxRatio;
    this.now.style.transform = `translateX(${((this.time - from) / (until - from || 1)) * width}px)`;
  }

  /** Sets the present time. If it leaves the visible part, that part moves so that the time is at its first tenth. */
  setTime(time) {
    const hasMoved = this.time !== undefined && time !== this.time;
    this.time = time;
    if (!this.chart) return;
    const [from, until] = this.span;
    const length = until - from;
    if (hasMoved && (time < from || time > until)) this.show(time - 0.1 * length, time + 0.9 * length);
    this.placeNow();
  }
}
