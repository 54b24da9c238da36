// The plot with its controls and its key, and the timeline that follows its width.

function makePlotPanel(player) {
  const { run, axis, state } = player;
  const hasShips = run.info.ships.length > 0;
  const panel = { showLoads: () => {} };
  const plot = new Plot(run, byId("plot"), axis, {
    onTime: (time) => player.actions.goTo(time),
    onPlaced: (left, width) => player.timeline.place(left, width, player.colours),
    onSpan: (span) => {
      player.timeline.setPart(span);
      panel.showTools();
    },
  });
  const placeTimeline = () => player.timeline.place(8, byId("track-row").clientWidth - 16, player.colours);

  panel.plot = plot;
  panel.showTools = () => {
    byId("full-scale").setAttribute("aria-pressed", String(plot.isFull));
    byId("full-scale").disabled = !plot.isFull && plot.off === null;
    byId("whole-run").disabled = !plot.isZoomed();
  };
  panel.rebuild = () => {
    plot.build(player.colours);
    panel.showLoads = fillPlotKey(run, plot, byId("load-now"), () => {
      plot.build();
      panel.showTools();
    });
    panel.showLoads(state.time);
    panel.showTools();
  };
  /** Takes the theme's colours. */
  panel.refresh = () => (hasShips ? panel.rebuild() : placeTimeline());
  panel.resize = () => (hasShips ? plot.resize() : placeTimeline());
  panel.setTime = (time) => {
    plot.setTime(time);
    panel.showLoads(time);
  };
  return panel;
}
