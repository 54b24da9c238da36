// Plots that grow with the run: one quantity at a time, a curve a hull and column.

/** The quantities of a run: titles with their columns. */
function liveQuantities(columns) {
  const quantities = new Map();
  for (const column of columns) {
    if (!column.plot) continue;
    if (!quantities.has(column.plot)) quantities.set(column.plot, []);
    quantities.get(column.plot).push(column);
  }
  return quantities;
}

const plotHeight = 150; // [px]

function makeLivePlot(element, select, colours) {
  let chart = null;
  let shown = null; // {run, curves, rows}

  /** The rows of all curves against the times of the first hull, in a unit that suits them. */
  function data() {
    const { run, curves } = shown;
    const times = run.forces.of[0]?.sample_s ?? [];
    return [times, ...curves.map(({ hull, name }) => run.forces.of[hull][name])];
  }

  function build() {
    chart?.destroy();
    chart = null;
    if (!shown || shown.curves.length === 0) return;
    const axis = { stroke: colours().muted, grid: { stroke: colours().line, width: 1 }, ticks: { show: false } };
    const { unit } = shown.curves[0];
    chart = new uPlot({
      width: Math.max(100, element.clientWidth), height: plotHeight, cursor: { y: false }, legend: { show: false },
      scales: { x: { time: false } },
      axes: [{ ...axis, values: (_, values) => values.map((value) => `${value} s`) },
        { ...axis, size: 76, values: (_, values) => values.map((value) => valueWords(value, unit)) }],
      series: [{}, ...shown.curves.map(({ hull, label, isMean }) => ({ label, stroke: shipColour(colours(), hull),
        width: isMean ? 1.5 : 1, dash: isMean ? [] : [4, 3], points: { show: false } }))],
    }, data(), element);
  }

  function choose() {
    const { run } = shown;
    const columns = liveQuantities(run.info.force_columns).get(select.value) ?? [];
    const several = run.info.ships.length > 1;
    shown.curves = run.info.ships.flatMap(({ name: ship }, hull) => columns.map(({ name, unit, curve }) =>
      ({ hull, name, unit, isMean: curve === "mean", label: several ? `${ship}: ${curve}` : curve })));
    build();
  }

  select.addEventListener("change", () => shown && choose());
  new ResizeObserver(() => chart?.setSize({ width: Math.max(100, element.clientWidth), height: plotHeight }))
    .observe(element);
  return {
    show(run) {
      shown = { run, curves: [], rows: 0 };
      const quantities = [...liveQuantities(run.info.force_columns).keys()];
      const before = select.value;
      select.replaceChildren(...quantities.map((title) => make("option", {}, title)));
      if (quantities.includes(before)) select.value = before;
      element.closest("section").hidden = run.info.ships.length === 0;
      choose();
    },
    /** Draws rows that have come since the last call. */
    grow() {
      const rows = shown?.run.forces.of[0]?.sample_s.length ?? 0;
      if (!chart || rows === shown.rows) return;
      shown.rows = rows;
      chart.setData(data());
    },
    rows: () => shown?.rows ?? 0,
    refresh: () => shown && build(),
  };
}
