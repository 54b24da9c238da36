// Forces by what causes them: columns of forces.csv, one for each cause, that add up to the force on a ship (io/run/force_causes.cpp).

/** Of each direction its parts: a column without its shares has the words of what is left. */
function partsByDirection({ force_causes: causes }) {
  const directions = new Map();
  for (const cause of causes) {
    const shares = causes.filter(({ share_of: of }) => of === cause.column).map(({ column }) => column);
    const part = { cause: cause.cause, words: shares.length > 0 ? cause.without_shares : cause.words, column: cause.column, unit: cause.unit, shares };
    directions.set(cause.direction, [...(directions.get(cause.direction) ?? []), part]);
  }
  return directions;
}

/** Adds a column for each part and for the sums to a ship's rows: all of them, and those above and below 0. Gives the parts that are not 0 throughout. */
function addCauses(rows, direction, parts) {
  const sums = { sum: new Float64Array(rows.force_t_s.length), up: new Float64Array(rows.force_t_s.length), down: new Float64Array(rows.force_t_s.length) };
  for (const part of parts) {
    const values = rows[part.column].map((value, row) => part.shares.reduce((left, share) => left - rows[share][row], value));
    rows[`${direction}: ${part.cause}`] = values;
    values.forEach((value, row) => {
      sums.sum[row] += value;
      sums[value > 0 ? "up" : "down"][row] += value;
    });
  }
  for (const [name, values] of Object.entries(sums)) rows[`${direction}: ${name}`] = values;
  return parts.filter((part) => rows[`${direction}: ${part.cause}`].some((value) => value !== 0));
}

/** The plots that stack the causes, one for each ship and direction, where any force acts. */
function stackedQuantities({ info, forces }) {
  const quantities = {};
  for (const [direction, parts] of partsByDirection(info)) {
    info.ships.forEach((ship, k) => {
      const acting = addCauses(forces[k], direction, parts);
      if (acting.length === 0) return;
      const { unit } = acting[0];
      const curve = (kind, label) => ({ kind, label, column: `${direction}: ${kind}`, base: unit, scale: "y" });
      const name = `${direction.split(" ")[0].toLowerCase()}_by_cause`;
      quantities[info.ships.length > 1 ? `${name}@${ship.name}` : name] = {
        label: info.ships.length > 1 ? `${direction}: ${ship.name}` : direction, ship: k, isStack: true,
        curves: [...acting.map(({ cause, words }) => ({ ...curve(cause, words), isArea: true })), curve("sum", "sum")],
        sums: [curve("up", "all above 0"), curve("down", "all below 0")],
      };
    });
  }
  return quantities;
}
