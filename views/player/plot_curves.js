// What the plot shows: quantities, each with its curves, which are columns of forces.csv. True loads lead; the paper's
// j/τ_c, which is larger by far, has its own name and its own axis.

const loads = { surge: ["Surge", "N"], sway: ["Sway", "N"], yaw: ["Yaw", "Nm"] };

function curvesOfLoad(load, unit, interval, hasShips) {
  const base = unit === "N" ? "N" : "N\u00b7m";
  const curve = (kind, label, infix, scale = "y") => ({ kind, label, column: `${load}${infix}_${unit}`, base, scale });
  const source = hasShips ? "_from_ships" : "";
  const curves = [curve("mean", `${interval} s mean`, source), curve("max", "step maximum", `${source}_max`)];
  if (!hasShips) curves.push(curve("paper", "j/\u03c4c (paper)", "_j_over_tau_c", "paper"));
  return curves;
}

/** The quantities a run can show. */
function plotQuantities(run) {
  const { info, forces } = run;
  const quantities = {};
  for (const [load, [word, unit]] of Object.entries(loads)) {
    const what = load === "yaw" ? "moment" : "force";
    const curves = curvesOfLoad(load, unit, info.forces_interval_s, false).filter(({ column }) => forces.every((rows) => rows[column]));
    quantities[load] = { label: `${word} ${what} of the ice`, curves };
  }
  const single = (column, label, base) => ({ label, curves: [{ kind: "mean", label: "", column, base, scale: "y" }] });
  quantities.speed = single("speed_m_per_s", "Speed over ground", "m/s");
  quantities.thrust = single("thrust_N", "Thrust", "N");
  quantities.contacts = single("force_contacts", "Contacts at the hull", "");
  for (const [load, [word, unit]] of Object.entries(loads)) {
    const curves = curvesOfLoad(load, unit, info.forces_interval_s, true);
    const isFelt = forces.some((rows) => curves.some(({ column }) => rows[column]?.some((value) => value !== 0)));
    if (isFelt) quantities[`${load}_from_ships`] = { label: `${word} ${load === "yaw" ? "moment" : "force"} of ships`, curves };
  }
  return quantities;
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
  const colour = curve.kind === "paper" && ships === 1 ? colours["paper-load"] : shipColour(colours, ship);
  if (curve.kind === "max") return { stroke: `${colour}80`, width: 1 };
  if (curve.kind === "paper") return { stroke: colour, width: 1, dash: [4, 3] };
  return { stroke: colour, width: 1.25 };
}
