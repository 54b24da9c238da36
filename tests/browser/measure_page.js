"use strict";
// node tests/browser/measure_page.js PAGE: times real time of the paper's voyage as fast as it can, and pictures a
// second with some 2000 floes at real time, in Chromium, each after 5 s. NODE_PATH has playwright-core
// (tests/view/run).
const { startBrowser } = require("../view/browser.js");

const field = { name: "two-thousand", time: { until_s: 300 },
  ships: [{ ship: "reference", name: "icebreaker", position_m: [-80, 0], speed_m_per_s: 3 }],
  floes: [{ field: { corner_m: [0, -300], extent_m: [600, 600], concentration: 0.8, floe_size_m: 12 } }] };

async function measured(page, text, rate) {
  if (text) {
    await page.evaluate((words) => {
      document.body.dataset.phase = "waiting";
      window.polynyaPage.parts.setScene(words, { isNew: true });
    }, text);
  }
  await page.waitForFunction(() => document.body.dataset.phase === "ready");
  await page.selectOption("#rate", rate);
  await page.evaluate(() => window.polynyaPage.actions.run());
  await page.waitForTimeout(5000);
  return page.evaluate(() => {
    const { run, speed, perSecond } = window.polynyaPage.page;
    return `${run.places.count} floes: ${speed.toFixed(1)} x real time, ${perSecond.toFixed(0)} pictures a second`;
  });
}

(async () => {
  const browser = await startBrowser();
  const page = await (await browser.newContext({ viewport: { width: 1360, height: 820 } })).newPage();
  await page.goto(`file://${require("node:path").resolve(process.argv[2])}`);
  console.log("sawamura2017-fig4b,", await measured(page, null, "Infinity"));
  console.log("a field,", await measured(page, JSON.stringify(field), "1"));
  await browser.close();
})();
