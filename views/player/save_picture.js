// Map and plot as PNG.

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
    const kind = [view.x, view.y, view.scale, view.width, view.height, state.colourBy, colours.water, state.sizes?.from,
      state.sizes?.below].join();
    const look = paleOutOfSizes(colourings[state.colourBy], run.floes, state.sizes, colours);
    drawStillAndMoving(ice, view, kind, state.time, Math.max(5, state.rate), (context, ids) =>
      drawFloes(context, view, run, places, raster, ids, look));
  };
}

/** What lies over the ice; gives what draws it, with the floe that is shown. */
function makeMarksPicture(player, canvas) {
  const { run, state, view, places, motions, circlesOf } = player;
  const marks = canvas.getContext("2d");
  const loadLine = makeLoadLine(run);

  function outline(id) {
    marks.beginPath();
    traceFloe(marks, view, run.floes, places, id);
    marks.strokeStyle = player.colours.highlight;
    marks.lineWidth = 1.5;
    marks.stroke();
  }

  function showNotices(notices) {
    const words = run.frames.times.length > 0
      ? notices.filter(Boolean).join(" ") : "This run has no frames: the scene is shown as it starts.";
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
    if (state.selected >= 0 && state.hovered >= 0 && state.hovered !== shown
      && places.isThere(state.hovered, state.time)) outline(state.hovered);
    drawShips(marks, view, run, motions, state.time, state.layers, colours);
    drawIceUnderHulls(marks, view, run, places, colours);
    if (places.under.includes(shown)) outline(shown);
    const notices = [player.isOver ? `This run ends at ${Number(player.range[1].toFixed(6))} s.` : ""];
    if (state.layers.circles) notices.push(drawCircles(marks, view, run, circlesOf, places, motions, colours));
    if (state.layers.forces) notices.push(drawContactForces(marks, view, run, motions, places, state.time, colours,
      player.forceScale));
    if (state.layers.largestLoads || state.layers.meanLoads)
      notices.push(drawLoadLine(marks, view, loadLine, motions, state.time, !state.layers.largestLoads));
    if (state.layers.velocities) drawVelocities(marks, view, run, places, motions, colours, player.arrowScale);
    if (state.event !== null) drawChosenEvent(marks, view, run.info.events[state.event], colours);
    if (player.plan) drawPlan(marks, player);
    drawScaleBar(marks, view, colours);
    showNotices(notices);
  };
}

// The map or the plot as a PNG file, each with what is needed to read it.

const pictureFont = (weight, size) => `${weight} ${size}px system-ui, "DejaVu Sans", sans-serif`;
const keyHeight = 20; // [px]

/** The items of a key, with their places in lines of a width [px]. */
function placedKey(context, items, width) {
  context.font = pictureFont(400, 12);
  let [x, y] = [14, 0];
  const placed = items.map((item) => {
    const wide = (item.mark ? 26 : 0) + context.measureText(item.words).width + 16;
    if (x > 14 && x + wide > width - 14) [x, y] = [14, y + keyHeight];
    x += wide;
    return { ...item, x: x - wide, y };
  });
  return { placed, height: items.length > 0 ? y + keyHeight + 8 : 0 };
}

function drawKey(context, { placed }, top, colours) {
  context.font = pictureFont(400, 12);
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const { x, y, words, mark, colour, border } of placed) {
    const middle = top + y + keyHeight / 2 + 2;
    if (mark === "box") {
      context.fillStyle = colour;
      context.strokeStyle = border;
      context.lineWidth = 1;
      context.fillRect(x, middle - 6, 20, 12);
      context.strokeRect(x + 0.5, middle - 5.5, 19, 11);
    } else if (mark === "line") {
      context.fillStyle = colour;
      context.fillRect(x, middle - 1, 20, 2);
    }
    context.fillStyle = colours.ink;
    context.fillText(words, x + (mark ? 26 : 0), middle);
  }
}

/** A picture of a width and height [px] under a title, over a key; `drawBody` draws what is between. */
function composePicture({ colours, name }, { width, height, ratio, title, key, drawBody }) {
  const canvas = make("canvas");
  const context = canvas.getContext("2d");
  const head = 34;
  const laid = placedKey(context, key, width);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round((head + height + laid.height) * ratio);
  context.scale(ratio, ratio);
  context.fillStyle = colours.panel;
  context.fillRect(0, 0, width, head + height + laid.height);
  context.save();
  context.translate(0, head);
  drawBody(context);
  context.restore();
  context.textBaseline = "middle";
  context.fillStyle = colours.ink;
  context.font = pictureFont(600, 14);
  context.textAlign = "left";
  context.fillText(name, 14, head / 2, Math.max(60, width - 40 - context.measureText(title).width));
  context.textAlign = "right";
  context.fillText(title, width - 14, head / 2);
  drawKey(context, laid, head + height, colours);
  return canvas;
}

/** What stands in the legend below the map. */
function legendItems() {
  return [...byId("legend").children].map((row) => {
    const swatch = row.querySelector("i");
    if (!swatch) return { words: `${row.textContent}:` };
    const style = getComputedStyle(swatch);
    return swatch.classList.contains("arrow") ? { mark: "line", colour: style.borderTopColor, words: row.textContent }
      : { mark: "box", colour: style.backgroundColor, border: style.borderTopColor, words: row.textContent };
  });
}

function mapPicture(player) {
  const { view, state } = player;
  return composePicture(player, {
    width: view.width, height: view.height, ratio: view.ratio, title: `${state.time.toFixed(1)} s`, key: legendItems(),
    drawBody: (context) => {
      for (const id of ["ice", "marks"]) context.drawImage(byId(id), 0, 0, view.width, view.height);
    },
  });
}

/** The curves or areas of the plot and their values at the present time. */
function curveItems({ plot, run, state }) {
  const ships = plot.ships();
  return plot.shownCurves().flatMap((curve) => ships.map((ship) => {
    const colour = curve.isArea ? plot.colours[`cause-${curve.kind}`] : curveStyle(curve, ship, run.info.ships.length,
      plot.colours).stroke;
    const at = plot.valueAt(ship, curve, state.time);
    const name = [ships.length > 1 ? run.info.ships[ship].name : "", curve.label
      || plot.shownQuantity().label].filter(Boolean).join(" ");
    return { mark: curve.isArea ? "box" : "line", colour, border: plot.colours.line, words: at
      ? `${name} ${valueWords(at.value, curve.base)}` : name };
  }));
}

function plotPicture(player) {
  const { plot, state } = player;
  const { chart, host } = plot;
  const [width, height] = [host.clientWidth, host.clientHeight];
  return composePicture(player, {
    width, height, ratio: chart.ctx.canvas.width / width,
      title: `${plot.shownQuantity().label}, ${state.time.toFixed(1)} s`, key: curveItems(player),
    drawBody: (context) => {
      context.drawImage(chart.ctx.canvas, 0, 0, width, height);
      const { offsetLeft: left, offsetTop: top, offsetWidth: across, offsetHeight: down } = chart.over;
      const [from, until] = plot.span;
      context.fillStyle = plot.colours.highlight;
      if (!plot.now.hidden) context.fillRect(left + ((state.time - from) / (until - from || 1)) * across - 1, top, 2,
        down);
      if (plot.offScale.hidden) return;
      context.font = pictureFont(400, 11);
      context.fillStyle = plot.colours.muted;
      context.textAlign = "right";
      context.textBaseline = "bottom";
      context.fillText(plot.offScale.querySelector(".long").textContent, left + across, top - 3, across);
    },
  });
}

/** Offers a picture as a file of that kind. */
function savePicture({ name: run, state }, canvas, kind) {
  const name = `${run}-${state.time.toFixed(1)}s-${kind}.png`.replace(/[^\w.-]+/g, "_");
  canvas.toBlob((blob) => {
    const link = make("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    showToast(`saved ${name}`);
  });
}
