// What is drawn over and under the ice: channel, ships, tracks, circles, velocities, lineage, marks, scale bar.

function traceRing(context, view, ring, x, y, heading) {
  const c = Math.cos(heading);
  const s = Math.sin(heading);
  ring.forEach(([px, py], k) => {
    const [sx, sy] = view.toScreen(x + c * px - s * py, y + s * px + c * py);
    if (k === 0) context.moveTo(sx, sy);
    else context.lineTo(sx, sy);
  });
  context.closePath();
}

/** The ship's poses up to now, near enough to each other that outlines overlap. */
function posesUpTo(run, motions, ship, spacing) {
  const poses = [];
  const add = (pose) => {
    const last = poses[poses.length - 1];
    if (!last) return poses.push(pose);
    const gap = Math.hypot(pose[0] - last[0], pose[1] - last[1]);
    const steps = Math.ceil(gap / spacing);
    for (let k = 1; k < steps; ++k) poses.push(last.map((v, i) => v + (k / steps) * (pose[i] - v)));
    return poses.push(pose);
  };
  for (let f = 0; f <= motions.frame() && f < run.frames.times.length; ++f) {
    const pose = Array.from(motions.shipInFrame(ship, f).subarray(0, 3));
    const last = poses[poses.length - 1];
    const isNear = last && Math.hypot(pose[0] - last[0], pose[1] - last[1]) < spacing / 8 && Math.abs(pose[2] - last[2]) < 0.01;
    if (!isNear) add(pose);
  }
  const now = motions.ship(ship);
  if (now) add(Array.from(now.subarray(0, 3)));
  return poses;
}

/** Open water that ships swept: their outlines painted over each other along their tracks. */
function drawSweptBand(context, view, run, motions, colours) {
  context.fillStyle = colours.swept;
  run.info.ships.forEach((ship, index) => {
    const xs = ship.waterline_m.map(([x]) => x);
    const length = Math.max(...xs) - Math.min(...xs);
    const poses = posesUpTo(run, motions, index, length / 8);
    for (let from = 0; from < poses.length; from += 16) {
      context.beginPath();
      for (const [x, y, heading] of poses.slice(from, from + 16)) traceRing(context, view, ship.waterline_m, x, y, heading);
      context.fill();
    }
  });
}

/** The polygons and lines of the run's channel.geojson, in place of the band. */
function drawChannel(context, view, channel, colours) {
  context.fillStyle = colours.swept;
  context.strokeStyle = colours.track;
  context.lineWidth = 1;
  const trace = (line) => line.forEach((point, k) => {
    const [x, y] = view.toScreen(point[0], point[1]);
    if (k === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
  const draw = (geometry) => {
    if (!geometry) return;
    const { type, coordinates, geometries } = geometry;
    if (type === "GeometryCollection") geometries.forEach(draw);
    const polygons = type === "Polygon" ? [coordinates] : type === "MultiPolygon" ? coordinates : [];
    const lines = type === "LineString" ? [coordinates] : type === "MultiLineString" ? coordinates : [];
    context.beginPath();
    for (const polygon of polygons) polygon.forEach(trace);
    if (polygons.length > 0) context.fill("evenodd");
    context.beginPath();
    lines.forEach(trace);
    if (lines.length > 0) context.stroke();
  };
  const features = channel.type === "FeatureCollection" ? channel.features : [channel];
  for (const feature of features) {
    if (feature.type === "Feature" && feature.properties && feature.properties.part === "station") continue;
    draw(feature.type === "Feature" ? feature.geometry : feature);
  }
}

function drawShips(context, view, run, motions, layers, colours) {
  run.info.ships.forEach((ship, index) => {
    const pose = motions.ship(index);
    if (!pose) return;
    if (layers.track) {
      context.beginPath();
      for (const [x, y] of posesUpTo(run, motions, index, Infinity)) context.lineTo(...view.toScreen(x, y));
      context.strokeStyle = colours.track;
      context.lineWidth = 2;
      context.setLineDash([8, 5]);
      context.stroke();
      context.setLineDash([]);
    }
    context.beginPath();
    traceRing(context, view, ship.waterline_m, pose[0], pose[1], pose[2]);
    context.fillStyle = colours.hull;
    context.fill();
    context.strokeStyle = colours["hull-edge"];
    context.lineWidth = 1.5;
    context.stroke();
    if (run.info.ships.length > 1) drawLabel(context, view, ship.name, pose, colours);
  });
}

function drawLabel(context, view, words, pose, colours) {
  const [x, y] = view.toScreen(pose[0], pose[1]);
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "center";
  context.lineWidth = 3;
  context.strokeStyle = colours.hull;
  context.strokeText(words, x, y + 4);
  context.fillStyle = "#ffffff";
  context.fillText(words, x, y + 4);
}

/** Contact circles of the floes and hulls on the screen. Returns what to tell where they are not drawn. */
function drawCircles(context, view, run, places, motions, colours) {
  const { columns, floes, info } = run;
  if (!info.has_circles) return "This page was written without contact circles.";
  if (info.circle_radius_m * view.scale < 1.5) return "Zoom in to see the contact circles.";
  const { circles_m: circles, circle_runs: runs, circle_runs_of: runsOf } = columns;
  context.strokeStyle = colours.accent;
  context.lineWidth = 0.8;
  const draw = (owner, x, y, c, s, dx, dy) => {
    context.beginPath();
    for (let r = runsOf[owner]; r < runsOf[owner + 1]; ++r) {
      for (let k = runs[2 * r]; k < runs[2 * r] + runs[2 * r + 1]; ++k) {
        const px = circles[3 * k] + dx;
        const py = circles[3 * k + 1] + dy;
        const wx = x + c * px - s * py;
        const wy = y + s * px + c * py;
        if (!view.shows(wx, wy, circles[3 * k + 2])) continue;
        const [sx, sy] = view.toScreen(wx, wy);
        const radius = circles[3 * k + 2] * view.scale;
        context.moveTo(sx + radius, sy);
        context.arc(sx, sy, radius, 0, 2 * Math.PI);
      }
    }
    context.stroke();
  };
  for (let n = 0; n < places.count; ++n) {
    const id = places.living[n];
    if (!view.shows(places.x[id], places.y[id], floes.reach[id])) continue;
    const oldest = floes.oldest[id];
    draw(id, places.x[id], places.y[id], places.cos[id], places.sin[id], floes.cx[oldest] - floes.cx[id],
      floes.cy[oldest] - floes.cy[id]);
  }
  context.strokeStyle = colours.highlight;
  info.ships.forEach((_, ship) => {
    const pose = motions.ship(ship);
    if (pose) draw(floes.count + ship, pose[0], pose[1], Math.cos(pose[2]), Math.sin(pose[2]), 0, 0);
  });
  return "";
}

/** Arrows along the floes' and ships' velocities, `perSpeed` pixels for 1 m/s. */
function drawVelocities(context, view, run, places, motions, colours, perSpeed) {
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.ink;
  context.lineWidth = 1.2;
  const arrow = (x, y, vx, vy) => {
    const length = Math.hypot(vx, vy) * perSpeed;
    if (length < 3) return;
    const [sx, sy] = view.toScreen(x, y);
    const ux = (vx * perSpeed) / length;
    const uy = (-vy * perSpeed) / length;
    const tip = Math.min(7, 0.5 * length);
    context.moveTo(sx, sy);
    context.lineTo(sx + length * ux, sy + length * uy);
    context.lineTo(sx + length * ux - tip * (ux + 0.5 * uy), sy + length * uy - tip * (uy - 0.5 * ux));
    context.moveTo(sx + length * ux, sy + length * uy);
    context.lineTo(sx + length * ux - tip * (ux - 0.5 * uy), sy + length * uy - tip * (uy + 0.5 * ux));
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

/** Of the floes whose centres show in the same square of the screen the largest, so that arrows can be told apart. */
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
  context.fillStyle = colours[kind];
  context.strokeStyle = "#ffffff";
  context.lineWidth = 1;
  context.beginPath();
  if (kind === "split") {
    context.moveTo(x, y - 1.3 * size);
    context.lineTo(x + 1.3 * size, y + size);
    context.lineTo(x - 1.3 * size, y + size);
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
    drawEventMark(context, ...view.toScreen(...event.point_m), event.kind, event.kind === "split" ? 6 : 3, colours);
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
