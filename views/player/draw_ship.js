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

/** All of them, with their tracks where that layer is on, and their names where there are several. */
function drawShips(context, view, run, motions, time, layers, colours) {
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
