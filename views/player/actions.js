// Actions of the player. Its controls, keys and pointers call them, and so do tests.

/** Returns all actions in one object. Each group may call actions of the others. Actions on the map and its layers draw
 * all again and return nothing. The others set `marksDirty`, or change the clock, if anything must be drawn. Only when
 * something is drawn are cards and the link of the moment updated. */
function makeActions(player) {
  const actions = clockActions(player.state);
  const redrawn = Object.entries({ ...mapActions(player, actions), ...layerActions(player) }).map(([name, act]) =>
    [name, (...words) => {
      act(...words);
      player.state.iceDirty = true;
    }]);
  const groups = [eventActions, takeAwayActions, floeActions, rulerActions, pageActions].map((group) =>
    group(player, actions));
  return Object.assign(actions, Object.fromEntries(redrawn), ...groups);
}

/** Actions that move to another frame or event. */
function eventActions({ run, state, view }, actions) {
  const { frames: { times }, info: { events } } = run;
  return {
    /** Moves by a number of frames; backwards from between two frames, the first step reaches the earlier of them. */
    stepFrames(count) {
      const at = lastAtMost(times, state.time + 1e-9);
      const next = count < 0 && state.time - times[at] > 1e-9 ? at + 1 + count : at + count;
      actions.goTo(times[Math.min(times.length - 1, Math.max(0, next))] ?? 0);
    },
    /** Selects an event, pauses and moves to its time. If its place is outside of the map, or within 20 px of its edge,
     * the map is centred on it; if it follows a ship, drawing moves it back to the ship. */
    goToEvent(index) {
      const event = events[index];
      if (!event) return;
      state.event = index;
      actions.play(false);
      actions.goTo(event.t_s);
      const [x, y] = view.toScreen(...event.point_m);
      if (x < 20 || y < 20 || x > view.width - 20 || y > view.height - 20) {
        [view.x, view.y] = event.point_m;
        state.isFitted = false;
      }
      showEventCard(byId("event-card"), run, event);
    },
    /** Index of the first event with a mark on the time axis after a time [s], or with step < 0 of the last one before
     * it; −1 if there is none. Ice that goes under a hull or surfaces has no mark (isMarked() in timeline.js). Two runs
     * side by side use it. */
    eventFrom(time, step) {
      const isBeyond = (event) => isMarked(event) && (step > 0 ? event.t_s > time + 1e-9 : event.t_s < time - 1e-9);
      return step > 0 ? events.findIndex(isBeyond) : events.findLastIndex(isBeyond);
    },
    /** Goes to the next marked event (`step` 1) or the one before (−1), from the selected event if the time is still
     * that of the event, otherwise from the present time. */
    stepEvent(step) {
      const marked = Array.from(events.keys()).filter((index) => isMarked(events[index]));
      let at = marked.indexOf(state.event);
      if (at < 0 || Math.abs(events[state.event].t_s - state.time) > 1e-6) {
        const after = marked.findIndex((index) => events[index].t_s > state.time);
        at = step > 0 ? (after < 0 ? marked.length : after) : (after < 0 ? marked.length : after) - 1;
      } else at += step;
      actions.goToEvent(marked[Math.min(marked.length - 1, Math.max(0, at))]);
    },
  };
}

/** Actions that change the visible part of the map. While `isFitted` is true, the map shows the whole run again when
 * the size of the window changes. */
function mapActions(player, actions) {
  const { state, view, run: { info: { ships } } } = player;
  return {
    pan(dx, dy) {
      view.panBy(dx, dy);
      if (state.follow >= 0) actions.setFollow(-1);
      state.isFitted = false;
    },
    zoom(px, py, factor) {
      view.zoomAt(px, py, factor);
      state.isFitted = false;
    },
    zoomCentre: (factor) => actions.zoom(view.width / 2, view.height / 2, factor),
    fit() {
      actions.setFollow(-1);
      view.fit(player.box);
      state.isFitted = true;
    },
    /** Follows the next ship; after the last one none. */
    follow: () => actions.setFollow(state.follow + 1 < ships.length ? state.follow + 1 : -1),
    /** Keeps a ship in the middle of the map; −1: none. If the whole run was in view, the map is zoomed in until its
     * shorter side shows 2.2 lengths of the ship. */
    setFollow(ship) {
      if (ship >= ships.length) return;
      state.follow = ship;
      byId("follow").setAttribute("aria-pressed", String(ship >= 0));
      if (ship < 0 || !state.isFitted) return;
      const { length } = hullBox(ships[ship].waterline_m);
      view.scale = Math.max(view.scale, Math.min(view.width, view.height) / (2.2 * length));
      state.isFitted = false;
    },
  };
}

/** Actions that change the contents of the map. */
function layerActions(player) {
  const { state } = player;
  return {
    colourBy(what) {
      state.colourBy = what;
      byId(`by-${what}`).checked = true;
      player.legend.show();
    },
    toggleLayer(name, isOn = !state.layers[name]) {
      state.layers[name] = isOn;
      byId(`layer-${name}`).checked = isOn;
      player.legend.show();
    },
    /** Highlights floes with sizes √area [m] from `from` to less than `below`; null: all floes. */
    chooseSizes(range = null) {
      state.sizes = range;
      player.sizePanel.showFields();
      player.legend.show();
    },
  };
}

/** Actions that export something from the page: a link or pictures. */
const takeAwayActions = (player) => ({
  copyLink: () => copyLink(player.address()),
  saveMap: () => savePicture(player, mapPicture(player), "map"),
  savePlot: () => player.run.info.ships.length > 0 && savePicture(player, plotPicture(player), "plot"),
});

/** Actions on the selected floe and on the floe under the pointer. */
function floeActions(player, actions) {
  const { run, state, view, places, range } = player;
  return {
    select(id) {
      state.selected = id;
      state.marksDirty = true;
      player.cardIsStale = true;
    },
    /** Selects a floe. If it is not there at the present time, on the water or under a hull, the player moves to its
     * birth, or to the start of the page's range of time if it was born earlier. */
    visit(id) {
      if (run.floes.born[id] === Infinity) return showToast(`floe ${id} is not in this page: it is out of the area`);
      if (!places.isThere(id, state.time)) {
        actions.play(false);
        actions.goTo(Math.max(range[0], run.floes.born[id]));
      }
      actions.select(id);
    },
    selectShip(index) {
      state.ship = index;
      state.marksDirty = true;
    },
    hover(px, py) {
      const at = view.toWorld(px, py);
      const [floe, ship] = [floeAt(run, places, ...at), shipAt(run, player.motions, ...at)];
      byId("stage").style.cursor = floe >= 0 || ship >= 0 ? "pointer" : "";
      if (floe === state.hovered && ship === state.hoveredShip) return;
      Object.assign(state, { hovered: floe, hoveredShip: ship, marksDirty: true });
      player.cardIsStale = true;
    },
    /** Selects the ship and the floe at a point of the screen, or deselects them if they were selected. Ice under a
     * hull is selected together with its ship. A click where there is no ship leaves the ship selected, a click where
     * there is no floe deselects the floe. For a scene that has not run, it also copies the coordinates. */
    click(px, py) {
      const at = view.toWorld(px, py);
      const [floe, ship] = [floeAt(run, places, ...at), shipAt(run, player.motions, ...at)];
      Object.assign(state, { hovered: floe, hoveredShip: ship });
      if (player.plan) pickPlace(player, px, py);
      const isKept = floe === state.selected;
      if (ship >= 0) actions.selectShip(ship === state.ship && (floe < 0 || isKept) ? -1 : ship);
      actions.select(isKept ? -1 : floe);
    },
    leave() {
      Object.assign(state, { hovered: -1, hoveredShip: -1, marksDirty: true });
    },
  };
}

/** Actions on the page: its cards, theme and plots. */
function pageActions(player, actions) {
  const { run, state, axis, plot } = player;
  return {
    /** Does the first of these that applies: closes the help, ends the ruler, or deselects ship, event and floe. */
    letGo() {
      if (byId("help").open) return byId("help").close();
      if (state.isMeasuring) return actions.toggleRuler(false);
      actions.selectShip(-1);
      state.event = null;
      showEventCard(byId("event-card"), run, null);
      return actions.select(-1);
    },
    /** Changes between the light and the dark theme; the page does not remember it. */
    toggleTheme() {
      const isDark = getComputedStyle(document.documentElement).colorScheme.includes("dark");
      document.documentElement.dataset.theme = isDark ? "light" : "dark";
      player.refreshTheme();
    },
    toggleHelp() {
      const help = byId("help");
      if (help.open) help.close();
      else help.showModal();
    },
    sizesBy: (what) => player.sizePanel.countBy(what),
    /** Switches the scale of loads in all plots between the largest value and a scale without spikes. */
    toggleFullScale() {
      player.plotPanel.setFull(!plot.isFull);
      player.plotPanel.showTools();
    },
    /** Shows a part of the run [s] in the plot; without arguments the whole run. */
    zoomPlot: (from = axis[0], until = axis[1]) => plot.show(from, until),
    plotQuantity(name) {
      if (!Object.hasOwn(plot.quantities, name)) return;
      plot.quantity = name;
      byId("quantity").value = name;
      player.plotPanel.rebuild();
    },
    /** Adds a plot below the others. Without a name it shows the first quantity that no other plot shows. */
    addPlot(name = nextQuantity(player.plotPanel)) {
      if (name !== undefined) actions.showPlots([...player.plotPanel.further(), name]);
    },
    /** Shows plots of these quantities below the first plot; the next drawing stores them in the link. */
    showPlots(quantities) {
      player.plotPanel.showFurther(quantities.filter((name) => Object.hasOwn(plot.quantities, name)));
      state.marksDirty = true;
    },
  };
}
