// Colours. Each ramp goes from light to dark in even steps of lightness, none at that of the water, so that it
// survives greyscale and colour blindness; marks are in the Okabe–Ito palette.

const ramps = {
  generation: ["#ffffff", "#fdf1c9", "#fbdd92", "#f2bd60", "#d98b3b", "#ad5f27"],
  speed: ["#ffffff", "#e9e4f2", "#d2c6e6", "#9c88c4", "#70539d", "#402468"],
  size: ["#0d4a35", "#2d7a55", "#58a173", "#b5dcbb", "#dcf0df", "#ffffff"],
};

/** Of a ship's curve. */
const shipColour = (colours, ship) => colours[`ship-${ship % 5}`];

/** The five largest of 1, 2, 5 × 10ⁿ below a value, growing: the edges of six classes. */
function roundEdges(largest) {
  const edges = [];
  let edge = roundBelow(largest * 0.999);
  for (; edges.length < 5; edge = roundBelow(edge * 0.999)) edges.unshift(Number(edge.toPrecision(1)));
  return edges;
}

function countWords(from, below) {
  if (below === undefined) return `${from} and more`;
  return below === from + 1 ? String(from) : `${from} \u2013 ${below - 1}`;
}

/** How floes are coloured: class edges, colours, words for the legend. */
function makeColourings(run) {
  const { floes, frames } = run;
  let fastest = 0;
  for (const at of frames.recordAt)
    fastest = Math.max(fastest, Math.hypot(frames.doubles[at + 3], frames.doubles[at + 4]));
  let largest = 0;
  for (let i = 0; i < floes.count; ++i) largest = Math.max(largest, floes.area[i]);
  const classes = (edges, unit) => {
    const words = [`below ${edges[0]}`];
    edges.forEach((edge, k) => words.push(k + 1 < edges.length ? `${edge} \u2013 ${edges[k + 1]}` : `${edge} and more`));
    return words.map((word) => `${word}${unit}`);
  };
  let oldest = 1;
  for (let i = 0; i < floes.count; ++i) oldest = Math.max(oldest, floes.generation[i]);
  const generations = oldest > 20 ? [1, ...roundEdges(oldest).slice(1)] : [1, 2, 3, 5, 10];
  const sizes = roundEdges(Math.sqrt(largest) || 1);
  const speeds = roundEdges(fastest || 1);
  return {
    generation: { title: "Fractures since the scene", edges: generations, colours: ramps.generation,
      words: ["none", ...generations.map((edge, k) => countWords(edge, generations[k + 1]))] },
    speed: { title: "Speed [m/s]", edges: speeds, colours: ramps.speed, words: classes(speeds, "") },
    size: { title: "Size \u221aarea [m]", edges: sizes, colours: ramps.size, words: classes(sizes, "") },
  };
}

/** The theme's colours, from the style sheet. */
function themeColours() {
  const style = getComputedStyle(document.documentElement);
  const names = ["water", "start-ice", "swept", "channel", "ice-edge", "hull", "hull-edge", "track", "ink", "panel", "muted",
    "accent", "highlight", "line", "family",
    "bend", "split", "rejected_cut", "ship-0", "ship-1", "ship-2", "ship-3", "ship-4"];
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}
