// What the plot shows: columns of forces.csv as curves, causes as stacked areas, and how far their axes reach.

// How far the axes of loads reach. Crushing ice gives spikes: drawn whole, one of them flattens all else.

const common = 0.99; // the share of rows with a load that the scale holds at least
const beyondCommon = 1.25; // the scale reaches this many times as far
const spike = 2; // a spike is larger than this many times that reach; without one the scale shows everything

/** Of the sizes of a column's rows that are not 0 the one that `common` of them stay below, and the largest. */
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

/** From the least to the largest of columns, grown from [low, high]. */
function extentOfColumns(columns, low, high) {
  for (const values of columns) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return [low, high];
}

/** The part of the axis that columns of loads need, [at most 0, at least 0]: all of it, or without spikes. */
function loadRange(columns, isFull) {
  const sizes = columns.map(sizesOf);
  const largest = Math.max(0, ...sizes.map((size) => size.largest));
  const reach = beyondCommon * Math.max(0, ...sizes.map((size) => size.usual));
  const limit = isFull || largest <= spike * reach ? largest : reach;
  const [low, high] = extentOfColumns(columns, 0, 0);
  return [Math.max(low, -limit), Math.min(high, limit)];
}

/** That of columns that are no loads. */
function wholeRange(columns) {
  const [low, high] = extentOfColumns(columns, Infinity, -Infinity);
  return low <= high ? [low, high] : [0, 1];
}

/** The ranges with some room, grown so that 0 is at one height in all of them. */
function alignedRanges(ranges) {
  const size = ([low, high]) => Math.max(high, -low) || 1;
  const below = Math.max(...ranges.map((range) => -range[0] / size(range)));
  const above = Math.max(...ranges.map((range) => range[1] / size(range)), below > 0 ? 0.1 : 1);
  return ranges.map((range) => [-1.06 * Math.max(below, 0.04) * size(range), 1.06 * above * size(range)]);
}

/** Rows of a column that lie off its scale: how many, and the largest with its time. */
function rowsOffScale(times, values, [low, high]) {
  const off = { count: 0, largest: 0, time: 0 };
  values.forEach((value, row) => {
    if (value >= low && value <= high) return;
    ++off.count;
    if (Math.abs(value) > Math.abs(off.largest)) Object.assign(off, { largest: value, time: times[row] });
  });
  return off;
}

// Forces by what causes them: columns, one for each cause, that add up to the force on a ship
// (io/run/records.cpp).

/** The plots that stack the causes, one for each ship and direction, where any force acts. */
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

// What the plot shows: quantities, each with its curves, which are columns of forces.csv. True loads lead; the paper's
// j/τ_c, which is larger by far, has its own name and its own axis.

/** The quantities a run can show, by the first of their columns; those that not every run has come last, where they are
 * not 0. */
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

const isLoad = (curve) => curve.base.startsWith("N");

/** The row of forces.csv whose interval holds the time; null before any. */
function rowAt(rows, time) {
  const times = rows.force_t_s;
  return times.length === 0 ? null : Math.min(times.length - 1, lastAtMost(times, time - 1e-9) + 1);
}

/** How a curve is drawn: in its ship's colour; the largest steps pale, behind the means; the paper's load dashed. */
function curveStyle(curve, ship, ships, colours) {
  if (curve.kind === "sum") return { stroke: colours.ink, width: 1.5 };
  const colour = curve.kind === "paper" && ships === 1 ? colours["paper-load"] : shipColour(colours, ship);
  if (curve.kind === "max") return { stroke: `${colour}80`, width: 1 };
  if (curve.kind === "paper") return { stroke: colour, width: 1, dash: [4, 3] };
  return { stroke: colour, width: 1.25 };
}

// Stacked areas: forces by cause, from 0 up those above it, from 0 down those below, and the line of their sum.

const columnWidth = 2; // [px]; rows that stand closer are drawn as their mean

/** How many rows of forces.csv go into one column of the picture. */
function rowsInColumn(plot) {
  const [first, end] = plot.rowsInView(plot.shownQuantity().ship);
  return Math.max(1, Math.ceil((columnWidth * (end - first)) / Math.max(1, plot.host.clientWidth)));
}

const meanOf = (values) => values.reduce((sum, value) => sum + value / values.length, 0);

/** What is in view, as columns of rows: of each shown cause its mean, how high and how low they stand together, their
 * sum, and the times between which each column stands [s]. Columns begin at multiples of their rows, so that they stay
 * when the plot moves. */
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
