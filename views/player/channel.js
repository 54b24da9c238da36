// The channel behind each ship at an instant, by the rules of docs/channel.md (and analysis/channel.cpp, analysis/swept_band.cpp):
// its track and what its hull swept are carried with the water, its width is from ice to ice.

/** Where a point of the water at (x, y) at one time is at another. */
function makeCarrier({ drift_m_per_s: [ux, uy], shear_per_s: shear, shear_direction_rad: direction, shear_origin_m: [ox, oy] }) {
  const [cx, cy] = [Math.cos(direction), Math.sin(direction)];
  return (x, y, from, to) => {
    const toPort = cx * (y - oy - from * uy) - cy * (x - ox - from * ux);
    return [x + (to - from) * (ux + shear * toPort * cx), y + (to - from) * (uy + shear * toPort * cy)];
  };
}

/** Whether a ship went anywhere, beside what is carried: through the water, else it has no channel; or over ground. */
function hasGone(run, motions, ship, carry) {
  const { times } = run.frames;
  const last = times.length - 1;
  const [ax, ay] = motions.shipInFrame(ship, 0);
  const [bx, by] = motions.shipInFrame(ship, last);
  const [x, y] = carry(ax, ay, times[0], times[last]);
  return Math.hypot(x - bx, y - by) > 1;
}

/** A ship's poses with their times, frame by frame up to now. */
function posesUpTo(run, motions, ship, time) {
  const { times } = run.frames;
  const poses = [];
  for (let f = 0; f < times.length && times[f] < time; ++f) poses.push([...motions.shipInFrame(ship, f).subarray(0, 3), times[f]]);
  const now = motions.ship(ship);
  if (now) poses.push([...now.subarray(0, 3), time]);
  return poses;
}

/** Poses so near each other in the water that outlines overlap: some between those far apart, none where it hardly moves. */
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

/** What hulls swept: their outlines painted over each other along their tracks, carried with the water. */
function drawSweptBand(context, view, run, motions, time, colours) {
  context.fillStyle = colours.swept;
  run.info.ships.forEach((ship, index) => {
    const xs = ship.waterline_m.map(([x]) => x);
    const poses = evenly(posesUpTo(run, motions, index, time), (Math.max(...xs) - Math.min(...xs)) / 8, run.carry, time);
    poses.forEach(([x, y, heading, at], k) => {
      if (k % 16 === 0) context.beginPath();
      const [c, s] = [Math.cos(heading), Math.sin(heading)];
      ship.waterline_m.forEach(([px, py], corner) => {
        const point = view.toScreen(...run.carry(x + c * px - s * py, y + s * px + c * py, at, time));
        if (corner === 0) context.moveTo(...point);
        else context.lineTo(...point);
      });
      context.closePath();
      if (k % 16 === 15 || k + 1 === poses.length) context.fill();
    });
  });
}

/** The track now: its corners, and how far along each is. */
function trackOf(run, motions, ship, time) {
  const track = { points: [], alongs: [] };
  for (const [px, py, , at] of posesUpTo(run, motions, ship, time)) {
    const [x, y] = run.carry(px, py, at, time);
    const last = track.points[track.points.length - 1];
    const way = last ? Math.hypot(x - last.x, y - last.y) : 0;
    if (last && way === 0) continue;
    track.points.push({ x, y });
    track.alongs.push(last ? track.alongs[track.alongs.length - 1] + way : 0);
  }
  return track;
}

function atWay({ points, alongs }, along) {
  const k = Math.min(Math.max(0, lastAtMost(alongs, along)), points.length - 2);
  const [a, b] = [points[k], points[k + 1]];
  const share = Math.min(1, (along - alongs[k]) / (alongs[k + 1] - alongs[k]));
  return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
}

/** Counter-clockwise convex hull of points [u, v]. */
function convexHull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (list) => {
    const hull = [];
    for (const p of list) {
      while (hull.length > 1) {
        const [a, b] = hull.slice(-2);
        if ((b[0] - a[0]) * (p[1] - b[1]) - (b[1] - a[1]) * (p[0] - b[0]) > 0) break;
        hull.pop();
      }
      hull.push(p);
    }
    return hull.slice(0, -1);
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

/** The cells along a ship's track, a beam long and four beams to either side, each in its own frame: u along, v to port. */
function cellsOf(run, motions, ship, time) {
  const { waterline_m: hull } = run.info.ships[ship];
  const beam = Math.max(...hull.map(([, y]) => y)) - Math.min(...hull.map(([, y]) => y));
  const track = trackOf(run, motions, ship, time);
  if (track.points.length < 2) return [];
  const behind = -Math.min(...hull.map(([x]) => x));
  const count = Math.max(0, Math.floor((track.alongs[track.alongs.length - 1] - behind) / beam));
  const joints = Array.from({ length: count + 1 }, (_, i) => atWay(track, beam * i));
  const direction = (a, b) => {
    const length = Math.hypot(b.x - a.x, b.y - a.y);
    return length > 0 ? [(b.x - a.x) / length, (b.y - a.y) / length] : [0, 0];
  };
  const ways = joints.map((_, i) => direction(joints[Math.max(0, i - 1)], joints[Math.min(count, i + 1)]));
  const reach = 4 * beam;
  const cells = [];
  for (let i = 0; i < count; ++i) {
    const [a, b] = [joints[i], joints[i + 1]];
    const [fx, fy] = direction(a, b);
    if (fx === 0 && fy === 0) continue;
    const cell = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, fx, fy, beam, reach, length: Math.hypot(b.x - a.x, b.y - a.y), along: (i + 0.5) * beam };
    const corners = [[a, ways[i]], [b, ways[i + 1]]].flatMap(([p, [wx, wy]]) => [reach, -reach].map((half) => {
      const [dx, dy] = [p.x - half * wy - cell.x, p.y + half * wx - cell.y];
      return [fx * dx + fy * dy, fx * dy - fy * dx];
    }));
    cells.push({ ...cell, outline: convexHull(corners), halfLength: Math.max(...corners.map(([u]) => Math.abs(u))),
      size: Math.max(...corners.map(([u, v]) => Math.hypot(u, v))) });
  }
  return cells;
}

/** The part of the segment a–b inside a convex outline, as the v of its ends; null where none is. */
function clippedAcross(outline, au, av, bu, bv) {
  let from = 0;
  let to = 1;
  for (let k = 0, j = outline.length - 1; k < outline.length; j = k++) {
    const [ex, ey] = [outline[k][0] - outline[j][0], outline[k][1] - outline[j][1]];
    const atA = ex * (av - outline[j][1]) - ey * (au - outline[j][0]);
    const atB = ex * (bv - outline[j][1]) - ey * (bu - outline[j][0]);
    if (atA < 0 && atB < 0) return null;
    if (atA < 0) from = Math.max(from, atA / (atA - atB));
    else if (atB < 0) to = Math.min(to, atA / (atA - atB));
  }
  return from < to ? [av + from * (bv - av), av + to * (bv - av)] : null;
}

/** How far a cell is open: from the track to the nearest ice to port and to starboard [m]; null where there is none. */
function opening(run, places, cell) {
  const { floes } = run;
  const { ringsOf, ringEnds } = floes;
  let port = Infinity;
  let starboard = Infinity;
  const see = (low, high) => {
    if (high > 0) port = Math.min(port, Math.max(0, low));
    if (low < 0) starboard = Math.min(starboard, Math.max(0, -high));
  };
  for (let n = 0; n < places.count; ++n) {
    const id = places.living[n];
    if (floes.cameUp[id]) continue; // brash lies in the channel
    const dx = places.x[id] - cell.x;
    const dy = places.y[id] - cell.y;
    const reach = floes.reach[id];
    const v = cell.fx * dy - cell.fy * dx;
    if (Math.abs(cell.fx * dx + cell.fy * dy) > cell.halfLength + reach || Math.abs(v) > cell.size + reach) continue;
    if (v - reach > Math.max(0, port) || -v - reach > Math.max(0, starboard)) continue; // behind nearer ice
    const [c, s] = [places.cos[id], places.sin[id]];
    if (contains(floes, id, -c * dx - s * dy, s * dx - c * dy)) see(-Infinity, Infinity);
    const { points, first } = floes.shape(id);
    const [cx, cy] = [floes.cx[id], floes.cy[id]];
    let k = first;
    for (let ring = ringsOf[id]; ring < ringsOf[id + 1]; ++ring) {
      const last = first + ringEnds[ring] - 1;
      let [au, av] = [0, 0];
      for (let i = k - 1; i <= last; ++i) {
        const from = i < k ? last : i;
        const [px, py] = [points[2 * from] - cx, points[2 * from + 1] - cy];
        const [wx, wy] = [dx + c * px - s * py, dy + s * px + c * py];
        const [bu, bv] = [cell.fx * wx + cell.fy * wy, cell.fx * wy - cell.fy * wx];
        const across = i < k ? null : clippedAcross(cell.outline, au, av, bu, bv);
        if (across) see(Math.min(...across), Math.max(...across));
        [au, av] = [bu, bv];
      }
      k = last + 1;
    }
  }
  return { port: Number.isFinite(port) ? port : null, starboard: Number.isFinite(starboard) ? starboard : null };
}

/** The stations of `polynya channel --at` now. */
function stationsOf(run, places, motions, ship, time) {
  return cellsOf(run, motions, ship, time).map((cell) => ({ ...cell, ...opening(run, places, cell) }));
}

const isBounded = ({ port, starboard }) => port !== null && starboard !== null;

/** Mean width of the stations with ice on both sides, in words; "" where there is none. */
function widthWords(stations) {
  const bounded = stations.filter(isBounded);
  if (bounded.length === 0) return "";
  const mean = bounded.reduce((sum, { port, starboard }) => sum + port + starboard, 0) / bounded.length;
  return `${mean.toFixed(1)} m wide, ${(mean / bounded[0].beam).toFixed(2)} beams`;
}

/** Of each station with ice on both sides the rectangle from ice to ice. */
function drawStations(context, view, stations, colours) {
  context.fillStyle = colours.channel;
  context.beginPath();
  for (const { x, y, fx, fy, length, port, starboard } of stations) {
    if (port === null || starboard === null || !view.shows(x, y, length + port + starboard)) continue;
    [[-0.5, port], [-0.5, -starboard], [0.5, -starboard], [0.5, port]].forEach(([part, v], k) => {
      const u = part * length;
      const point = view.toScreen(x + fx * u - fy * v, y + fy * u + fx * v);
      if (k === 0) context.moveTo(...point);
      else context.lineTo(...point);
    });
    context.closePath();
  }
  context.fill();
}
