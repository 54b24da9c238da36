// The plot: true loads first and under their names, a scale that a spike does not flatten, zoom and read-out.
"use strict";
const { test, before, assert, folder, open } = require("./bench.js");
const { makeRun, makePage, giveLoads, smallScene, ship } = require("./runs.js");

const spikeRow = 70; // of forces.csv
let page, run, rows;

/** A run whose forces.csv has been given known loads: a wave of 100 kN, in one row 9 MN. */
function runWithSpike(name, fracture) {
  const made = makeRun(folder, smallScene(name, { fracture, ships: [ship("a", 0)] }));
  const given = giveLoads(made, (k) => {
    const mean = k === spikeRow ? -9e6 : -1e5 * (1 + Math.sin(k / 5));
    return { surge_N: mean, surge_max_N: 1.5 * mean, surge_j_over_tau_c_N: 20 * mean };
  });
  rows ??= given;
  return made;
}

before(async () => {
  run = runWithSpike("spiked", { splitting: { model: "michel" } });
  page = await open(makePage(run), { viewport: { width: 1440, height: 900 } });
});

const over = () => page.locator("#plot .u-over").boundingBox();
const span = () => page.player(({ plot }) => plot.span);
const scale = (name) => page.player(({ plot: { chart } }, key) => [chart.scales[key].min, chart.scales[key].max], name);
const close = (a, b, room = 1e-6) => Math.abs(a - b) <= room;

test("true loads lead: the interval's mean, the step maximum, then j/\u03c4c by its name on its own axis", async () => {
  const key = await page.locator("#load-now .curve").allTextContents();
  assert.deepEqual(key.map((words) => words.replace(/[\u2212\d.]+ \w*N$/, "").trim()),
    ["0.1 s mean", "step maximum (depends on the step)", "j/\u03c4c (paper)"]);
  assert.equal(await page.text("#quantity option >> nth=0"), "Surge force of the ice");
  const zero = ([low, high]) => -low / (high - low);
  assert.ok(close(zero(await scale("y")), zero(await scale("paper")), 1e-9), "0 is at one height on both axes");
});

test("j/\u03c4c is shown by default where it decides splits, elsewhere on request", async () => {
  assert.ok(await page.locator("#curve-paper").isChecked());
  const other = await open(makePage(runWithSpike("true-only", { splitting: { model: "lefm" } })));
  const scales = () => other.player(({ plot }) => plot.chart.series.slice(1).map((series) => series.scale));
  assert.ok(!(await other.locator("#curve-paper").isChecked()));
  assert.deepEqual(await scales(), ["y", "y"]);
  await other.locator("#curve-paper").check();
  assert.deepEqual(await scales(), ["paper", "y", "y"]);
  await other.context().close();
});

test("one spike does not flatten the rest: it is marked and counted, and the full scale shows it", async () => {
  const [low] = await scale("y");
  assert.ok(low <= -3e5 && low > -6e5, `the scale goes down to ${low} N for steps of 300 kN`);
  const words = await page.text("#off-scale .long");
  for (const part of ["0.1 s mean to \u22129 MN at 7.1 s",
    "step maximum (depends on the step) to \u221213.5 MN at 7.1 s", "j/\u03c4c (paper) to \u2212180 MN"])
    assert.ok(words.includes(part), words);
  assert.equal(await page.player(({ plot }) => plot.off.count), 3);
  await page.click("#full-scale");
  assert.ok((await scale("y"))[0] <= -13.5e6);
  assert.ok(!(await page.locator("#off-scale").isVisible()));
  await page.click("#full-scale");
  assert.equal((await scale("y"))[0], low);
});

test("under the pointer the key has the values of the row, elsewhere those of the present time", async () => {
  const box = await over();
  const key = () => page.locator("#load-now output").allTextContents();
  const before = await key();
  for (const time of [2.06, 7.06]) {
    await page.mouse.move(box.x + (time / 10) * box.width, box.y + 20);
    const words = await page.locator("#reading").innerText();
    const row = rows[Math.ceil(time / 0.1 - 1e-9) - 1];
    assert.ok(close(row.t_s, time, 0.1) && words === `values at ${Number(row.t_s.toFixed(6))} s`, words);
    const [factor, unit] = Math.abs(row.surge_N) >= 1e6 ? [1e-6, "MN"] : [1e-3, "kN"];
    assert.equal((await key())[0], `\u2212${Math.abs(row.surge_N * factor).toPrecision(4)} ${unit}`);
    const tip = await page.locator(".reading-words").boundingBox();
    assert.ok(tip.x >= box.x - 1 && tip.x + tip.width <= box.x + box.width + 1);
  }
  await page.mouse.move(box.x, box.y - 300);
  assert.ok(!(await page.locator("#reading").isVisible()));
  assert.deepEqual(await key(), before);
});

test("the wheel zooms about the pointer, a part can be chosen, a double click shows the whole run", async () => {
  const box = await over();
  const px = Math.round(box.x + 0.3 * box.width);
  const part = (px - box.x) / box.width;
  await page.mouse.move(px, box.y + 30);
  await page.mouse.wheel(0, -500);
  await page.waitForFunction(() => window.polynyaPlayer.plot.isZoomed());
  const [from, until] = await span();
  assert.ok(close(from + part * (until - from), 10 * part, 1e-3), "the time under the pointer stays there");
  assert.ok(until - from < 6);
  const mark = await page.locator("#track .part").boundingBox();
  assert.ok(close(mark.x, box.x + (from / 10) * box.width, 1.5) && close(mark.width, ((until - from) / 10) * box.width,
    1.5), "the timeline marks that part");
  assert.equal(await page.locator("#off-scale").isVisible(), until > 7.1, "the scale is that of what is in view");
  await page.mouse.dblclick(px, box.y + 30);
  assert.deepEqual(await span(), [0, 10]);
  assert.ok(await page.locator("#whole-run").isDisabled());

  await page.keyboard.down("Shift");
  await page.drag([box.x + 0.2 * box.width, box.y + 30], [box.x + 0.6 * box.width, box.y + 30]);
  await page.keyboard.up("Shift");
  const chosen = await span();
  assert.ok(close(chosen[0], 2, 0.05) && close(chosen[1], 6, 0.05), `${chosen}`);
  // In the enlarged part, a drag goes to the times of that part, and the visible range follows the present time.
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 30);
  assert.ok(close(await page.player(({ state }) => state.time), 4, 0.05));
  await page.act("goTo", 9);
  await page.waitForFunction(() => window.polynyaPlayer.plot.span[1] > 9);
  await page.click("#whole-run");
  assert.deepEqual(await span(), [0, 10]);
});

test("two fingers zoom the plot", async () => {
  const box = await over();
  const session = await page.context().newCDPSession(page);
  const touch = (type, ends) => session.send("Input.dispatchTouchEvent",
    { type, touchPoints: ends.map((end, id) => ({ x: box.x + end * box.width, y: box.y + 40, id })) });
  await touch("touchStart", [0.4, 0.6]);
  for (const wide of [0.15, 0.2, 0.25]) await touch("touchMove", [0.5 - wide, 0.5 + wide]);
  await touch("touchEnd", []);
  const [from, until] = await span();
  assert.ok(close(until - from, 4, 0.2) && close((from + until) / 2, 5, 0.2), `${from} ${until}`);
});
