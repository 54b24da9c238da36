// The card of a ship, the text about it on the map, and the search for the ship under a point.

/** Returns true if a point lies inside a ring of points [x, y]. */
function isInRing(ring, x, y) {
  let isInside = false;
  ring.forEach(([ax, ay], k) => {
    const [bx, by] = ring.at(k - 1);
    if ((ay > y) !== (by > y) && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) isInside = !isInside;
  });
  return isInside;
}

/** Index of the ship or structure whose waterline contains a point of the world; −1 if there is none, or no frame that
 * has its place. */
function shipAt({ info: { ships } }, motions, x, y) {
  return ships.findIndex(({ waterline_m: ring }, index) => {
    const pose = motions.ship(index);
    if (!pose) return false;
    const [dx, dy, c, s] = [x - pose[0], y - pose[1], Math.cos(pose[2]), Math.sin(pose[2])];
    return isInRing(ring, c * dx + s * dy, -s * dx + c * dy);
  });
}

/** An angle in degrees as text with one decimal. */
const degreeWords = (degrees) => `${minus((Math.abs(degrees) < 0.05 ? 0 : degrees).toFixed(1))}\u00b0`;

/** An angle [rad] as text in degrees from −180 to 180. */
const angleWords = (angle) => degreeWords((180 / Math.PI) * Math.atan2(Math.sin(angle), Math.cos(angle)));

const slowest = 0.005; // below this speed no course is shown, because its direction would be arbitrary [m/s]

/** Rows of a ship's card: name, text, exact value if the text is rounded, and meaning of the row. The motion of
 * the ship is interpolated between frames. Lever, rudder, power and number of contacts are from forces.csv, at the
 * end of the row's interval that contains the time. */
function shipFacts(run, motions, index, time) {
  const ship = run.info.ships[index];
  const [, , heading, vx, vy, turn] = motions.ship(index);
  const rows = run.forces[index];
  const row = rowAt(rows, time);
  const column = (name) => (row !== null && rows[name] ? rows[name][row] : undefined);
  const facts = [[ship.is_fixed ? "structure" : "ship", ship.name]];
  const add = (name, words, value, meaning) => facts.push([name, words, value, meaning]);
  const speed = Math.hypot(vx, vy);
  if (!ship.is_fixed) {
    add("speed", shipSpeedWords(speed), `${speed} m/s`, "over ground");
    add("heading", angleWords(heading), `${heading} rad`, "from the x axis, counter-clockwise");
    if (speed > slowest) add("course", angleWords(Math.atan2(vy, vx)), `${Math.atan2(vy, vx)} rad`,
      "direction of motion over ground, from the x axis, counter-clockwise");
    add("rate of turn", valueWords((180 / Math.PI) * turn, "\u00b0/s"), `${turn} rad/s`, "counter-clockwise");
  }
  const ofColumn = (name, label, unit, meaning, words = valueWords) => {
    if (column(name) !== undefined) add(label, words(column(name), unit), `${column(name)} ${unit}`.trim(), meaning);
  };
  if (ship.has_engine) {
    ofColumn("lever", "thrust lever", "", "share of the power: \u22121 full astern to 1 full ahead");
    ofColumn("steering_deg", "rudder", "\u00b0", "angle of rudder or thrusters, to port", degreeWords);
    ofColumn("delivered_power_W", "power", "W", "delivered at that lever");
  }
  ofColumn("contacts", "contacts with ice", "", "at the hull");
  if (ship.is_moored) facts.push(["mooring", run.moorings.brokeAt(ship.name) <= time ? "broken" : "holds"]);
  return facts;
}

/** Forces on a ship by cause at a time: a row for each cause that acts in this run, a column for each direction, and
 * the sum of each column. A cell is null if the cause does not act in that direction. */
function shipForces({ info: { force_causes: causes }, forces }, index, time) {
  const rows = forces[index];
  const row = rowAt(rows, time);
  const acting = causes.filter(({ column }) => rows[column].some(Boolean));
  const directions = [...new Set(acting.map(({ direction }) => direction))];
  const cellOf = (found) => (found === undefined || row === null ? null
    : { value: rows[found.column][row], unit: found.unit });
  const table = [...new Map(acting.map(({ cause, words }) => [cause, words]))].map(([cause, words]) => ({ cause, words,
    cells: directions.map((direction) => cellOf(acting.find((one) => one.cause === cause
      && one.direction === direction))) }));
  const sumOf = (cells) => cells.reduce((sum, { value, unit }) => ({ value: (sum?.value ?? 0) + value, unit }), null);
  const sums = directions.map((_, k) => sumOf(table.map(({ cells }) => cells[k]).filter(Boolean)));
  return { directions, table, sums };
}

/** A number as text in the unit of its column, which `factor` converts to. It has as many decimals as give the column's
 * largest value three digits, at most three. */
function cellWords(value, largest, factor) {
  const digits = Math.max(0, 2 - Math.floor(Math.log10(largest * factor || 1)));
  const text = (value * factor).toFixed(Math.min(3, digits));
  return minus(Number(text) === 0 ? "0" : text);
}

/** Makes the table of forces, in which each column has one unit. The exact value of a cell is in `data-value` and in
 * its tooltip. */
function forceTable({ directions, table, sums }) {
  const columns = directions.map((direction, k) => {
    const cells = [...table.map(({ cells: row }) => row[k]), sums[k]].filter(Boolean);
    const largest = Math.max(...cells.map(({ value }) => Math.abs(value)));
    const { factor, name: unit } = unitFor(largest, cells[0].unit);
    return { name: direction.split(" ")[0].toLowerCase(), largest, factor, unit };
  });
  const cellOf = (cell, k) => (cell === null ? make("td", {}, "\u2013")
    : make("td", { "data-value": String(cell.value), title: `${cell.value} ${cell.unit}` },
      cellWords(cell.value, columns[k].largest, columns[k].factor)));
  const rowOf = ({ cause, words, cells }) => make("tr", { "data-cause": cause },
    make("th", { scope: "row" }, make("i", { style: `background: var(--cause-${cause})` }), words),
    ...cells.map(cellOf));
  return make("table", { class: "by-cause" },
    make("thead", {}, make("tr", {}, make("th", { scope: "col" }, "by cause"), ...columns.map(({ name, unit }) =>
      make("th", { scope: "col" }, name, make("span", {}, `[${unit}]`))))),
    make("tbody", {}, ...table.map(rowOf)),
    make("tfoot", {}, make("tr", { "data-cause": "sum" }, make("th", { scope: "row" }, "sum"), ...sums.map(cellOf))));
}

/** Shows the facts and forces of a ship in `host`, or a hint if `index` is negative. Tests find a row by `data-fact`
 * and its exact value by `data-value`. */
function showShipCard(host, run, motions, index, time) {
  if (index < 0) return host.replaceChildren(make("p", { class: "hint" }, "Click a ship."));
  const list = make("dl");
  for (const [name, words, value, meaning] of shipFacts(run, motions, index, time))
    list.append(make("dt", meaning ? { title: meaning } : {}, name), make("dd", { "data-fact": name,
      ...(value !== undefined && { "data-value": String(value).split(" ")[0], title: String(value) }) }, words));
  const forces = shipForces(run, index, time);
  return host.replaceChildren(list, ...(forces.table.length > 0
    ? [make("h3", { title: `mean over the ${run.info.forces_interval_s} s of a row of forces.csv` },
      "Forces on the ship"), forceTable(forces)] : []));
}

/** Text on the map for the ship under the pointer. */
function shipLine({ info: { ships } }, motions, index) {
  const [, , , vx, vy] = motions.ship(index);
  return ships[index].is_fixed ? ships[index].name
    : `${ships[index].name} \u00b7 ${shipSpeedWords(Math.hypot(vx, vy))}`;
}

/** Returns a function that updates the card when the ship that is selected or under the pointer changes, or the time.
 * */
function makeShownShip({ run, state, motions }) {
  let shown = "";
  return () => {
    const index = state.ship >= 0 ? state.ship : state.hoveredShip;
    const key = `${index} ${state.time}`;
    if (key === shown) return;
    shown = key;
    showShipCard(byId("ship-card"), run, motions, index, state.time);
  };
}

/** Returns an object whose `brokeAt` gives the time at which the mooring of a ship broke [s]; Infinity if it did
 * not. */
const readMoorings = (events) => ({
  brokeAt: (name) => events.find(({ kind, ship }) => kind === "mooring_break" && ship === name)?.t_s ?? Infinity,
});
