// Curves of the plot: columns of forces.csv as lines, causes as stacked areas, and the ranges of their axes.

// Ranges of the axes of loads. Crushing ice causes spikes; a scale that showed all of them would flatten everything
// else.

// Least fraction of the rows with a load that the scale shows [-]; smaller: more spikes are cut off.
const common = 0.99;
const beyondCommon = 1.25; // a scale without spikes ends at this multiple of the load at the fraction `common` [-]
const spike = 2; // the scale leaves out spikes only if the largest load exceeds this multiple of its end [-]

/** The value below which the fraction `common` of a column's rows that are not 0 lies, and the largest value, as
 * magnitudes. The first is estimated from at most 5000 rows, so that sorting stays fast. */
function sizesOf(values) {
  const stride = Math.ceil(values.length / 5000);
  const sizes = [];
  let largest = 0;
  for (let k = 0; k < values.length; ++k) {
    const size = Math.abs(values[k]);
    if (size > largest) largest = size;
    if (size > 0 && k % stride === 0) sizes.push(size);
  }
  sizes.sort((a, b) => a - b);
  return { usual: sizes[Math.floor(common * (sizes.length - 1))] ?? 0, largest };
}

/** Extends the range [low, high] to the smallest and largest value of columns. */
function extentOfColumns(columns, low, high) {
  for (const values of columns) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return [low, high];
}

/** Range of an axis that columns of loads need, which includes 0: everything, or without spikes. */
function loadRange(columns, isFull) {
  const sizes = columns.map(sizesOf);
  const largest = Math.max(0, ...sizes.map((size) => size.largest));
  const reach = beyondCommon * Math.max(0, ...sizes.map((size) => size.usual));
  const limit = isFull || largest <= spike * reach ? largest : reach;
  const [low, high] = extentOfColumns(columns, 0, 0);
  return [Math.max(low, -limit), Math.min(high, limit)];
}

/** Range of an axis for columns that are not loads: from their smallest to their largest value. */
function wholeRange(columns) {
  const [low, high] = extentOfColumns(columns, Infinity, -Infinity);
  return low <= high ? [low, high] : [0, 1];
}

/** Ranges with a margin of 6 %, extended so that 0 is at the same height in all of them. They extend below 0 by at
 * least 4 % of their largest magnitude, so that a curve at 0 is visible, and above 0 by at least 10 % of it.
 * Ranges in which all values are 0 end at about 1 in the base unit. */
function alignedRanges(ranges) {
  const size = ([low, high]) => Math.max(high, -low) || 1;
  const below = Math.max(...ranges.map((range) => -range[0] / size(range)));
  const above = Math.max(...ranges.map((range) => range[1] / size(range)), below > 0 ? 0.1 : 1);
  return ranges.map((range) => [-1.06 * Math.max(below, 0.04) * size(range), 1.06 * above * size(range)]);
}

/** Rows of a column that are beyond its scale: their number, and the largest with its time. */
function rowsOffScale(times, values, [low, high]) {
  const off = { count: 0, largest: 0, time: 0 };
  values.forEach((value, row) => {
    if (value >= low && value <= high) return;
    ++off.count;
    if (Math.abs(value) > Math.abs(off.largest)) Object.assign(off, { largest: value, time: times[row] });
  });
  return off;
}

// Forces by cause: one column for each cause, whose sum is the force on a ship (io/run/records.cpp).

/** Plots that stack the causes, one for each ship and direction with any force, by their names in a link. Adds the sum
 * of the causes to the ship's rows as a column. The values of `sums`, the sums of the positive and of the negative
 * means, are in no column: Plot computes them for the visible rows. */
function stackedQuantities({ info: { force_causes: causes, ships }, forces }) {
  const quantities = {};
  for (const direction of new Set(causes.map((cause) => cause.direction))) {
    forces.forEach((rows, ship) => {
      const acting = causes.filter((cause) => cause.direction === direction && rows[cause.column].some(Boolean));
      if (acting.length === 0) return;
      const sum = `${direction}: sum`;
      rows[sum] = rows.force_t_s.map((_, row) => acting.reduce((all, { column }) => all + rows[column][row], 0));
      const curve = (kind, label, column) => ({ kind, label, column, base: acting[0].unit, scale: "y" });
      const areas = acting.map(({ cause, words, column }) => ({ ...curve(cause, words, column), isArea: true }));
      const name = `${direction.split(" ")[0].toLowerCase()}_by_cause`;
      const isOfMany = ships.length > 1;
      quantities[isOfMany ? `${name}@${ships[ship].name}` : name] = {
        label: isOfMany ? `${direction}: ${ships[ship].name}` : direction, ship, isStack: true,
        curves: [...areas, curve("sum", "sum", sum)],
        sums: [curve("up", "all above 0"), curve("down", "all below 0")],
      };
    });
  }
  return quantities;
}

// Quantities of the plot, each with its curves, which are columns of forces.csv. True loads come first. The
// collision force j/τ_c of Sawamura's paper (docs/glossary.md), which is much larger, has its own name and axis.

/** Quantities that a run can show; each has the name of the first of its columns. Optional quantities, which not every
 * run has, are listed last, and only if one of their values is not 0. */
function plotQuantities({ info, forces }) {
  const labels = { mean: `${info.forces_interval_s} s mean`, max: "step maximum (depends on the step)",
    paper: "j/\u03c4c (paper)" };
  const isShown = ({ name, is_optional }) => !is_optional || forces.some((rows) => rows[name].some(Boolean));
  const plots = new Map([false, true].flatMap((is_optional) =>
    info.force_columns.filter((column) => column.is_optional === is_optional).map(({ plot }) => [plot, []])));
  for (const column of info.force_columns) plots.get(column.plot).push(column);
  return Object.fromEntries([...plots].filter(([, columns]) => columns.some(isShown)).map(([label, columns]) =>
    [columns[0].name, { label, curves: columns.map(({ name, unit, curve }) =>
      ({ kind: curve, label: columns.length > 1 ? labels[curve] : "", column: name, base: unit,
        scale: curve === "paper" ? "paper" : "y" })) }]));
}

/** Returns true for forces and moments, whose units are N and N·m. */
const isLoad = (curve) => curve.base.startsWith("N");

/** Index of the row of forces.csv whose interval contains a time [s]: of the first row for earlier times, of the last
 * for later ones; null if there are no rows. A time at which one interval ends belongs to that interval; the margin of
 * 1e-9 s allows for rounding. */
function rowAt(rows, time) {
  const times = rows.force_t_s;
  return times.length === 0 ? null : Math.min(times.length - 1, lastAtMost(times, time - 1e-9) + 1);
}

/** Style of a curve: the colour of its ship; the largest steps are pale and behind the means; the paper's load is
 * dashed and, in a run with one ship, has a colour of its own. */
function curveStyle(curve, ship, ships, colours) {
  if (curve.kind === "sum") return { stroke: colours.ink, width: 1.5 };
  const colour = curve.kind === "paper" && ships === 1 ? colours["paper-load"] : shipColour(colours, ship);
  if (curve.kind === "max") return { stroke: `${colour}80`, width: 1 };
  if (curve.kind === "paper") return { stroke: colour, width: 1, dash: [4, 3] };
  return { stroke: colour, width: 1.25 };
}

// Stacked areas: forces by cause, positive ones upwards from 0, negative ones downwards, and the line of their sum.

const columnWidth = 2; // rows that are closer together than this are drawn as their mean [px]

/** Number of rows of forces.csv that are combined into one column of the picture. */
function rowsInColumn(plot) {
  const [first, end] = plot.rowsInView(plot.shownQuantity().ship);
  return Math.max(1, Math.ceil((columnWidth * (end - first)) / Math.max(1, plot.host.clientWidth)));
}

const meanOf = (values) => values.reduce((sum, value) => sum + value / values.length, 0);

/** Visible rows combined into columns: the means of each cause that is shown, the line of the sum, the upper and lower
 * limit of the whole stack, and the times between which each column lies [s]. Columns begin at multiples of their
 * number of rows, so that they do not change when the plot moves. A row lies between the time of the previous row and
 * its own; the first has the length of the second. */
function stackOf(plot) {
  const { ship } = plot.shownQuantity();
  const rows = plot.run.forces[ship];
  const times = rows.force_t_s;
  const [first, end] = plot.rowsInView(ship);
  const size = rowsInColumn(plot);
  const columns = [];
  for (let from = first - (first % size); from < end; from += size)
    columns.push([from, Math.min(times.length, from + size)]);
  const meansOf = ({ column }) => Float64Array.from(columns, (part) => meanOf(rows[column].subarray(...part)));
  const shown = plot.shownCurves();
  const areas = shown.filter(({ kind }) => kind !== "sum").map((curve) => ({ curve, means: meansOf(curve) }));
  const line = shown.find(({ kind }) => kind === "sum");
  const sumOf = (sign) => Float64Array.from(columns, (_, k) =>
    areas.reduce((sum, { means }) => sum + Math.max(0, sign * means[k]), 0) * sign);
  const startOf = (row) => (row > 0 ? times[row - 1] : 2 * times[0] - (times[1] ?? 2 * times[0]));
  return { areas, line: line ? meansOf(line) : null, high: sumOf(1), low: sumOf(-1),
    starts: columns.map(([from]) => startOf(from)), ends: columns.map(([, to]) => times[to - 1]) };
}

/** Draws the areas and the line of the sum into a chart. */
function drawStack(plot, chart) {
  const { areas, line, starts, ends } = stackOf(plot);
  const { ctx, bbox } = chart;
  const xOf = (time) => Math.round(chart.valToPos(time, "x", true));
  const yOf = (value) => Math.round(chart.valToPos(value, "y", true));
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  const [below, above] = [new Float64Array(starts.length), new Float64Array(starts.length)];
  for (const { curve, means } of areas) {
    ctx.fillStyle = plot.colours[`cause-${curve.kind}`];
    means.forEach((mean, k) => {
      const tops = mean > 0 ? above : below;
      const [left, from] = [xOf(starts[k]), yOf(tops[k])];
      tops[k] += mean;
      ctx.fillRect(left, from, xOf(ends[k]) - left, yOf(tops[k]) - from);
    });
  }
  if (line) {
    traceLine(ctx, [...line].flatMap((value, k) => [starts[k], ends[k]].map((time) => [xOf(time), yOf(value)])));
    strokeTwice(ctx, plot.colours.panel, plot.colours.ink, 1.5 * devicePixelRatio, 2 * devicePixelRatio);
  }
  ctx.restore();
}
