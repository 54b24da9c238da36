// The plot's chart, as uPlot takes it: its axes, its curves and their rows.

function chartAxis({ colours }, scale, label, extra) {
  const font = "11px system-ui, sans-serif";
  return { scale, stroke: colours.muted, grid: { stroke: colours.line, width: 1 }, ticks: { stroke: colours.line, width: 1, size: 4 },
    font, labelFont: font, label, labelSize: 16, gap: 3, ...extra };
}

function valueAxis(plot, scale, side) {
  const base = plot.shownCurves().find((curve) => curve.scale === scale)?.base ?? "";
  const unit = (chart) => (base.startsWith("N") ? loadUnit(Math.max(-chart.scales[scale].min, chart.scales[scale].max), base)
    : { factor: 1, name: base });
  const name = scale === "paper" ? "j/\u03c4c " : "";
  return chartAxis(plot, scale, (chart) => (unit(chart).name ? `${name}[${unit(chart).name}]` : ""), {
    side, size: 46, grid: { show: side === 3, stroke: plot.colours.line, width: 1 },
    values: (chart, splits) => splits.map((v) => minus(String(Number((v * unit(chart).factor).toPrecision(6))))),
  });
}

/** The curves in the order of drawing: the first is drawn last, over the others. */
const drawnCurves = (plot) => plot.shownCurves().reverse();

/** The series of uPlot. Stacked areas are drawn by drawStack. */
function chartSeries(plot, curves) {
  const paths = plot.shownQuantity().isStack ? { paths: () => null } : {};
  return plot.ships().flatMap((ship) => curves.map((curve) =>
    ({ scale: curve.scale, points: { show: false }, ...paths, ...curveStyle(curve, ship, plot.run.forces.length, plot.colours) })));
}

function chartOptions(plot) {
  const curves = drawnCurves(plot);
  const ofLoads = plot.isOfLoads();
  const rangeOf = (scale) => () => plot.axisRanges()[scale] ?? [0, 1]; // a chart that was replaced asks once more
  const isPaper = plot.scales().includes("paper");
  const isPlain = plot.scales().includes("y");
  const placed = (chart) => plot.onPlaced(chart.over.offsetLeft, chart.over.offsetWidth);
  return {
    width: plot.host.clientWidth, height: plot.host.clientHeight, padding: [ofLoads ? 18 : 6, isPaper ? 0 : 24, 0, isPlain ? 0 : 24],
    legend: { show: false }, cursor: { show: false },
    hooks: { ready: [placed], setSize: [placed], draw: [(chart) => drawOffScale(plot, chart)],
      drawAxes: plot.shownQuantity().isStack ? [(chart) => drawStack(plot, chart)] : [] },
    scales: { x: { time: false, range: () => plot.span }, ...Object.fromEntries(plot.scales().map((name) => [name, { range: rangeOf(name) }])) },
    axes: [chartAxis(plot, "x", undefined, { size: 22, values: (_, splits) => splits.map((t) => `${Number(t.toFixed(6))} s`) }),
      ...(isPlain ? [valueAxis(plot, "y", 3)] : []), ...(isPaper ? [valueAxis(plot, "paper", 1)] : [])],
    series: [{}, ...chartSeries(plot, curves)],
  };
}

/** The curves of the ships that are shown over one axis of times. */
function chartRows(plot) {
  const curves = drawnCurves(plot);
  const tables = plot.ships().map((ship) => plot.run.forces[ship]).map((rows) => [rows.force_t_s, ...curves.map((curve) => rows[curve.column])]);
  if (tables.every(([times]) => times.length === 0)) return [[], ...tables.flatMap(() => curves.map(() => []))];
  return tables.length === 1 ? tables[0] : uPlot.join(tables.map((columns) => columns.map((column) => Array.from(column))));
}
