// The plots with their controls and legends, one below the other, and the timeline, which has the same width. All plots
// show the same part of the run. The buttons for the full scale and for the whole run apply to all plots; each plot has
// its own quantity and its own hidden curves.

const mostPlots = 4; // largest number of plots, with the first one; more would leave each too little height

/** Makes one plot with its legend. `parts` are the list of quantities, the element of the plot and that of the legend.
 * */
function makePlotView(player, panel, { select, host, key }, quantity) {
  const { run, axis } = player;
  const view = { host, select, key, showLoads: () => {} };
  view.plot = new Plot(run, host, axis, {
    onTime: (time) => player.actions.goTo(time),
    onPoint: (px) => panel.point(px, view.plot),
    onPlaced: (left, width) => view.plot.isFirst && player.timeline.place(left, width, player.colours),
    onSpan: (span) => panel.share(span, view.plot),
    hasPaperAxis: () => panel.views.some(({ plot }) => plot.scales().includes("paper")),
  }, quantity);
  view.rebuild = () => {
    view.plot.build(player.colours);
    view.showLoads = fillPlotKey(run, view.plot, key, () => panel.redraw());
  };
  select.replaceChildren(...quantityGroups(view.plot.quantities));
  select.value = view.plot.quantity;
  return view;
}

/** Controls of the first plot, which are part of the page. */
const firstParts = () => ({ select: byId("quantity"), host: byId("plot"), key: byId("load-now") });

/** Makes the controls of a further plot. */
function furtherParts(onQuantity, onRemove) {
  const select = make("select", { "aria-label": "What this plot shows" });
  const words = "Remove this plot";
  const remove = make("button", { type: "button", "aria-label": words, title: words }, "\u00d7");
  const key = make("div", { class: "curves" });
  const host = make("div", { class: "plot", "aria-label": "Quantity against time; drag to go there" });
  select.addEventListener("change", () => onQuantity(select.value));
  remove.addEventListener("click", onRemove);
  const row = make("div", { class: "further-plot" }, make("div", { class: "plot-head" }, select, remove, key), host);
  return { select, key, host, row };
}

/** The first quantity that no plot shows. */
const nextQuantity = ({ views }) => Object.keys(views[0].plot.quantities).find((name) =>
  views.every(({ plot }) => plot.quantity !== name));

/** Enables and disables the common buttons of the plots. */
function showPlotTools(panel) {
  byId("full-scale").setAttribute("aria-pressed", String(panel.plot.isFull));
  byId("full-scale").disabled = !panel.plot.isFull && panel.views.every(({ plot }) => plot.off === null);
  byId("whole-run").disabled = !panel.plot.isZoomed();
  byId("add-plot").disabled = panel.views.length >= mostPlots || nextQuantity(panel) === undefined;
}

/** Shows the position of the pointer in one plot [px] in all plots. The plot with the pointer also shows the time at
 * which the interval of the row there ends. */
function showPointed(panel, px, pointedPlot) {
  panel.pointed = px === null ? null : pointedPlot.timeAt(px);
  for (const { plot } of panel.views) {
    const at = px === null ? null : plot.valueAt(plot.ships()[0], plot.curves()[0], panel.pointed);
    plot.pointed.hidden = at === null;
    plot.pointed.style.left = `${px}px`;
    plot.pointed.classList.toggle("to-left", px > plot.chart.over.clientWidth / 2);
    plot.pointed.firstChild.hidden = plot !== pointedPlot;
    plot.pointed.firstChild.textContent = at ? `values at ${Number(at.time.toFixed(6))} s` : "";
  }
}

/** Adds a plot of a quantity below the others. It shows the same part of the run. If its quantity is changed, the map
 * is marked for drawing, because drawing also updates the address of the page. */
function addPlotView(player, panel, quantity) {
  const parts = furtherParts((name) => {
    view.plot.quantity = name;
    panel.rebuild();
    player.state.marksDirty = true;
  }, () => player.actions.showPlots(panel.further().filter((_, k) => panel.views[k + 1] !== view)));
  byId("further-plots").append(parts.row);
  const view = Object.assign(makePlotView(player, panel, parts, quantity), { row: parts.row });
  view.plot.span = panel.plot.span;
  view.plot.isFull = panel.plot.isFull;
  panel.views.push(view);
  return view;
}

/** Makes the panel. A run without ships has no loads: its plots are hidden and never built, and the timeline is placed
 * here, with a margin of 8 px at either end, instead of by the time axis of the first plot. */
function makePlotPanel(player) {
  const { state } = player;
  const hasShips = player.run.info.ships.length > 0;
  const panel = { views: [], pointed: null };
  const plots = () => panel.views.map(({ plot }) => plot);
  const placeTimeline = () => player.timeline.place(8, byId("track-row").clientWidth - 16, player.colours);
  const sizes = new ResizeObserver(() => panel.resize());
  const finish = () => {
    panel.setTime(state.time);
    panel.showTools();
  };
  Object.assign(panel, {
    showTools: () => showPlotTools(panel),
    /** Shows the values at the pointer in the legends: those of the rows whose intervals contain the time there. */
    point(px, pointedPlot) {
      showPointed(panel, px, pointedPlot);
      panel.setTime(state.time);
    },
    /** Makes all plots show the part of the run that one of them shows. */
    share(span, from) {
      for (const plot of plots())
        if (plot !== from && plot.span.join() !== span.join()) plot.show(...span);
      player.timeline.setPart(span);
      panel.showTools();
    },
    /** Draws all plots and legends again. redraw() keeps legends, so that one in use does not change. */
    rebuild() {
      for (const view of panel.views) view.rebuild();
      finish();
    },
    redraw() {
      for (const plot of plots()) plot.build();
      finish();
    },
    ...furtherPlots(player, panel, sizes),
    /** Applies the colours of the theme. */
    refresh: () => (hasShips ? panel.rebuild() : placeTimeline()),
    resize: () => (hasShips ? plots().forEach((plot) => plot.resize()) : placeTimeline()),
    setFull: (isFull) => plots().forEach((plot) => plot.setFull(isFull)),
    setTime(time) {
      for (const { plot, showLoads } of panel.views) {
        plot.setTime(time);
        showLoads(panel.pointed ?? time);
      }
    },
  });
  panel.views.push(makePlotView(player, panel, firstParts()));
  panel.plot = panel.views[0].plot;
  return panel;
}

/** Functions for the plots below the first: their quantities in order, and showing others instead. */
const furtherPlots = (player, panel, sizes) => ({
  further: () => panel.views.slice(1).map(({ plot }) => plot.quantity),
  showFurther(quantities) {
    for (const { row } of panel.views.splice(1)) row.remove();
    for (const quantity of quantities.slice(0, mostPlots - 1))
      sizes.observe(addPlotView(player, panel, quantity).host);
    panel.rebuild();
  },
});
