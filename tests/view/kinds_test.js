// Runs of every kind, and a phone: the page opens without errors and shows what there is.
"use strict";
const { test, before, after } = require("node:test");
const assert = require("node:assert/strict");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { startBrowser, openPage } = require("./browser.js");
const { makeRun, makePage, smallScene, ship } = require("./runs.js");

let folder, browser;
before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "polynya-view-"));
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  fs.rmSync(folder, { recursive: true, force: true });
});

async function withPage(file, options, use) {
  const page = await openPage(browser, file, options);
  await use(page);
  assert.deepEqual(page.errors, []);
  await page.context().close();
}
const living = (page) => page.locator("#living").textContent().then(Number);

test("no ships, nothing breaks: floes drift", async () => {
  const file = makePage(makeRun(folder, smallScene("adrift", {})));
  await withPage(file, {}, async (page) => {
    assert.equal(await living(page), 9);
    assert.ok(!(await page.locator("#plot").isVisible()));
    assert.ok(await page.locator("#follow").isDisabled());
    assert.ok((await page.locator("#event-card").textContent()).includes("Nothing broke"));
    await page.click("#play");
    await page.waitForFunction(() => window.polynyaPlayer.state.time > 0.2);
  });
});

test("no floes: the ship sails", async () => {
  const file = makePage(makeRun(folder, smallScene("open-water", { floes: [], ships: [ship("lonely", 0)] })));
  await withPage(file, {}, async (page) => assert.equal(await living(page), 0));
});

test("several ships: a curve and a number each, followed in turn", async () => {
  const file = makePage(makeRun(folder, smallScene("two-ships", { ships: [ship("north", 60), ship("south", 10)] })));
  await withPage(file, {}, async (page) => {
    assert.equal(await page.locator("#load-now span").count(), 2);
    for (const wanted of [0, 1, -1]) {
      await page.keyboard.press("f");
      assert.equal(await page.evaluate(() => window.polynyaPlayer.state.follow), wanted);
    }
  });
});

test("a description that is markup is words", async () => {
  const description = '</script><!-- <b>"&amp;\\u2028 {{columns}}';
  const run = makeRun(folder, smallScene("marked-up", { description, ships: [ship("a", 0)] }));
  await withPage(makePage(run), {}, async (page) => {
    assert.equal(await page.title(), "marked-up – Polynya");
    assert.equal(await page.locator("#description").textContent(), description);
  });
});

test("a run that was killed says how far it came; one without frames shows its scene", async () => {
  const run = makeRun(folder, smallScene("killed", { ships: [ship("a", 0)] }));
  const summary = path.join(run, "summary.json");
  fs.writeFileSync(summary, fs.readFileSync(summary, "utf8").replace('"finished": true', '"finished": false'));
  const frames = path.join(run, "frames.bin");
  fs.truncateSync(frames, fs.statSync(frames).size - 10);
  await withPage(makePage(run), {}, async (page) => {
    assert.ok((await page.locator("#badge").textContent()).startsWith("unfinished: 8.0 of 10 s"));
    assert.equal(await living(page), 9);
  });
  fs.truncateSync(frames, 16);
  await withPage(makePage(run), {}, async (page) => {
    assert.ok((await page.locator("#notice").textContent()).includes("no frames"));
    assert.equal(await living(page), 9);
    assert.ok(await page.locator("#play").isDisabled());
  });
});

test("a channel in the run folder is shown instead of the swept band", async () => {
  const run = makeRun(folder, smallScene("channelled", { ships: [ship("a", 0)] }));
  const colourAt = (page) => page.evaluate(() => {
    const { view } = window.polynyaPlayer;
    const [x, y] = view.toScreen(25, -25);
    return [...document.getElementById("ice").getContext("2d").getImageData(x * view.ratio, y * view.ratio, 1, 1).data];
  });
  const square = [[[-100, -30], [100, -30], [100, -20], [-100, -20], [-100, -30]]];
  const feature = { type: "Feature", properties: {}, geometry: { type: "Polygon", coordinates: square } };
  let water;
  await withPage(makePage(run), {}, async (page) => {
    await page.evaluate(() => window.polynyaPlayer.actions.zoomCentre(0.5));
    await page.waitForTimeout(100);
    water = await colourAt(page);
  });
  fs.writeFileSync(path.join(run, "channel.geojson"), JSON.stringify({ type: "FeatureCollection", features: [feature] }));
  await withPage(makePage(run), {}, async (page) => {
    await page.evaluate(() => window.polynyaPlayer.actions.zoomCentre(0.5));
    await page.waitForTimeout(100);
    assert.notDeepEqual(await colourAt(page), water);
    assert.ok((await page.locator("#legend").textContent()).includes("channel"));
  });
});

test("thinned, it still plays from end to end", async () => {
  const run = makeRun(folder, "level-plate", "--until", "60");
  const file = makePage(run, "--every", "5", "--from", "11", "--until", "51");
  await withPage(file, {}, async (page) => {
    const times = await page.evaluate(() => Array.from(window.polynyaPlayer.run.frames.times));
    assert.deepEqual(times, [12, 22, 32, 42, 50]);
    await page.keyboard.press("End");
    await page.waitForFunction(() => window.polynyaPlayer.state.time === 50);
  });
});

test("on a phone: nothing is cut off, a tap picks, two fingers zoom", async () => {
  const file = makePage(makeRun(folder, smallScene("phone", { ships: [ship("a", 0)] })));
  const phone = { viewport: { width: 360, height: 740 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
  await withPage(file, phone, async (page) => {
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
    const at = await page.evaluate(() => {
      const { view, places } = window.polynyaPlayer;
      const box = document.getElementById("stage").getBoundingClientRect();
      const [x, y] = view.toScreen(places.x[4], places.y[4]);
      return [box.left + x, box.top + y];
    });
    await page.touchscreen.tap(...at);
    await page.waitForFunction(() => window.polynyaPlayer.state.selected === 4);
    assert.ok((await page.locator("#chip").textContent()).startsWith("floe 4"));
    const session = await page.context().newCDPSession(page);
    const touch = (type, spread) => session.send("Input.dispatchTouchEvent", { type, touchPoints: spread === null ? []
      : [-1, 1].map((side, id) => ({ x: 180 + side * spread, y: 250, id })) });
    const scale = await page.evaluate(() => window.polynyaPlayer.view.scale);
    await touch("touchStart", 40);
    for (const spread of [50, 60, 70, 80]) await touch("touchMove", spread);
    await touch("touchEnd", null);
    await page.waitForTimeout(100);
    const factor = (await page.evaluate(() => window.polynyaPlayer.view.scale)) / scale;
    assert.ok(Math.abs(factor - 2) < 0.05, `zoomed by ${factor}`);
  });
});
