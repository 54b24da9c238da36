// The player: what is shown, and how it changes.

const rates = [0.5, 1, 2, 5, 10, 20, 50, 100];

function startPlayer() {
  const run = readRun();
  const { info, frames, floes } = run;
  run.breakOf = new Map();
  info.events.forEach((event, index) => { if (event.kind !== "rejected_cut") run.breakOf.set(event.floe, index); });
  const hasFrames = frames.times.length > 0;
  const range = hasFrames ? [frames.times[0], frames.times[frames.times.length - 1]] : [0, 0];
  const motions = makeMotions(run);
  const places = makePlaces(run, motions);
  run.carry = makeCarrier(info.water);
  const start = startPlaces(run, motions, range[0]);
  const raster = makeFloeRaster();
  const circlesOf = makeCircleSampler(run);
  const drawStillAndMoving = makeStillIce(run, places, motions);
  const colourings = makeColourings(run);
  const stage = byId("stage");
  const [iceCanvas, markCanvas] = [byId("ice"), byId("marks")];
  const view = makeMapView(stage, [iceCanvas, markCanvas]);
  const ice = iceCanvas.getContext("2d", { alpha: false });
  const marks = markCanvas.getContext("2d");
  const isUnderWay = (carry) => hasFrames && info.ships.some((_, ship) => hasGone(run, motions, ship, carry));
  const state = {
    time: range[0], isPlaying: false, rate: defaultRate(range[1] - range[0]), selected: -1, hovered: -1, event: null,
    follow: -1, colourBy: "generation", isFitted: true,
    layers: { channel: isUnderWay(run.carry), startIce: isUnderWay((x, y) => [x, y]), track: true, circles: false, velocities: false, forces: false, fractures: false },
    iceDirty: true, marksDirty: true,
  };
  let colours = themeColours();
  const box = extentOf(run, motions, places, range);
  const plot = makePlot(run, byId("plot"), (time) => actions.goTo(time), (left, width) => {
    timeline.place(left, width, colours);
    state.iceDirty = true;
  });

  const actions = {
    goTo(time) {
      state.time = Math.min(range[1], Math.max(range[0], time));
      state.iceDirty = true;
    },
    goToEnd: (isEnd) => actions.goTo(isEnd ? range[1] : range[0]),
    play(isPlaying) {
      if (isPlaying && state.time >= range[1]) state.time = range[0];
      state.isPlaying = isPlaying && range[1] > range[0];
      byId("play").setAttribute("aria-pressed", String(state.isPlaying));
      byId("play").setAttribute("aria-label", state.isPlaying ? "Pause" : "Play");
      state.iceDirty = true;
    },
    togglePlay: () => actions.play(!state.isPlaying),
    stepFrames(count) {
      const at = lastAtMost(frames.times, state.time + 1e-9);
      const next = count < 0 && state.time - frames.times[at] > 1e-9 ? at + 1 + count : at + count;
      actions.goTo(frames.times[Math.min(frames.times.length - 1, Math.max(0, next))] ?? 0);
    },
    goToEvent(index) {
      const event = info.events[index];
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
    stepEvent(step) {
      const { events } = info;
      let index = state.event;
      if (index === null || Math.abs(events[index].t_s - state.time) > 1e-6) {
        const after = events.findIndex((event) => event.t_s > state.time);
        index = step > 0 ? (after < 0 ? events.length : after) : (after < 0 ? events.length : after) - 1;
      } else index += step;
      actions.goToEvent(Math.min(events.length - 1, Math.max(0, index)));
    },
    setRate(rate) {
      state.rate = rate;
      byId("rate").value = String(rate);
    },
    changeRate(step) {
      const at = rates.indexOf(state.rate) + step;
      actions.setRate(rates[Math.min(rates.length - 1, Math.max(0, at))]);
    },
    pan(dx, dy) {
      view.panBy(dx, dy);
      if (state.follow >= 0) actions.setFollow(-1);
      state.isFitted = false;
      state.iceDirty = true;
    },
    zoom(px, py, factor) {
      view.zoomAt(px, py, factor);
      state.isFitted = false;
      state.iceDirty = true;
    },
    zoomCentre: (factor) => actions.zoom(view.width / 2, view.height / 2, factor),
    fit() {
      actions.setFollow(-1);
      view.fit(box);
      state.isFitted = true;
      state.iceDirty = true;
    },
    follow: () => actions.setFollow(state.follow + 1 < info.ships.length ? state.follow + 1 : -1),
    setFollow(ship) {
      state.follow = ship;
      byId("follow").setAttribute("aria-pressed", String(ship >= 0));
      if (ship >= 0 && state.isFitted) {
        const hull = info.ships[ship].waterline_m.map(([x]) => x);
        const length = Math.max(...hull) - Math.min(...hull);
        view.scale = Math.max(view.scale, Math.min(view.width, view.height) / (2.2 * length));
        state.isFitted = false;
      }
      state.iceDirty = true;
    },
    colourBy(what) {
      state.colourBy = what;
      byId(`by-${what}`).checked = true;
      showLegend();
      state.iceDirty = true;
    },
    toggleLayer(name, isOn = !state.layers[name]) {
      state.layers[name] = isOn;
      byId(`layer-${name}`).checked = isOn;
      showLegend();
      state.iceDirty = true;
    },
    select(id) {
      state.selected = id;
      state.marksDirty = true;
      cardShown = null;
    },
    /** Chooses a floe and goes to where it lives, if that is not now. */
    visit(id) {
      if (!places.isAlive(id, state.time)) {
        actions.play(false);
        actions.goTo(Math.max(range[0], floes.born[id]));
      }
      actions.select(id);
    },
    hover(px, py) {
      const found = floeAt(run, places, ...view.toWorld(px, py));
      stage.style.cursor = found >= 0 ? "pointer" : "";
      if (found === state.hovered) return;
      state.hovered = found;
      state.marksDirty = true;
    },
    click(px, py) {
      const found = floeAt(run, places, ...view.toWorld(px, py));
      state.hovered = found;
      actions.select(found === state.selected ? -1 : found);
    },
    leave() {
      state.hovered = -1;
      state.marksDirty = true;
    },
    letGo() {
      if (byId("help").open) return byId("help").close();
      state.event = null;
      showEventCard(byId("event-card"), run, null);
      return actions.select(-1);
    },
    toggleTheme() {
      const isDark = getComputedStyle(document.documentElement).colorScheme.includes("dark");
      document.documentElement.dataset.theme = isDark ? "light" : "dark";
      refreshTheme();
    },
    toggleHelp() {
      const help = byId("help");
      if (help.open) help.close();
      else help.showModal();
    },
  };

  function refreshTheme() {
    colours = themeColours();
    if (info.ships.length > 0) plot.build(colours, range);
    else timeline.place(8, byId("track-row").clientWidth - 16, colours);
    showLegend();
    state.iceDirty = true;
  }

  function resize() {
    view.resize();
    if (state.isFitted) view.fit(box);
    refreshTheme();
  }

  const forceScale = 40 / (typicalForce(run) || 1); // [px/N]
  const channelWidth = make("output", { id: "channel-width" });
  const arrowScale = () => {
    const { edges } = colourings.speed;
    return 40 / (edges[edges.length - 1] || 1);
  };

  function showLegend() {
    const colouring = colourings[state.colourBy];
    const rows = colouring.words.map((words, k) => legendRow(colouring.colours[k], words));
    if (state.colourBy === "size") rows.reverse();
    if (state.layers.startIce) rows.push(legendRow(colours["start-ice"], "ice at the start"));
    if (state.layers.channel) rows.push(legendRow(colours.swept, "swept by the hull"), legendRow(colours.channel, "open from ice to ice ", channelWidth));
    if (state.layers.velocities) rows.push(velocityRow());
    if (state.layers.forces) rows.push(...forceRows());
    byId("legend").replaceChildren(make("b", {}, colouring.title), ...rows);
  }
  function legendRow(colour, ...words) {
    const swatch = make("i");
    swatch.style.background = colour;
    return make("span", {}, swatch, ...words);
  }
  function arrowRow(pixels, words) {
    const arrow = make("i", { class: "arrow" });
    arrow.style.width = `${pixels}px`;
    return make("span", {}, arrow, words);
  }
  function velocityRow() {
    const speed = roundBelow(60 / arrowScale());
    return arrowRow(speed * arrowScale(), `${Number(speed.toPrecision(2))} m/s`);
  }
  function forceRows() {
    const force = roundBelow(60 / forceScale);
    const unit = loadUnit(force, "N");
    return [arrowRow(force * forceScale, `${shortNumber(force * unit.factor)} ${unit.name}`),
      legendRow(colours.split, "crushing"), legendRow(colours.bend, "not crushing")];
  }

  function drawAllIce() {
    ice.resetTransform();
    ice.fillStyle = colours.water;
    ice.fillRect(0, 0, iceCanvas.width, iceCanvas.height);
    ice.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    if (state.layers.startIce) drawStartIce(ice, view, run, start, places, state.time, colours);
    if (state.layers.channel && hasFrames) drawChannels();
    const look = [view.x, view.y, view.scale, view.width, view.height, state.colourBy, colours.water].join();
    drawStillAndMoving(ice, view, look, state.time, Math.max(5, state.rate), (context, ids) =>
      drawFloes(context, view, run, places, raster, ids, colourings[state.colourBy], state.colourBy, colours));
  }

  function drawChannels() {
    drawSweptBand(ice, view, run, motions, state.time, colours);
    const words = info.ships.map((ship, index) => {
      const stations = stationsOf(run, places, motions, index, state.time);
      drawStations(ice, view, stations, colours);
      return widthWords(stations);
    }).filter(Boolean);
    channelWidth.textContent = words.length > 0 ? words.join("; ") : "";
  }

  function drawAllMarks() {
    marks.resetTransform();
    marks.clearRect(0, 0, markCanvas.width, markCanvas.height);
    marks.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    const shown = shownFloe();
    if (shown >= 0) drawLineage(marks, view, run, places, shown, state.time, colours);
    if (state.layers.fractures) drawFractures(marks, view, run, state.time, colours);
    if (state.selected >= 0 && state.hovered >= 0 && state.hovered !== shown && places.isAlive(state.hovered, state.time)) outline(state.hovered);
    drawShips(marks, view, run, motions, state.time, state.layers, colours);
    const notices = [];
    if (state.layers.circles) notices.push(drawCircles(marks, view, run, circlesOf, places, motions, colours));
    if (state.layers.forces) notices.push(drawContactForces(marks, view, run, motions, places, state.time, colours, forceScale));
    if (state.layers.velocities) drawVelocities(marks, view, run, places, motions, colours, arrowScale());
    if (state.event !== null) drawChosenEvent(marks, view, info.events[state.event], colours);
    drawScaleBar(marks, view, colours);
    byId("notice").textContent = hasFrames ? notices.filter(Boolean).join(" ") : "This run has no frames: the scene is shown as it starts.";
    byId("notice").hidden = byId("notice").textContent === "";
  }
  function outline(id) {
    marks.beginPath();
    traceFloe(marks, view, floes, places, id);
    marks.strokeStyle = colours.highlight;
    marks.lineWidth = 1.5;
    marks.stroke();
  }

  const chosenFloe = () => (state.selected >= 0 ? state.selected : state.hovered);
  const shownFloe = () => (chosenFloe() < 0 ? -1 : standIn(run, places, chosenFloe(), state.time));

  let cardShown = null;
  function showCard() {
    const id = shownFloe();
    const key = `${id} ${state.time}`;
    if (key === cardShown) return;
    cardShown = key;
    const host = byId("floe-card");
    if (host.contains(document.activeElement) && state.isPlaying) return;
    showFloeCard(host, run, places, motions, chosenFloe(), id, state.time, actions);
    const chip = byId("chip");
    chip.hidden = id < 0;
    if (id < 0) return;
    const facts = floeFacts(run, places, motions, id);
    chip.textContent = `floe ${id} \u00b7 ${sixDigits(floes.area[id])} m\u00b2 \u00b7 ${places.isAlive(id, state.time) ? facts.speed[0] : "not alive now"}`;
  }

  function showNumbers() {
    const words = `${state.time.toFixed(1)} s`;
    byId("now").textContent = words;
    byId("living").textContent = String(places.count);
    byId("living-word").textContent = places.count === 1 ? "floe" : "floes";
    plot.setTime(state.time);
    timeline.setTime(state.time, `${words}, ${places.count} floes`);
    const values = info.ships.map((ship, k) => {
      const at = plot.valueAt(k, state.time);
      const words = at ? plot.words(at.value) : "\u2013";
      const item = make("span", { "data-value": at ? String(at.value) : "", "data-time": at ? String(at.time) : "" }, info.ships.length > 1 ? `${ship.name} ${words}` : words);
      item.style.color = info.ships.length > 1 ? shipColour(colours, k) : "";
      return item;
    });
    byId("load-now").replaceChildren(...values);
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
      if (state.follow >= 0) followShip();
      drawAllIce();
      showNumbers();
    }
    if (state.iceDirty || state.marksDirty) {
      drawAllMarks();
      showCard();
    }
    state.iceDirty = state.marksDirty = false;
    if (isDrawn) {
      ++player.drawn;
      if (player.drawTimes.push(performance.now() - before) > 2000) player.drawTimes.length = 0;
    }
    requestAnimationFrame(frame);
  }
  function followShip() {
    const pose = motions.ship(state.follow);
    if (pose) [view.x, view.y] = pose;
  }

  // For tests and measurements; nothing here is needed to look at a run.
  const player = {
    run, state, view, places, motions, plot, actions, drawn: 0, drawTimes: [],
    stations: (ship) => stationsOf(run, places, motions, ship, state.time),
    circlesOf,
    contacts: () => contactsOfFrame(run, motions.frame()),
  };
  const timeline = makeTimeline(run, byId("track"), range, actions);
  fillPage(run, range, state, plot, actions, refreshTheme);
  watchGestures(stage, view, actions);
  watchKeys(actions);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refreshTheme);
  new ResizeObserver(resize).observe(stage);
  resize();
  actions.select(-1);
  showEventCard(byId("event-card"), run, null);
  requestAnimationFrame(frame);
  return player;
}

/** Half a minute for the whole run. */
function defaultRate(duration) {
  return rates.find((rate) => duration / rate <= 40) ?? rates[rates.length - 1];
}
