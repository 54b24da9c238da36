"use strict";
// Contrast of the texts of the page, in light and dark, in each of its states (WCAG 2.1, 1.4.3: at least 4.5).
const { test, after, before } = require("node:test");
const assert = require("node:assert/strict");
const { newPage, startBrowser } = require("../view/browser.js");
const { faintTexts } = require("../view/contrast.js");

let browser = null;
before(async () => { browser = await startBrowser(); });
after(() => browser.close());

const scene = { name: "two ships", description: "A description.", time: { until_s: 2 },
  ships: [-60, 60].map((y) => ({ name: `ship ${y}`, ship: "reference", position_m: [-90, y], heading_deg: 0,
    pilot: { route: { waypoints: [{ position_m: [300, y], speed_m_per_s: 3 }] } } })),
  floes: [{ rectangle: { corner_m: [0, -20], size_m: [40, 40] } }] };

async function setScene(page, fields, phase) {
  await page.evaluate((words) => {
    document.body.dataset.phase = "waiting";
    window.polynyaPage.parts.setScene(words, { isNew: true });
  }, JSON.stringify({ ...scene, ...fields }));
  await page.waitForFunction((name) => document.body.dataset.phase === name, phase);
}

for (const colorScheme of ["light", "dark"]) {
  test(`${colorScheme}: the texts of the page stand out from their backgrounds`, async () => {
    const page = await newPage(browser, { viewport: { width: 1440, height: 900 }, colorScheme });
    await page.goto(`file://${process.env.PAGE}`);
    await page.waitForFunction(() => document.body.dataset.phase === "ready");
    const check = async (state, least) => {
      const { seen, faint } = await faintTexts(page);
      assert.ok(seen >= least, `${state}: only ${seen} texts are seen`);
      assert.deepEqual(faint, [], state);
    };
    await setScene(page, {}, "ready");
    await check("before the run, with its form", 60);
    await page.click("#tab-text");
    await page.click("#save-menu summary");
    await page.click("[data-place=floe]");
    await check("with its text, the menu and a tool in use", 35);
    await page.click("#save-menu summary");
    await setScene(page, { hello: 1, ice: { thickness_m: -1 } }, "refused");
    await check("with problems and a message", 35);
    await setScene(page, {}, "ready");
    await page.selectOption("#rate", "Infinity");
    await page.click("#run");
    await page.waitForFunction(() => document.body.dataset.phase === "ended");
    await page.click("#take-helm");
    await check("at the run's end, with the helm and a note", 25);
    await page.evaluate(() => {
      document.getElementById("about").style.cssText = "color: #8a8f94; background: #333a40"; // 3.5
    });
    const { faint } = await faintTexts(page);
    assert.equal(faint.length, 1, "a text that is made faint is found");
    assert.match(faint[0], /^p#about/);
  });
}
