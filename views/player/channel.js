// The channel behind each ship (docs/channel.md): the widths that analysis/channel.cpp measured, and the band that the
// hull swept. Both are carried with the water to the time that is shown. Places are in the world [m], headings in
// radians from the x axis, counter-clockwise. placedBy() and lastAtMost() are in motion.js, the other functions for
// drawing in draw_marks.js.

/** Drift at a time: the displacement of the water in x and y since the start of the scene [m], which carries channels,
 * and the velocity of free drift of ice in x and y [m/s], from which draw_marks.js finds the direction upstream. Both
 * are interpolated linearly between the samples [t, x, y, vx, vy] of the page, of which there are at least two, and
 * extrapolated from the nearest two at times outside of them. */
function driftAt(samples, time) {
  const after = samples.findIndex(([t]) => t > time);
  const k = Math.max(1, after < 0 ? samples.length - 1 : after);
  const [from, to] = [samples[k - 1], samples[k]];
  const share = (time - from[0]) / (to[0] - from[0]);
  return [1, 2, 3, 4].map((column) => from[column] + share * (to[column] - from[column]));
}

/** Makes `run.carry` from `run.info.water`: a function carry(x, y, from, to) that returns the place [x, y] at the time
 * `to` of the water that is at (x, y) at the time `from` [s]. The water moves with the drift, and in the direction
 * `shear_direction_rad` at the shear rate [1/s] times its distance to port of the shear's origin, which drifts too. */
function makeCarrier({ drift, shear_per_s: shear, shear_direction_rad: direction, shear_origin_m: [ox, oy] }) {
  const [cx, cy] = [Math.cos(direction), Math.sin(direction)];
  return (x, y, from, to) => {
    const [px, py] = driftAt(drift, from);
    const [qx, qy] = driftAt(drift, to);
    const toPort = cx * (y - oy - py) - cy * (x - ox - px);
    return [x + qx - px + (to - from) * shear * toPort * cx, y + qy - py + (to - from) * shear * toPort * cy];
  };
}

/** Returns true if a ship has moved by more than 1 m from the first frame to the last, relative to `carry`, which
 * carries points with the water, or leaves them in place for motion over ground. A smaller limit would count ships that
 * only sway. The run must have frames, which the caller checks. firstState() of player.js asks this of every ship that
 * is not moored: when the page opens, the layer "channel" is on only if one has moved relative to the water, and the
 * layer "ice at the start" only if one has moved over ground. */
function hasGone(run, motions, ship, carry) {
  const { times } = run.frames;
  const last = times.length - 1;
  const [ax, ay] = motions.shipInFrame(ship, 0);
  const [bx, by] = motions.shipInFrame(ship, last);
  const [x, y] = carry(ax, ay, times[0], times[last]);
  return Math.hypot(x - bx, y - by) > 1;
}

/** Poses of a ship [x, y, heading, time] at all frames before a time, and at that time; none if the run has no frames.
 * `motions` must be set to the same time. */
function posesUpTo(run, motions, ship, time) {
  const { times } = run.frames;
  const poses = [];
  for (let f = 0; f < times.length && times[f] < time; ++f)
    poses.push([...motions.shipInFrame(ship, f).subarray(0, 3), times[f]]);
  const now = motions.ship(ship);
  if (now) poses.push([...now.subarray(0, 3), time]);
  return poses;
}

/** Selects poses at distances of at most `spacing` [m], at which the drawn outlines overlap. Where the given poses are
 * farther apart, poses are interpolated between them. Headings can be interpolated because they are continuous: frames
 * do not reduce them to one turn. To save drawing, poses are left out where the ship moves by less than an eighth of
 * `spacing` and turns by less than 0.01 rad, at which the band looks the same; the last pose is always kept. Distances
 * are those of the poses carried with the water to `time`. */
function evenly(poses, spacing, carry, time) {
  const placed = ([x, y, , at]) => carry(x, y, at, time);
  const even = [];
  poses.forEach((pose, k) => {
    const last = even[even.length - 1];
    if (!last) return even.push(pose);
    const [[ax, ay], [bx, by]] = [placed(last), placed(pose)];
    const gap = Math.hypot(ax - bx, ay - by);
    if (gap < spacing / 8 && Math.abs(pose[2] - last[2]) < 0.01 && k + 1 < poses.length) return even.length;
    const steps = Math.ceil(gap / spacing);
    for (let i = 1; i < steps; ++i) even.push(last.map((v, j) => v + (i / steps) * (pose[j] - v)));
    return even.push(pose);
  });
  return even;
}

/** Draws the band that hulls swept up to a time [s]: the outlines along their tracks, carried with the water and
 * painted over each other. The colour must be opaque, because a translucent one would darken where outlines overlap.
 * Two outlines are at most an eighth of the hull's length apart; with a larger spacing the edges of the band become
 * jagged, with a smaller one drawing takes longer. */
function drawSweptBand(context, view, run, motions, time, colours) {
  run.info.ships.forEach(({ waterline_m: waterline }, index) => {
    const spacing = hullBox(waterline).length / 8;
    for (const pose of evenly(posesUpTo(run, motions, index, time), spacing, run.carry, time)) {
      const place = placedBy(pose);
      traceLine(context, waterline.map((corner) => view.toScreen(...run.carry(...place(...corner), pose[3], time))));
      fillWith(context, colours.swept);
    }
  });
}

/** Stations that are a channel behind a ship (`is_channel` in docs/channel.md), from the last measurement at or before
 * a time [s], carried with the water to that time; none before the first measurement. `channel_measured_s` lists all
 * instants of measurement, also those without any station, at which the drawn channel disappears. There are at most 200
 * (player_data.cpp), because each makes the page larger and slower to write; between them the channel is not up to
 * date. Of a station, (x, y) is its middle on the track, (fx, fy) the unit vector along the track, `port` and
 * `starboard` are the distances from the track to the ice, `length` is its length along the track, `along` its distance
 * from the beginning of the track, which only tests read, and `beam` the beam of the hull, the same for all stations
 * [m]. */
function stationsOf(run, ship, time) {
  const { columns: c, info } = run;
  const measured = c.channel_measured_s[lastAtMost(c.channel_measured_s, time)];
  const { beam } = hullBox(info.ships[ship].waterline_m);
  const stations = [];
  for (let k = 0; k < c.channel_ship.length; ++k) {
    if (c.channel_ship[k] !== ship || c.channel_t_s[k] !== measured) continue;
    const [x, y] = run.carry(c.channel_x_m[k], c.channel_y_m[k], measured, time);
    stations.push({ x, y, fx: c.channel_forward_x[k], fy: c.channel_forward_y[k], beam, along: c.channel_along_m[k],
      length: c.channel_length_m[k], port: c.channel_port_m[k], starboard: c.channel_starboard_m[k] });
  }
  return stations;
}

/** Mean width of the stations of one ship in words, in metres and in beams, for the legend; "" if there are none. */
function widthWords(stations) {
  if (stations.length === 0) return "";
  const mean = stations.reduce((sum, { port, starboard }) => sum + port + starboard, 0) / stations.length;
  return `${mean.toFixed(1)} m wide, ${(mean / stations[0].beam).toFixed(2)} beams`;
}

/** Draws the rectangle from ice to ice at each station. Stations outside the visible part of the map are skipped; the
 * disc that is tested for this is larger than the rectangle. */
function drawStations(context, view, stations, colours) {
  context.beginPath();
  for (const { x, y, fx, fy, length, port, starboard } of stations) {
    if (!view.shows(x, y, length + port + starboard)) continue;
    const place = placedBy([x, y, Math.atan2(fy, fx)]);
    [[-0.5, port], [-0.5, -starboard], [0.5, -starboard], [0.5, port]].forEach(([part, v], k) =>
      context[k > 0 ? "lineTo" : "moveTo"](...view.toScreen(...place(part * length, v))));
  }
  fillWith(context, colours.channel);
}
