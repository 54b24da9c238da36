/** Returns the parameters of a link to an instant of two runs: those of the first run (momentOf()) with the time of the
 * common clock [s], and `floe2` for the selected floe of the second. */
function momentOfPair([first, second], clock) {
  const words = { ...momentOf(first), t: Number(clock.time.toFixed(4)) };
  if (second.state.selected >= 0) words.floe2 = second.state.selected;
  return words;
}

/** Goes to the instant of a link in the first player, and selects the floe `floe2` in the second. At the next refresh
 * of the screen, share() of makeCommon() copies the settings that the link changed to the second player. Returns
 * messages about parts that were not understood. */
function goToMomentOfPair([first, second], link) {
  const words = new URLSearchParams(link.replace(/^#/, ""));
  const ofSecond = words.get("floe2");
  words.delete("floe2");
  const problems = goToMoment(first, words.toString());
  return ofSecond === null ? problems : [...problems, ...applyWords(second, [["floe", ofSecond]])];
}

// Two runs side by side. Each has its own player in a frame. This script has their common clock and their common
// settings.

/** Returns the HTML of the page of run `k` (0 or 1): `template` is the page of one run with marks in double braces,
 * which are replaced by the run's data in this page. The data are removed from this page, to save memory. `labels` are
 * the names that the players show for the runs, `axis_s` is the range of times that the axes of both show, from the
 * earlier start to the later end [s]. The character `<` is escaped in the options, because a name could otherwise end
 * the script element that contains them. In the data it has been escaped when the page was written. */
function pageOfRun(template, { labels, axis_s }, k) {
  const take = (id) => {
    const text = byId(id).textContent;
    byId(id).remove();
    return text;
  };
  const options = JSON.stringify({ axis_s, label: labels[k] }).replaceAll("<", "\\u003c");
  const parts = { title: "", options, info: take(`info-${k}`), columns: take(`columns-${k}`) };
  return template.replace(/\{\{(title|options|info|columns)\}\}/g, (_, name) => parts[name]);
}

/** Puts the two players into the page, each in a frame of its own, which becomes its member `frame`. The returned
 * promise gives them when both have started. */
function openPlayers() {
  const pair = JSON.parse(byId("pair-info").textContent);
  const template = JSON.parse(byId("player-page").textContent);
  byId("player-page").remove();
  return Promise.all(pair.labels.map((label, k) => new Promise((done) => {
    const frame = make("iframe", { title: label });
    frame.addEventListener("load", () => done(Object.assign(frame.contentWindow.polynyaPlayer, { frame })));
    frame.srcdoc = pageOfRun(template, pair, k);
    byId("runs").append(frame);
  })));
}

/** Makes the common clock, which replaces the clocks of both players: their controls and keys act on it. A run that
 * ends earlier stays at its end, because its own clock does not go beyond it; with `isOver` its map shows a notice. A
 * run that begins later waits at its beginning, without a notice.
 * Each player also gets the speed of playback, which determines for how much time ahead its map draws the ice at rest
 * as one picture (makeIcePicture()). */
function makePairClock(players) {
  const clock = makeClock(players[0].axis, () => {
    byId("now").textContent = `${clock.time.toFixed(1)} s`;
    for (const player of players) {
      player.isOver = clock.time > player.range[1];
      player.state.rate = clock.rate;
      player.state.goTo(clock.time);
    }
  });
  for (const { actions } of players) Object.assign(actions, clockActions(clock));
  return clock;
}

/** Applies the settings of another player's plots. The `quantity` of the first plot and its `hidden` kinds of curves
 * are applied only if this run has that quantity. `isFull` chooses the scale up to the largest value instead of the
 * scale without spikes, `span` is the visible part of the run [s], and `further` lists the quantities of the plots
 * below, of which those that this run lacks are left out. */
function showPlotAs({ plot, plotPanel, actions }, { quantity, hidden, isFull, span, further }) {
  if (Object.hasOwn(plot.quantities, quantity) && (plot.quantity !== quantity
    || [...plot.hidden].join() !== hidden.join())) {
    plot.hidden = new Set(hidden);
    actions.plotQuantity(quantity);
  }
  if (plotPanel.further().join() !== further.join()) actions.showPlots(further);
  plotPanel.setFull(isFull);
  plotPanel.showTools();
  plot.show(...span);
}

/** Settings that both players share: `of` reads one from a player, `give` applies it to another. A setting is shared
 * while `isOn` returns true, or always without it. Changes that are made while `isOn` returns false are not shared
 * later. While a player follows a ship, only the scale of its map is shared, because the ship determines the centre.
 * Ships are followed by their number in the scene; a run with fewer ships ignores a number that it lacks. Each player
 * keeps its own selection of floe, ship and event, and its own ruler. */
const common = {
  colours: { of: ({ state }) => state.colourBy, give: ({ actions }, by) => actions.colourBy(by) },
  layers: { of: ({ state }) => state.layers, give: ({ actions }, layers) =>
    Object.entries(layers).forEach((layer) => actions.toggleLayer(...layer)) },
  sizes: { of: ({ state }) => state.sizes, give: ({ actions }, sizes) => actions.chooseSizes(sizes) },
  follow: { of: ({ state }) => state.follow, give: ({ actions }, ship) => actions.setFollow(ship) },
  plot: {
    of: ({ plot, plotPanel }) => ({ quantity: plot.quantity, hidden: [...plot.hidden], isFull: plot.isFull,
      span: plot.span, further: plotPanel.further() }),
    give: showPlotAs,
  },
  map: {
    isOn: () => byId("same-map").checked,
    of: ({ view, state }) => ({ x: view.x, y: view.y, scale: view.scale, isFitted: state.isFitted }),
    give: ({ view, state }, { x, y, scale, isFitted }) => {
      Object.assign(view, state.follow >= 0 ? { scale } : { x, y, scale });
      Object.assign(state, { isFitted, iceDirty: true });
    },
  },
};

/** Applies the settings of the first player to the second, and returns two functions. share() applies settings that
 * have changed in one player since its last call to the other; if both have changed one, that of the first counts. It
 * is called at each refresh of the screen. show() draws both plots again, when the check box for a common scale or a
 * plot has changed. */
function makeCommon(players) {
  const known = {}; // the setting of both players when it was last shared, as JSON
  const wordsOf = ({ of }) => players.map((player) => JSON.stringify(of(player)));
  // Drawing again makes both plots use a common scale if the check box for it is on (joinScales()).
  const show = () => players.forEach(({ plot }) => plot.show(...plot.span));
  const give = (name, from) => {
    const thing = common[name];
    if (thing.isOn?.() ?? true) thing.give(players[1 - from], thing.of(players[from]));
    known[name] = wordsOf(thing);
  };
  for (const name of Object.keys(common)) give(name, 0);
  return {
    show,
    share() {
      for (const [name, thing] of Object.entries(common)) {
        const changed = wordsOf(thing).findIndex((words, k) => words !== known[name][k]);
        if (changed < 0) continue;
        give(name, changed);
        if (name === "plot") show();
      }
    },
  };
}

/** Gives both players the same extent of the map, which contains both runs, the same scales of arrows (the smaller one
 * of both) and the same classes of colours, up to the larger extremes. Then the same length or colour means the same in
 * both. The plots share a scale, which contains the ranges of both, only while they show the same quantity and the
 * check box for it is on. Plots call `widened` with the range [low, high] of each axis, by the name of its scale. */
function joinScales(players) {
  const scales = Object.fromEntries(["forceScale", "arrowScale"].map((name) =>
    [name, Math.min(...players.map((player) => player[name]))]));
  const most = Object.fromEntries(Object.keys(players[0].extremes).map((name) =>
    [name, Math.max(...players.map(({ extremes }) => extremes[name]))]));
  const boxes = players.map(({ box }) => box);
  const box = { left: Math.min(...boxes.map(({ left }) => left)), right: Math.max(...boxes.map(({ right }) => right)),
    bottom: Math.min(...boxes.map(({ bottom }) => bottom)), top: Math.max(...boxes.map(({ top }) => top)) };
  players.forEach((player, k) => {
    player.box = box;
    player.colourUpTo(most);
    Object.assign(player, scales);
    const other = players[1 - k].plot;
    player.plot.widened = (ranges) => {
      if (!byId("same-scale").checked || !other.chart || other.quantity !== player.plot.quantity) return ranges;
      const more = other.neededRanges();
      return Object.fromEntries(Object.entries(ranges).map(([name, [low, high]]) =>
        [name, [Math.min(low, more[name]?.[0] ?? low), Math.max(high, more[name]?.[1] ?? high)]]));
    };
    player.actions.fit();
  });
}

/** Moves to the next (`step` 1) or previous (−1) event of either run that has a mark on the timeline, seen from the
 * present time, and selects it in its run. Of several events at the same time, in one run or in both, only one is
 * reached; if both runs have one, it is an event of the first. */
function stepEvent(players, clock, step) {
  const found = players.map(({ actions, run }) => {
    const index = actions.eventFrom(clock.time, step);
    return { actions, index, time: run.info.events[index]?.t_s };
  }).filter(({ index }) => index >= 0).sort((a, b) => step * (a.time - b.time));
  if (found.length > 0) found[0].actions.goToEvent(found[0].index);
}

/** Changes this page and both players from the light theme to the dark one or back. The choice is not stored. */
function toggleThemes(players) {
  const isDark = getComputedStyle(document.documentElement).colorScheme.includes("dark");
  for (const { documentElement } of [document, ...players.map(({ frame }) =>
    frame.contentDocument)]) documentElement.dataset.theme = isDark ? "light" : "dark";
  for (const player of players) player.refreshTheme();
}

/** Handles the controls of the common bar, and keys that are pressed there, which act as if they were pressed in the
 * first player. The players' own controls and keys for the theme, the link and the next event act on both runs as well.
 * `address` returns the link to the present instant. */
function watchBar(players, clock, shared, address) {
  const common = { toggleTheme: () => toggleThemes(players), copyLink: () => copyLink(address()),
    stepEvent: (step) => stepEvent(players, clock, step) };
  for (const { actions } of players) Object.assign(actions, common);
  watchControls({ ...players[0].actions, shareScale: shared.show });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isForControl(event)) return;
    const { contentWindow, contentDocument } = players[0].frame;
    const passed = new contentWindow.KeyboardEvent("keydown", { key: event.key, shiftKey: event.shiftKey, bubbles: true,
      cancelable: true });
    if (!contentDocument.body.dispatchEvent(passed)) event.preventDefault();
  });
}

/** Starts the page. Both runs play at the larger of the speeds at which they would start alone, and the address of the
 * page follows the state of both. `polynyaPair` is for tests and tools/measure_player.js only. */
async function startPair() {
  const players = await openPlayers();
  const clock = makePairClock(players);
  const words = () => momentOfPair(players, clock);
  joinScales(players);
  const shared = makeCommon(players);
  watchBar(players, clock, shared, () => addressOf(words()));
  byId("end").textContent = `${Number(players[0].axis[1].toFixed(1))} s`;
  clock.setRate(Math.max(...players.map(({ state }) => state.rate)));
  shared.show();
  const keepLink = watchMoment({ words, goTo: (link) => goToMomentOfPair(players, link), isPlaying: () =>
    clock.isPlaying });
  for (const player of players) player.keepLink = keepLink;
  runClock(clock, players[0].axis, shared.share);
  window.polynyaPair = { players, clock };
}
