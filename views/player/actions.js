// What can be done with the player: by its controls, keys and pointers, and by tests.

/** All actions, each group with the others at hand. */
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

/** From frame to frame, and from event to event. */
function eventActions({ run, state, view }, actions) {
  const { frames: { times }, info: { events } } = run;
  return {
    stepFrames(count) {
      const at = lastAtMost(times, state.time + 1e-9);
      const next = count < 0 && state.time - times[at] > 1e-9 ? at + 1 + count : at + count;
      actions.goTo(times[Math.min(times.length - 1, Math.max(0, next))] ?? 0);
    },
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
    /** The first marked event after a time [s], or before it; −1 where there is none. */
    eventFrom(time, step) {
      const isBeyond = (event) => isMarked(event) && (step > 0 ? event.t_s > time + 1e-9 : event.t_s < time - 1e-9);
      return step > 0 ? events.findIndex(isBeyond) : events.findLastIndex(isBeyond);
    },
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

/** The part of the map in view. */
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
    follow: () => actions.setFollow(state.follow + 1 < ships.length ? state.follow + 1 : -1),
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

/** What the map shows. */
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
    /** Sizes √area [m] `from` on and `below`; null: all. */
    chooseSizes(range = null) {
      state.sizes = range;
      player.sizePanel.showFields();
      player.legend.show();
    },
  };
}

/** What is taken out of the page: a link, pictures. */
const takeAwayActions = (player) => ({
  copyLink: () => copyLink(player.address()),
  saveMap: () => savePicture(player, mapPicture(player), "map"),
  savePlot: () => player.run.info.ships.length > 0 && savePicture(player, plotPicture(player), "plot"),
});

/** The floe that is chosen, and the one pointed at. */
function floeActions(player, actions) {
  const { run, state, view, places, range } = player;
  return {
    select(id) {
      state.selected = id;
      state.marksDirty = true;
      player.cardIsStale = true;
    },
    /** Chooses a floe, and moves to its time if it is not there now. */
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
    /** Chooses what is there, or lets go of it where it was chosen. Ice under a hull is chosen with its ship. */
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

/** The page: its cards, its theme and its plot. */
function pageActions(player, actions) {
  const { run, state, axis, plot } = player;
  return {
    letGo() {
      if (byId("help").open) return byId("help").close();
      if (state.isMeasuring) return actions.toggleRuler(false);
      actions.selectShip(-1);
      state.event = null;
      showEventCard(byId("event-card"), run, null);
      return actions.select(-1);
    },
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
    toggleFullScale() {
      player.plotPanel.setFull(!plot.isFull);
      player.plotPanel.showTools();
    },
    /** Shows a part of the run in the plot [s]; without ends all of it. */
    zoomPlot: (from = axis[0], until = axis[1]) => plot.show(from, until),
    plotQuantity(name) {
      if (!Object.hasOwn(plot.quantities, name)) return;
      plot.quantity = name;
      byId("quantity").value = name;
      player.plotPanel.rebuild();
    },
    /** Adds a plot below the others, of the first quantity that none shows if not named. */
    addPlot(name = nextQuantity(player.plotPanel)) {
      if (name !== undefined) actions.showPlots([...player.plotPanel.further(), name]);
    },
    /** Shows plots of these quantities below the first. */
    showPlots(quantities) {
      player.plotPanel.showFurther(quantities.filter((name) => Object.hasOwn(plot.quantities, name)));
      state.marksDirty = true;
    },
  };
}
