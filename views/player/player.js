// The player: text and controls of the page, drawing, and assembly of the parts.

// Text and controls of the page.

/** Kinds of events whose numbers the panel of facts shows, by the words that it shows for them. */
const eventCounts = { bends: "bend", splits: "split", ground: "grind", "rejected cuts": "rejected_cut",
  "went under": "submerge", "came up": "resurface", "stayed under": "stay_under", "moorings broken": "mooring_break" };

/** Fills the panel of facts, which do not change with time. A page that was written with `--area`, `--every`, `--from`
 * or `--until` contains only a part of the floes or frames: it shows both numbers, such as "20 of 300". Events are
 * counted over the whole run, also with `--from` or `--until`, but with `--area` only those of the page's floes. Kinds
 * of events that did not occur are left out, except bends and splits of a scene that has run. If ice went under hulls,
 * two rows with the numbers at the present time stand above (showCountsUnderHulls()). */
function fillFacts({ run: { info, floes }, name, plan }) {
  const ofRun = (held, all) => (held === all ? held : `${held} of ${all}`);
  const counts = Object.entries(eventCounts).map(([words, kind]) =>
    [words, info.events.filter((event) => event.kind === kind).length]);
  const facts = {
    "floes in all": ofRun(info.floes, floes.count),
    ...(info.area_m && { area: `${info.area_m.map(shortNumber).join(", ")} m` }),
    ...Object.fromEntries(counts.filter(([words, count]) => count > 0 || (!plan && /bends|splits/.test(words)))),
    ships: info.ships.map((ship) => ship.name).join(", ") || "none",
    ...(info.time_steps && {
    steps: `${info.time_steps}, ticks of ${info.step_s} s, the shortest step ${+info.shortest_step_s.toPrecision(3)} s`,
  }),
    ...(!plan && { frames: ofRun(info.frames, info.frames_of_run) }),
    ...(name !== info.scene && { "scene's name": info.scene }),
    seed: info.seed, scene: info.scene_hash, polynya: info.polynya,
  };
  byId("facts").replaceChildren(...Object.entries(facts).flatMap(([fact, value]) =>
    [make("dt", {}, fact), make("dd", {}, String(value))]));
  if ("went under" in facts) byId("facts").prepend(...rowsUnderHulls());
}

/** Options of the list from which the user chooses the quantity of a plot (plot_panel.js). Forces by cause, which are
 * drawn as stacked areas, are a separate group. A group without quantities is left out. */
function quantityGroups(quantities) {
  return [[false, "Quantities"], [true, "Stacked areas"]].flatMap(([stacks, label]) => {
    const group = Object.entries(quantities).filter(([, { isStack = false }]) => isStack === stacks);
    const choices = group.map(([value, { label: words }]) => make("option", { value }, words));
    return choices.length > 0 ? [make("optgroup", { label }, ...choices)] : [];
  });
}

/** Fills the page and connects its controls. What a run does not have is hidden or disabled. Playback starts at the
 * slowest speed of the list at which the run takes at most 40 s, or at the fastest one if there is none; with a longer
 * time, runs start slower. */
function fillPage(player) {
  const { run: { info, frames }, range, name, isOneOfTwo, axis, state, actions } = player;
  byId("scene").textContent = name;
  document.body.classList.toggle("one-of-two", isOneOfTwo);
  document.body.classList.toggle("no-ships", info.ships.length === 0);
  for (const id of ["description", "description-whole"]) {
    byId(id).textContent = info.description;
    byId(id).classList.toggle("empty", info.description === "");
  }
  byId("end").textContent = `${Number(range[1].toFixed(1))} s`;
  byId("badge").hidden = info.finished;
  byId("badge").textContent = `unfinished: ${range[1].toFixed(1)} of ${info.until_s} s`
    + (info.stopped_by ? `, stopped by ${info.stopped_by}` : "");
  fillFacts(player);
  if (player.plan) fillPlan(player);
  byId("event-before").disabled = byId("event-after").disabled = info.events.length === 0;
  byId("play").disabled = frames.times.length < 2;
  byId("follow").disabled = info.ships.length === 0;
  byId("ship-section").hidden = info.ships.length === 0;
  for (const [layer, isOn] of Object.entries(state.layers)) byId(`layer-${layer}`).checked = isOn;
  byId("track").setAttribute("aria-valuemin", String(axis[0]));
  byId("track").setAttribute("aria-valuemax", String(axis[1]));
  state.setRate(playRates().find((rate) => (range[1] - range[0]) / rate <= 40) ?? playRates().at(-1));
  watchControls(actions);
  watchKeys(actions);
}

// Drawing of the picture and the numbers at each refresh of the screen.

/** Shows the time, the number of floating floes, and what depends on them: sizes, ice under hulls, plots, timeline. */
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

/** Draws at each refresh of the screen what has changed (`iceDirty`, `marksDirty` of the state), and advances the clock
 * of the player while it plays. The clocks of two runs side by side never play; the common clock of pair.js sets their
 * time, and drawing is the same. A map that follows a ship is centred on it before it is drawn. Tests wait for `drawn`,
 * the number of pictures of the ice. tools/measure_player.js reads `drawTimes`, the time that each took [ms]; the list
 * is emptied after 2000, so that it does not grow without limit. */
function startDrawing(player, canvases) {
  const { state, view, places, motions } = player;
  const drawIce = makeIcePicture(player, canvases[0]);
  const drawMarks = makeMarksPicture(player, canvases[1]);
  const shownFloe = makeShownFloe(player);
  const showShip = makeShownShip(player);
  runClock(state, player.range, () => {
    const { iceDirty } = state;
    if (!iceDirty && !state.marksDirty) return;
    const before = performance.now();
    if (iceDirty) {
      places.setTime(state.time);
      const pose = state.follow >= 0 ? motions.ship(state.follow) : null;
      if (pose) [view.x, view.y] = pose;
      drawIce();
      showNumbers(player);
    }
    drawMarks(shownFloe.shown());
    shownFloe.showCard();
    showShip();
    player.keepLink();
    state.iceDirty = state.marksDirty = false;
    if (!iceDirty) return;
    ++player.drawn;
    if (player.drawTimes.push(performance.now() - before) > 2000) player.drawTimes.length = 0;
  });
}

// Assembly of the player.

/** Reads the run, and adds data that several parts use. `breakOf` has, for each floe that ended, the index of the event
 * that ended it. The colours of the floe's pieces and its card depend on that event, so the events that do not end a
 * floe are left out: rejected cuts and going under a hull, after which the floe lives until it surfaces or is found to
 * stay under. `under` has the number of floes that went under hulls and the times at which they surfaced, and
 * `moorings` tells when moorings broke. `carry` moves points with the water from one time to another (makeCarrier()),
 * and `outline(floe)` gives the outline of a floe as a path for drawing. */
function readPlayedRun(source) {
  const run = readRun(source);
  run.breakOf = new Map();
  run.info.events.forEach((event, index) => {
    if ("floe" in event && !["rejected_cut", "submerge"].includes(event.kind)) run.breakOf.set(event.floe, index);
  });
  run.under = readIceUnderHulls(run.info.events);
  run.moorings = readMoorings(run.info.events);
  run.carry = makeCarrier(run.info.water);
  run.outline = makeOutlines(run);
  return run;
}

/** Options of the page. For one of two runs side by side: its `label`, the name that is shown, and `axis_s`, the first
 * and the last time of the common axis [s]. For a scene that has not run: its `plan` (scene_plan.cpp). Else empty. */
const readOptions = () => JSON.parse(byId("page-options").textContent);

/** State of the page when it opens: a clock with further members. `selected` and `hovered` are floes, `ship`,
 * `hoveredShip` and `follow` (the ship in the middle of the map) are ships, `event` is the selected event; −1 if
 * nothing is chosen, for events null. `iceDirty` is set when all must be drawn again, `marksDirty` when only the marks
 * above the ice must. `sizes` is the range of floe sizes that is highlighted [m], `ruler` the measured line; both may
 * be null. `isFitted` is true while the map shows the whole run; it is then fitted again when the size of the map
 * changes. Of the layers, the channel is shown if a ship or structure that is not moored moves through the water, the
 * ice at the start if one moves over ground. A fixed structure moves through water that drifts. */
function firstState(run, motions, range) {
  const isUnderWay = (carry) => run.frames.times.length > 0 && run.info.ships.some(({ is_moored: isMoored }, ship) =>
    !isMoored && hasGone(run, motions, ship, carry));
  const state = makeClock(range, () => { state.iceDirty = true; });
  return Object.assign(state, {
    selected: -1, hovered: -1, ship: -1, hoveredShip: -1, isMeasuring: false, ruler: null,
    event: null, follow: -1, colourBy: "breakage", isFitted: true, sizes: null,
    layers: { channel: isUnderWay(run.carry), startIce: isUnderWay((x, y) => [x, y]), track: true, velocities: false,
      forces: false, largestLoads: false, meanLoads: false, fractures: false },
    iceDirty: true, marksDirty: true,
  });
}

/** Makes the player without its controls. Tests and measurements read its members. `range` is the time of the first and
 * the last frame [s], `axis` the range of the time axis, `name` the name that the page shows, and `box` the part of the
 * world that fit() shows [m]. `cardIsStale` is set when the card of a floe must be filled again; `loadLine` has the
 * loads along the hulls. Only tests use the last four members: `stations` of the channel behind a ship, `contacts` of
 * the present frame, `valueWords` and `rulerWords`. */
function makePlayer(canvases, source) {
  const run = readPlayedRun(source);
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
    box: extentOf(run, motions, places, range), colours: themeColours(), colourings, extremes, cardIsStale: false,
    loadLine: makeLoadLine(run), drawn: 0, drawTimes: [],
    // An arrow of 40 px is a large force, which one contact in twenty exceeds (typicalForce()), or the speed at which
    // the highest class of colours begins. Longer arrows would hide more of the ice.
    forceScale: 40 / (typicalForce(run) || 1), // [px/N]
    arrowScale: 40 / (colourings.speed.edges.at(-1) || 1), // [px/(m/s)]
    /** Sets the classes of colours for other extremes, such as those of two runs. The scales of arrows stay as they
     * are: joinScales() in pair.js sets common ones. */
    colourUpTo: (most) => Object.assign(colourings, makeColourings(run, places, most)),
    stations: (ship) => stationsOf(run, ship, state.time),
    contacts: () => contactsOfFrame(run, motions.frame), valueWords, rulerWords,
  };
}

/** Updates the page when the theme or the sizes of its parts change. A map that shows the whole run is fitted again. */
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

/** Starts the player in this page with the run of a source (pageSource) and returns it. `keepLink` updates the address
 * of the page, so that it leads to the present state; pair.js sets it for two runs side by side. `address` is the link
 * that the user can copy. */
function startPlayer(source) {
  const canvases = [byId("ice"), byId("marks")];
  const player = makePlayer(canvases, source);
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
  watchMap(byId("stage"), player.actions, () => player.state.isMeasuring);
  watchPage(player);
  view.resize();
  view.fit(player.box);
  player.refreshTheme();
  player.actions.select(-1);
  player.actions.selectShip(-1);
  showEventCard(byId("event-card"), run, null);
  if (!player.isOneOfTwo) player.keepLink = watchMoment({ words: () => momentOf(player),
    goTo: (link) => goToMoment(player, link), isPlaying: () => player.state.isPlaying });
  startDrawing(player, canvases);
  return player;
}
