// The plot of loads against time, in step with the picture. Drawn by uPlot; the present time is a line laid over it.

const shortestSpan = 20; // rows of forces.csv; the plot zooms no closer

/** `onTime` is called with the requested time, `onPlaced` with the left end and the width of the axis of times [px],
 * `onSpan` with the part of the run that is in view [s]. */
function makePlot(run, host, range, { onTime, onPlaced, onSpan }) {
  const { forces, info } = run;
  const quantities = plotQuantities(run);
  const plot = { quantities, quantity: Object.keys(quantities)[0], chart: null, span: range, isFull: false, off: null,
    hidden: new Set(info.splits_by_j_over_tau_c ? [] : ["paper"]) };
  const now = make("div", { class: "now-line" });
  const offScale = make("div", { class: "off-scale", id: "off-scale" });
  const reading = makePlotReading(run, plot);
  let colours = {};

  plot.curves = () => quantities[plot.quantity].curves;
  plot.isShown = (curve) => plot.curves().length === 1 || !plot.hidden.has(curve.kind);
  plot.shownCurves = () => plot.curves().filter(plot.isShown);
  const scales = () => [...new Set(plot.shownCurves().map((curve) => curve.scale))];

  /** A column's rows in view, of one ship. */
  function inView(ship, column) {
    const times = forces[ship].force_t_s;
    const first = Math.max(0, lastAtMost(times, plot.span[0]));
    return forces[ship][column].subarray(first, lastAtMost(times, plot.span[1]) + 1);
  }
  const columnsOf = (scale) => plot.shownCurves().filter((curve) => curve.scale === scale)
    .flatMap((curve) => forces.map((_, ship) => inView(ship, curve.column)));

  /** The ranges of the axes of loads, by scale, for what is in view. */
  function loadRanges() {
    const names = scales();
    const ranges = alignedRanges(names.map((name) => loadRange(columnsOf(name), plot.isFull)));
    return Object.fromEntries(names.map((name, k) => [name, ranges[k]]));
  }

  /** Counts the rows in view that lie off the scale, and names the largest of each curve. */
  function countOffScale() {
    plot.off = null;
    const ranges = loadRanges();
    for (const curve of plot.shownCurves().filter(isLoad)) {
      for (let ship = 0; ship < forces.length; ++ship) {
        const times = forces[ship].force_t_s;
        const off = rowsOffScale(times.subarray(Math.max(0, lastAtMost(times, plot.span[0]))), inView(ship, curve.column), ranges[curve.scale]);
        if (off.count === 0) continue;
        plot.off ??= { count: 0, words: [] };
        plot.off.count += off.count;
        plot.off.words.push(`${curve.label} to ${valueWords(off.largest, curve.base)} at ${Number(off.time.toFixed(3))} s`);
      }
    }
    offScale.hidden = plot.off === null;
    if (plot.off) offScale.replaceChildren(make("span", { class: "long" }, `\u25b2 off the scale: ${plot.off.words.join("; ")}`),
      make("span", { class: "short" }, `\u25b2 ${plot.off.count} values off the scale`));
  }

  /** A mark at the edge for rows off the scale, one for each few pixels. */
  function drawOffScale(chart) {
    if (!plot.off) return;
    const { ctx, bbox } = chart;
    const size = 4 * devicePixelRatio;
    plot.shownCurves().forEach((curve, c) => forces.forEach((rows, ship) => {
      const { min, max } = chart.scales[curve.scale];
      ctx.fillStyle = curveStyle(curve, ship, forces.length, colours).stroke.slice(0, 7);
      const marked = new Set();
      const first = Math.max(0, lastAtMost(rows.force_t_s, plot.span[0]));
      inView(ship, curve.column).forEach((value, k) => {
        if (value >= min && value <= max) return;
        const side = value > max ? 1 : -1;
        const x = chart.valToPos(rows.force_t_s[first + k], "x", true);
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
    }));
  }

  /** Curves of all ships over one axis of times, in the form uPlot takes. */
  function table(curves) {
    const tables = forces.map((rows) => [rows.force_t_s, ...curves.map((curve) => rows[curve.column])]);
    if (tables.every(([times]) => times.length === 0)) return [[], ...forces.flatMap(() => curves.map(() => []))];
    return tables.length === 1 ? tables[0] : uPlot.join(tables.map((columns) => columns.map((column) => Array.from(column))));
  }

  function axis(scale, label, extra) {
    const font = "11px system-ui, sans-serif";
    return { scale, stroke: colours.muted, grid: { stroke: colours.line, width: 1 }, ticks: { stroke: colours.line, width: 1, size: 4 },
      font, labelFont: font, label, labelSize: 16, gap: 3, ...extra };
  }

  function valueAxis(scale, side) {
    const base = plot.shownCurves().find((curve) => curve.scale === scale)?.base ?? "";
    const unit = (chart) => (base.startsWith("N") ? loadUnit(Math.max(-chart.scales[scale].min, chart.scales[scale].max), base)
      : { factor: 1, name: base });
    const name = scale === "paper" ? "j/\u03c4c " : "";
    return axis(scale, (chart) => (unit(chart).name ? `${name}[${unit(chart).name}]` : ""), { side, size: 46, grid: { show: side === 3, stroke: colours.line, width: 1 },
      values: (chart, splits) => splits.map((v) => minus(String(Number((v * unit(chart).factor).toPrecision(6))))) });
  }

  plot.build = (themeColours = colours) => {
    colours = themeColours;
    plot.chart?.destroy();
    const curves = plot.shownCurves().reverse(); // the first is drawn last, over the others
    const ofLoads = curves.every(isLoad);
    const rangeOf = (scale) => (chart, low, high) => (ofLoads ? loadRanges()[scale] : uPlot.rangeNum(low ?? 0, high ?? 1, 0.1, true));
    const isPaper = scales().includes("paper");
    const isPlain = scales().includes("y");
    const placed = (chart) => onPlaced(chart.over.offsetLeft, chart.over.offsetWidth);
    plot.chart = new uPlot({
      width: host.clientWidth, height: host.clientHeight, padding: [ofLoads ? 18 : 6, isPaper ? 0 : 24, 0, isPlain ? 0 : 24],
      legend: { show: false }, cursor: { show: false },
      hooks: { ready: [placed], setSize: [placed], draw: [drawOffScale] },
      scales: { x: { time: false, range: () => plot.span }, ...Object.fromEntries(scales().map((name) => [name, { range: rangeOf(name) }])) },
      axes: [axis("x", undefined, { size: 22, values: (_, splits) => splits.map((t) => `${Number(t.toFixed(6))} s`) }),
        ...(isPlain ? [valueAxis("y", 3)] : []), ...(isPaper ? [valueAxis("paper", 1)] : [])],
      series: [{}, ...forces.flatMap((_, ship) => curves.map((curve) =>
        ({ scale: curve.scale, points: { show: false }, ...curveStyle(curve, ship, forces.length, colours) })))],
    }, table(curves), host);
    plot.chart.over.append(now, offScale, reading.element);
    countOffScale();
    watchPlot(plot, range, onTime, reading);
    plot.setTime(plot.time ?? range[0]);
  };

  plot.resize = () => {
    const [width, height] = [host.clientWidth, host.clientHeight];
    if (plot.chart && width > 0 && (plot.chart.width !== width || plot.chart.height !== height)) plot.chart.setSize({ width, height });
  };

  /** Shows a part of the run, at least some rows of it, at most all. */
  plot.show = (from, until) => {
    if (!plot.chart) return;
    const length = Math.min(range[1] - range[0], Math.max(until - from, shortestSpan * info.forces_interval_s));
    const start = Math.min(range[1] - length, Math.max(range[0], (from + until - length) / 2));
    plot.span = length >= range[1] - range[0] ? range : [start, start + length];
    plot.chart.setScale("x", { min: plot.span[0], max: plot.span[1] });
    countOffScale();
    onSpan(plot.span);
    placeNow();
  };
  plot.isZoomed = () => plot.span !== range;

  plot.setFull = (isFull) => {
    plot.isFull = isFull;
    plot.show(...plot.span);
  };

  function placeNow() {
    const isIn = plot.time >= plot.span[0] && plot.time <= plot.span[1];
    now.hidden = !isIn;
    const width = plot.chart.bbox.width / uPlot.pxRatio;
    now.style.transform = `translateX(${((plot.time - plot.span[0]) / (plot.span[1] - plot.span[0] || 1)) * width}px)`;
  }

  /** Sets the present time; what is in view follows it. */
  plot.setTime = (time) => {
    const hasMoved = plot.time !== undefined && time !== plot.time;
    plot.time = time;
    if (!plot.chart) return;
    const length = plot.span[1] - plot.span[0];
    if (hasMoved && (time < plot.span[0] || time > plot.span[1])) plot.show(time - 0.1 * length, time + 0.9 * length);
    placeNow();
  };

  /** What a ship's curve is at a time, with the end of the row's interval. */
  plot.valueAt = (ship, curve, time) => {
    const row = rowAt(forces[ship], time);
    return row === null ? null : { time: forces[ship].force_t_s[row], value: forces[ship][curve.column][row] };
  };
  return plot;
}
