// Shapes of floes. The page holds whole ones, and of the others what floes.ndjson does (docs/run-folder.md): stretches of the parent's
// rings and new points. These are assembled on demand, and the last ones kept.

const mostKeptPoints = 4e6; // of assembled shapes, 64 MB

/**
 * Gives a floe's shape: `points` [x, y, ...] in its body frame [m] from the point `first` on, ring after ring. A ring ends before the
 * point `first + ring_ends[ring]`.
 */
function makeShapes(columns) {
  const { parent, rings_of: ringsOf, ring_ends: ringEnds, points_m: points } = columns;
  const { part_floe: floeOf, part_ring: ringOf, part_first: firstOf, part_count: countOf } = columns;
  const count = parent.length;
  const sizeOf = (floe) => ringEnds[ringsOf[floe + 1] - 1];
  const partsOf = new Map(); // by floe: its first part, and one past its last one
  floeOf.forEach((floe, part) => partsOf.set(floe, [partsOf.get(floe)?.[0] ?? part, part + 1]));
  const newAt = new Int32Array(count + 1); // the first of each floe's new points
  for (let floe = 0; floe < count; ++floe) {
    let fresh = sizeOf(floe);
    const [from, to] = partsOf.get(floe) ?? [0, 0];
    for (let part = from; part < to; ++part) if (ringOf[part] >= 0) fresh -= countOf[part];
    newAt[floe + 1] = newAt[floe] + fresh;
  }
  const kept = new Map(); // the oldest first
  let keptPoints = 0;

  function keep(floe, shape) {
    kept.set(floe, shape);
    keptPoints += sizeOf(floe);
    for (const oldest of kept.keys()) {
      if (keptPoints <= mostKeptPoints || oldest === floe) break;
      kept.delete(oldest);
      keptPoints -= sizeOf(oldest);
    }
  }

  function assemble(floe, of) {
    const assembled = new Float64Array(2 * sizeOf(floe));
    const [from, to] = partsOf.get(floe);
    let at = 0;
    const copy = (source, first, number) => {
      assembled.set(source.subarray(2 * first, 2 * (first + number)), at);
      at += 2 * number;
    };
    for (let part = from; part < to; ++part) {
      if (ringOf[part] < 0) {
        copy(points, newAt[floe] + firstOf[part], countOf[part]);
        continue;
      }
      const ring = ringsOf[parent[floe]] + ringOf[part];
      const start = ringOf[part] > 0 ? ringEnds[ring - 1] : 0;
      const beforeEnd = Math.min(countOf[part], ringEnds[ring] - start - firstOf[part]);
      copy(of.points, of.first + start + firstOf[part], beforeEnd);
      copy(of.points, of.first + start, countOf[part] - beforeEnd);
    }
    return { points: assembled, first: 0 };
  }

  return (floe) => {
    const missing = [];
    let at = floe;
    for (; partsOf.has(at) && !kept.has(at); at = parent[at]) missing.push(at);
    let shape = kept.get(at) ?? { points, first: newAt[at] };
    while (missing.length > 0) {
      const next = missing.pop();
      shape = assemble(next, shape);
      keep(next, shape);
    }
    return shape;
  };
}
