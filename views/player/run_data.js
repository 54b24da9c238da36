// The run as the page holds it: its columns, and the shapes of its floes.

// Shapes of floes. The page holds whole ones, and of the others what floes.ndjson does (docs/run-folder.md): stretches
// of the parent's rings and new points. These are assembled on demand, and the last ones kept.

const mostKeptPoints = 4e6; // of assembled shapes, 64 MB

/** Where each floe's parts and new points stand in the page's columns. */
function shapeParts(columns) {
  const { parent, rings_of: ringsOf, ring_ends: ringEnds } = columns;
  const { part_floe: floeOf, part_ring: ringOf, part_count: countOf } = columns;
  const sizeOf = (floe) => (ringsOf[floe + 1] > ringsOf[floe] ? ringEnds[ringsOf[floe + 1] - 1] : 0);
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
 * Gives a floe's shape: `points` [x, y, ...] in its body frame [m] from the point `first` on, ring after ring. A ring
 * ends before the
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

// The run in the page: words and lists as JSON, numbers as columns (docs/view.md).

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const columnTypes = { f64: Float64Array, i32: Int32Array, u8: Uint8Array };

const floeRows = ["parent", "generation", "born_s", "died_s", "went_under_s", "came_up", "area_m2", "mass_kg",
  "thickness_m", "flexural_strength_Pa",
  "centroid_x_m", "centroid_y_m", "reach_m"];

/** Gives the floes of a page of an area their ids: rows of all floes of the run, in which those left out are never born
 * and have no shape. */
function spreadFloes(columns, count) {
  const ids = columns.floe_id;
  for (const name of floeRows) {
    const kept = columns[name];
    columns[name] = new kept.constructor(count).fill(name === "parent" ? -1 : name.endsWith("_s") ? Infinity : 0);
    ids.forEach((id, row) => { columns[name][id] = kept[row]; });
  }
  const ends = new Int32Array(count + 1);
  ids.forEach((id, row) => { ends[id + 1] = columns.rings_of[row + 1]; });
  for (let id = 0; id < count; ++id) ends[id + 1] = Math.max(ends[id], ends[id + 1]);
  columns.rings_of = ends;
}

function readRun() {
  const info = JSON.parse(byId("run-info").textContent);
  const bytes = bytesOfBase64(byId("run-columns").textContent.trim());
  byId("run-columns").remove();
  const columns = {};
  for (const c of info.columns) columns[c.name] = new columnTypes[c.type](bytes.buffer, c.offset, c.count);
  if (columns.floe_id) spreadFloes(columns, info.floes_of_run);
  const floes = readFloes(columns);
  const frames = readFrames(columns.frames, floes.count, info.ships.length);
  return { info, columns, floes, frames, forces: readForces(info, columns) };
}

function readFloes(columns) {
  const count = columns.parent.length;
  const floes = {
    count,
    parent: columns.parent,
    generation: columns.generation,
    born: columns.born_s,
    died: columns.died_s,
    wentUnder: columns.went_under_s,
    floatsUntil: Float64Array.from(columns.died_s, (died, i) => Math.min(died, columns.went_under_s[i])),
    cameUp: columns.came_up, // from under a hull, or what came up broke into it
    area: columns.area_m2,
    mass: columns.mass_kg,
    thickness: columns.thickness_m,
    flexuralStrength: columns.flexural_strength_Pa,
    cx: columns.centroid_x_m,
    cy: columns.centroid_y_m,
    ringsOf: columns.rings_of,
    ringEnds: columns.ring_ends,
    shape: makeShapes(columns),
    reach: columns.reach_m, // farthest vertex from the centroid [m]
    oldest: new Int32Array(count), // the floe of the scene it comes from
    children: new Map(),
  };
  for (let i = 0; i < count; ++i) {
    const parent = floes.parent[i];
    floes.oldest[i] = parent >= 0 ? floes.oldest[parent] : i;
    if (parent >= 0) floes.children.set(parent, [...(floes.children.get(parent) ?? []), i]);
  }
  return floes;
}

/** frames.bin (docs/run-folder.md), indexed by floe. */
function readFrames(bytes, floeCount, shipCount) {
  const words = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
  const doubles = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length >> 3);
  const times = [];
  const shipAt = []; // of each frame: where its ships begin in doubles
  const starts = [];
  const recordsOf = new Int32Array(floeCount + 1);
  let at = 2; // in doubles
  while (at + 3 <= doubles.length) {
    const ships = words[2 * at + 1];
    const floes = words[2 * at + 2];
    times.push(doubles[at + 2]);
    shipAt.push(at + 3);
    const first = at + 3 + 6 * ships;
    starts.push([first, floes]);
    for (let i = 0; i < floes; ++i) ++recordsOf[words[2 * (first + 7 * i)] + 1];
    at = first + 7 * floes;
  }
  for (let i = 0; i < floeCount; ++i) recordsOf[i + 1] += recordsOf[i];
  const recordFrame = new Int32Array(recordsOf[floeCount]);
  const recordAt = new Int32Array(recordsOf[floeCount]);
  const next = recordsOf.slice();
  starts.forEach(([first, floes], frame) => {
    for (let i = 0; i < floes; ++i) {
      const slot = next[words[2 * (first + 7 * i)]]++;
      recordFrame[slot] = frame;
      recordAt[slot] = first + 7 * i + 1;
    }
  });
  return { times: Float64Array.from(times), shipAt, shipCount, doubles, recordsOf, recordFrame, recordAt };
}

/** The rows of forces.csv, by ship: the columns that the page names. */
function readForces(info, columns) {
  const names = ["force_t_s", ...info.force_columns.map(({ name }) => name)];
  return info.ships.map((_, ship) => {
    const rows = [];
    columns.force_ship.forEach((s, row) => { if (s === ship) rows.push(row); });
    return Object.fromEntries(names.map((name) => [name, Float64Array.from(rows, (row) => columns[name][row])]));
  });
}
