// The player: the page's words and controls, its drawing, and its parts put together.

// The page's words and controls.

/** The panel with the numbers of the whole run. */
function fillFacts({ run: { info, floes }, name, plan }) {
  const count = (kind) => info.events.filter((event) => event.kind === kind).length;
  const facts = {
    "floes in all": info.floes === floes.count ? floes.count : `${info.floes} of ${floes.count}`,
    ...(info.area_m && { area: `${info.area_m.map(shortNumber).join(", ")} m` }),
      ...(!plan && { bends: count("bend"), splits: count("split"), ...(count("grind") && { ground: count("grind") }),
        "rejected cuts": count("rejected_cut") }),
    ...(count("submerge") && { "went under": count("submerge"), "came up": count("resurface"),
      ...(count("stay_under") && { "stayed under": count("stay_under") }) }),
    ...(count("mooring_break") && { "moorings broken": count("mooring_break") }),
    ships: info.ships.map((ship) => ship.name).join(", ") || "none",
    ...(info.steps?.length && { steps: info.steps.map(({ step_s, count }) => `${count} of ${step_s} s`).join(", ") }),
    ...(!plan
      && { frames: info.frames === info.frames_of_run ? info.frames : `${info.frames} of ${info.frames_of_run}` }),
    ...(name !== info.scene
      && { "scene's name": info.scene }), seed: info.seed, scene: info.scene_hash, polynya: info.polynya,
  };
  byId("facts").replaceChildren(...Object.entries(facts).flatMap(([fact, value]) =>
    [make("dt", {}, fact), make("dd", {}, String(value))]));
  if (count("submerge")) byId("facts").prepend(...rowsUnderHulls());
}

/** What the plot can show, forces by cause apart. */
function quantityGroups(quantities) {
  return [[false, "Quantities"], [true, "Stacked areas"]].flatMap(([stacks, label]) => {
    const group = Object.entries(quantities).filter(([, { isStack = false }]) => isStack === stacks);
    return group.length > 0
      ? [make("optgroup", { label }, ...group.map(([name, { label: words }]) =>
        make("option", { value: name }, words)))] : [];
  });
}

function fillPage(player) {
  const { run, range, name, isOneOfTwo, axis, state, plot, actions } = player;
  const { info, frames } = run;
  byId("scene").textContent = name;
  document.body.classList.toggle("one-of-two", isOneOfTwo);
  for (const id of ["description", "description-whole"]) {
    byId(id).textContent = info.description;
    byId(id).classList.toggle("empty", info.description === "");
  }
  byId("end").textContent = `${Number(range[1].toFixed(1))} s`;
  if (!info.finished) {
    byId("badge").hidden = false;
    byId("badge").textContent = `unfinished: ${range[1].toFixed(1)} of ${info.until_s} s` + (info.stopped_by
      ? `, stopped by ${info.stopped_by}` : "");
  }
  fillFacts(player);
  if (player.plan) fillPlan(player);

  const onClick = {
    play: () => actions.togglePlay(), "event-before": () => actions.stepEvent(-1), "event-after": () =>
      actions.stepEvent(1),
    "zoom-in": () => actions.zoomCentre(1.4), "zoom-out": () =>
      actions.zoomCentre(1 / 1.4), fit: actions.fit, follow: actions.follow,
    theme: actions.toggleTheme, "help-button": actions.toggleHelp, "help-close": actions.toggleHelp,
    "full-scale": actions.toggleFullScale, "whole-run": () =>
      actions.zoomPlot(), "save-plot": actions.savePlot, "save-map": actions.saveMap,
    "copy-link": actions.copyLink,
  };
  for (const [id, act] of Object.entries(onClick)) byId(id).addEventListener("click", act);
  byId("event-before").disabled = byId("event-after").disabled = info.events.length === 0;
  byId("play").disabled = frames.times.length < 2;
  byId("rate").replaceChildren(...rates.map((rate) => make("option", { value: String(rate) }, `${rate}\u00d7`)));
  byId("rate").value = String(state.rate);
  byId("rate").addEventListener("change", (event) => actions.setRate(Number(event.target.value)));
  byId("follow").disabled = info.ships.length === 0;
  for (const what of ["breakage", "generation", "speed", "size"]) byId(`by-${what}`).addEventListener("change", () =>
    actions.colourBy(what));
  for (const name of Object.keys(state.layers)) {
    byId(`layer-${name}`).checked = state.layers[name];
    byId(`layer-${name}`).addEventListener("change", (event) => actions.toggleLayer(name, event.target.checked));
  }
  byId("track").setAttribute("aria-valuemin", String(axis[0]));
  byId("track").setAttribute("aria-valuemax", String(axis[1]));
  document.body.classList.toggle("no-ships", info.ships.length === 0);
  byId("quantity").replaceChildren(...quantityGroups(plot.quantities));
  byId("quantity").addEventListener("change", (event) => actions.plotQuantity(event.target.value));
}

// The picture and the numbers at each tick of the screen.

/** Moves the time on by what passed [ms] since the last tick; the run stops at its end. */
function playOn({ state, range, actions }, passed) {
  state.time += (Math.min(100, passed) / 1000) * state.rate;
  if (state.time >= range[1]) {
    state.time = range[1];
    actions.play(false);
  }
  state.iceDirty = true;
}

function showNumbers({ run, state, places, plotPanel, sizePanel, timeline }) {
  const words = `${state.time.toFixed(1)} s`;
  byId("now").textContent = words;
  byId("living").textContent = String(places.count);
  byId("living-word").textContent = places.count === 1 ? "floe" : "floes";
  sizePanel.show();
  if (run.under.went > 0) showCountsUnderHulls(run, places, state.time);
  plotPanel.setTime(state.time);
  timeline.setTime(state.time, `${words}, ${counted(places.count, "floe")}`);
}

function startDrawing(player, canvases) {
  const { state, view, places, motions } = player;
  const drawIce = makeIcePicture(player, canvases[0]);
  const drawMarks = makeMarksPicture(player, canvases[1]);
  const shownFloe = makeShownFloe(player);

  /** Draws what has changed. */
  function draw() {
    if (state.iceDirty) {
      places.setTime(state.time);
      const pose = state.follow >= 0 ? motions.ship(state.follow) : null;
      if (pose) [view.x, view.y] = pose;
      drawIce();
      showNumbers(player);
    }
    if (state.iceDirty || state.marksDirty) {
      drawMarks(shownFloe.shown());
      shownFloe.showCard();
    }
    if (state.iceDirty || state.marksDirty) player.keepLink();
    state.iceDirty = state.marksDirty = false;
  }

  let last = 0;
  function tick(now) {
    if (state.isPlaying) playOn(player, now - last);
    last = now;
    const isDrawn = state.iceDirty;
    const before = performance.now();
    draw();
    if (isDrawn) {
      ++player.drawn;
      if (player.drawTimes.push(performance.now() - before) > 2000) player.drawTimes.length = 0;
    }
    requestAnimationFrame(tick);
  }
  requestAnimationFrame(tick);
}

// The player: its parts, put together.

/** The run, with what several parts ask of it. */
function readPlayedRun() {
  const run = readRun();
  run.breakOf = new Map();
  run.info.events.forEach((event, index) => {
    if ("floe" in event && !["rejected_cut", "submerge"].includes(event.kind)) run.breakOf.set(event.floe, index);
  });
  run.under = readIceUnderHulls(run.info.events);
  run.carry = makeCarrier(run.info.water);
  return run;
}

/** Of one of two runs side by side its `label` and `axis_s`, the times on the axes of both; of a scene that has not run
 * its `plan`; else nothing. */
const readOptions = () => JSON.parse(byId("page-options").textContent);

/** What is shown when the page opens. */
function firstState(run, motions, range) {
  const isUnderWay = (carry) => run.frames.times.length > 0 && run.info.ships.some((_, ship) =>
    hasGone(run, motions, ship, carry));
  return {
    time: range[0], isPlaying: false, rate: defaultRate(range[1] - range[0]), selected: -1, hovered: -1, event: null,
    follow: -1, colourBy: "breakage", isFitted: true, sizes: null,
    layers: { channel: isUnderWay(run.carry), startIce: isUnderWay((x, y) => [x, y]), track: true, circles: false,
      velocities: false, forces: false, largestLoads: false, meanLoads: false, fractures: false },
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
    run, range, plan: options.plan, axis: options.axis_s ?? range, isOneOfTwo: "axis_s" in options,
      name: options.label ?? run.info.scene, state, view: makeMapView(byId("stage"), canvases), places, motions,
        box: extentOf(run, motions, places, range),
    colours: themeColours(), colourings, extremes, circlesOf: makeCircleSampler(run), cardIsStale: false, drawn: 0,
      drawTimes: [],
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
  for (const [x, y] of player.plan?.routes.flatMap((route) => route.points_m) ?? []) includePoint(player.box, x, y);
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
