// Contrast of the player's texts, in light and dark (WCAG 2.1, 1.4.3: at least 4.5), with its cards, its legends and
// the values of five ships, each in the colour of its ship.
"use strict";
const { test, before, assert, folder, open } = require("./bench.js");
const { makeRun, makePage, smallScene, ship } = require("./runs.js");
const { faintTexts, faintTextsInCanvases } = require("./contrast.js");

let page;
before(async () => {
  const ships = [-160, -100, 10, 60, 120].map((y, k) => ship(`ship ${k}`, y));
  page = await open(makePage(makeRun(folder, smallScene("five-ships", { description: "A description.", ships }))));
  await page.act("goTo", 6);
});

for (const theme of ["light", "dark"]) {
  test(`${theme}: the texts of the player stand out from their backgrounds`, async () => {
    await page.emulateMedia({ colorScheme: theme });
    await page.waitForFunction((name) => getComputedStyle(document.documentElement).colorScheme === name, theme);
    await page.act("select", -1);
    await page.act("selectShip", -1);
    for (const [state, act] of [["at first", () => {}], ["with a floe's card", () => page.act("select", 4)],
      ["with a ship's card", () => page.act("selectShip", 2)],
      ["with the keys", () => page.keyboard.press("?")]]) {
      await act();
      const { seen, faint } = await faintTexts(page);
      assert.ok(seen >= 40, `${state}: only ${seen} texts are seen`);
      assert.deepEqual(faint, [], state);
    }
    await page.keyboard.press("Escape");
    const { seen, faint } = await faintTextsInCanvases(page, async () => {
      for (const time of [2, 4]) {
        await page.act("goTo", time);
        await page.act("selectShip", time);
        await page.player(({ plot }) => plot.show(0, plot.span[1] - 1));
        await page.evaluate(() => new Promise((done) => { setTimeout(done, 300); }));
      }
    });
    assert.ok(seen >= 20, `only ${seen} texts are drawn into canvases`);
    assert.deepEqual(faint, [], "in canvases");
    const made = await faintTextsInCanvases(page, () => page.evaluate(() => {
      const context = document.querySelector("canvas").getContext("2d");
      context.fillStyle = getComputedStyle(document.body).backgroundColor;
      context.fillText("faint words", 5, 5);
    }));
    assert.equal(made.faint.length, 1, "a text that is drawn faintly is found");
    assert.match(made.faint[0], /^canvas "faint words"/);
  });
}
