// Debian's Chromium, driven by playwright-core, which is found by NODE_PATH.
"use strict";
const { chromium } = require("playwright-core");

const flags = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync"];

/** Starts it with an empty profile of its own. */
exports.startBrowser = () =>
  chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", headless: true, args: flags });

/** Opens a page written by `polynya view`; errors and requests of the page are collected. */
exports.openPage = async (browser, file, options = {}) => {
  const context = await browser.newContext({ viewport: { width: 1360, height: 820 }, ...options });
  const page = await context.newPage();
  page.errors = [];
  page.requests = [];
  page.on("pageerror", (error) => page.errors.push(error.stack));
  page.on("console", (message) => { if (message.type() === "error") page.errors.push(message.text()); });
  page.on("request", (request) => page.requests.push(request.url()));
  const start = Date.now();
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => window.polynyaPlayer?.drawn > 0 || window.polynyaPair?.players.every(({ drawn }) =>
    drawn > 0));
  page.openedAfter = Date.now() - start; // [ms]
  return page;
};
