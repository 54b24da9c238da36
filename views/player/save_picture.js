// Draws the map, and saves the map and the plots as PNG.

// The map has two pictures: the ice, and everything above it.

/** Returns a function that draws the ice and the channels. The picture of ice that hardly moves (draw_ice.js) is made
 * for the next second of playback, but at least for 5 s of the run. For a longer time it would be made more rarely, but
 * more floes would move in that time and be drawn at each refresh. */
function makeIcePicture(player, canvas) {
  const { run, state, view, places, motions, colourings, range } = player;
  const start = startPlaces(run, motions, range[0]);
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
    const kind = [view.x, view.y, view.scale, view.width, view.height, state.colourBy, colours.water,
      state.sizes?.from, state.sizes?.below].join();
    const look = paleOutOfSizes(colourings[state.colourBy], run.floes, state.sizes, colours);
    drawStillAndMoving(ice, view, kind, state.time, Math.max(5, state.rate), (context, ids) =>
      drawFloes(context, view, run, places, ids, look));
  };
}

/** Returns a function that draws everything above the ice. Its argument is the highlighted floe, −1 for none. A notice
 * says so if the run has no data for the layers of forces or loads. Tests read the places of names from
 * player.namesAt(). */
function makeMarksPicture(player, canvas) {
  const { run, state, view, places, motions, loadLine } = player;
  const marks = canvas.getContext("2d");
  const placeNames = makeNamePlacer();

  function outline(id) {
    marks.strokeStyle = player.colours.highlight;
    onMap(marks, view, { width: 1.5 }, () => drawFloe(marks, view, run, places, id, "stroke"));
  }

  function showNotices(notices) {
    const words = run.frames.times.length > 0 ? notices.filter(Boolean).join(" ")
      : "This run has no frames: the scene is shown as it starts.";
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
    const isOther = state.selected >= 0 && state.hovered >= 0 && state.hovered !== shown;
    if (isOther && places.isThere(state.hovered, state.time)) outline(state.hovered);
    drawShips(marks, view, run, motions, state.time, state.layers, colours);
    drawIceUnderHulls(marks, view, run, places, colours);
    if (state.ship >= 0) drawChosenShip(marks, view, run.info.ships[state.ship], motions.ship(state.ship), colours);
    if (places.under.includes(shown)) outline(shown);
    const notices = [player.isOver ? `This run ends at ${Number(player.range[1].toFixed(6))} s.` : ""];
    if (state.layers.forces)
      notices.push(drawContactForces(marks, view, run, motions, places, state.time, colours, player.forceScale));
    if (state.layers.largestLoads || state.layers.meanLoads)
      notices.push(drawLoadLine(marks, view, loadLine, motions, state.time, !state.layers.largestLoads));
    if (state.layers.velocities) drawVelocities(marks, view, run, places, motions, colours, player.arrowScale);
    if (state.event !== null) drawChosenEvent(marks, view, run.info.events[state.event], colours);
    if (player.plan) drawPlan(marks, player);
    const hasNames = player.plan || run.info.ships.length > 1;
    const names = hasNames ? placeNames(marks, view, shipsOnScreen(view, run, motions), colours) : [];
    player.namesAt = () => names;
    if (state.ruler) drawRuler(marks, view, state.ruler, colours);
    drawScaleBar(marks, view, colours);
    showNotices(notices);
  };
}

// PNG files of the map or the plots, with the title above and the legend below, which are drawn as the page shows them.

/** Draws colour samples, text and lines of an element of the page into a picture, at `place` [px] from its left and
 * top. */
function drawElement(context, element, [left, top]) {
  const origin = element.getBoundingClientRect();
  const walker = document.createTreeWalker(element);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const range = document.createRange();
    range.selectNode(node);
    const style = getComputedStyle(node.parentElement);
    if (!node.parentElement.checkVisibility()) continue;
    if (node.nodeName === "I") {
      const { backgroundColor, borderTopColor, borderTopWidth } = getComputedStyle(node);
      const { x, y, width, height } = node.getBoundingClientRect();
      context.fillStyle = borderTopColor;
      context.fillRect(left + x - origin.x, top + y - origin.y, width, height);
      const rim = parseFloat(borderTopWidth);
      context.fillStyle = backgroundColor;
      if (height > 2 * rim)
        context.fillRect(left + x - origin.x + rim, top + y - origin.y + rim, width - 2 * rim, height - 2 * rim);
    } else if (node.nodeName === "#text" && node.data.trim()) {
      const { x, y, height } = range.getBoundingClientRect();
      context.font = `${style.fontWeight} ${style.fontSize} system-ui, "DejaVu Sans", sans-serif`;
      context.fillStyle = style.color;
      context.textAlign = "left";
      context.textBaseline = "middle";
      context.fillText(node.data.trim(), left + x - origin.x, top + y - origin.y + height / 2);
    }
  }
}

/** Returns a picture with a title above and a legend, `key`, below. `drawBody` draws the part between, which is `width`
 * × `height` [px]. */
function composePicture({ colours, name }, { width, height, title, key, drawBody }) {
  const canvas = make("canvas");
  const head = 34;
  const all = head + height + key.offsetHeight + 8;
  const context = clearedCanvas(canvas, width, all);
  context.fillStyle = colours.panel;
  context.fillRect(0, 0, width, all);
  context.save();
  context.translate(0, head);
  drawBody(context);
  context.restore();
  drawElement(context, key, [0, head + height + 4]);
  context.fillStyle = colours.ink;
  context.textBaseline = "middle";
  context.font = '600 14px system-ui, "DejaVu Sans", sans-serif';
  context.textAlign = "left";
  context.fillText(name, 14, head / 2, Math.max(60, width - 40 - context.measureText(title).width));
  context.textAlign = "right";
  context.fillText(title, width - 14, head / 2);
  return canvas;
}

const mapPicture = (player) => composePicture(player, {
  width: player.view.width, height: player.view.height, title: `${player.state.time.toFixed(1)} s`, key: byId("legend"),
  drawBody: (context) => {
    for (const id of ["ice", "marks"]) context.drawImage(byId(id), 0, 0, player.view.width, player.view.height);
  },
});

/** Returns a picture of one plot and its legend. */
function pictureOfPlot(player, { plot, key }) {
  const { chart, host } = plot;
  const [width, height] = [host.clientWidth, host.clientHeight];
  return composePicture(player, {
    width, height, title: `${plot.shownQuantity().label}, ${player.state.time.toFixed(1)} s`, key,
    drawBody: (context) => {
      context.drawImage(chart.ctx.canvas, 0, 0, width, height);
      const { offsetLeft: left, offsetTop: top, offsetWidth: across, offsetHeight: down } = chart.over;
      const [from, until] = plot.span;
      context.fillStyle = plot.colours.highlight;
      const now = left + ((player.state.time - from) / (until - from || 1)) * across;
      if (!plot.now.hidden) context.fillRect(now - 1, top, 2, down);
      if (!plot.offScale.hidden) drawElement(context, plot.offScale, [left, top - plot.offScale.offsetHeight]);
    },
  });
}

/** Returns a picture of all plots, one below the other. */
function plotPicture(player) {
  const pictures = player.plotPanel.views.map((view) => pictureOfPlot(player, view));
  if (pictures.length === 1) return pictures[0];
  const canvas = make("canvas");
  canvas.width = Math.max(...pictures.map(({ width }) => width));
  canvas.height = pictures.reduce((sum, { height }) => sum + height, 0);
  const context = canvas.getContext("2d");
  context.fillStyle = player.colours.panel;
  context.fillRect(0, 0, canvas.width, canvas.height);
  let top = 0;
  for (const picture of pictures) {
    context.drawImage(picture, 0, top);
    top += picture.height;
  }
  return canvas;
}

/** Offers a picture for download. `kind` is part of its file name. */
function savePicture({ name: run, state }, canvas, kind) {
  const name = `${run}-${state.time.toFixed(1)}s-${kind}.png`.replace(/[^\w.-]+/g, "_");
  canvas.toBlob((blob) => {
    const link = make("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    showToast(`saved ${name}`);
  });
}
