// Floe sizes: their classes, and the panel that chooses among them.

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

/** Whether a floe is in a range of sizes; all are where none is chosen. */
function isInSizes(floes, id, range) {
  return range === null || (sizeOf(floes, id) >= range.from && sizeOf(floes, id) < range.below);
}

/** "from 5 to 20 m" */
const sizeRangeWords = ({ from, below }) =>
  (Number.isFinite(below) ? `from ${shortNumber(from)} to ${shortNumber(below)} m` : `from ${shortNumber(from)} m on`);

const paleness = 0.72; // of floes out of the range: how far they go to the water's colour

/** A colouring whose floes out of a range of sizes are pale. */
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

// The panel with the histogram of floe sizes: a drag over it chooses a range, which the map shows; others are pale.

const labelGap = 6; // between sizes below the histogram [px]

/** A number of floes or an area as people read it. */
const amountWords = (value, isArea) =>
  (isArea ? valueWords(value, "m\u00b2") : counted(value, "floe"));

/** Puts a bar for each class into the histogram; gives the bars. Below stand as many round sizes as have room; they are
 * chosen again when the histogram gets another width. */
function fillHistogram(host, { edges }) {
  const bars = edges.slice(1).map(() => make("i"));
  const labels = edges.map((edge, k) => make("span", { style: `left: ${(100 * k) / bars.length}%` },
    `${edge}${k === 0 ? " m" : ""}`));
  const isRound = (edge) => /^0*\.?0*[125]0*$/.test(String(edge));
  host.replaceChildren(...bars.map((bar) => make("div", {}, bar)), ...labels);
  new ResizeObserver(() => {
    let end = -Infinity; // of the last label that is shown [px]
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

/** Pointers on the histogram: a drag chooses classes, a click one of them; the one under the pointer is read out. */
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

/** Fields for the two ends of the range; what is no range changes nothing. */
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
