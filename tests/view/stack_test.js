// Forces by cause as stacked areas: each as high as its column of forces.csv, with the line of their sum.
"use strict";
const { test, before, assert, folder, open } = require("./bench.js");
const { makeRun, makePage, giveLoads, smallScene, ship } = require("./runs.js");

let page, rows;
// Causes from 0 outwards, in the order in which the plot stacks them.
const causes = ["ice", "friction", "submerged", "water", "thrust", "rudder", "mooring"];

/** Loads that change their signs, of row k. */
const loadsOf = (k) => {
  const way = Math.floor(k / 10) % 2 === 0 ? 1e3 : -1e3;
  return { surge_N: -200 * way, surge_from_ice_friction_N: -50 * way, surge_from_submerged_ice_N: -60e3,
    surge_from_water_N: 80 * way, thrust_N: 300e3, surge_from_rudder_N: -40e3, surge_from_mooring_N: 70e3 + 1e3 * k };
};

/** What each cause gives in a row of forces.csv [N]. */
const partsOf = (row) => ({ ice: row.surge_N - row.surge_from_ice_friction_N, friction: row.surge_from_ice_friction_N,
  submerged: row.surge_from_submerged_ice_N, water: row.surge_from_water_N, thrust: row.thrust_N,
  rudder: row.surge_from_rudder_N, mooring: row.surge_from_mooring_N });
const sumOf = (values) => values.reduce((sum, value) => sum + value, 0);

/** A run of a moored ship with an engine, whose forces.csv has been given known loads; sampled at an interval [s]. */
function runWithLoads(name, interval) {
  const { mass_kg: _, moment_of_inertia_kg_m2: __, ...moored } = { ...ship("a", 0),
    hull: { length_m: 40, beam_m: 8, entrance_angle_deg: 27, draught_m: 2, block_coefficient: 0.6 },
    propulsion: { engine: { bollard_pull_kN: 100, open_water_speed_m_per_s: 6, propeller_diameter_m: 1.5 } },
    steering: { rudder: { area_m2: 2 } }, mooring: { surge_stiffness_N_per_m: 1e4 } };
  const run = makeRun(folder, smallScene(name, { ships: [moored], record: { forces_interval_s: interval } }));
  return { run, rows: giveLoads(run, loadsOf) };
}

before(async () => {
  const made = runWithLoads("by-cause", 0.1);
  rows = made.rows;
  page = await open(makePage(made.run), { viewport: { width: 1440, height: 900 } });
  await page.selectOption("#quantity", "surge_by_cause");
});

/** The colours of the plot in the middle of each cause's area at a time, and whether each is that cause's. */
const areasAt = (time, parts) => page.player(({ plot: { chart, colours } }, at, list) => {
  const probe = document.createElement("canvas").getContext("2d");
  const bytesOf = (colour) =>
    { probe.fillStyle = colour; probe.fillRect(0, 0, 1, 1); return [...probe.getImageData(0, 0, 1, 1).data].join(); };
  const sum = chart.valToPos(list.reduce((all, [, value]) => all + value, 0), "y", true);
  const x = Math.round(chart.valToPos(at, "x", true));
  const tops = { up: 0, down: 0 };
  return list.map(([cause, value]) => {
    const side = value > 0 ? "up" : "down";
    const from = tops[side];
    tops[side] += value;
    const [a, b] = [chart.valToPos(from, "y", true), chart.valToPos(tops[side], "y", true)];
    const y = Math.round((a + b) / 2);
    const colour = [...chart.ctx.getImageData(x, y, 1, 1).data].join();
    return { cause, isClear: Math.abs(a - b) > 4 && Math.abs(y - sum) > 4,
      isIts: colour === bytesOf(colours[`cause-${cause}`]) };
  });
}, time, parts);

test("each cause has its area, one on the other from 0, above it or below it", async () => {
  let compared = 0;
  for (const row of [rows[4], rows[13], rows[47], rows[95]]) { // ice and water change their signs
    const parts = partsOf(row);
    const areas = await areasAt(row.t_s - 0.05, causes.map((cause) => [cause, parts[cause]]));
    for (const { cause, isClear, isIts } of areas) {
      if (!isClear) continue;
      assert.ok(isIts, `${cause} at ${row.t_s} s`);
      ++compared;
    }
  }
  assert.ok(compared > 18, `${compared} areas`);
});

test("the key has the causes of this ship, with their present values, and the sum", async () => {
  await page.act("goTo", 4.75);
  const row = rows[47];
  const key = await page.locator("#load-now .curve").evaluateAll((all) =>
    all.map((e) => [e.textContent.replace(/[\u2212\d.]+ \w*N$/, "").trim(),
      Number(e.querySelector("output").dataset.value)]));
  const parts = partsOf(row);
  assert.deepEqual(key.map(([words]) => words), ["ice: crushing and pushing", "ice: friction", "ice under the hull",
    "water on the hull", "thrust", "rudder", "mooring", "sum"]);
  [...causes.map((cause) => parts[cause]), sumOf(Object.values(parts))].forEach((value, k) =>
    assert.ok(Math.abs(key[k][1] - value) < 1e-6, `${key[k]}: ${value}`));
});

test("a cause that is ticked off leaves the stack, the sum stays that of all", async () => {
  const most = () => page.player(({ plot }) => plot.chart.scales.y.max);
  const before = await most();
  await page.locator("#curve-thrust").uncheck();
  const now = await most();
  assert.ok(now < before - 1.5e5, `${before} N, then ${now} N`);
  const row = rows[47];
  const parts = partsOf(row);
  const left = causes.filter((cause) => cause !== "thrust");
  const areas = await areasAt(row.t_s - 0.05, left.map((cause) => [cause, parts[cause]]));
  assert.deepEqual(areas.filter(({ cause, isClear, isIts }) => cause === "mooring" && isClear && !isIts), [],
    "what stood on it stands lower");
  assert.equal(Number(await page.locator("#load-now .curve").last().locator("output").getAttribute("data-value")),
    sumOf(Object.values(parts)));
  await page.locator("#curve-thrust").check();
});

test("rows closer than the pixels are drawn as their means, which is stated; zoomed in each row stands for itself",
  async () => {
  const { run } = runWithLoads("by-cause-densely", 0.01);
  const dense = await open(makePage(run), { viewport: { width: 900, height: 700 } });
  await dense.selectOption("#quantity", "surge_by_cause");
  const words = () => dense.text("#off-scale");
  const stated = /means over ([\d.]+) s/.exec(await words());
  assert.ok(Number(stated?.[1]) >= 0.02, await words());
  const most = await dense.player(({ plot }) => plot.inView().map(({ values }) => Math.max(...values.map(Math.abs))));
  assert.ok(most[0] > 1e6, "mooring reaches 1 MN in the last rows");
  await dense.act("zoomPlot", 2, 3);
  assert.ok(!(await words()).includes("means"));
  await dense.context().close();
});
