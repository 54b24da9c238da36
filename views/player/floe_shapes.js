// Shapes of floes. The page holds whole ones, and of the others what floes.ndjson does (docs/run-folder.md): stretches of the parent's
// rings and new points. These are assembled on demand, and the last ones kept.

const mostKeptPoints = 4e6; // of assembled shapes, 64 MB

/** Where each floe's parts and new points stand in the page's columns. */
function shapeParts(columns) {
  const { parent, rings_of: ringsOf, ring_ends: ringEnds } = columns;
  const { part_floe: floeOf, part_ring: ringOf, part_count: countOf } = columns;
  const sizeOf = (floe) => ringEnds[ringsOf[floe + 1] - 1];
  const partsOf = new Map(); // by floe: its first part, and one past its last one
  floeOf.forEach((floe, part) => partsOf.set(floe, [partsOf.get(floe)?.[0] ?? part, part + 1]));
  const newAt = new Int32Array(parent.length + 1); // the first of each floe's new points
  for (let floe = 0; floe < parent.length; ++floe) {
    let fresh = sizeOf(floe);
    const [from, to] = partsOf.get(floe) ?? [0, 0];
    for (let part = from; part < to; ++part) if (ringOf[part] >= 0) fresh -= countOf[part];
    newAt[floe + 1] = newAt[floe] + fresh;
  }
  return { sizeOf, partsOf, newAt };
}

/** A floe's points from its parts and the shape of its parent. */
function assembleShape(columns, { sizeOf, partsOf, newAt }, floe, ofParent) {
  const { parent, rings_of: ringsOf, ring_ends: ringEnds, points_m: points } = columns;
  const { part_ring: ringOf, part_first: firstOf, part_count: countOf } = columns;
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
    copy(ofParent.points, ofParent.first + start + firstOf[part], beforeEnd);
    copy(ofParent.points, ofParent.first + start, countOf[part] - beforeEnd);
  }
  return { points: assembled, first: 0 };
}

/** The shapes assembled last. */
class KeptShapes {
  constructor(sizeOf) {
    this.sizeOf = sizeOf;
    this.shapes = new Map(); // by floe, the oldest first
    this.points = 0;
  }

  keep(floe, shape) {
    this.shapes.set(floe, shape);
    this.points += this.sizeOf(floe);
    for (const oldest of this.shapes.keys()) {
      if (this.points <= mostKeptPoints || oldest === floe) break;
      this.shapes.delete(oldest);
      this.points -= this.sizeOf(oldest);
    }
  }
}

/**
 * Gives a floe's shape: `points` [x, y, ...] in its body frame [m] from the point `first` on, ring after ring. A ring ends before the
 * point `first + ring_ends[ring]`.
 */
function makeShapes(columns) {
  const parts = shapeParts(columns);
  const kept = new KeptShapes(parts.sizeOf);
  return (floe) => {
    const missing = [];
    let at = floe;
    for (; parts.partsOf.has(at) && !kept.shapes.has(at); at = columns.parent[at]) missing.push(at);
    let shape = kept.shapes.get(at) ?? { points: columns.points_m, first: parts.newAt[at] };
    while (missing.length > 0) {
      const next = missing.pop();
      shape = assembleShape(columns, parts, next, shape);
      kept.keep(next, shape);
    }
    return shape;
  };
}
