// Plots that grow with the run. They show one quantity at a time, with a curve for each hull and column.

/** Quantities of a run: titles with their columns. */
function liveQuantities(columns) {
  const quantities = new Map();
  for (const column of columns) {
    if (!column.plot) continue;
    if (!quantities.has(column.plot)) quantities.set(column.plot, []);
    quantities.get(column.plot).push(column);
  }
  return quantities;
}

const plotHeight = 150; // height of the plot [px]

/** Options of a chart with the curves {hull, name, unit, isMean, label}. */
function chartOptions(curves, width, colours) {
  const axis = { stroke: colours.muted, grid: { stroke: colours.line, width: 1 }, ticks: { show: false } };
  const { unit } = curves[0];
  return {
    width, height: plotHeight, cursor: { y: false }, legend: { show: false }, scales: { x: { time: false } },
    axes: [{ ...axis, values: (_, values) => values.map((value) => `${value} s`) },
      { ...axis, size: 76, values: (_, values) => values.map((value) => valueWords(value, unit)) }],
    series: [{}, ...curves.map(({ hull, label, isMean }) => ({ label, stroke: shipColour(colours, hull),
      width: isMean ? 1.5 : 1, dash: isMean ? [] : [4, 3], points: { show: false } }))],
  };
}

/** Curves of a quantity, one for each hull and column. */
function curvesOf({ info: { ships, force_columns: columns } }, quantity) {
  const several = ships.length > 1;
  return ships.flatMap(({ name: ship }, hull) => (liveQuantities(columns).get(quantity) ?? []).map(({ name, unit,
    curve }) => ({ hull, name, unit, isMean: curve === "mean", label: several ? `${ship}: ${curve}` : curve })));
}

function makeLivePlot(element, select, colours) {
  let chart = null;
  let shown = null; // {run, curves, rows}
  const width = () => Math.max(100, element.clientWidth);
  const data = () => [shown.run.forces.of[0]?.sample_s ?? [],
    ...shown.curves.map(({ hull, name }) => shown.run.forces.of[hull][name])];

  function build() {
    chart?.destroy();
    chart = null;
    if (!shown) return;
    shown.curves = curvesOf(shown.run, select.value);
    if (shown.curves.length > 0) chart = new uPlot(chartOptions(shown.curves, width(), colours()), data(), element);
  }

  select.addEventListener("change", build);
  new ResizeObserver(() => chart?.setSize({ width: width(), height: plotHeight })).observe(element);
  return {
    show(run) {
      shown = { run, curves: [], rows: 0 };
      const quantities = [...liveQuantities(run.info.force_columns).keys()];
      const before = select.value;
      select.replaceChildren(...quantities.map((title) => make("option", {}, title)));
      if (quantities.includes(before)) select.value = before;
      element.closest("section").hidden = run.info.ships.length === 0;
      build();
    },
    /** Draws the rows that were added since the last call. */
    grow() {
      const rows = shown?.run.forces.of[0]?.sample_s.length ?? 0;
      if (!chart || rows === shown.rows) return;
      shown.rows = rows;
      chart.setData(data());
    },
    rows: () => shown?.rows ?? 0,
    refresh: build,
  };
}
