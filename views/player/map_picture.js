// The map's two pictures: the ice, and what lies over it.

function makeMapPicture(player, [iceCanvas, markCanvas], forceScale, arrowScale) {
  const { run, state, view, places, motions, colourings, circlesOf, range } = player;
  const { info, floes } = run;
  const hasFrames = run.frames.times.length > 0;
  const start = startPlaces(run, motions, range[0]);
  const raster = makeFloeRaster();
  const drawStillAndMoving = makeStillIce(run, places, motions);
  const ice = iceCanvas.getContext("2d", { alpha: false });
  const marks = markCanvas.getContext("2d");

  function drawIce() {
    const { colours } = player;
    ice.resetTransform();
    ice.fillStyle = colours.water;
    ice.fillRect(0, 0, iceCanvas.width, iceCanvas.height);
    ice.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    if (state.layers.startIce) drawStartIce(ice, view, run, start, places, state.time, colours);
    if (state.layers.channel && hasFrames) drawChannels();
    const look = [view.x, view.y, view.scale, view.width, view.height, state.colourBy, colours.water].join();
    drawStillAndMoving(ice, view, look, state.time, Math.max(5, state.rate), (context, ids) =>
      drawFloes(context, view, run, places, raster, ids, colourings[state.colourBy], colours));
  }

  function drawChannels() {
    drawSweptBand(ice, view, run, motions, state.time, player.colours);
    player.legend.showWidths(info.ships.map((ship, index) => {
      const stations = stationsOf(run, places, motions, index, state.time);
      drawStations(ice, view, stations, player.colours);
      return widthWords(stations);
    }).filter(Boolean));
  }

  function outline(id) {
    marks.beginPath();
    traceFloe(marks, view, floes, places, id);
    marks.strokeStyle = player.colours.highlight;
    marks.lineWidth = 1.5;
    marks.stroke();
  }

  function drawMarks(shown) {
    const { colours } = player;
    marks.resetTransform();
    marks.clearRect(0, 0, markCanvas.width, markCanvas.height);
    marks.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    if (shown >= 0) drawLineage(marks, view, run, places, shown, state.time, colours);
    if (state.layers.fractures) drawFractures(marks, view, run, state.time, colours);
    if (state.selected >= 0 && state.hovered >= 0 && state.hovered !== shown && places.isAlive(state.hovered, state.time)) outline(state.hovered);
    drawShips(marks, view, run, motions, state.time, state.layers, colours);
    const notices = [];
    if (state.layers.circles) notices.push(drawCircles(marks, view, run, circlesOf, places, motions, colours));
    if (state.layers.forces) notices.push(drawContactForces(marks, view, run, motions, places, state.time, colours, forceScale));
    if (state.layers.velocities) drawVelocities(marks, view, run, places, motions, colours, arrowScale);
    if (state.event !== null) drawChosenEvent(marks, view, info.events[state.event], colours);
    drawScaleBar(marks, view, colours);
    byId("notice").textContent = hasFrames ? notices.filter(Boolean).join(" ") : "This run has no frames: the scene is shown as it starts.";
    byId("notice").hidden = byId("notice").textContent === "";
  }

  return { drawIce, drawMarks };
}
