// Draws everything that is above the ice on the map: contacts, marks of fractures, arrows, and ships.

// Contacts recorded at frames (contacts.csv) and their forces.

/** Contacts recorded at a frame. The force acts on `ship`, or on `floe` if `ship` is −1. `isCrushing` is 0 or 1. */
function contactsOfFrame({ columns: c, frames }, frame) {
  const at = frames.times[frame];
  const contacts = [];
  for (let row = lastAtMost(c.contact_t_s, at); row >= 0 && c.contact_t_s[row] === at; --row)
    contacts.unshift({ ship: c.contact_ship[row], floe: c.contact_floe[row], byFloe: c.contact_by_floe[row],
      x: c.contact_x_m[row], y: c.contact_y_m[row], fx: c.contact_fx_N[row], fy: c.contact_fy_N[row],
      isCrushing: c.contact_is_crushing[row] });
  return contacts;
}

/** The force that one contact in twenty exceeds [N]; 0 if no contact presses. Its arrow is 40 px long (player.js). */
function typicalForce({ columns: { contact_fx_N: fx, contact_fy_N: fy } }) {
  const sizes = Float64Array.from(fx, (x, row) => Math.hypot(x, fy[row])).filter((size) => size > 0).sort();
  return sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0;
}

/** Returns a function that moves a point with a body since a frame; null for a floe that has broken or gone under
 * since. Floes move it at their velocity without their rotation. */
function moveSince(run, motions, places, frame, ship, floe, time) {
  if (ship < 0) {
    const duration = time - run.frames.times[frame];
    if (!places.isAlive(floe, time)) return null;
    return (x, y) => [x + duration * places.vx[floe], y + duration * places.vy[floe]];
  }
  const [x0, y0, angle] = motions.shipInFrame(ship, frame);
  const now = motions.ship(ship);
  const move = placedBy([now[0], now[1], now[2] - angle]);
  return (x, y) => move(x - x0, y - y0);
}

/** Fills the current path. */
function fillWith(context, colour) {
  context.fillStyle = colour;
  context.fill();
}

/** Strokes the current path. */
function strokeWith(context, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

/** Strokes the current path twice, first wider by `rim`, so that it contrasts with ice and water. Widths are in the
 * unit of the context: pixels, or metres in the ship's frame. */
function strokeTwice(context, under, over, width, rim = 2.4) {
  strokeWith(context, under, width + rim);
  strokeWith(context, over, width);
}

/** Draws words on the map with an outline that separates them from the background. */
function drawWords(context, words, x, y, ink, rim, align = "center") {
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = align;
  context.lineWidth = 3;
  context.strokeStyle = rim;
  context.strokeText(words, x, y);
  context.fillStyle = ink;
  context.fillText(words, x, y);
}

/** Adds an arrow to the path, from a point of the screen in the direction (fx, fy), with y upwards. */
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

/** Draws arrows for the forces of contacts on ships, or on the first floe of two, `perNewton` pixels long per newton.
 * They belong to the last frame and move with the body on which they act. Arrows below 1 px are left out. Returns a
 * notice if the run has no contacts. */
function drawContactForces(context, view, run, motions, places, time, colours, perNewton) {
  if (run.columns.contact_t_s.length === 0) return "This run recorded no contacts.";
  const contacts = contactsOfFrame(run, motions.frame);
  for (const [kind, colour] of [[0, colours.bend], [1, colours.split]]) {
    context.beginPath();
    for (const { ship, floe, x, y, fx, fy, isCrushing } of contacts) {
      const length = perNewton * Math.hypot(fx, fy);
      if (isCrushing !== kind || length < 1) continue;
      const move = moveSince(run, motions, places, motions.frame, ship, floe, time);
      if (move) traceArrow(context, ...view.toScreen(...move(x, y)), fx, fy, length);
    }
    strokeTwice(context, colours.panel, colour, 2, 2);
  }
}

// Other drawings over the ice: velocities, lineage, marks, scale bar.

/** Draws arrows for the velocities of floes and ships, `perSpeed` pixels long for 1 m/s. Arrows below 3 px, which show
 * no direction, are left out. */
function drawVelocities(context, view, run, places, motions, colours, perSpeed) {
  const arrow = (x, y, vx, vy) => {
    const length = Math.hypot(vx, vy) * perSpeed;
    if (length >= 3) traceArrow(context, ...view.toScreen(x, y), vx, vy, length);
  };
  context.beginPath();
  for (const id of largestPerCell(view, run.floes, places))
    arrow(places.x[id], places.y[id], places.vx[id], places.vy[id]);
  strokeWith(context, colours.ink, 1.2);
  context.beginPath();
  run.info.ships.forEach((_, ship) => {
    const pose = motions.ship(ship);
    if (pose) arrow(pose[0], pose[1], pose[3], pose[4]);
  });
  strokeWith(context, colours["hull-edge"], 2);
}

const arrowCell = 24; // side of the squares of which each has at most one arrow of a floe [px]

/** Ids of the largest floe in each square of the screen, by centre, so that arrows do not overlap. Squares are numbered
 * in one integer, which is unique for up to a million of them across. */
function largestPerCell(view, floes, places) {
  const cells = new Map();
  // Squares are fixed in the world, so that arrows do not flicker when the map moves.
  const cell = arrowCell / view.scale;
  for (let n = 0; n < places.count; ++n) {
    const id = places.living[n];
    if (!view.shows(places.x[id], places.y[id], cell)) continue;
    const key = Math.floor(places.x[id] / cell) * 1e6 + Math.floor(places.y[id] / cell);
    const other = cells.get(key);
    if (other === undefined || floes.area[id] > floes.area[other]) cells.set(key, id);
  }
  return cells.values();
}

/** Draws the family of a floe: tints the floating pieces of the same floe of the scene, and outlines its ancestors and
 * the floe. A floe that does not float is dashed, at the place where its motion would carry it. */
function drawLineage(context, view, run, places, id, time, colours) {
  const { floes } = run;
  if (!places.isAlive(id, time)) places.place(id);
  const family = places.living.subarray(0, places.count).filter((other) => other !== id
    && floes.oldest[other] === floes.oldest[id] && view.shows(places.x[other], places.y[other], floes.reach[other]));
  context.fillStyle = colours.family;
  context.strokeStyle = colours.highlight;
  onMap(context, view, { dash: [5, 4] }, () => {
    family.forEach((other) => drawFloe(context, view, run, places, other, "fill"));
    drawAncestors(context, view, run, places, id);
  });
  const dash = places.isAlive(id, time) ? [] : [3, 3];
  onMap(context, view, { width: 3, dash }, () => drawFloe(context, view, run, places, id, "stroke"));
}

const mostAncestors = 40; // number of ancestors that are drawn, the latest ones; more take longer to draw

/** Draws the outlines of ancestors. They share the body frame of the floe, so its pose places them. */
function drawAncestors(context, view, run, places, id) {
  const { parent, cx, cy } = run.floes;
  const [c, s] = [places.cos[id], places.sin[id]];
  for (let a = parent[id], drawn = 0; a >= 0 && drawn < mostAncestors; a = parent[a], ++drawn) {
    const [dx, dy] = [cx[a] - cx[id], cy[a] - cy[id]];
    const ghost = { x: { [a]: places.x[id] + c * dx - s * dy }, y: { [a]: places.y[id] + s * dx + c * dy },
      cos: { [a]: c }, sin: { [a]: s } };
    drawFloe(context, view, run, ghost, a, "stroke");
  }
}

/** Corners of the mark of each kind of event, in units of its size; a disc if there are none. Kinds without a colour of
 * their own (submerge, resurface) have the colour of ice under hulls. */
const markCorners = { split: [[0, -1.3], [1.3, 1], [-1.3, 1]], bend: [],
  mooring_break: [[0, -1.4], [1.4, 0], [0, 1.4], [-1.4, 0]], other: [[-1, -1], [1, -1], [1, 1], [-1, 1]] };

function drawEventMark(context, x, y, kind, size, colours) {
  const corners = markCorners[kind] ?? markCorners.other;
  context.beginPath();
  corners.forEach(([dx, dy]) => context.lineTo(x + size * dx, y + size * dy));
  if (corners.length === 0) context.arc(x, y, size, 0, 2 * Math.PI);
  context.closePath();
  fillWith(context, colours[kind] ?? colours["under-hull"]);
  strokeWith(context, "#ffffff", 1);
}

/** Draws the marks of the events until a time that have one (timeline.js), larger for the rare kinds. */
function drawFractures(context, view, run, time, colours) {
  for (const event of run.info.events) {
    if (event.t_s > time) break;
    const size = isAbove(event) ? 6 : 3;
    if (isMarked(event)) drawEventMark(context, ...view.toScreen(...event.point_m), event.kind, size, colours);
  }
}

function drawChosenEvent(context, view, event, colours) {
  const [x, y] = view.toScreen(...event.point_m);
  context.beginPath();
  context.arc(x, y, 13, 0, 2 * Math.PI);
  strokeWith(context, colours.highlight, 2);
  drawEventMark(context, x, y, event.kind, 5, colours);
}

function drawScaleBar(context, view, colours) {
  const length = roundBelow(Math.min(180, view.width / 4) / view.scale);
  const pixels = length * view.scale;
  const [x, y] = [view.width - pixels - 16, view.height - 16];
  context.globalAlpha = 0.85;
  context.fillStyle = colours.panel;
  context.fillRect(x - 8, y - 22, pixels + 16, 30);
  context.globalAlpha = 1;
  traceLine(context, [[x, y - 5], [x, y], [x + pixels, y], [x + pixels, y - 5]]);
  strokeWith(context, colours.ink, 2);
  const words = length >= 1000 ? `${length / 1000} km` : `${Number(length.toPrecision(3))} m`;
  drawWords(context, words, x + pixels / 2, y - 8, colours.ink, colours.panel);
}

// Ships and structures: the waterline of the run, and within it the deck, the deck house and the bow for recognition.

const deckBeam = 7; // narrower ships are drawn as a waterline only [px]

/** Box of a waterline in the ship's frame [m]. */
function hullBox(waterline) {
  const [xs, ys] = [0, 1].map((axis) => waterline.map((point) => point[axis]));
  const box = { aft: Math.min(...xs), bow: Math.max(...xs), starboard: Math.min(...ys), port: Math.max(...ys) };
  return { ...box, length: box.bow - box.aft, beam: box.port - box.starboard, middle: (box.port + box.starboard) / 2 };
}

/** Begins a path and adds a line through points to it. */
function traceLine(context, points) {
  context.beginPath();
  for (const point of points) context.lineTo(...point);
}

/** Draws deck, deck house, bridge, and the centreline of the bow in the ship's frame. `pixel` is the size of a pixel
 * [m]. */
function drawDeck(context, waterline, { aft, length, beam, middle }, pixel, colours) {
  const shrunk = ([x, y]) => [x + 0.14 * beam * (0.5 - (x - aft) / length), middle + 0.86 * (y - middle)];
  traceLine(context, waterline.map(shrunk));
  fillWith(context, colours.deck);
  traceLine(context, [[aft + 0.45 * length, middle], [aft + length - 0.07 * beam, middle]]);
  strokeWith(context, colours["hull-edge"], 0.8 * pixel);
  context.fillStyle = colours["deck-house"];
  for (const [from, along, across] of [[0.2, 0.2, 0.58], [0.4, 0.045, 0.84]])
    context.fillRect(aft + from * length, middle - 0.5 * across * beam, along * length, across * beam);
}

/** Draws an arrow from the bow along the heading, 16 to 50 pixels long. */
function drawHeading(context, { bow, middle, length }, pixel, colours) {
  const start = bow + 3 * pixel;
  const end = start + Math.min(50 * pixel, Math.max(16 * pixel, 0.3 * length));
  const tip = [[end - 6 * pixel, middle + 3.6 * pixel], [end, middle], [end - 6 * pixel, middle - 3.6 * pixel]];
  traceLine(context, [[start, middle], [end, middle], ...tip]);
  strokeTwice(context, colours["hull-edge"], colours.hull, 2 * pixel, 2.5 * pixel);
}

/** Calls `draw` with the canvas in the ship's frame [m]. Its argument is the size of a pixel [m]. */
function inShipFrame(context, view, [x, y, heading], draw) {
  context.save();
  context.translate(...view.toScreen(x, y));
  context.rotate(-heading);
  context.scale(view.scale, -view.scale);
  draw(1 / view.scale);
  context.restore();
}

function drawShip(context, view, ship, pose, colours) {
  const box = hullBox(ship.waterline_m);
  inShipFrame(context, view, pose, (pixel) => {
    context.lineJoin = context.lineCap = "round";
    traceLine(context, ship.waterline_m);
    context.closePath();
    fillWith(context, colours.hull);
    strokeWith(context, colours["hull-edge"], 1.5 * pixel);
    if (ship.is_fixed) return;
    if (box.beam > deckBeam * pixel) drawDeck(context, ship.waterline_m, box, pixel, colours);
    drawHeading(context, box, pixel, colours);
  });
}

/** Strokes a dashed line through points of the world. Width and dashes are in pixels. */
function drawDashed(context, view, points, colour, width, dash) {
  traceLine(context, points.map((point) => view.toScreen(...point)));
  context.setLineDash(dash);
  strokeWith(context, colour, width);
  context.setLineDash([]);
}

/** Draws the patterns of ships that manage ice, which lie upstream of the bodies that they protect: against the free
 * drift of ice, or along +x if there is no drift. */
function drawPatterns(context, view, run, motions, time, colours) {
  const [, , vx, vy] = driftAt(run.info.water.drift, time);
  const upstream = vx === 0 && vy === 0 ? 0 : Math.atan2(-vy, -vx);
  for (const { body, line_m: line } of run.info.patterns) {
    const pose = motions.ship(body);
    const place = pose && placedBy([pose[0], pose[1], upstream]);
    if (pose) drawDashed(context, view, [...line, line[0]].map((point) => place(...point)), colours.highlight, 1.5,
      [3, 4]);
  }
}

/** Draws all ships, and their tracks if that layer is shown. */
function drawShips(context, view, run, motions, time, layers, colours) {
  if (layers.track) drawPatterns(context, view, run, motions, time, colours);
  run.info.ships.forEach((ship, index) => {
    const pose = motions.ship(index);
    if (!pose) return;
    if (layers.track && !ship.is_fixed)
      drawDashed(context, view, posesUpTo(run, motions, index, time), colours.track, 2, [8, 5]);
    drawShip(context, view, ship, pose, colours);
  });
}

/** Names, centres and outlines of ships on the screen, for placing their names. */
function shipsOnScreen(view, { info: { ships } }, motions) {
  return ships.map(({ name, waterline_m: ring }, index) => ({ name, pose: motions.ship(index), ring }))
    .filter(({ pose }) => pose).map(({ name, pose, ring }) => ({ name, centre: view.toScreen(pose[0], pose[1]),
      ring: ring.map((point) => view.toScreen(...placedBy(pose)(...point))) }));
}

/** Outlines the selected ship. */
function drawChosenShip(context, view, { waterline_m: ring }, pose, colours) {
  traceLine(context, ring.map((point) => view.toScreen(...placedBy(pose)(...point))));
  context.closePath();
  strokeWith(context, colours.highlight, 2.5);
}
