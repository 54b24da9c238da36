// The player: its parts, put together.

/** The run, with what several parts ask of it. */
function readPlayedRun() {
  const run = readRun();
  run.breakOf = new Map();
  run.info.events.forEach((event, index) => {
    if (!["rejected_cut", "submerge", "mooring_break"].includes(event.kind)) run.breakOf.set(event.floe, index);
  });
  run.under = readIceUnderHulls(run.info.events);
  run.carry = makeCarrier(run.info.water);
  return run;
}

/** Of one of two runs side by side its `label` and `axis_s`, the times on the axes of both; else nothing. */
const readOptions = () => JSON.parse(byId("page-options").textContent);

/** What is shown when the page opens. */
function firstState(run, motions, range) {
  const isUnderWay = (carry) => run.frames.times.length > 0 && run.info.ships.some((_, ship) => hasGone(run, motions, ship, carry));
  return {
    time: range[0], isPlaying: false, rate: defaultRate(range[1] - range[0]), selected: -1, hovered: -1, event: null,
    follow: -1, colourBy: "breakage", isFitted: true, sizes: null,
    layers: { channel: isUnderWay(run.carry), startIce: isUnderWay((x, y) => [x, y]), track: true, circles: false, velocities: false, forces: false, fractures: false },
    iceDirty: true, marksDirty: true,
  };
}

/** The player without its controls. Includes what tests and measurements read. */
function makePlayer(canvases) {
  const run = readPlayedRun();
  const { times } = run.frames;
  const range = times.length > 0 ? [times[0], times[times.length - 1]] : [0, 0];
  const options = readOptions();
  const motions = new Motions(run);
  const places = makePlaces(run, motions);
  const state = firstState(run, motions, range);
  const extremes = extremesOf(run);
  const colourings = makeColourings(run, places, extremes);
  return {
    run, range, axis: options.axis_s ?? range, isOneOfTwo: "axis_s" in options, name: options.label ?? run.info.scene, state, view: makeMapView(byId("stage"), canvases), places, motions, box: extentOf(run, motions, places, range),
    colours: themeColours(), colourings, extremes, circlesOf: makeCircleSampler(run), cardIsStale: false, drawn: 0, drawTimes: [],
    forceScale: 40 / (typicalForce(run) || 1), // [px/N]
    arrowScale: 40 / (colourings.speed.edges.at(-1) || 1), // [px/(m/s)]
    /** Classes of colours up to other extremes, as another run has them. */
    colourUpTo: (most) => Object.assign(colourings, makeColourings(run, places, most)),
    stations: (ship) => stationsOf(run, ship, state.time),
    contacts: () => contactsOfFrame(run, motions.frame),
  };
}

/** Keeps the page up with the theme and with the sizes of its parts. */
function watchPage(player) {
  const { state, view, plotPanel } = player;
  player.refreshTheme = () => {
    player.colours = themeColours();
    plotPanel.refresh();
    player.legend.show();
    state.iceDirty = true;
  };
  const sizes = new ResizeObserver(() => {
    view.resize();
    if (state.isFitted) view.fit(player.box);
    plotPanel.resize();
    state.iceDirty = true;
  });
  for (const id of ["stage", "plot", "track-row"]) sizes.observe(byId(id));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", player.refreshTheme);
}

function startPlayer() {
  const canvases = [byId("ice"), byId("marks")];
  const player = makePlayer(canvases);
  const { run, axis, view } = player;
  player.plotPanel = makePlotPanel(player);
  player.plot = player.plotPanel.plot;
  player.actions = makeActions(player);
  player.timeline = makeTimeline(run, byId("track"), axis, player.actions);
  player.legend = makeLegend(player);
  player.sizePanel = makeSizePanel(player);
  player.address = () => addressOf(momentOf(player));
  player.keepLink = () => {};
  fillPage(player);
  watchGestures(byId("stage"), player.actions);
  watchKeys(player.actions);
  watchPage(player);
  view.resize();
  view.fit(player.box);
  player.refreshTheme();
  player.actions.select(-1);
  showEventCard(byId("event-card"), run, null);
  if (!player.isOneOfTwo) keepMoment(player);
  startDrawing(player, canvases);
  return player;
}
