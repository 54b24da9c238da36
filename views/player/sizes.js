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

const plotInset = { left: 4, right: 4, top: 16, bottom: 18 }; // [px]

/** A number of floes or an area as people read it. */
const amountWords = (value, isArea) =>
  (isArea ? `${sixDigits(Number(value.toPrecision(4)))} m\u00b2` : counted(value, "floe"));

function drawHistogram(canvas, { width, height }, { edges }, bars, { chosen, pointed, words }, colours) {
  const context = clearedCanvas(canvas, width, height);
  const { left, top } = plotInset;
  const wide = (width - left - plotInset.right) / bars.length;
  const bottom = height - plotInset.bottom;
  const most = Math.max(...bars) || 1;
  bars.forEach((value, k) => {
    const isIn = chosen === null || (edges[k + 1] > chosen.from && edges[k] < chosen.below);
    const tall = value > 0 ? Math.max(1, (value / most) * (bottom - top)) : 0;
    context.fillStyle = isIn ? colours.accent : colours.line;
    context.fillRect(left + k * wide + 0.5, bottom - tall, Math.max(1, wide - 1), tall);
    if (k === pointed) {
      context.fillStyle = `${colours.accent}30`;
      context.fillRect(left + k * wide, top, wide, bottom - top);
    }
  });
  context.fillStyle = colours.muted;
  context.fillRect(left, bottom, width - left - plotInset.right, 1);
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "top";
  context.textAlign = "right";
  context.fillText(words, width - plotInset.right, 1);
  context.textAlign = "center";
  let free = 0;
  edges.forEach((edge, k) => { // from the left, as many as fit
    const label = `${edge}${k === 0 ? " m" : ""}`;
    const half = context.measureText(label).width / 2;
    const x = Math.min(width - half, Math.max(half, left + k * wide));
    if (x - half < free || !/^0*\.?0*[125]0*$/.test(String(edge)) && k > 0) return;
    context.fillText(label, x, bottom + 4);
    free = x + half + 8;
  });
}

/** Pointers on the histogram: a drag chooses classes, a click one of them; the one under the pointer is read out. */
function watchHistogram(canvas, { edges }, panel, actions) {
  let from = 0;
  const classAt = ([px]) => {
    const part = (px - plotInset.left) / (canvas.clientWidth - plotInset.left - plotInset.right);
    return Math.min(edges.length - 2, Math.max(0, Math.floor(part * (edges.length - 1))));
  };
  const choose = (to) => actions.chooseSizes({ from: edges[Math.min(from, to)], below: edges[Math.max(from, to) + 1] });
  watchPointers(canvas, {
    start(event, at) {
      from = classAt(at);
      choose(from);
    },
    drag: (at) => choose(classAt(at)),
    hover: (event, at) => panel.point(classAt(at)),
  });
  canvas.addEventListener("pointerleave", () => panel.point(-1));
  canvas.addEventListener("dblclick", () => actions.chooseSizes());
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

function makeSizePanel(player) {
  const { run, state, places, actions } = player;
  const classes = makeSizeClasses(run);
  const canvas = byId("sizes");
  const panel = { isArea: false, pointed: -1, shown: "", box: { width: 0, height: 0 } };
  byId("size-section").hidden = classes.edges.length === 0;

  panel.show = () => {
    if (classes.edges.length === 0) return;
    const counts = countSizes(run, places, classes, state.sizes);
    const bars = panel.isArea ? counts.area : counts.number;
    const key = [bars.join(), panel.isArea, panel.pointed, panel.box.width, state.sizes?.from, state.sizes?.below,
      player.colours.accent].join(";");
    if (key === panel.shown || panel.box.width === 0) return;
    panel.shown = key;
    const { pointed, isArea } = panel;
    const { edges } = classes;
    const words = pointed < 0 ? `at most ${amountWords(Math.max(...bars), isArea)}`
    : `${edges[pointed]} \u2013 ${edges[pointed + 1]} m: ${amountWords(bars[pointed], isArea)}`;
    drawHistogram(canvas, panel.box, classes, bars, { chosen: state.sizes, pointed, words }, player.colours);
    const { all, chosen } = counts;
    byId("size-words").textContent = state.sizes === null ? "A drag over the histogram chooses sizes."
      : `${chosen.number} of ${amountWords(all.number, false)}, ${amountWords(chosen.area, true)} ` +
      `(${((100 * chosen.area) / (all.area || 1)).toFixed(1)} % of the ice)`;
    byId("size-all").disabled = state.sizes === null;
  };
  panel.point = (k) => {
    panel.pointed = k;
    panel.show();
  };
  panel.showFields = () => {
    byId("size-from").value = state.sizes ? state.sizes.from : "";
    byId("size-below").value = Number.isFinite(state.sizes?.below) ? state.sizes.below : "";
  };
  panel.countBy = (what) => {
    panel.isArea = what === "area";
    panel.show();
  };
  new ResizeObserver(([{ contentRect: { width, height } }]) => { // to read it of the canvas lays out the page
    panel.box = { width, height };
    panel.show();
  }).observe(canvas);
  watchHistogram(canvas, classes, panel, actions);
  watchSizeFields(state, actions);
  return panel;
}
