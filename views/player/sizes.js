// Floe sizes: their classes, and the panel in which a range of sizes is selected.

// Sizes √area in classes with round limits, ten per decade.

/** Lower limits of the ten classes of the decade from 1 to 10 m [m]; other decades have these times a power of ten. */
const roundSizes = [1, 1.25, 1.6, 2, 2.5, 3.2, 4, 5, 6.3, 8];
// Least number of classes of the histogram; with fewer, floes of nearly one size would fill it with a single bar.
const leastClasses = 6;

/** Size of a floe [m]: the root of its area. */
const sizeOf = (floes, id) => Math.sqrt(floes.area[id]);

/** Limits of classes that contain all sizes from the smallest to the largest. If these are too few, classes are added
 * above and below until there are enough. The search for the first limit starts one class lower, because round limits
 * deviate from powers of 10^0.1. */
function sizeEdges(least, largest) {
  const edgeOf = (n) => Number((roundSizes[((n % 10) + 10) % 10] * 10 ** Math.floor(n / 10)).toPrecision(3));
  let first = Math.floor(10 * Math.log10(least)) - 1;
  while (edgeOf(first + 1) <= least) ++first;
  let last = first + 1;
  while (edgeOf(last) <= largest) ++last;
  for (; last - first < leastClasses; ++last) if ((last - first) % 2 === 0) --first;
  return Array.from({ length: last - first + 1 }, (_, k) => edgeOf(first + k));
}

/** Classes of all floes of a run at any time: their limits, and the class of each floe. Floes that a page of an area
 * does not contain have no area here, and class 0. */
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

/** Number and area [m²] of floating floes in each class, in total, and in a range of sizes. */
function countSizes({ floes }, places, { edges, of }, range) {
  const classes = Math.max(0, edges.length - 1);
  const counts = { number: new Float64Array(classes), area: new Float64Array(classes), all: { number: 0, area: 0 },
    chosen: { number: 0, area: 0 } };
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

/** Returns true if a floe is in a range of sizes, or if none is selected. */
function isInSizes(floes, id, range) {
  return range === null || (sizeOf(floes, id) >= range.from && sizeOf(floes, id) < range.below);
}

/** A range of sizes as text for the legend: "from 5 to 20 m", or "from 20 m on". */
const sizeRangeWords = ({ from, below }) =>
  (Number.isFinite(below) ? `from ${shortNumber(from)} to ${shortNumber(below)} m` : `from ${shortNumber(from)} m on`);

const paleness = 0.72; // fraction of the water's colour in floes outside the selected range

/** Returns a colouring in which floes outside a range of sizes are pale: the bucket of a floe, the colour of each
 * bucket, and the colour of its edge. The pale buckets precede the others, which are drawn over them. */
function paleOutOfSizes(colouring, floes, range, colours) {
  const bucketOf = (id) => classOf(colouring.value(id), colouring.edges);
  const edge = colours["ice-edge"];
  if (range === null) return { bucketOf, fills: colouring.colours, edgeOf: () => edge };
  const classes = colouring.colours.length;
  const pale = colouring.colours.map((colour) => mixedColour(colour, colours.water, paleness));
  const paleEdge = mixedColour(edge, colours.water, paleness);
  return { bucketOf: (id) => bucketOf(id) + (isInSizes(floes, id, range) ? classes : 0),
    fills: [...pale, ...colouring.colours],
    edgeOf: (bucket) => (bucket < classes ? paleEdge : edge) };
}

// The panel with the histogram of floe sizes. Dragging over it selects a range; floes outside are pale on the map.

const labelGap = 6; // least distance between labels below the histogram [px]

/** A number of floes, or an area, as text. */
const amountWords = (value, isArea) =>
  (isArea ? valueWords(value, "m\u00b2") : counted(value, "floe"));

/** Adds a bar for each class to the histogram and returns the bars. Sizes of 1, 2 and 5 × 10ⁿ are shown below, as far
 * as they fit; they are chosen again when the width changes. */
function fillHistogram(host, { edges }) {
  const bars = edges.slice(1).map(() => make("i"));
  const labels = edges.map((edge, k) => make("span", { style: `left: ${(100 * k) / bars.length}%` },
    `${edge}${k === 0 ? " m" : ""}`));
  const isRound = (edge) => /^0*\.?0*[125]0*$/.test(String(edge));
  host.replaceChildren(...bars.map((bar) => make("div", {}, bar)), ...labels);
  new ResizeObserver(() => {
    let end = -Infinity; // right end of the last label that is shown [px]
    labels.forEach((label, k) => {
      label.hidden = false;
      const { left, right } = label.getBoundingClientRect();
      label.hidden = !(k === 0 || isRound(edges[k])) || left < end + labelGap
        || right > host.getBoundingClientRect().right + 1;
      if (!label.hidden) end = right;
    });
  }).observe(host);
  return bars;
}

/** Handles pointers on the histogram. Dragging selects classes, a click one class, a double click none; the class under
 * the pointer is described. */
function watchHistogram(host, { edges }, panel, actions) {
  let from = 0;
  const classAt = ([px]) =>
    Math.min(edges.length - 2, Math.max(0, Math.floor((px / host.clientWidth) * (edges.length - 1))));
  const choose = (to) => actions.chooseSizes({ from: edges[Math.min(from, to)], below: edges[Math.max(from, to) + 1] });
  watchPointers(host, {
    start(event, at) {
      from = classAt(at);
      choose(from);
    },
    drag: (at) => choose(classAt(at)),
    hover: (event, at) => panel.point(classAt(at)),
  });
  host.addEventListener("pointerleave", () => panel.point(-1));
  host.addEventListener("dblclick", () => actions.chooseSizes());
}

/** Handles the two fields with the ends of the range. If their values are no range, the fields are set back to the
 * present range. */
function watchSizeFields(state, actions) {
  for (const id of ["size-from", "size-below"]) {
    byId(id).addEventListener("change", () => {
      const read = (field, otherwise) => (byId(field).value === "" ? otherwise : Number(byId(field).value));
      const range = { from: read("size-from", 0), below: read("size-below", Infinity) };
      if (range.from === 0 && range.below === Infinity) actions.chooseSizes();
      else actions.chooseSizes(range.from >= 0 && range.below > range.from ? range : state.sizes);
    });
  }
}

/** Makes the panel. Its bars show the floes that float at the present time, and the highest bar always fills the
 * height. show() updates it after a change of the time or the range, showFields() writes the range to the two fields,
 * and countBy() selects what bars show, "number" or "area". */
function makeSizePanel({ run, state, places, actions }) {
  const classes = makeSizeClasses(run);
  const { edges } = classes;
  const bars = fillHistogram(byId("sizes"), classes);
  let [isArea, pointed, shown] = [false, -1, ""];
  byId("size-section").hidden = bars.length === 0;
  watchHistogram(byId("sizes"), classes, { point }, actions);
  watchSizeFields(state, actions);

  function show() {
    const { all, chosen, ...counts } = countSizes(run, places, classes, state.sizes);
    const values = isArea ? counts.area : counts.number;
    const key = [values.join(), isArea, pointed, state.sizes?.from, state.sizes?.below].join(";");
    if (key === shown || bars.length === 0) return;
    shown = key;
    const most = Math.max(...values);
    bars.forEach((bar, k) => {
      const isIn = state.sizes === null || (edges[k + 1] > state.sizes.from && edges[k] < state.sizes.below);
      bar.classList.toggle("out", !isIn);
      bar.style.height = `${(100 * values[k]) / (most || 1)}%`;
    });
    byId("size-most").textContent = pointed < 0 ? `at most ${amountWords(most, isArea)}`
      : `${edges[pointed]} \u2013 ${edges[pointed + 1]} m: ${amountWords(values[pointed], isArea)}`;
    byId("size-words").textContent = state.sizes === null ? "A drag over the histogram chooses sizes."
      : `${chosen.number} of ${amountWords(all.number, false)}, ${amountWords(chosen.area, true)} ` +
      `(${((100 * chosen.area) / (all.area || 1)).toFixed(1)} % of the ice)`;
    byId("size-all").disabled = state.sizes === null;
  }
  function point(k) {
    pointed = k;
    show();
  }
  return {
    show,
    showFields() {
      byId("size-from").value = state.sizes ? state.sizes.from : "";
      byId("size-below").value = Number.isFinite(state.sizes?.below) ? state.sizes.below : "";
    },
    countBy(what) {
      isArea = what === "area";
      show();
    },
  };
}
