// The plot of loads against time, in step with the picture. Drawn by uPlot; the present time is a line laid over it.

const shortestSpan = 20; // rows of forces.csv; the plot zooms no closer

/** `onTime` is called with the requested time, `onPlaced` with the left end and the width of the axis of times [px],
 * `onSpan` with the part of the run that is in view [s]. */
class Plot {
  constructor(run, host, range, { onTime, onPlaced, onSpan }) {
    Object.assign(this, { run, host, range, onTime, onPlaced, onSpan });
    this.quantities = { ...plotQuantities(run), ...stackedQuantities(run) };
    this.quantity = Object.keys(this.quantities)[0];
    this.hidden = new Set(run.info.splits_by_j_over_tau_c ? [] : ["paper"]); // kinds of curves
    this.span = range; // in view [s]
    this.isFull = false; // up to the largest value, else without spikes
    this.off = null; // the rows off the scale
    this.chart = null;
    this.widened = (ranges) => ranges; // so that two plots have one scale
    this.colours = {};
    this.now = make("div", { class: "now-line" });
    this.offScale = make("div", { class: "off-scale", id: "off-scale" });
    this.reading = makePlotReading(run, this);
  }

  shownQuantity() {
    return this.quantities[this.quantity];
  }

  curves() {
    return this.shownQuantity().curves;
  }

  /** The ships whose curves are shown, by index. */
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

  /** Of a ship's rows the first in view and one past the last. */
  rowsInView(ship) {
    const times = this.run.forces[ship].force_t_s;
    return [Math.max(0, lastAtMost(times, this.span[0])), lastAtMost(times, this.span[1]) + 1];
  }

  /** What is in view of each curve and ship: its times and values. Of stacked areas how high and how low they stand. */
  inView() {
    if (this.shownQuantity().isStack) {
      const { high, low, line, ends } = stackOf(this);
      const [up, down] = this.shownQuantity().sums;
      return [[up, high], [down, low], ...(line ? [[this.curves().at(-1), line]] : [])].map(([curve, values]) => ({ curve, ship: this.ships()[0], times: ends, values }));
    }
    return this.shownCurves().flatMap((curve) => this.ships().map((ship) => {
      const [rows, part] = [this.run.forces[ship], this.rowsInView(ship)];
      return { curve, ship, times: rows.force_t_s.subarray(...part), values: rows[curve.column].subarray(...part) };
    }));
  }

  isOfLoads() {
    return this.shownCurves().every(isLoad);
  }

  /** The parts of its axes that this plot needs, by scale. */
  neededRanges() {
    const all = this.inView();
    const columnsOf = (scale) => all.filter(({ curve }) => curve.scale === scale).map(({ values }) => values);
    const rangeOf = (columns) => (this.isOfLoads() ? loadRange(columns, this.isFull) : wholeRange(columns));
    return Object.fromEntries(this.scales().map((name) => [name, rangeOf(columnsOf(name))]));
  }

  /** The ranges of the axes, by scale, for what is in view. */
  axisRanges() {
    const needed = this.widened(this.neededRanges());
    const names = Object.keys(needed);
    const ranges = this.isOfLoads() ? alignedRanges(names.map((name) => needed[name])) : names.map((name) => uPlot.rangeNum(...needed[name], 0.1, true));
    return Object.fromEntries(names.map((name, k) => [name, ranges[k]]));
  }

  /** What a ship's curve is at a time, with the end of the row's interval. */
  valueAt(ship, curve, time) {
    const rows = this.run.forces[ship];
    const row = rowAt(rows, time);
    return row === null ? null : { time: rows.force_t_s[row], value: rows[curve.column][row] };
  }

  build(colours = this.colours) {
    this.colours = colours;
    this.chart?.destroy();
    this.chart = new uPlot(chartOptions(this), chartRows(this), this.host);
    this.chart.over.append(this.now, this.offScale, this.reading.element);
    showOffScale(this);
    watchPlot(this, this.range, this.onTime, this.reading);
    this.setTime(this.time ?? this.range[0]);
  }

  resize() {
    const [width, height] = [this.host.clientWidth, this.host.clientHeight];
    if (this.chart && width > 0 && (this.chart.width !== width || this.chart.height !== height)) this.chart.setSize({ width, height });
  }

  /** Shows a part of the run, at least some rows of it, at most all. */
  show(from, until) {
    if (!this.chart) return;
    const { range } = this;
    const length = Math.min(range[1] - range[0], Math.max(until - from, shortestSpan * this.run.info.forces_interval_s));
    const start = Math.min(range[1] - length, Math.max(range[0], (from + until - length) / 2));
    this.span = length >= range[1] - range[0] ? range : [start, start + length];
    this.chart.setScale("x", { min: this.span[0], max: this.span[1] });
    showOffScale(this);
    this.onSpan(this.span);
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

  /** Sets the present time; what is in view follows it. */
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
