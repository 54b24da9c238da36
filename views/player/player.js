// The player: its parts, and the picture at each tick of the screen.

function startPlayer() {
  const run = readRun();
  const { info, frames } = run;
  run.breakOf = new Map();
  info.events.forEach((event, index) => { if (event.kind !== "rejected_cut") run.breakOf.set(event.floe, index); });
  run.carry = makeCarrier(info.water);
  const hasFrames = frames.times.length > 0;
  const range = hasFrames ? [frames.times[0], frames.times[frames.times.length - 1]] : [0, 0];
  const motions = makeMotions(run);
  const places = makePlaces(run, motions);
  const stage = byId("stage");
  const canvases = [byId("ice"), byId("marks")];
  const view = makeMapView(stage, canvases);
  const isUnderWay = (carry) => hasFrames && info.ships.some((_, ship) => hasGone(run, motions, ship, carry));
  const state = {
    time: range[0], isPlaying: false, rate: defaultRate(range[1] - range[0]), selected: -1, hovered: -1, event: null,
    follow: -1, colourBy: "breakage", isFitted: true,
    layers: { channel: isUnderWay(run.carry), startIce: isUnderWay((x, y) => [x, y]), track: true, circles: false, velocities: false, forces: false, fractures: false },
    iceDirty: true, marksDirty: true,
  };
  // Includes what tests and measurements read.
  const player = {
    run, range, state, view, places, motions, box: extentOf(run, motions, places, range), colours: themeColours(),
    colourings: makeColourings(run, places), circlesOf: makeCircleSampler(run), cardIsStale: false, drawn: 0, drawTimes: [],
    stations: (ship) => stationsOf(run, places, motions, ship, state.time),
    contacts: () => contactsOfFrame(run, motions.frame()),
  };
  player.plot = makePlot(run, byId("plot"), range, {
    onTime: (time) => player.actions.goTo(time),
    onPlaced: (left, width) => timeline.place(left, width, player.colours),
    onSpan: (span) => {
      timeline.setPart(span);
      player.showPlotTools();
    },
  });
  player.actions = makeActions(player);
  const { plot, actions } = player;
  const timeline = makeTimeline(run, byId("track"), range, actions);
  const forceScale = 40 / (typicalForce(run) || 1); // [px/N]
  const arrowScale = 40 / (player.colourings.speed.edges.at(-1) || 1); // [px/(m/s)]
  player.legend = makeLegend(player, forceScale, arrowScale);
  player.showLegend = player.legend.show;
  const picture = makeMapPicture(player, canvases, forceScale, arrowScale);
  const shownFloe = makeShownFloe(player);
  let showLoads = () => {};

  player.rebuildPlot = () => {
    plot.build(player.colours);
    showLoads = fillPlotKey(run, plot, byId("load-now"), () => {
      plot.build();
      player.showPlotTools();
    });
    showLoads(state.time);
    player.showPlotTools();
  };
  player.showPlotTools = () => {
    byId("full-scale").setAttribute("aria-pressed", String(plot.isFull));
    byId("full-scale").disabled = !plot.isFull && plot.off === null;
    byId("whole-run").disabled = !plot.isZoomed();
  };
  player.refreshTheme = () => {
    player.colours = themeColours();
    if (info.ships.length > 0) player.rebuildPlot();
    else placeTimeline();
    player.showLegend();
    state.iceDirty = true;
  };
  const placeTimeline = () => timeline.place(8, byId("track-row").clientWidth - 16, player.colours);

  function resize() {
    view.resize();
    if (state.isFitted) view.fit(player.box);
    if (info.ships.length > 0) plot.resize();
    else placeTimeline();
    state.iceDirty = true;
  }

  function showNumbers() {
    const words = `${state.time.toFixed(1)} s`;
    byId("now").textContent = words;
    byId("living").textContent = String(places.count);
    byId("living-word").textContent = places.count === 1 ? "floe" : "floes";
    plot.setTime(state.time);
    timeline.setTime(state.time, `${words}, ${places.count} floes`);
    showLoads(state.time);
  }

  let last = 0;
  function frame(now) {
    if (state.isPlaying) {
      state.time += (Math.min(100, now - last) / 1000) * state.rate;
      if (state.time >= range[1]) {
        state.time = range[1];
        actions.play(false);
      }
      state.iceDirty = true;
    }
    last = now;
    const isDrawn = state.iceDirty;
    const before = performance.now();
    if (state.iceDirty) {
      places.setTime(state.time);
      const pose = state.follow >= 0 ? motions.ship(state.follow) : null;
      if (pose) [view.x, view.y] = pose;
      picture.drawIce();
      showNumbers();
    }
    if (state.iceDirty || state.marksDirty) {
      picture.drawMarks(shownFloe.shown());
      shownFloe.showCard();
    }
    state.iceDirty = state.marksDirty = false;
    if (isDrawn) {
      ++player.drawn;
      if (player.drawTimes.push(performance.now() - before) > 2000) player.drawTimes.length = 0;
    }
    requestAnimationFrame(frame);
  }

  fillPage(player);
  watchGestures(stage, view, actions);
  watchKeys(actions);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", player.refreshTheme);
  const sizes = new ResizeObserver(resize);
  for (const id of ["stage", "plot", "track-row"]) sizes.observe(byId(id));
  view.resize();
  view.fit(player.box);
  player.refreshTheme();
  actions.select(-1);
  showEventCard(byId("event-card"), run, null);
  requestAnimationFrame(frame);
  return player;
}
