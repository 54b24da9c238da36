// The controls, by mouse, keys and fingers, from a phone to a desktop: the area that they cover, their size, and the
// effect of a drag and of the space bar.
"use strict";
const { test, before, assert, folder, open } = require("./bench.js");
const { shippedRun, makePage } = require("./runs.js");

const sizes = [[360, 740], [390, 844], [768, 1024], [1440, 900]];
const until = 550; // [s]; a mark for nearly each pixel from 216 s on

let file, page;
before(async () => {
  file = makePage(shippedRun(folder, "sawamura2017-fig4b"));
  page = await open(file);
});

const played = () => page.player(({ state }) => state.isPlaying);
const act = (...words) => page.act(...words);
const now = () => page.player(({ state }) => state.time);

/** In the page: controls over the map, targets below a size [px], and how far the page goes sideways. */
function measureControls(least) {
  const boxOf = (e) => e.getBoundingClientRect();
  const controls = [...document.querySelectorAll("button, select, input, [role=slider]")].filter((e) =>
    e.checkVisibility() && boxOf(e).width > 0);
  const name = (e) => `${e.id || e.textContent} ${boxOf(e).width.toFixed(1)} x ${boxOf(e).height.toFixed(1)}`;
  const map = boxOf(document.getElementById("stage"));
  const isOverMap = (e) => {
    const box = boxOf(e);
    return Math.min(box.right, map.right) - Math.max(box.left, map.left) > 0.5
      && Math.min(box.bottom, map.bottom) - Math.max(box.top, map.top) > 0.5;
  };
  const target = (e) => (e.matches("[type=checkbox], [type=radio]") ? [e, e.closest("label")] : [e]);
  const isSmall = (e, k) => Math.min(boxOf(e).width, boxOf(e).height) < (k === 0 && e.matches("input")
    ? Math.min(24, least) : least) - 0.01;
  const { scrollWidth, clientWidth } = document.documentElement;
  return {
    overMap: controls.filter((e) => !e.closest("aside, dialog") && isOverMap(e)).map(name),
    small: controls.flatMap((e) => target(e).filter(isSmall).map(name)),
    sideways: scrollWidth - clientWidth,
    controls: controls.length,
  };
}

for (const [width, height] of sizes) {
  const size = `${width} x ${height}`;
  test(`at ${size} no control lies over the map, none is below 24 px, nothing scrolls sideways`, async () => {
    await page.setViewportSize({ width, height });
    await act("select", 190); // with the links of its card
    const { controls, ...found } = await page.evaluate(measureControls, 24);
    assert.ok(controls > 25, `${controls} controls`);
    assert.deepEqual(found, { overMap: [], small: [], sideways: 0 });
  });

  test(`at ${size} a drag that begins on a mark scrubs, and a press without motion goes to its event`, async () => {
    await page.setViewportSize({ width, height });
    await page.locator("#track").scrollIntoViewIfNeeded();
    const box = await page.locator("#track").boundingBox();
    const events = await page.player(({ run }) => run.info.events.map(({ t_s }) => t_s));
    const y = box.y + 17; // among the marks
    for (let k = 0; k < events.length; k += Math.ceil(events.length / 5)) {
      await act("letGo");
      await page.mouse.move(box.x + (events[k] / until) * box.width, y);
      await page.mouse.down();
      await page.mouse.move(box.x + 0.3 * box.width, y, { steps: 5 });
      assert.ok(Math.abs((await now()) - 0.3 * until) < (1.5 * until) / box.width,
        `the drag from ${events[k]} s came to ${await now()} s`);
      await page.mouse.move(box.x + 0.2 * box.width, y, { steps: 2 });
      await page.mouse.up();
      assert.ok(Math.abs((await now()) - 0.2 * until) < (1.5 * until) / box.width, "its end is no click either");
      assert.equal(await page.player(({ state }) => state.event), null);
    }
    await page.mouse.click(box.x + (events[0] / until) * box.width, y);
    assert.ok(events.includes(await now()), "a press without motion");
  });

  test(`at ${size} Space plays after a choice of speed, and after any other control`, async () => {
    await page.setViewportSize({ width, height });
    await act("goToEnd", false);
    await page.selectOption("#rate", "10");
    for (const control of ["#rate", "#quantity", "#layer-velocities", "#by-speed", "#zoom-in", "#theme",
      "label:has(#layer-velocities)"]) {
      if (["#rate", "#quantity"].includes(control)) { // headless Chromium shows no list to click in
        await page.locator(control).focus();
        await page.locator(control).evaluate((e) => e.dispatchEvent(new Event("change", { bubbles: true })));
      } else await page.click(control);
      await page.keyboard.press("Space");
      assert.equal(await played(), true, `after ${control}`);
      await act("play", false);
    }
  });
}

test("a control that keys have reached answers keys, and keeps the focus", async () => {
  const scale = () => page.player(({ view }) => view.scale);
  const before = await scale();
  await page.locator("#zoom-in").focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("Enter");
  assert.ok((await scale()) > 1.9 * before);
  const hasBox = await page.locator("#layer-track").isChecked();
  await page.locator("#layer-track").focus();
  await page.keyboard.press("Space");
  assert.equal(await page.locator("#layer-track").isChecked(), !hasBox);
  await page.locator("#rate").focus();
  await page.keyboard.press("ArrowDown");
  assert.equal(await page.evaluate(() => document.activeElement.id), "rate");
  assert.equal(await played(), false);
});

test("for fingers targets have 40 px", async () => {
  const phone = await open(file, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  const { controls, ...found } = await phone.evaluate(measureControls, 40);
  assert.deepEqual(found, { overMap: [], small: [], sideways: 0 });
  assert.ok(controls > 25);
});
