// Colours of the ice: the history of each floe, the palette, and the legend below the map.

// History of a floe, from its lineage and area: whole, cut, split off, broken off by bending or grinding, or surfaced
// from under a hull. The numbers are indices into the colours of `ramps` and the words of the legend.

const breakages = { whole: 0, cut: 1, split: 2, bend: 3, cameUp: 4 };
// If the floe that breaks is whole or cut, a piece with at least this fraction of the area of the scene's floe counts
// as the cut floe, not as a piece broken off [-]. With a larger fraction, more large pieces, such as halves of split
// floes, have the colour of pieces that broke off.
const cutShare = 0.2;

/**
 * Returns one of `breakages` for each floe of the run, which does not change with time. `whole`: a floe of the scene,
 * until it breaks. `cut`: it is the remaining part of a floe of the scene, which is the largest piece of each bend, and
 * every piece of a whole or cut floe with at least `cutShare` of the area of the scene's floe. `split` and `bend`: any
 * other piece, by the fracture that freed it, where everything but a split counts as bending; the largest piece of a
 * piece that broke off keeps its kind. `cameUp`: it surfaced from under a hull, which makes a new floe even of a floe
 * of the scene, or broke from such a floe. `breakOf` maps a floe to the index of the event that ended it, except for
 * going under.
 */
function breakagesOf({ floes, info, breakOf }) {
  const of = new Uint8Array(floes.count);
  for (let i = 0; i < floes.count; ++i) {
    const parent = floes.parent[i];
    if (parent < 0) continue;
    const isBend = info.events[breakOf.get(parent)]?.kind !== "split";
    const isLargest = floes.children.get(parent).every((other) => floes.area[other] <= floes.area[i]);
    const isLeft = of[parent] <= breakages.cut;
    if (floes.cameUp[i]) of[i] = breakages.cameUp;
    else if (isLeft
      && ((isBend && isLargest) || floes.area[i] >= cutShare * floes.area[floes.oldest[i]])) of[i] = breakages.cut;
    else if (!isLeft && isLargest) of[i] = of[parent];
    else of[i] = isBend ? breakages.bend : breakages.split;
  }
  return of;
}

// The colours of the classes, in the order of the classes: one more than a colouring has limits. Along a ramp lightness
// changes in one direction, in steps of 5 to 29 of 100, so that colours can be distinguished in greyscale and by
// colour-blind users. Ramps go from light to dark, but sizes from dark to light. The last colour of `breakage`, of ice
// that surfaced, is outside of its ramp. No colour has the lightness of the water in the light theme; in the dark theme
// the darkest colours of `speed` and `size` are close to it. No test checks this. The colours of marks are in
// player.css; in the light theme those of bends, splits and ice under hulls are from the Okabe–Ito palette.

const ramps = {
  breakage: ["#ffffff", "#f6e3a8", "#dd9a45", "#8f4a1c", "#edc7dd"],
  generation: ["#ffffff", "#fdf1c9", "#fbdd92", "#f2bd60", "#d98b3b", "#ad5f27"],
  speed: ["#ffffff", "#e9e4f2", "#d2c6e6", "#9c88c4", "#70539d", "#402468"],
  size: ["#0d4a35", "#2d7a55", "#58a173", "#b5dcbb", "#dcf0df", "#ffffff"],
};

/** Mixes two colours "#rrggbb" and returns a third. `part` is the fraction of the second one, 0 to 1. sizes.js makes
 * floes outside of the chosen sizes pale with it. */
function mixedColour(colour, other, part) {
  const channel = (css, k) => parseInt(css.slice(1 + 2 * k, 3 + 2 * k), 16);
  const mixed = [0, 1, 2].map((k) => Math.round(channel(colour, k) + part * (channel(other, k) - channel(colour, k))));
  return `#${mixed.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}

/** Colour of a ship's curves in the plot. The theme has five, so the sixth ship has the colour of the first. */
const shipColour = (colours, ship) => colours[`ship-${ship % 5}`];

/** The five largest of 1, 2, 5 × 10ⁿ below a value in ascending order: the limits of six classes. They are at most
 * 0.999 of the value, because a limit equal to it would leave only the largest value in the highest class. The value
 * must be positive, otherwise the limits are 0 or no numbers. */
function roundEdges(largest) {
  const edges = [];
  let edge = roundBelow(largest * 0.999);
  for (; edges.length < 5; edge = roundBelow(edge * 0.999)) edges.unshift(Number(edge.toPrecision(1)));
  return edges;
}

/** Words for the class of counts from `from` to less than `below`; undefined: without an upper limit. */
function countWords(from, below) {
  if (below === undefined) return `${from} and more`;
  return below === from + 1 ? String(from) : `${from} \u2013 ${below - 1}`;
}

/** Largest values in a run, which determine the classes of colours: the fastest record of a floe [m/s], the largest
 * area [m²], and the most ancestors of a floe, at least 1. They are those of the whole page, not of the present time,
 * so classes do not change while the run plays. For two runs side by side, pair.js replaces them by the larger ones of
 * both, so that a colour means the same in both. */
function extremesOf({ floes, frames }) {
  const most = { speed: 0, area: 0, generation: 1 };
  for (const at of frames.recordAt) most.speed = Math.max(most.speed, Math.hypot(frames.doubles[at + 3],
    frames.doubles[at + 4]));
  for (let i = 0; i < floes.count; ++i) {
    most.area = Math.max(most.area, floes.area[i]);
    most.generation = Math.max(most.generation, floes.generation[i]);
  }
  return most;
}

/** Ways of colouring floes, in classes up to the extremes `most`: the value of a floe, limits, colours, and words for
 * the legend. A value equal to a limit belongs to the class above it. Speeds are those of centroids at the present
 * time. The classes of generations are fixed unless a floe has more than 20 ancestors; surfacing adds one just as a
 * fracture does. Without any motion or area, the classes are those for an extreme of 1. The legend leaves out the
 * classes for which isUsed() returns false: those kinds of breakage that no floe of the run has. */
function makeColourings(run, places, most) {
  const { floes } = run;
  const classes = (edges) => [`below ${edges[0]}`,
    ...edges.map((edge, k) => (k + 1 < edges.length ? `${edge} \u2013 ${edges[k + 1]}` : `${edge} and more`))];
  const generations = most.generation > 20 ? [1, ...roundEdges(most.generation).slice(1)] : [1, 2, 3, 5, 10];
  const sizes = roundEdges(Math.sqrt(most.area) || 1);
  const speeds = roundEdges(most.speed || 1);
  const breakageOf = breakagesOf(run);
  const colouring = (name, title, edges, value, words) =>
    ({ title, edges, colours: ramps[name], value, words, isUsed: () => true });
  return {
    breakage: { ...colouring("breakage", "Ice", [1, 2, 3, 4], (id) => breakageOf[id], ["whole",
      "cut: what is left of a floe", "split off", "broken off by bending or grinding", "came up from under the hull"]),
    isUsed: (k) => breakageOf.includes(k) },
    generation: colouring("generation", "Generations since the scene", generations, (id) => floes.generation[id],
      ["none", ...generations.map((edge, k) => countWords(edge, generations[k + 1]))]),
    speed: colouring("speed", "Speed [m/s]", speeds, (id) => Math.hypot(places.vx[id], places.vy[id]), classes(speeds)),
    size: colouring("size", "Size \u221aarea [m]", sizes, (id) => sizeOf(floes, id), classes(sizes)),
  };
}

/** Colours of the present theme by their names in the style sheet (player.css), without the leading "--": all
 * properties of rules whose selector is ":root". They must be read again when the theme changes. */
function themeColours() {
  const style = getComputedStyle(document.documentElement);
  const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]);
  const names = rules.filter(({ selectorText }) => selectorText === ":root").flatMap((rule) => [...rule.style]);
  return Object.fromEntries(names.map((name) => [name.slice(2), style.getPropertyValue(name).trim()]));
}

/** Makes the legend below the map, which explains the colours, marks and arrows that are shown. Sizes are listed from
 * the largest to the smallest. Whatever changes the layers, the colouring, the range of sizes or the theme must call
 * show(). showWidths() sets the text with the width of the channel behind each ship, when the map is drawn. Arrows of
 * contacts in crushing have the colour of split marks, those of all other contacts the colour of bend marks. */
function makeLegend(player) {
  const { run, state, colourings } = player;
  // The field has room for 23 characters per ship, about its longest text, from the start, so that the legend does not
  // change its size while the run plays.
  const channelWidth = make("output", { id: "channel-width", style: `flex: 0 1 ${23 * run.info.ships.length}ch` });

  const row = (attributes, ...words) => make("span", {}, make("i", attributes), ...words);
  const swatchRow = (colour, ...words) => row({ style: `background: ${colour}` }, ...words);
  /** A row with an arrow of at most 60 px that stands for a round value. `perUnit` is the scale of the arrows [px per
   * unit]; `words` returns the text for the value. */
  function scaleRow(perUnit, words) {
    const length = roundBelow(60 / perUnit);
    return row({ class: "arrow", style: `width: ${length * perUnit}px` }, words(length));
  }
  /** Rows of the colours of loads along hulls, from 0 to the largest peak of the page (`loadLine.most`). */
  const loadRows = () => Array.from({ length: loadSteps }, (_, step) => swatchRow(loadColour((step + 0.5) / loadSteps),
    `up to ${valueWords((player.loadLine.most * (step + 1)) / loadSteps, "N")}`));

  return {
    show() {
      const { colours } = player;
      const colouring = colourings[state.colourBy];
      const rows = colouring.words.map((words, k) => swatchRow(colouring.colours[k], words)).filter((_, k) =>
        colouring.isUsed(k));
      if (state.colourBy === "size") rows.reverse();
      if (state.sizes) rows.push(make("span", { class: "pale" }, `pale: not ${sizeRangeWords(state.sizes)}`));
      if (run.under.went > 0) rows.push(row({ class: "under-hull" }, "ice under the hull or waiting behind it"));
      if (state.layers.startIce) rows.push(swatchRow(colours["start-ice"], "ice at the start"));
      if (state.layers.channel) rows.push(swatchRow(colours.swept, "swept by the hull"),
        swatchRow(colours.channel, "open from ice to ice ", channelWidth));
      if (state.layers.velocities) rows.push(scaleRow(player.arrowScale, (v) => `${Number(v.toPrecision(2))} m/s`));
      if (state.layers.forces) rows.push(scaleRow(player.forceScale, (force) => valueWords(force, "N")),
        swatchRow(colours.split, "crushing"), swatchRow(colours.bend, "not crushing"));
      if (state.layers.largestLoads || state.layers.meanLoads) rows.push(...loadRows());
      byId("legend").replaceChildren(make("b", {}, colouring.title), ...rows);
    },
    showWidths: (words) => { channelWidth.textContent = words.join("; ") || "\u2013"; },
  };
}
