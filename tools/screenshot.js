// A picture of the player: node tools/screenshot.js PAGE.html OUT.png [STEP...]    (playwright-core in NODE_PATH)
// Each STEP is a call of the player, such as goTo=300, setFollow=0, colourBy=speed, zoomCentre=2, select=240,
// toggleLayer=velocities or toggleTheme; first, "phone" makes it a phone's screen, "size=1440x900" a window of that
// size.
"use strict";
const path = require("node:path");
const { startBrowser, openPage } = require("../tests/view/browser.js");

async function main([file, out, ...steps]) {
  const isPhone = steps[0] === "phone";
  const [, width, height] = /^size=(\d+)x(\d+)$/.exec(steps[0]) ?? [];
  const screen = isPhone ? { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true,
    hasTouch: true }
    : { viewport: { width: Number(width ?? 1280), height: Number(height ?? 760) } };
  const browser = await startBrowser();
  const page = await openPage(browser, path.resolve(file), screen);
  for (const step of steps.slice(isPhone || width ? 1 : 0)) {
    const [name, word] = step.split("=");
    const value = word !== undefined && !Number.isNaN(Number(word)) ? Number(word) : word;
    await page.evaluate(([action, given]) =>
      (window.polynyaPlayer ?? window.polynyaPair.players[0]).actions[action](...(given === undefined ? [] : [given])),
        [name, value]);
    await page.waitForTimeout(60);
  }
  await page.waitForTimeout(200);
  await page.screenshot({ path: out });
  if (page.errors.length > 0) throw new Error(page.errors.join("\n"));
  await browser.close();
}
main(process.argv.slice(2));
