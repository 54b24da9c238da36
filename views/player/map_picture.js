// The map's two pictures: the ice, and what lies over it.

/** The ice and the channels; gives what draws them. */
function makeIcePicture(player, canvas) {
  const { run, state, view, places, motions, colourings, range } = player;
  const start = startPlaces(run, motions, range[0]);
  const raster = new FloeRaster();
  const drawStillAndMoving = makeStillIce(run, places, motions);
  const ice = canvas.getContext("2d", { alpha: false });

  function drawChannels() {
    drawSweptBand(ice, view, run, motions, state.time, player.colours);
    player.legend.showWidths(run.info.ships.map((ship, index) => {
      const stations = stationsOf(run, index, state.time);
      drawStations(ice, view, stations, player.colours);
      return widthWords(stations);
    }).filter(Boolean));
  }

  return () => {
    const { colours } = player;
    ice.resetTransform();
    ice.fillStyle = colours.water;
    ice.fillRect(0, 0, canvas.width, canvas.height);
    ice.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    if (state.layers.startIce) drawStartIce(ice, view, run, start, places, state.time, colours);
    if (state.layers.channel && run.frames.times.length > 0) drawChannels();
    const kind = [view.x, view.y, view.scale, view.width, view.height, state.colourBy, colours.water, state.sizes?.from, state.sizes?.below].join();
    const look = paleOutOfSizes(colourings[state.colourBy], run.floes, state.sizes, colours);
    drawStillAndMoving(ice, view, kind, state.time, Math.max(5, state.rate), (context, ids) =>
      drawFloes(context, view, run, places, raster, ids, look));
  };
}

/** What lies over the ice; gives what draws it, with the floe that is shown. */
function makeMarksPicture(player, canvas) {
  const { run, state, view, places, motions, circlesOf } = player;
  const marks = canvas.getContext("2d");

  function outline(id) {
    marks.beginPath();
    traceFloe(marks, view, run.floes, places, id);
    marks.strokeStyle = player.colours.highlight;
    marks.lineWidth = 1.5;
    marks.stroke();
  }

  function showNotices(notices) {
    const words = run.frames.times.length > 0 ? notices.filter(Boolean).join(" ") : "This run has no frames: the scene is shown as it starts.";
    byId("notice").textContent = words;
    byId("notice").hidden = words === "";
  }

  return (shown) => {
    const { colours } = player;
    marks.resetTransform();
    marks.clearRect(0, 0, canvas.width, canvas.height);
    marks.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    if (shown >= 0) drawLineage(marks, view, run, places, shown, state.time, colours);
    if (state.layers.fractures) drawFractures(marks, view, run, state.time, colours);
    if (state.selected >= 0 && state.hovered >= 0 && state.hovered !== shown && places.isThere(state.hovered, state.time)) outline(state.hovered);
    drawShips(marks, view, run, motions, state.time, state.layers, colours);
    drawIceUnderHulls(marks, view, run, places, colours);
    if (places.under.includes(shown)) outline(shown);
    const notices = [player.isOver ? `This run ends at ${Number(player.range[1].toFixed(6))} s.` : ""];
    if (state.layers.circles) notices.push(drawCircles(marks, view, run, circlesOf, places, motions, colours));
    if (state.layers.forces) notices.push(drawContactForces(marks, view, run, motions, places, state.time, colours, player.forceScale));
    if (state.layers.velocities) drawVelocities(marks, view, run, places, motions, colours, player.arrowScale);
    if (state.event !== null) drawChosenEvent(marks, view, run.info.events[state.event], colours);
    drawScaleBar(marks, view, colours);
    showNotices(notices);
  };
}
