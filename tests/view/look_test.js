// Meaning of the picture: the default colours by the history of a floe, and the drawing of a ship.
"use strict";
const { test, before, assert, fs, path, folder, open } = require("./bench.js");
const vm = require("node:vm");
const { makeRun, makePage, readNdjson, plateAndFloe, ship } = require("./runs.js");

let page, run;
before(async () => {
  run = makeRun(folder, plateAndFloe("plate-and-floe", { ships: [ship("a", 30)] }));
  page = await open(makePage(run));
  for (const layer of ["track", "channel", "startIce"]) await page.act("toggleLayer", layer, false);
  await page.act("goToEnd", true);
});

/** The scripts' own functions, without a page; `globals` are what they take from the browser. */
function scriptsWith(globals, ...names) {
  const context = vm.createContext(globals);
  for (const name of names) vm.runInContext(fs.readFileSync(path.join(__dirname, "../../views/player", name), "utf8"),
    context);
  return context;
}
const scripts = (...names) => scriptsWith({}, ...names);

/** The edges that a path draws, by the rules of the canvas: after closePath() the pen is at the first point of the part
 * that was closed, and lineTo() without a pen only puts it down. */
class EdgesOfPath {
  edges = [];
  moveTo(...point) { this.first = this.pen = point; }
  lineTo(...point) {
    if (this.pen && `${this.pen}` !== `${point}`) this.edges.push([this.pen, point]);
    this.first ??= point;
    this.pen = point;
  }
  closePath() { this.lineTo(...this.first); }
}

test("the outline of a floe has the edges of its rings and no others", () => {
  const { makeOutlines } = scriptsWith({ Path2D: EdgesOfPath }, "draw_ice.js");
  const rings = [[[0, 0], [9, 0], [9, 9], [0, 9]], [[1, 1], [1, 3], [3, 3]], [[5, 5], [5, 7], [7, 7], [7, 5]]];
  const floes = { ringsOf: [0, 3], ringEnds: [4, 7, 11], cx: [2], cy: [1], shape: () => rings.flat(2) };
  const edges = rings.flatMap((ring) => ring.map((from, k) =>
    [from, ring[(k + 1) % ring.length]].map(([x, y]) => [x - 2, y - 1])));
  assert.deepEqual(makeOutlines({ floes })(0).edges, edges);
});

test("untouched floes, what is left of a plate, and cusps have the colours that the legend gives them", async () => {
  const births = readNdjson(run, "floes.ndjson");
  const legend = Object.fromEntries(await page.locator("#legend span").evaluateAll((all) =>
    all.filter((row) => row.querySelector("i")).map((row) => [row.textContent.split(":")[0],
      row.querySelector("i").style.background])));
  const living = await page.player(({ places }) => Array.from(places.living.subarray(0, places.count)));
  const left = living.filter((id) => id !== 1).sort((a, b) => births[b].area_m2 - births[a].area_m2);
  assert.ok(births[left[0]].generation > 0 && births[left[0]].area_m2 > 0.8 * 5400,
    "the plate lost cusps and is still there");
  assert.ok(left.length > 1, "cusps float");
  const inPlate = await page.player(({ places }, id) => [places.x[id], places.y[id] + 20], left[0]);
  const [whole, cut] = await page.colours("ice", [[12, 90], inPlate]);
  assert.equal(whole, legend.whole);
  assert.equal(cut, legend.cut);
  const breakage = await page.player(({ colourings }, ids) => ids.map((id) => colourings.breakage.value(id)), left);
  assert.deepEqual([...new Set(breakage.slice(1))], [3], "all others are broken off by bending");
  assert.equal(breakage[0], 1);
  assert.deepEqual(Object.keys(legend), ["whole", "cut", "broken off by bending or grinding"],
    "nothing was split here");
});

test("what became of a floe follows from its lineage and its area", () => {
  const { breakagesOf } = scripts("colours.js");
  // Each row: parent, kind of the parent's fracture, area, expected result. The last case is a plate that loses 200
  // cusps.
  const rows = [[-1, "", 1000, 0],
    [0, "split", 600, 1], [0, "split", 300, 1], [0, "split", 100, 2],
    [1, "bend", 580, 1], [1, "bend", 20, 3],
    [3, "bend", 90, 2], [3, "bend", 10, 3],
    [2, "bend", 190, 1], [2, "bend", 110, 3],
    [5, "split", 11, 3], [5, "split", 9, 2],
    [-1, "", 10, 0], [-1, "", 1000, 0]];
  for (let k = 0, plate = rows.length - 1; k < 200; ++k, plate = rows.length - 2)
    rows.push([plate, "bend", 1000 - 4.9 * (k + 1), 1], [plate, "bend", 4.9, 3]);
  const children = new Map();
  const breakOf = new Map();
  const events = [];
  rows.forEach(([parent, kind], id) => {
    if (parent < 0) return;
    if (!children.has(parent)) breakOf.set(parent, events.push({ kind }) - 1);
    children.set(parent, [...(children.get(parent) ?? []), id]);
  });
  const oldest = [];
  rows.forEach(([parent], id) => oldest.push(parent < 0 ? id : oldest[parent]));
  const floes = { count: rows.length, parent: rows.map(([parent]) => parent), area: rows.map(([, , area]) => area),
    oldest, children, cameUp: rows.map(() => 0) };
  assert.deepEqual(Array.from(breakagesOf({ floes, info: { events }, breakOf })),
    rows.map(([, , , expected]) => expected));
  floes.cameUp[3] = floes.cameUp[6] = 1; // whatever broke it, and its largest piece
  assert.deepEqual(Array.from(breakagesOf({ floes, info: { events }, breakOf }).subarray(2, 8)), [1, 4, 1, 3, 4, 3]);
});

test("the scale of loads leaves out only few and far larger rows", () => {
  const { loadRange, alignedRanges } = scripts("plot_curves.js");
  const wave = Float64Array.from({ length: 1000 }, (_, k) => 10 * Math.sin(k / 7));
  const spiked = wave.with(500, 400);
  const near = (range, wanted) => range.forEach((v, k) => assert.ok(Math.abs(v - wanted[k]) < 0.1, `${range}`));
  near(loadRange([wave], false), [-10, 10]);
  near(loadRange([spiked], false), [-10, 12.5]);
  near(loadRange([spiked], true), [-10, 400]);
  near(loadRange([new Float64Array(5)], false), [0, 0]);
  near(loadRange([Float64Array.of(0, 0, 7)], false), [0, 7]);
  for (const [[low, high], [low2, high2]] of [alignedRanges([[-1, 0], [0, 50]]), alignedRanges([[0, 0], [-3, 2]])]) {
    assert.ok(low < 0 && high > 0 && Math.abs(low / high - low2 / high2) < 1e-12);
  }
});

test("the ship shows as one: hull, deck, deck house, and a mark along its heading", async () => {
  await page.act("goTo", 0);
  await page.act("setFollow", 0);
  // It is 40 m long and 8 m wide, its centre at (-20, 30), its heading along x.
  const at = (along, across) => [-20 + along, 30 + across];
  const [edge, deck, house, ahead, beside, astern] = await page.colours("marks",
    [at(-10, 3.85), at(2, 2), at(-8.5, 1), at(23, 0), at(23, 4), at(-24, 0)]);
  const theme = await page.evaluate(() => {
    const probe = document.body.appendChild(document.createElement("i"));
    const all = ["--hull", "--deck", "--deck-house"].map((name) => {
      probe.style.color = `var(${name})`;
      return getComputedStyle(probe).color;
    });
    probe.remove();
    return all;
  });
  assert.deepEqual([edge, deck, house], theme);
  assert.equal(ahead, theme[0], "the heading mark");
  assert.deepEqual([beside, astern], ["none", "none"]);
});
