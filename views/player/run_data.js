// Reads the run from the page: its columns, and the shapes of its floes.

// Largest number of points of assembled shapes that are kept in memory, 64 MB. If there are more, all are dropped and
// assembled again when they are needed; a smaller number saves memory and makes drawing slower.
const mostKeptPoints = 4e6;

/**
 * Returns a function that gives the points [x, y, ...] of a floe in its body frame [m], ring after ring, the outer ring
 * first. Coordinates in the body frame are those that the floe's oldest ancestor had in the scene, so callers subtract
 * the centroid (`cx`, `cy`) before they place a shape. The rings of a floe are those from rings_of[floe] to before
 * rings_of[floe + 1]; each ends before the point ring_ends[ring], counted from the floe's first point. As in
 * floes.ndjson (docs/run-folder.md), shapes are whole, or in parts, in the order of the floe's points. A part is
 * `part_count` points of `part_floe` from the point `part_first`: of the parent's ring `part_ring`, where it may wrap
 * around from the ring's end to its start, or, if `part_ring` is negative, of the floe's own new points in points_m,
 * which has the points that are not a parent's, floe after floe. Parts must be sorted by floe, because bisection finds
 * them.
 * Floes are numbered by the ids of the run, also on a page of an area; a parent has a smaller id than its pieces.
 * Shapes in parts are assembled when they are needed and then kept.
 */
function makeShapes({ parent, rings_of: ringsOf, ring_ends: ringEnds, points_m: points, ...parts }) {
  const { part_floe: floeOf, part_ring: ringOf, part_first: firstOf, part_count: countOf } = parts;
  const sizeOf = (floe) => (ringsOf[floe + 1] > ringsOf[floe] ? ringEnds[ringsOf[floe + 1] - 1] : 0);
  const newAt = new Int32Array(parent.length + 1); // index of the first new point of each floe
  parent.forEach((_, floe) => { newAt[floe + 1] = sizeOf(floe); });
  floeOf.forEach((floe, part) => { if (ringOf[part] >= 0) newAt[floe + 1] -= countOf[part]; });
  for (let floe = 0; floe < parent.length; ++floe) newAt[floe + 1] += newAt[floe];
  const firstPart = (floe) => lastAtMost(floeOf, floe - 1) + 1;
  const kept = new Map();
  let keptPoints = 0;

  function assemble(floe, ofParent) {
    const shape = new Float64Array(2 * sizeOf(floe));
    let at = 0;
    const copy = (source, first, count) => {
      shape.set(source.subarray(2 * first, 2 * (first + count)), at);
      at += 2 * count;
    };
    for (let part = firstPart(floe); floeOf[part] === floe; ++part) {
      if (ringOf[part] < 0) {
        copy(points, newAt[floe] + firstOf[part], countOf[part]);
        continue;
      }
      const ring = ringsOf[parent[floe]] + ringOf[part];
      const start = ringOf[part] > 0 ? ringEnds[ring - 1] : 0;
      const beforeEnd = Math.min(countOf[part], ringEnds[ring] - start - firstOf[part]);
      copy(ofParent, start + firstOf[part], beforeEnd);
      copy(ofParent, start, countOf[part] - beforeEnd);
    }
    return shape;
  }

  return (floe) => {
    const missing = [];
    let at = floe;
    for (; !kept.has(at) && floeOf[firstPart(at)] === at; at = parent[at]) missing.push(at);
    let shape = kept.get(at) ?? points.subarray(2 * newAt[at], 2 * newAt[at + 1]);
    while (missing.length > 0) {
      shape = assemble(missing.at(-1), shape);
      if ((keptPoints += shape.length / 2) > mostKeptPoints) kept.clear(), keptPoints = 0;
      kept.set(missing.pop(), shape);
    }
    return shape;
  };
}

// The page contains the words and lists of a run as JSON, and its numbers as columns (docs/view.md).

const bytesOfBase64 = (text) => Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** Types of columns by their names in the page. A type that ColumnWriter (views/player/player_page.hpp) writes must be
 * here, otherwise the page does not open. Only frames are bytes, "u8"; flags such as came_up are integers, "i32". */
const columnTypes = { f64: Float64Array, i32: Int32Array, u8: Uint8Array };

/** Columns with one value for each floe, which become members of `floes` (readFloes()). A new column of floes must be
 * added here as well as in player_data.cpp; otherwise `floes` does not have it, and pages of an area read it by the
 * wrong floe. */
const floeRows = ["parent", "generation", "born_s", "died_s", "went_under_s", "came_up", "area_m2", "mass_kg",
  "thickness_m", "flexural_strength_Pa", "centroid_x_m", "centroid_y_m", "reach_m"];

/** Expands the columns of a page of an area, which has only some floes, to all `count` floes of the run, so that ids
 * are indices. Floes that the page does not have are never born, never break and never go under (times of Infinity), so
 * they are never drawn; they have no parent and no rings. The columns of parts name floes by id and need no change. */
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

/**
 * The source of the player's run. `read()` returns the words and lists of a run, `info`, and its columns of numbers,
 * `bytes`, both as views/player/player_data.cpp makes them; `info.columns` states where each column is in the bytes.
 * This source, the only one at present, is the page that `polynya view` writes; another one needs only these two, and
 * is passed to startPlayer(). The text of the columns is removed from the page to free memory, so it is read only once.
 */
const pageSource = {
  read() {
    const info = JSON.parse(byId("run-info").textContent);
    const bytes = bytesOfBase64(byId("run-columns").textContent.trim());
    byId("run-columns").remove();
    return { info, bytes };
  },
};

/** Reads the run from a source. Columns are views into its bytes, so each must begin at a multiple of 8 bytes in their
 * buffer; the browser throws an error for a column that is not aligned. Only a page of an area has the column
 * `floe_id`. */
function readRun(source) {
  const { info, bytes } = source.read();
  const columns = {};
  for (const { name, type, offset, count } of info.columns)
    columns[name] = new columnTypes[type](bytes.buffer, bytes.byteOffset + offset, count);
  if (columns.floe_id) spreadFloes(columns, info.floes_of_run);
  const floes = readFloes(columns);
  const frames = readFrames(columns.frames, floes.count, info.ships.length);
  return { info, columns, floes, frames, forces: readForces(info, columns) };
}

/** Columns of floes, named without units: died_s becomes `died` and went_under_s `wentUnder` [s]; both are Infinity if
 * it never happens. `generation` is the number of ancestors of a floe. `reach` is the distance of the farthest vertex
 * from the centroid [m]: a floe farther than it from the screen or the pointer is skipped. `floatsUntil` is the time at
 * which the floe broke or went under [s]; until then it is drawn on the water. `cameUp` is 1 for brash: floes that
 * surfaced from under a hull, and their pieces. `children` has the ids of the pieces of each floe that broke.
 * `shape(floe)` gives a floe's points (makeShapes()). */
function readFloes(columns) {
  const capital = (_, letter) => letter.toUpperCase();
  const nameOf = (column) => column.replace(/_(s|m|m2|kg|Pa)$/, "").replace(/_(.)/g, capital);
  const floes = Object.fromEntries([...floeRows, "rings_of", "ring_ends"].map((name) => [nameOf(name), columns[name]]));
  const count = columns.parent.length;
  Object.assign(floes, {
    count, cx: floes.centroidX, cy: floes.centroidY, shape: makeShapes(columns),
    floatsUntil: floes.died.map((died, i) => Math.min(died, floes.wentUnder[i])),
    oldest: new Int32Array(count), // id of the floe of the scene from which it broke; its own id if it is one
    children: new Map(),
  });
  for (let i = 0; i < count; ++i) {
    const parent = floes.parent[i];
    floes.oldest[i] = parent >= 0 ? floes.oldest[parent] : i;
    if (parent >= 0) floes.children.set(parent, [...(floes.children.get(parent) ?? []), i]);
  }
  return floes;
}

/** Reads frames.bin (docs/run-folder.md) and sorts its records by floe. The file has a header of 16 bytes. A frame has
 * four 32-bit words ("FRAM", the numbers of ships and floes, and 0), its time, six doubles per ship, and for each floe
 * its id as a 64-bit integer, of which the lower 32 bits are read, and six doubles. All numbers are little-endian, as
 * typed arrays are on computers with a usual browser. A page contains whole frames only.
 * A frame contains only the floes that do not move as their last record predicts. Of the result, `times` are the times
 * of the frames [s], and `shipAt` is the index in `doubles` of the first ship of each frame. The records of a floe are
 * those from recordsOf[floe] to before recordsOf[floe + 1], in ascending order of time: `recordFrame` is the frame of
 * each, and `recordAt` the index in `doubles` of its six numbers: x, y [m], angle [rad], velocity in x and y [m/s], and
 * angular velocity [rad/s]. Ships have the same six. */
function readFrames(bytes, floeCount, shipCount) {
  const words = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
  const doubles = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length >> 3);
  const times = [];
  const shipAt = []; // index in doubles of the first ship of each frame
  const starts = [];
  const recordsOf = new Int32Array(floeCount + 1);
  let at = 2; // index in doubles
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

/** Rows of forces.csv for each ship in the order of time, which its card and the plots show: the time `force_t_s`, and
 * the columns that the lists `force_columns` and `force_causes` of `info` name, which player_data.cpp makes with their
 * labels and units. A page that was written with `--from` or `--until` has only the rows of that time. */
function readForces(info, columns) {
  const named = [...info.force_columns.map(({ name }) => name), ...info.force_causes.map(({ column }) => column)];
  return info.ships.map((_, ship) => {
    const rows = [];
    columns.force_ship.forEach((s, row) => { if (s === ship) rows.push(row); });
    const valuesOf = (name) => Float64Array.from(rows, (row) => columns[name][row]);
    return Object.fromEntries(["force_t_s", ...named].map((name) => [name, valuesOf(name)]));
  });
}
