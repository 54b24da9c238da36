// The page at many window sizes and in both themes, with a long description and two ships: by the boxes of its elements
// nothing is cut off and nothing overlaps, the map keeps a useful height, and map and plot can be dragged.
"use strict";
const { test, before, assert, folder, open } = require("./bench.js");
const { makeRun, makePage, smallScene, ship } = require("./runs.js");

const sizes = [[360, 740], [390, 844], [721, 900], [768, 1024], [900, 700], [1024, 768], [1190, 800], [1280, 720],
  [1440, 900], [1920, 1080], [844, 390]];
const description = "Two icebreakers at constant speed through nine floes of fifteen metres, in a scene whose only " +
  "purpose is a description of three hundred characters, because a line as long as this one once made the page wider " +
  "than every window it was opened in, and its controls could no longer be reached by anyone who opened it.";

let page;
before(async () => {
  const scene = smallScene("a-name-of-many-words-in-one", { description,
    ships: [ship("north", 60), ship("south", 10)] });
  page = await open(makePage(makeRun(folder, scene)));
  await page.addScriptTag({ content: findProblems.toString() });
  await page.act("goTo", 6);
  await page.act("select", 4); // with the line on the map
  for (const layer of ["largestLoads", "forces", "velocities"]) await page.act("toggleLayer", layer, true);
});

/** In the page: what is cut off, reaches out of the window or overlaps, in words. */
function findProblems() {
  const problems = [];
  const classOf = (e) => (e.className?.baseVal === undefined && e.className ? `.${e.className}` : "");
  const textOf = (e) => (e.textContent || "").trim().slice(0, 24);
  const name = (e) => `${e.tagName.toLowerCase()}${e.id ? `#${e.id}` : ""}${classOf(e)} "${textOf(e)}"`;
  const isVisible = (e) => e.checkVisibility() && e.getBoundingClientRect().width > 0
    && e.getBoundingClientRect().height > 0;
  const { clientWidth, scrollWidth } = document.documentElement;
  if (scrollWidth > clientWidth) problems.push(`the page is ${scrollWidth} px wide in a window of ${clientWidth}`);
  const scrollers = [...document.querySelectorAll("aside, #further-plots")];
  const scrolls = getComputedStyle(document.body).display === "flex";
  const all = [...document.body.querySelectorAll("*")].filter((e) =>
    !e.closest("dialog, .uplot canvas, select, svg, noscript, script") && isVisible(e));
  for (const e of all) {
    const style = getComputedStyle(e);
    if (style.display === "inline" || e.matches(".thumb, .reading, canvas")) continue;
    if (e.scrollWidth > e.clientWidth + 1) problems.push(`${name(e)} holds ${e.scrollWidth} px in ${e.clientWidth}`);
    if (style.overflowY === "hidden" && e.scrollHeight > e.clientHeight + 1)
      problems.push(`${name(e)} holds ${e.scrollHeight} px of height in ${e.clientHeight}`);
  }
  /** The part of an element's box that its scrolling panel shows. */
  const boxOf = (e) => {
    const { left, right, top, bottom } = e.getBoundingClientRect();
    const scroller = scrollers.find((one) => one !== e && one.contains(e));
    if (!scroller) return { left, right, top, bottom };
    const panel = scroller.getBoundingClientRect();
    return { left, right, top: Math.max(top, panel.top), bottom: Math.min(bottom, panel.bottom) };
  };
  const parts = all.filter((e) => e.matches("button, select, label, output, h1, h2, h3, dt, dd, td, th, p, li, " +
    "#badge, #now, " +
    ".clock > span, .legend > *, .keys-legend > span," +
    "#stage, #chip, #notice, #plot, #track, aside")).map((e) => ({ e, box: boxOf(e) })).filter(({ box }) =>
      box.bottom > box.top);
  for (const { e, box } of parts) {
    if (box.left < -0.5 || box.right > innerWidth + 0.5)
      problems.push(`${name(e)} reaches from ${box.left} to ${box.right} px across`);
    if (!scrolls && (box.top < -0.5 || box.bottom > innerHeight + 0.5))
      problems.push(`${name(e)} reaches from ${box.top} to ${box.bottom} px down`);
  }
  for (const [k, { e, box }] of parts.entries()) {
    for (const { e: other, box: b } of parts.slice(k + 1)) {
      if (e.contains(other) || other.contains(e)) continue;
      const [width, height] = [Math.min(box.right, b.right) - Math.max(box.left, b.left),
        Math.min(box.bottom, b.bottom) - Math.max(box.top, b.top)];
      if (Math.min(width, height) > 0.5)
        problems.push(`${name(e)} and ${name(other)} overlap by ${width} x ${height} px`);
    }
  }
  return problems;
}

const state = () => page.player(({ state: { time }, view: { x, y, scale } }) => ({ time, x, y, scale }));

/** Waits until the page has the theme's colours everywhere. */
async function useTheme(theme) {
  await page.emulateMedia({ colorScheme: theme });
  await page.waitForFunction(() =>
    window.polynyaPlayer.colours.ink === getComputedStyle(document.documentElement).getPropertyValue("--ink").trim());
  await page.drawn();
}

/** Drags the pointer over an element, from one part of its width to another. */
async function drag(selector, from, to, halfway) {
  await page.locator(selector).scrollIntoViewIfNeeded();
  const box = await page.locator(selector).boundingBox();
  const at = (part) => [box.x + part * box.width, box.y + 0.6 * box.height];
  await page.drag(at(from), at(to), halfway);
  return box;
}

for (const [width, height] of sizes) {
  test(`at ${width} x ${height} nothing is cut off or overlaps; map and plot can be dragged`, async () => {
    await page.setViewportSize({ width, height });
    for (const theme of ["dark", "light"]) {
      await useTheme(theme);
      await page.evaluate(() => scrollTo(0, 0));
      for (const quantity of ["surge_by_cause@north", "surge_N"]) {
        await page.act("plotQuantity", quantity);
        assert.deepEqual(await page.evaluate(() => findProblems()), [], `${theme}, ${quantity}`);
      }
    }
    const map = await page.locator("#stage").boundingBox();
    assert.ok(map.height >= Math.max(200, 0.38 * height), `the map is ${map.height} px high`);
    assert.ok(map.y + map.height <= height, "it shows without scrolling");

    const before = await state();
    await drag("#stage", 0.3, 0.5);
    const moved = await state();
    assert.ok(Math.abs((before.x - moved.x) * before.scale - 0.2 * map.width) < 2, "the map follows the pointer");

    // The legend grows halfway, and all other elements move with it.
    const box = await drag("#plot .u-over", 0.2, 0.7, () => page.act("toggleLayer", "forces"));
    const { time } = await state();
    assert.ok(Math.abs(time - 0.7 * 10) < (2 * 10) / box.width, `the drag ends at ${time} s`);
    await page.act("fit");
  });
}

for (const [width, height] of [[360, 740], [768, 1024], [1440, 900]]) {
  test(`at ${width} x ${height} a ship's card and two more plots are cut off nowhere`, async () => {
    await page.setViewportSize({ width, height });
    await page.act("selectShip", 0);
    await page.act("showPlots", ["speed_m_per_s", "yaw_Nm"]);
    for (const theme of ["dark", "light"]) {
      await useTheme(theme);
      await page.evaluate(() => document.querySelector("#ship-card").scrollIntoView());
      assert.deepEqual(await page.evaluate(() => findProblems()), [], theme);
    }
    await page.act("showPlots", []);
    await page.act("selectShip", -1);
  });
}

test("each swatch of the legend stands out from its panel in both themes", async () => {
  for (const theme of ["light", "dark"]) {
    await useTheme(theme);
    for (const name of ["channel", "startIce", "forces"]) await page.act("toggleLayer", name, true);
    await page.act("colourBy", theme === "light" ? "speed" : "generation");
    const contrasts = await page.evaluate(() => {
      const light = (colour) => {
        const [r, g, b] = colour.match(/[\d.]+/g).map((v) => v / 255)
          .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
      return [...document.querySelectorAll("#legend i:not(.arrow)")].map((i) => {
        const panel = getComputedStyle(document.getElementById("legend")).backgroundColor;
        const style = getComputedStyle(i);
        return [i.parentElement.textContent, Math.max(contrast(style.backgroundColor, panel),
          contrast(style.borderTopColor, panel))];
      });
    });
    assert.ok(contrasts.length >= 8);
    for (const [words, contrast] of contrasts) assert.ok(contrast >= 3, `${theme}, ${words}: ${contrast}`);
  }
});

test("each fact of the run that is one word stands in one line", async () => {
  for (const [width, height] of sizes) {
    await page.setViewportSize({ width, height });
    const broken = await page.locator("#facts dd").evaluateAll((all) => all.filter((dd) => {
      const range = document.createRange();
      range.selectNodeContents(dd);
      return !dd.textContent.includes(" ") && new Set([...range.getClientRects()].map(({ top }) => top)).size > 1;
    }).map((dd) => dd.textContent));
    assert.deepEqual(broken, [], `${width} px`);
  }
});
