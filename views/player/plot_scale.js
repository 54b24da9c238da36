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

/** The part of the axis that columns of loads need, [at most 0, at least 0]: all of it, or without spikes. */
function loadRange(columns, isFull) {
  const sizes = columns.map(sizesOf);
  const largest = Math.max(0, ...sizes.map((size) => size.largest));
  const reach = beyondCommon * Math.max(0, ...sizes.map((size) => size.usual));
  const limit = isFull || largest <= spike * reach ? largest : reach;
  let [low, high] = [0, 0];
  for (const values of columns) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return [Math.max(low, -limit), Math.min(high, limit)];
}

/** From the least to the largest of columns that are no loads. */
function wholeRange(columns) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of columns) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
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
