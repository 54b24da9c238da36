// What stands above the ice on the map: contacts, marks of fractures, arrows, ships.

// The contacts recorded at frames (contacts.csv) and their forces.

/** The contacts recorded at a frame. */
function contactsOfFrame({ columns, frames }, frame) {
  const times = columns.contact_t_s;
  const at = frames.times[frame];
  let row = lastAtMost(times, at);
  while (row >= 0 && times[row] === at) --row;
  const contacts = [];
  for (++row; times[row] === at; ++row) {
    contacts.push({ ship: columns.contact_ship[row], floe: columns.contact_floe[row],
      byFloe: columns.contact_by_floe[row],
      x: columns.contact_x_m[row], y: columns.contact_y_m[row], fx: columns.contact_fx_N[row],
        fy: columns.contact_fy_N[row],
      isCrushing: columns.contact_is_crushing[row] });
  }
  return contacts;
}

/** A force of which one contact in twenty is larger [N]; 0 where nothing presses. */
function typicalForce({ columns }) {
  const sizes = Float64Array.from(columns.contact_fx_N, (fx, row) => Math.hypot(fx,
    columns.contact_fy_N[row])).filter((size) => size > 0).sort();
  return sizes.length > 0 ? sizes[Math.floor(0.95 * (sizes.length - 1))] : 0;
}

/** How a body has moved since a frame; null for a floe that broke since. */
function moveSince(run, motions, places, frame, ship, floe, time) {
  if (ship < 0) {
    const duration = time - run.frames.times[frame];
    if (!places.isAlive(floe, time)) return null;
    return (x, y) => [x + duration * places.vx[floe], y + duration * places.vy[floe]];
  }
  const [then, now] = [motions.shipInFrame(ship, frame), motions.ship(ship)];
  const [c, s] = [Math.cos(now[2] - then[2]), Math.sin(now[2] - then[2])];
  return (x, y) => [now[0] + c * (x - then[0]) - s * (y - then[1]), now[1] + s * (x - then[0]) + c * (y - then[1])];
}

/** An arrow from a point of the screen along (fx, fy), y up, added to the path. */
function traceArrow(context, sx, sy, fx, fy, length) {
  const size = Math.hypot(fx, fy);
  const [ux, uy] = [fx / size, -fy / size];
  const tip = Math.min(8, 0.5 * length);
  const [ex, ey] = [sx + length * ux, sy + length * uy];
  context.moveTo(sx, sy);
  context.lineTo(ex, ey);
  context.lineTo(ex - tip * (ux + 0.5 * uy), ey - tip * (uy - 0.5 * ux));
  context.moveTo(ex, ey);
  context.lineTo(ex - tip * (ux - 0.5 * uy), ey - tip * (uy + 0.5 * ux));
}

/** Arrows of the forces on ships (of floe on floe: on the first),
  `perNewton` pixels a newton; those of the frame before go with
 * the ship they press on. Returns the notice to show where there are none. */
function drawContactForces(context, view, run, motions, places, time, colours, perNewton) {
  const { columns } = run;
  if (columns.contact_t_s.length === 0) return "This run recorded no contacts.";
  const frame = motions.frame;
  const contacts = contactsOfFrame(run, frame);
  for (const [isCrushing, colour] of [[0, colours.bend], [1, colours.split]]) {
    context.beginPath();
    for (const { ship, floe, x, y, fx, fy, isCrushing: crushes } of contacts) {
      const length = perNewton * Math.hypot(fx, fy);
      const move = crushes === isCrushing && length >= 1 ? moveSince(run, motions, places, frame, ship, floe,
        time) : null;
      if (move) traceArrow(context, ...view.toScreen(...move(x, y)), fx, fy, length);
    }
    for (const [width, stroke] of [[4, colours.panel], [2, colour]]) {
      context.lineWidth = width;
      context.strokeStyle = stroke;
      context.stroke();
    }
  }
  return "";
}

// Contact circles as geometry samples them (geometry/contact/contact_circles.cpp), on demand: those of a floe when it
// is first seen from close by.

/** A ring's edges [ax, ay, bx, by], one after the other, the interior on their left. */
function edgesOfRing(coordinates) {
  return coordinates.map(([x, y], k) => [x, y, ...coordinates[(k + 1) % coordinates.length]]);
}

const lengthOf = ([ax, ay, bx, by]) => Math.hypot(bx - ax, by - ay);

/** The middles of the pieces one circle each stands for,
  with the edge each lies on: of edges longer than the radius equal parts,
 * of shorter ones as many in a row as are no longer together. */
function boundaryPieces(edges, radius) {
  const pieces = [];
  const onEdge = (edge, part) =>
    pieces.push([edge[0] + part * (edge[2] - edge[0]), edge[1] + part * (edge[3] - edge[1]), edge]);
  for (let e = 0; e < edges.length; ++e) {
    let total = lengthOf(edges[e]);
    if (total > radius) {
      const parts = Math.ceil(total / radius);
      for (let k = 0; k < parts; ++k) onEdge(edges[e], (k + 0.5) / parts);
      continue;
    }
    const row = [edges[e]];
    for (; e + 1 < edges.length && total + lengthOf(edges[e + 1]) <= radius; ++e) {
      row.push(edges[e + 1]);
      total += lengthOf(edges[e + 1]);
    }
    let before = 0;
    while (row.length > 1 && before + lengthOf(row[0]) < total / 2) before += lengthOf(row.shift());
    onEdge(row[0], Math.min(1, (total / 2 - before) / lengthOf(row[0])));
  }
  return pieces;
}

/** The largest radius at which a circle touches (x, y) from the side (nx, ny) and holds none of the edges. */
function inscribedRadius(edges, x, y, nx, ny, radius) {
  for (let shrink = 0; shrink < 64; ++shrink) {
    const [cx, cy] = [x + radius * nx, y + radius * ny];
    let nearest = (radius * (1 - 1e-9)) ** 2;
    let next = null;
    for (const [ax, ay, bx, by] of edges) {
      const [dx, dy] = [bx - ax, by - ay];
      const part = Math.min(1, Math.max(0, ((cx - ax) * dx + (cy - ay) * dy) / (dx * dx + dy * dy)));
      const [qx, qy] = [ax + part * dx, ay + part * dy];
      const distance = (qx - cx) ** 2 + (qy - cy) ** 2;
      const height = (qx - x) * nx + (qy - y) * ny; // a point level with the touching point is on its own edge
      if (distance >= nearest || height <= 1e-12 * radius) continue;
      nearest = distance;
      next = ((qx - x) ** 2 + (qy - y) ** 2) / (2 * height);
    }
    if (next === null) break;
    radius = next;
  }
  return radius;
}

/** The circles of rings of points, [x, y, radius] one after the other. */
function contactCircles(rings, radius) {
  const ofRing = rings.map(edgesOfRing);
  const edges = ofRing.flat();
  return Float64Array.from(ofRing.flatMap((ring) => boundaryPieces(ring, radius)).flatMap(([x, y, edge]) => {
    const [dx, dy] = [edge[2] - edge[0], edge[3] - edge[1]];
    const length = Math.hypot(dx, dy);
    const near = edges.filter(([ax, ay, bx, by]) => Math.min(ax, bx) < x + 2 * radius
      && Math.max(ax, bx) > x - 2 * radius &&
      Math.min(ay, by) < y + 2 * radius && Math.max(ay, by) > y - 2 * radius);
    const r = inscribedRadius(near, x, y, -dy / length, dx / length, radius);
    return [x - (r * dy) / length, y + (r * dx) / length, r];
  }));
}

/** A floe's rings as points from its centroid, in its body frame. */
function ringsOf(floes, id) {
  const rings = [];
  const { points, first } = floes.shape(id);
  let start = first;
  for (let ring = floes.ringsOf[id]; ring < floes.ringsOf[id + 1]; ++ring) {
    const end = first + floes.ringEnds[ring];
    rings.push(Array.from({ length: end - start }, (_, k) =>
      [points[2 * (start + k)] - floes.cx[id], points[2 * (start + k) + 1] - floes.cy[id]]));
    start = end;
  }
  return rings;
}

/** Gives the circles of a floe, or of the n-th ship as floe −1 − n. */
function makeCircleSampler({ floes, info }) {
  const sampled = new Map();
  return (owner) => {
    if (!sampled.has(owner))
      sampled.set(owner, contactCircles(owner < 0 ? [info.ships[-1 - owner].waterline_m] : ringsOf(floes, owner),
        info.circle_radius_m));
    return sampled.get(owner);
  };
}

/** Contact circles of the floes and hulls on the screen. Returns the notice to show where they are not drawn. */
function drawCircles(context, view, run, circlesOf, places, motions, colours) {
  const { floes, info } = run;
  if (info.circle_radius_m * view.scale < 1.5) return "Zoom in to see the contact circles.";
  context.lineWidth = 0.8;
  const draw = (owner, x, y, c, s) => {
    const circles = circlesOf(owner);
    context.beginPath();
    for (let k = 0; k < circles.length; k += 3) {
      const wx = x + c * circles[k] - s * circles[k + 1];
      const wy = y + s * circles[k] + c * circles[k + 1];
      if (!view.shows(wx, wy, circles[k + 2])) continue;
      const [sx, sy] = view.toScreen(wx, wy);
      const radius = circles[k + 2] * view.scale;
      context.moveTo(sx + radius, sy);
      context.arc(sx, sy, radius, 0, 2 * Math.PI);
    }
    context.stroke();
  };
  context.strokeStyle = colours.accent;
  for (const id of places.living.subarray(0, places.count))
    if (view.shows(places.x[id], places.y[id], floes.reach[id])) draw(id, places.x[id], places.y[id], places.cos[id],
      places.sin[id]);
  context.strokeStyle = colours.highlight;
  info.ships.forEach((_, ship) => {
    const pose = motions.ship(ship);
    if (pose) draw(-1 - ship, pose[0], pose[1], Math.cos(pose[2]), Math.sin(pose[2]));
  });
  return "";
}

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
  for (const id of largestPerCell(view, run.floes, places)) arrow(places.x[id], places.y[id], places.vx[id],
    places.vy[id]);
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
    if (isMarked(event)) drawEventMark(context, ...view.toScreen(...event.point_m), event.kind, isAbove(event) ? 6 : 3,
      colours);
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

// Ships and structures: the waterline as the run has it, and inside it what shows a ship from above: deck, house, bow.

const deckBeam = 7; // [px]; narrower ships have their waterline only

/** The box of a waterline in the ship's frame [m]. */
function hullBox(waterline) {
  const [xs, ys] = [0, 1].map((axis) => waterline.map((point) => point[axis]));
  const box = { aft: Math.min(...xs), bow: Math.max(...xs), starboard: Math.min(...ys), port: Math.max(...ys) };
  return { ...box, length: box.bow - box.aft, beam: box.port - box.starboard, middle: (box.port + box.starboard) / 2 };
}

function traceWaterline(context, waterline) {
  context.beginPath();
  for (const point of waterline) context.lineTo(...point);
  context.closePath();
}

/** The deck's edge: the waterline, somewhat smaller, its corners rounded but for the bow's. */
function traceDeck(context, waterline, box) {
  const inset = 0.07 * box.beam;
  const centre = [(box.aft + box.bow) / 2, box.middle];
  const shrink = [1 - (2 * inset) / box.length, 1 - (2 * inset) / box.beam];
  const deck = waterline.map((point) => point.map((v, k) => centre[k] + shrink[k] * (v - centre[k])));
  const distance = ([ax, ay], [bx, by]) => Math.hypot(ax - bx, ay - by);
  context.beginPath();
  deck.forEach((corner, k) => {
    const [before, after] = [deck[(k + deck.length - 1) % deck.length], deck[(k + 1) % deck.length]];
    const isBow = waterline[k][0] > box.bow - 1e-6 * box.length;
    const radius = isBow ? 0 : Math.min(0.3 * box.beam, 0.4 * distance(corner, before), 0.4 * distance(corner, after));
    if (k === 0) context.moveTo((before[0] + corner[0]) / 2, (before[1] + corner[1]) / 2);
    context.arcTo(...corner, ...after, radius);
  });
  context.closePath();
}

/** Deck, deck house, bridge and funnel, the bow's centreline. All in the ship's frame; `pixel` is one in metres. */
function drawDeck(context, waterline, box, pixel, colours) {
  context.save();
  traceDeck(context, waterline, box);
  context.fillStyle = colours.deck;
  context.fill();
  context.clip();
  const across = (x, width, length) => context.rect(x, box.middle - width / 2, length, width);
  context.strokeStyle = colours["hull-edge"];
  context.lineWidth = 0.8 * pixel;
  context.beginPath();
  context.moveTo(box.aft + 0.45 * box.length, box.middle);
  context.lineTo(box.bow, box.middle);
  context.stroke();
  context.fillStyle = colours["deck-house"];
  context.beginPath();
  across(box.aft + 0.2 * box.length, 0.58 * box.beam, 0.2 * box.length);
  across(box.aft + 0.4 * box.length, 0.84 * box.beam, 0.045 * box.length);
  context.fill();
  context.fillStyle = colours.hull;
  context.beginPath();
  context.arc(box.aft + 0.26 * box.length, box.middle, 0.09 * box.beam, 0, 2 * Math.PI);
  context.fill();
  context.restore();
}

/** From the bow along the heading, with a tip; 16 to 50 pixels long. */
function drawHeading(context, box, pixel, colours) {
  const length = Math.min(50 * pixel, Math.max(16 * pixel, 0.3 * box.length));
  const [start, end, tip] = [box.bow + 3 * pixel, box.bow + 3 * pixel + length, 6 * pixel];
  context.beginPath();
  context.moveTo(start, box.middle);
  context.lineTo(end, box.middle);
  context.moveTo(end - tip, box.middle + 0.6 * tip);
  context.lineTo(end, box.middle);
  context.lineTo(end - tip, box.middle - 0.6 * tip);
  for (const [width, colour] of [[4.5, colours["hull-edge"]], [2, colours.hull]]) {
    context.lineWidth = width * pixel;
    context.strokeStyle = colour;
    context.stroke();
  }
}

function drawShip(context, view, ship, [x, y, heading], colours) {
  const box = hullBox(ship.waterline_m);
  const pixel = 1 / view.scale;
  context.save();
  context.translate(...view.toScreen(x, y));
  context.rotate(-heading);
  context.scale(view.scale, -view.scale);
  context.lineJoin = context.lineCap = "round";
  traceWaterline(context, ship.waterline_m);
  context.fillStyle = colours.hull;
  context.fill();
  context.strokeStyle = colours["hull-edge"];
  context.lineWidth = 1.5 * pixel;
  context.stroke();
  if (!ship.is_fixed) {
    if (box.beam > deckBeam * pixel) drawDeck(context, ship.waterline_m, box, pixel, colours);
    drawHeading(context, box, pixel, colours);
  }
  context.restore();
}

function drawTrack(context, view, run, motions, index, time, colours) {
  context.beginPath();
  for (const [x, y] of posesUpTo(run, motions, index, time)) context.lineTo(...view.toScreen(x, y));
  context.strokeStyle = colours.track;
  context.lineWidth = 2;
  context.setLineDash([8, 5]);
  context.stroke();
  context.setLineDash([]);
}

/** The lines of ships that manage ice, against the drift from the bodies that they protect. */
function drawPatterns(context, view, run, motions, time, colours) {
  const [, , vx, vy] = driftAt(run.info.water.drift, time);
  const speed = Math.hypot(vx, vy);
  const [ux, uy] = speed > 0 ? [-vx / speed, -vy / speed] : [1, 0];
  context.beginPath();
  for (const { body, line_m: line } of run.info.patterns) {
    const pose = motions.ship(body);
    if (!pose) continue;
    line.forEach(([x, y], k) =>
      context[k ? "lineTo" : "moveTo"](...view.toScreen(pose[0] + x * ux - y * uy, pose[1] + x * uy + y * ux)));
    context.closePath();
  }
  context.strokeStyle = colours.highlight;
  context.lineWidth = 1.5;
  context.setLineDash([3, 4]);
  context.stroke();
  context.setLineDash([]);
}

/** All of them, with their tracks where that layer is on, and their names where there are several. */
function drawShips(context, view, run, motions, time, layers, colours) {
  if (layers.track) drawPatterns(context, view, run, motions, time, colours);
  run.info.ships.forEach((ship, index) => {
    const pose = motions.ship(index);
    if (!pose) return;
    if (layers.track && !ship.is_fixed) drawTrack(context, view, run, motions, index, time, colours);
    drawShip(context, view, ship, pose, colours);
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
