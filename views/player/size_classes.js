// Sizes of floes, √area, in classes: ten to a decade at round sizes.

const roundSizes = [1, 1.25, 1.6, 2, 2.5, 3.2, 4, 5, 6.3, 8];
const leastClasses = 6;

const sizeOf = (floes, id) => Math.sqrt(floes.area[id]);

/** Edges of classes that hold all sizes from the least to the largest. */
function sizeEdges(least, largest) {
  const edgeOf = (n) => Number((roundSizes[((n % 10) + 10) % 10] * 10 ** Math.floor(n / 10)).toPrecision(3));
  let first = Math.floor(10 * Math.log10(least)) - 1;
  while (edgeOf(first + 1) <= least) ++first;
  let last = first + 1;
  while (edgeOf(last) <= largest) ++last;
  for (; last - first < leastClasses; ++last) if ((last - first) % 2 === 0) --first;
  return Array.from({ length: last - first + 1 }, (_, k) => edgeOf(first + k));
}

/** The classes of a run's floes: their edges and, of each floe, its class. */
function makeSizeClasses({ floes }) {
  let [least, largest] = [Infinity, 0];
  for (let id = 0; id < floes.count; ++id) {
    if (!(floes.area[id] > 0)) continue;
    least = Math.min(least, sizeOf(floes, id));
    largest = Math.max(largest, sizeOf(floes, id));
  }
  const edges = largest > 0 ? sizeEdges(least, largest) : [];
  const of = Uint8Array.from({ length: floes.count }, (_, id) => Math.max(0, lastAtMost(edges, sizeOf(floes, id))));
  return { edges, of };
}

/** How many floes float in each class, and their area [m²]; of all and of those in a range of sizes too. */
function countSizes({ floes }, places, { edges, of }, range) {
  const classes = Math.max(0, edges.length - 1);
  const counts = { number: new Float64Array(classes), area: new Float64Array(classes), all: { number: 0, area: 0 }, chosen: { number: 0, area: 0 } };
  for (let n = 0; n < places.count; ++n) {
    const id = places.living[n];
    const area = floes.area[id];
    ++counts.number[of[id]];
    counts.area[of[id]] += area;
    ++counts.all.number;
    counts.all.area += area;
    if (!isInSizes(floes, id, range)) continue;
    ++counts.chosen.number;
    counts.chosen.area += area;
  }
  return counts;
}

/** Whether a floe is in a range of sizes; all are where none is chosen. */
function isInSizes(floes, id, range) {
  return range === null || (sizeOf(floes, id) >= range.from && sizeOf(floes, id) < range.below);
}

/** "from 5 to 20 m" */
const sizeRangeWords = ({ from, below }) => (Number.isFinite(below) ? `from ${shortNumber(from)} to ${shortNumber(below)} m` : `from ${shortNumber(from)} m on`);

const paleness = 0.72; // of floes out of the range: how far they go to the water's colour

/** A colouring whose floes out of a range of sizes are pale. */
function paleOutOfSizes(colouring, floes, range, colours) {
  const bucketOf = (id) => classOf(colouring.value(id), colouring.edges);
  const edge = colours["ice-edge"];
  if (range === null) return { bucketOf, fills: colouring.colours, edgeOf: () => edge };
  const classes = colouring.colours.length;
  const pale = colouring.colours.map((colour) => mixedColour(colour, colours.water, paleness));
  const paleEdge = mixedColour(edge, colours.water, paleness);
  return { bucketOf: (id) => bucketOf(id) + (isInSizes(floes, id, range) ? classes : 0), fills: [...pale, ...colouring.colours],
    edgeOf: (bucket) => (bucket < classes ? paleEdge : edge) };
}
