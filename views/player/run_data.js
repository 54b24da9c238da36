// The run in the page: words and lists as JSON, numbers as columns (docs/view.md).

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const columnTypes = { f64: Float64Array, i32: Int32Array, u8: Uint8Array };

function readRun() {
  const info = JSON.parse(byId("run-info").textContent);
  const bytes = bytesOfBase64(byId("run-columns").textContent.trim());
  byId("run-columns").remove();
  const columns = {};
  for (const c of info.columns) columns[c.name] = new columnTypes[c.type](bytes.buffer, c.offset, c.count);
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
