// The contacts recorded at frames (contacts.csv) and their forces.

/** The contacts recorded at a frame. */
function contactsOfFrame({ columns, frames }, frame) {
  const times = columns.contact_t_s;
  const at = frames.times[frame];
  let row = lastAtMost(times, at);
  while (row >= 0 && times[row] === at) --row;
  const contacts = [];
  for (++row; times[row] === at; ++row) {
    contacts.push({ ship: columns.contact_ship[row], floe: columns.contact_floe[row], byFloe: columns.contact_by_floe[row],
      x: columns.contact_x_m[row], y: columns.contact_y_m[row], fx: columns.contact_fx_N[row], fy: columns.contact_fy_N[row],
      isCrushing: columns.contact_is_crushing[row] });
  }
  return contacts;
}

/** A force of which one contact in twenty is larger [N]; 0 where nothing presses. */
function typicalForce({ columns }) {
  const sizes = Float64Array.from(columns.contact_fx_N, (fx, row) => Math.hypot(fx, columns.contact_fy_N[row])).filter((size) => size > 0).sort();
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

/** Arrows of the forces on ships (of floe on floe: on the first), `perNewton` pixels a newton; those of the frame before go with
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
      const move = crushes === isCrushing && length >= 1 ? moveSince(run, motions, places, frame, ship, floe, time) : null;
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
