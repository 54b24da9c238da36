// What the plot shows: quantities, each with its curves, which are columns of forces.csv. True loads lead; the paper's
// j/τ_c, which is larger by far, has its own name and its own axis.

/** The quantities a run can show, by the first of their columns; those that not every run has come last, where they are not 0. */
function plotQuantities({ info, forces }) {
  const labels = { mean: `${info.forces_interval_s} s mean`, max: "step maximum", paper: "j/\u03c4c (paper)" };
  const plots = new Map();
  for (const column of info.force_columns) plots.set(column.plot, [...(plots.get(column.plot) ?? []), column]);
  const isShown = ({ name, is_optional }) => !is_optional || forces.some((rows) => rows[name].some((value) => value !== 0));
  const isOptional = ([, columns]) => Number(columns[0].is_optional);
  return Object.fromEntries([...plots].filter(([, columns]) => columns.some(isShown)).sort((a, b) => isOptional(a) - isOptional(b))
    .map(([label, columns]) => [columns[0].name, { label, curves: columns.map(({ name, unit, curve }) =>
      ({ kind: curve, label: columns.length > 1 ? labels[curve] : "", column: name, base: unit, scale: curve === "paper" ? "paper" : "y" })) }]));
}

const isLoad = (curve) => curve.base.startsWith("N");

/** A value with the unit that suits it. */
function valueWords(value, base) {
  const unit = base.startsWith("N") ? loadUnit(Math.abs(value), base) : { factor: 1, name: base };
  const digits = value === 0 ? "0" : Number.isInteger(value) && unit.factor === 1 ? String(value) : (value * unit.factor).toPrecision(4);
  return minus(`${digits} ${unit.name}`.trim());
}

/** The row of forces.csv whose interval holds the time; null before any. */
function rowAt(rows, time) {
  const times = rows.force_t_s;
  return times.length === 0 ? null : Math.min(times.length - 1, lastAtMost(times, time - 1e-9) + 1);
}

/** How a curve is drawn: in its ship's colour; the largest steps pale, behind the means; the paper's load dashed. */
function curveStyle(curve, ship, ships, colours) {
  if (["sum", "up", "down"].includes(curve.kind)) return { stroke: colours.ink, width: 1.5 };
  const colour = curve.kind === "paper" && ships === 1 ? colours["paper-load"] : shipColour(colours, ship);
  if (curve.kind === "max") return { stroke: `${colour}80`, width: 1 };
  if (curve.kind === "paper") return { stroke: colour, width: 1, dash: [4, 3] };
  return { stroke: colour, width: 1.25 };
}
