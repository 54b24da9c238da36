// A run that grows. It has the members of a run that the player's drawing functions need; snapshots of the worker fill
// it.

/** A column of numbers that grows. */
function makeGrowing(Type) {
  const column = { values: new Type(1024), count: 0 };
  column.reserve = (count) => {
    if (count <= column.values.length) return;
    const grown = new Type(Math.max(count, 2 * column.values.length));
    grown.set(column.values.subarray(0, column.count));
    column.values = grown;
  };
  column.append = (added) => {
    column.reserve(column.count + added.length);
    column.values.set(added, column.count);
    column.count += added.length;
  };
  return column;
}

/** Floes of a growing run in columns, as draw_ice.js reads them. */
function makeLiveFloes() {
  const [whole, real] = [() => makeGrowing(Int32Array), () => makeGrowing(Float64Array)];
  const columns = { parent: whole(), generation: whole(), area: real(), cx: real(), cy: real(), reach: real(),
    ringsOf: whole(), ringEnds: whole(), pointsOf: whole(), points: real(), oldest: whole() };
  columns.ringsOf.append([0]);
  columns.pointsOf.append([0]);
  const floes = { count: 0,
    shape: (id) => floes.points.subarray(2 * floes.pointsOf[id], 2 * floes.pointsOf[id + 1]) };
  const show = () => Object.entries(columns).forEach(([name, { values }]) => { floes[name] = values; });

  /** Appends floes, which arrive in the order of their ids. */
  floes.append = (born) => {
    columns.points.append(born.points_m);
    for (const [to, from] of [["parent", "born_parent"], ["generation", "born_generation"], ["area", "born_area_m2"],
      ["cx", "born_x_m"], ["cy", "born_y_m"]]) columns[to].append(born[from]);
    let ring = 0;
    let at = columns.pointsOf.values[columns.pointsOf.count - 1];
    born.born_floe.forEach((id, k) => {
      let size = 0;
      const ends = [];
      for (let r = 0; r < born.born_rings[k]; ++r) ends.push(size += born.ring_sizes[ring++]);
      columns.ringEnds.append(ends);
      columns.ringsOf.append([columns.ringEnds.count]);
      let reach = 0;
      for (let p = at; p < at + size; ++p) reach = Math.max(reach, Math.hypot(columns.points.values[2 * p]
        - born.born_x_m[k], columns.points.values[2 * p + 1] - born.born_y_m[k]));
      at += size;
      columns.pointsOf.append([at]);
      columns.reach.append([reach]);
      const parent = born.born_parent[k];
      columns.oldest.append([parent >= 0 ? columns.oldest.values[parent] : id]);
    });
    floes.count += born.born_floe.length;
    show();
  };
  show();
  return floes;
}

/** Places of the floes in the last snapshot, by id. */
function makeLivePlaces() {
  const names = ["x", "y", "cos", "sin", "vx", "vy"];
  const places = { count: 0, living: new Int32Array(0), under: [] };
  for (const name of names) places[name] = new Float64Array(1024);
  places.set = ({ floe, place, floating }, floes) => {
    if (places.x.length < floes.count)
      for (const name of names) places[name] = new Float64Array(2 * floes.count);
    floe.forEach((id, k) => names.forEach((name, column) => { places[name][id] = place[6 * k + column]; }));
    places.living = floe.subarray(0, floating[0]);
    places.count = floating[0];
    places.under = Array.from(floe.subarray(floating[0]));
  };
  places.isAlive = (id) => places.living.includes(id);
  return places;
}

/** Loads so far: a table for each hull with a column for each quantity, as the player's plot reads them. */
function makeLiveForces(hulls, columns) {
  const names = ["force_t_s", ...columns.map(({ name }) => name)];
  const growing = hulls.map(() => new Map(names.map((name) => [name, makeGrowing(Float64Array)])));
  const tables = hulls.map(() => ({}));
  const append = (added) => {
    added.sample_hull.forEach((hull, row) => growing[hull].forEach((column, name) =>
      column.append([name === "force_t_s" ? added.sample_s[row] : added[name][row]])));
    growing.forEach((of, hull) => of.forEach(({ values, count }, name) => {
      tables[hull][name] = values.subarray(0, count);
    }));
  };
  append({ sample_hull: [] });
  return { tables, append };
}

/** Makes the run of a scene that the module has read. */
function makeLiveRun(words) {
  const floes = makeLiveFloes();
  const hulls = words.hulls.map(() => new Float64Array(8));
  const ships = words.hulls.map(({ name, waterline_m, can_be_steered: canBeSteered }, k) =>
    ({ name, waterline_m, canBeSteered, is_fixed: k >= words.ships }));
  const forces = makeLiveForces(words.hulls, words.force_columns);
  const run = {
    words, floes, time: 0, counts: { bends: 0, splits: 0, ground: 0 }, events: [], tracks: ships.map(() => []),
    // Only at its end it is known which optional quantities and which causes a run has. So the plot of a running run
    // offers all quantities and no stacked causes.
    info: { ships, patterns: [], force_columns: words.force_columns.map((one) => ({ ...one, is_optional: false })),
      force_causes: [], forces_interval_s: words.forces_interval_s,
      splits_by_j_over_tau_c: words.splits_by_j_over_tau_c },
    places: makeLivePlaces(), forces: forces.tables,
    motions: { ship: (index) => hulls[index] }, hasPlaces: false,
  };
  run.outline = makeOutlines(run);
  run.take = ({ words: at, columns }) => {
    run.time = at.t_s;
    run.counts = at;
    floes.append(columns);
    run.places.set(columns, floes);
    hulls.forEach((hull, k) => hull.set(columns.hull.subarray(8 * k, 8 * k + 8)));
    run.tracks.forEach((track, k) => {
      const [x, y] = hulls[k];
      const last = track.at(-1);
      if (!last || Math.hypot(x - last[0], y - last[1]) > 1) track.push([x, y]);
    });
    forces.append(columns);
    for (const line of new TextDecoder().decode(columns.events).split("\n"))
      if (line) run.events.push(JSON.parse(line));
    run.hasPlaces = true;
  };
  return run;
}
