// Debian's Chromium and Firefox, driven by playwright-core, which is found by NODE_PATH.
"use strict";
const { chromium, firefox } = require("playwright-core");

const flags = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync"];

/** Starts it with an empty profile of its own. */
exports.startBrowser = () =>
  chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", headless: true, args: flags });

/** Starts Firefox in the same way, by WebDriver BiDi. That has no command for the colour scheme: it is a setting. */
exports.startFirefox = (colorScheme = "light") =>
  firefox.launch({ executablePath: process.env.FIREFOX || "/usr/bin/firefox-esr", channel: "moz-firefox",
    headless: true, firefoxUserPrefs: { "layout.css.prefers-color-scheme.content-override":
      ["dark", "light"].indexOf(colorScheme) } });

/** An empty page in a context of its own; its errors and requests are collected. */
exports.newPage = async (browser, options) => {
  const page = await (await browser.newContext(options)).newPage();
  page.errors = [];
  page.requests = [];
  page.on("pageerror", (error) => page.errors.push(error.stack));
  page.on("console", (message) => { if (message.type() === "error") page.errors.push(message.text()); });
  page.on("request", (request) => page.requests.push(request.url()));
  return page;
};

/** Writes into the field for the scene's text. In Firefox the driver's own `fill` sometimes never returns. */
exports.writeText = (page, words) => (page.context().browser().browserType().name() === "firefox"
  ? page.locator("#text").evaluate((area, value) => {
    area.value = value;
    area.dispatchEvent(new Event("input", { bubbles: true }));
  }, words) : page.fill("#text", words));

/** Opens a page written by `polynya view`. */
exports.openPage = async (browser, file, options = {}) => {
  const page = await exports.newPage(browser, { viewport: { width: 1360, height: 820 }, ...options });
  const start = Date.now();
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => window.polynyaPlayer?.drawn > 0 || window.polynyaPair?.players.every(({ drawn }) =>
    drawn > 0));
  page.openedAfter = Date.now() - start; // [ms]
  /** What `read` gives of the player, and of more words. */
  page.player = (read, ...words) => page.evaluate(([text, list]) =>
    new Function("player", "words", `return (${text})(player, ...words)`)(window.polynyaPlayer, list),
  [read.toString(), words]);
  page.text = (css) => page.locator(css).textContent();
  /** Drags the pointer from a place to another; does something halfway. */
  page.drag = async (from, to, halfway) => {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 });
    await halfway?.();
    await page.mouse.move(...to, { steps: 3 });
    await page.mouse.up();
  };
  /** Waits until what was asked for is drawn. */
  page.drawn = () => page.evaluate(() => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
  /** Does something with the player (of two, the first). */
  page.act = async (name, ...words) => {
    await page.evaluate(([action, list]) => {
      (window.polynyaPlayer ?? window.polynyaPair.players[0]).actions[action](...list);
    }, [name, words]);
    await page.drawn();
  };
  /** Colours of a canvas at points of the world; "none" where nothing is drawn. */
  page.colours = (canvas, points) => page.evaluate(([id, all]) => {
    const { view } = window.polynyaPlayer;
    const context = document.getElementById(id).getContext("2d");
    return all.map((point) => {
      const [x, y] = view.toScreen(...point).map((pixel) => Math.round(pixel * view.ratio));
      const [r, g, b, a] = context.getImageData(x, y, 1, 1).data;
      return a === 0 ? "none" : `rgb(${r}, ${g}, ${b})`;
    });
  }, [canvas, points]);
  return page;
};
