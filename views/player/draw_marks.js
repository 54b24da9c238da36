// What is drawn over the ice besides ships: velocities, lineage, marks, scale bar.

/** Arrows along the floes' and ships' velocities, `perSpeed` pixels for 1 m/s. */
function drawVelocities(context, view, run, places, motions, colours, perSpeed) {
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.ink;
  context.lineWidth = 1.2;
  const arrow = (x, y, vx, vy) => {
    const length = Math.hypot(vx, vy) * perSpeed;
    if (length >= 3) traceArrow(context, ...view.toScreen(x, y), vx, vy, length);
  };
  context.beginPath();
  for (const id of largestPerCell(view, run.floes, places)) arrow(places.x[id], places.y[id], places.vx[id], places.vy[id]);
  context.stroke();
  context.strokeStyle = colours["hull-edge"];
  context.lineWidth = 2;
  context.beginPath();
  run.info.ships.forEach((_, ship) => {
    const pose = motions.ship(ship);
    if (pose) arrow(pose[0], pose[1], pose[3], pose[4]);
  });
  context.stroke();
}

const arrowCell = 24; // [px]

/** Of the floes whose centres show in the same square of the screen the largest, so that arrows stay apart. */
function largestPerCell(view, floes, places) {
  const cells = new Map();
  const cell = arrowCell / view.scale; // fixed in the world, so that arrows do not flicker as the map moves
  for (let n = 0; n < places.count; ++n) {
    const id = places.living[n];
    if (!view.shows(places.x[id], places.y[id], cell)) continue;
    const key = Math.floor(places.x[id] / cell) * 1e6 + Math.floor(places.y[id] / cell);
    const other = cells.get(key);
    if (other === undefined || floes.area[id] > floes.area[other]) cells.set(key, id);
  }
  return cells.values();
}

/** The floe's family: pieces of the same floe of the scene tinted, its ancestors' outlines, itself outlined. */
function drawLineage(context, view, run, places, id, time, colours) {
  const { floes } = run;
  if (!places.isAlive(id, time)) places.place(id);
  context.fillStyle = colours.family;
  for (let n = 0; n < places.count; ++n) {
    const other = places.living[n];
    if (other === id || floes.oldest[other] !== floes.oldest[id]) continue;
    if (!view.shows(places.x[other], places.y[other], floes.reach[other])) continue;
    context.beginPath();
    traceFloe(context, view, floes, places, other);
    context.fill();
  }
  drawAncestors(context, view, run, places, id, colours);
  context.beginPath();
  traceFloe(context, view, floes, places, id);
  context.lineWidth = 3;
  context.strokeStyle = colours.highlight;
  if (!places.isAlive(id, time)) context.setLineDash([3, 3]);
  context.stroke();
  context.setLineDash([]);
}

/** Ancestors share the floe's body frame: its pose places them. */
function drawAncestors(context, view, run, places, id, colours) {
  const { floes } = run;
  const ghost = { x: {}, y: {}, cos: {}, sin: {} };
  context.strokeStyle = colours.highlight;
  context.lineWidth = 1;
  context.setLineDash([5, 4]);
  let drawn = 0;
  for (let a = floes.parent[id]; a >= 0 && drawn < 40; a = floes.parent[a], ++drawn) {
    const dx = floes.cx[a] - floes.cx[id];
    const dy = floes.cy[a] - floes.cy[id];
    ghost.x[a] = places.x[id] + places.cos[id] * dx - places.sin[id] * dy;
    ghost.y[a] = places.y[id] + places.sin[id] * dx + places.cos[id] * dy;
    ghost.cos[a] = places.cos[id];
    ghost.sin[a] = places.sin[id];
    context.beginPath();
    traceFloe(context, view, floes, ghost, a);
    context.stroke();
  }
  context.setLineDash([]);
}

function drawEventMark(context, x, y, kind, size, colours) {
  context.fillStyle = colours[kind] ?? colours["under-hull"];
  context.strokeStyle = "#ffffff";
  context.lineWidth = 1;
  context.beginPath();
  if (kind === "split") {
    context.moveTo(x, y - 1.3 * size);
    context.lineTo(x + 1.3 * size, y + size);
    context.lineTo(x - 1.3 * size, y + size);
    context.closePath();
  } else if (kind === "mooring_break") {
    context.moveTo(x, y - 1.4 * size);
    context.lineTo(x + 1.4 * size, y);
    context.lineTo(x, y + 1.4 * size);
    context.lineTo(x - 1.4 * size, y);
    context.closePath();
  } else if (kind === "bend") {
    context.arc(x, y, size, 0, 2 * Math.PI);
  } else {
    context.rect(x - size, y - size, 2 * size, 2 * size);
  }
  context.fill();
  context.stroke();
}

function drawFractures(context, view, run, time, colours) {
  for (const event of run.info.events) {
    if (event.t_s > time) break;
    if (isMarked(event)) drawEventMark(context, ...view.toScreen(...event.point_m), event.kind, isAbove(event) ? 6 : 3, colours);
  }
}

function drawChosenEvent(context, view, event, colours) {
  const [x, y] = view.toScreen(...event.point_m);
  context.strokeStyle = colours.highlight;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(x, y, 13, 0, 2 * Math.PI);
  context.stroke();
  drawEventMark(context, x, y, event.kind, 5, colours);
}

function drawScaleBar(context, view, colours) {
  const length = roundBelow(Math.min(180, view.width / 4) / view.scale);
  const pixels = length * view.scale;
  const x = view.width - pixels - 16;
  const y = view.height - 16;
  const words = length >= 1000 ? `${length / 1000} km` : `${Number(length.toPrecision(3))} m`;
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "center";
  context.globalAlpha = 0.85;
  context.fillStyle = colours.panel;
  context.fillRect(x - 8, y - 22, pixels + 16, 30);
  context.globalAlpha = 1;
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.ink;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + pixels, y);
  context.lineTo(x + pixels, y - 5);
  context.stroke();
  context.fillText(words, x + pixels / 2, y - 8);
}
