// Two runs side by side: one file, one clock, one part of the map, one scale of the plots.
"use strict";
const { test, before, assert, fs, path, folder, open } = require("./bench.js");
const { makeRun, polynya, smallScene, ship } = require("./runs.js");

let page, file;
before(async () => {
  const run = (name, fields, ...options) => makeRun(folder, smallScene(name, { ships: [ship("a", 30)],
    floes: [{ rectangle: { corner_m: [2, 0], size_m: [90, 60] } }], ...fields }), ...options);
  const fast = { ...ship("a", 30), propulsion: { constant_speed_m_per_s: 4 } };
  file = path.join(folder, "pair.html");
  polynya("view", run("slow", {}), run("fast and short", { ships: [fast] }, "--until", "6"), "--out", file);
  page = await open(file, { viewport: { width: 1600, height: 900 } });
});

const both = (read) =>
  page.evaluate((text) => window.polynyaPair.players.map(new Function("player", `return (${text})(player)`)),
    read.toString());
/** A value that is the same in both; it. */
async function same(read) {
  const [mine, its] = await both(read);
  assert.deepEqual(mine, its);
  return mine;
}
const clock = () => page.evaluate(() => window.polynyaPair.clock.time);
const drawn = () => page.drawn();
const inFirst = (css) => page.frameLocator("iframe >> nth=0").locator(css);
const inSecond = (css) => page.frameLocator("iframe >> nth=1").locator(css);

test("it is one file that asks for nothing else, and names both runs", async () => {
  assert.deepEqual(page.requests.filter((url) => !["about:srcdoc", "data:,", `file://${file}`].includes(url)), []);
  assert.equal(await inFirst("#scene").textContent(), "slow");
  assert.equal(await inSecond("#scene").textContent(), "fast and short");
  assert.equal(await page.title(), "slow and fast and short – Polynya");
});

test("one clock moves both: played, by a drag on either timeline, by keys; a run that is over stays at its end",
  async () => {
  await page.click("#play");
  await page.waitForFunction(() => window.polynyaPair.clock.time > 1);
  await page.click("#play");
  assert.equal(await same((player) => player.state.time), await clock());
  const box = await inSecond("#track").boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + box.height - 3);
  for (const time of await both((player) => player.state.time)) assert.ok(Math.abs(time - 5) < 0.1, `${time}`);
  await page.keyboard.press("End"); // the last click was in the second run
  await drawn();
  assert.deepEqual(await both((player) => player.state.time), [10, 6]);
  assert.equal(await inSecond("#notice").textContent(), "This run ends at 6 s.");
  assert.equal(await page.locator("#now").textContent(), "10.0 s");
  await page.locator("header").click({ position: { x: 500, y: 5 } });
  await page.keyboard.press("Home"); // pressed in the bar
  assert.deepEqual(await both((player) => player.state.time), [0, 0]);
  await page.click("#event-after");
  const events = await both((player) => player.run.info.events.map(({ t_s: time }) => time));
  assert.equal(await clock(), Math.min(...events.flat()));
});

test("the part of the map is one, until it is ticked off; colours have the same classes", async () => {
  const box = await inFirst("#stage").boundingBox();
  await page.mouse.move(box.x + 100, box.y + 150);
  await page.mouse.wheel(0, -600);
  await drawn();
  const view = (player) => [player.view.x, player.view.y, player.view.scale];
  const its = await same(view);
  await inSecond("#by-speed").check();
  await drawn();
  assert.equal(await same((player) => player.state.colourBy), "speed");
  await same((player) => player.colourings.speed.edges);
  await same(({ forceScale, arrowScale }) => [forceScale, arrowScale]);
  await page.uncheck("#same-map");
  await page.mouse.move(box.x + 100, box.y + 150);
  await page.mouse.wheel(0, -300);
  await drawn();
  const [moved, stays] = await both(view);
  assert.notDeepEqual(moved, stays);
  assert.deepEqual(stays, its);
  await page.check("#same-map");
});

test("the plots show one quantity, one part of the run and one scale, until that is ticked off", async () => {
  await inFirst("#quantity").selectOption("surge_by_cause");
  await drawn();
  assert.equal(await same((player) => player.plot.quantity), "surge_by_cause");
  await page.evaluate(() => window.polynyaPair.players[1].actions.zoomPlot(2, 5));
  await drawn();
  assert.deepEqual(await same((player) => player.plot.span), [2, 5]);
  const range = (player) => [player.plot.chart.scales.y.min, player.plot.chart.scales.y.max];
  await same(range);
  await page.uncheck("#same-scale");
  await drawn();
  assert.notDeepEqual(...(await both(range)));
  await page.check("#same-scale");
  for (const quantity of ["speed_m_per_s", "surge_N"]) { // one goes at 2 m/s, the other at 4
    await inFirst("#quantity").selectOption(quantity);
    await drawn();
    const [low, high] = await same(range);
    if (quantity === "speed_m_per_s") assert.ok(low <= 2 && high >= 4, `${low} to ${high}`);
  }
  await inFirst("#quantity").selectOption("surge_by_cause");
  await drawn();
  await inSecond("#curve-thrust").uncheck();
  await drawn();
  assert.ok(await same((player) => [...player.plot.hidden].includes("thrust")));
});

test("a link has the instant and a floe of each", async () => {
  await page.evaluate(() => {
    const { players, clock } = window.polynyaPair;
    clock.goTo(7.5);
    players[0].actions.select(0);
    players[1].actions.select(1);
  });
  await page.waitForFunction(() => /t=7.5&floe=0.*&floe2=1$/.test(location.hash));
  const other = await open(page.url().replace("file://", ""));
  assert.deepEqual(await other.evaluate(() => [window.polynyaPair.clock.time,
    ...window.polynyaPair.players.map(({ state }) => state.selected)]), [7.5, 0, 1]);
  // Another link selects another floe of the second run; the plots that both links name stay.
  const plots = () => other.evaluate(() => window.polynyaPair.players.map(({ plotPanel }) => plotPanel.further()));
  const quantity = await other.evaluate(() => Object.keys(window.polynyaPair.players[0].plot.quantities)[1]);
  for (const floe of [1, 0]) {
    await other.evaluate((link) => { location.hash = link; },
      `t=7.5&floe=0&below=${encodeURIComponent(quantity)}&floe2=${floe}`);
    await other.waitForFunction((k) => window.polynyaPair.players[1].state.selected === k, floe);
    await other.evaluate(() => new Promise((done) => { setTimeout(done, 300); })); // share() runs at each refresh
    assert.deepEqual(await plots(), [[quantity], [quantity]]);
  }
  await other.context().close();
});

test("light and dark are one; nothing is cut off at any width", async () => {
  await page.click("#theme");
  const roots = (read) => page.evaluate((text) =>
    [document, ...window.polynyaPair.players.map(({ frame }) => frame.contentDocument)]
      .map(({ documentElement }) => new Function("e", `return (${text})(e)`)(documentElement)), read.toString());
  assert.equal(new Set(await roots((e) => e.dataset.theme)).size, 1);
  for (const [width, height] of [[390, 844], [768, 1024], [1024, 768], [1280, 720], [1920, 1080], [844, 390]]) {
    await page.setViewportSize({ width, height });
    await drawn();
    assert.deepEqual(await roots((e) => e.scrollWidth - e.clientWidth), [0, 0, 0], `${width} x ${height}`);
    const maps = await both((player) => [player.view.width, player.view.height]);
    for (const [across, down] of maps)
      assert.ok(across > 150 && down > 120, `${width} x ${height}: a map of ${across} x ${down}`);
  }
});

test("runs of one name have the names of their folders, or those of --label; without --out they are refused",
  async () => {
  const [one, two] = ["one", "two"].map((name) => path.join(folder, name));
  for (const copy of [one, two]) fs.cpSync(path.join(folder, "slow"), copy, { recursive: true });
  const labels = (...options) => {
    polynya("view", one, two, "--out", file, ...options);
    return JSON.parse(/id="pair-info">(.*?)<\/script>/.exec(fs.readFileSync(file, "utf8"))[1]).labels;
  };
  assert.deepEqual(labels(), ["one", "two"]);
  assert.deepEqual(labels("--label", "thin,thick"), ["thin", "thick"]);
  assert.throws(() => polynya("view", one, two), { status: 2 });
  assert.throws(() => polynya("view", one, "--label", "thin"), { status: 2 });
  assert.throws(() => polynya("view", one, path.join(folder, "none"), "--out", file), { status: 5 });
});
