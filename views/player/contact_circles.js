// Contact circles as geometry samples them (geometry/contact/contact_circles.cpp), on demand: those of a floe when it is
// first seen from close by.

/** A ring's edges [ax, ay, bx, by], one after the other, the interior on their left. */
function edgesOfRing(coordinates) {
  return coordinates.map(([x, y], k) => [x, y, ...coordinates[(k + 1) % coordinates.length]]);
}

const lengthOf = ([ax, ay, bx, by]) => Math.hypot(bx - ax, by - ay);

/** The middles of the pieces one circle each stands for, with the edge each lies on: of edges longer than the radius equal parts,
 * of shorter ones as many in a row as are no longer together. */
function boundaryPieces(edges, radius) {
  const pieces = [];
  const onEdge = (edge, part) => pieces.push([edge[0] + part * (edge[2] - edge[0]), edge[1] + part * (edge[3] - edge[1]), edge]);
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
    const near = edges.filter(([ax, ay, bx, by]) => Math.min(ax, bx) < x + 2 * radius && Math.max(ax, bx) > x - 2 * radius &&
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
      sampled.set(owner, contactCircles(owner < 0 ? [info.ships[-1 - owner].waterline_m] : ringsOf(floes, owner), info.circle_radius_m));
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
    if (view.shows(places.x[id], places.y[id], floes.reach[id])) draw(id, places.x[id], places.y[id], places.cos[id], places.sin[id]);
  context.strokeStyle = colours.highlight;
  info.ships.forEach((_, ship) => {
    const pose = motions.ship(ship);
    if (pose) draw(-1 - ship, pose[0], pose[1], Math.cos(pose[2]), Math.sin(pose[2]));
  });
  return "";
}
