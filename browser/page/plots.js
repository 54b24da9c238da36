// The plot that grows with the run: the player's plot (views/player/plot.js) over the part of the run that there is.

const shortestRun = 20; // least number of rows of loads over which the time axis reaches

function makeLivePlot(host, select, colours) {
  let plot = null;
  let run = null;
  let rows = 0;
  let showLoads = () => {};
  const none = () => {};
  const on = { onTime: none, onPoint: none, onPlaced: none, onSpan: none,
    hasPaperAxis: () => plot.scales().includes("paper") };

  function build() {
    if (!plot || plot.ships().length === 0) return;
    plot.build(colours());
    plot.now.remove(); // the present is the plot's right end
    showLoads = fillPlotKey(run, plot, byId("load-now"), build);
    showLoads(run.time);
  }

  select.addEventListener("change", () => {
    plot.quantity = select.value;
    build();
  });
  new ResizeObserver(() => plot?.resize()).observe(host);
  return {
    show(shown) {
      const before = plot?.quantity;
      plot?.chart?.destroy();
      [run, rows] = [shown, 0];
      plot = new Plot(run, host, [0, shortestRun * run.info.forces_interval_s], on);
      if (plot.quantities[before]) plot.quantity = before;
      select.replaceChildren(...Object.entries(plot.quantities).map(([value, { label }]) =>
        make("option", { value }, label)));
      select.value = plot.quantity;
      host.closest("section").hidden = run.info.ships.length === 0;
      build();
    },
    /** Draws the rows that were added since the last call. */
    grow() {
      const count = run?.forces[0]?.force_t_s.length ?? 0;
      if (!plot?.chart || count === rows) return;
      rows = count;
      plot.range[1] = Math.max(plot.range[1], run.forces[0].force_t_s[rows - 1]);
      plot.chart.setData(chartRows(plot));
      showOffScale(plot);
      showLoads(run.time);
    },
    rows: () => rows,
    refresh: build,
  };
}
