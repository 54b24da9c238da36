// What every test of the player begins with: a folder and a browser of its own, which go when it ends.
"use strict";
const { test, before, after } = require("node:test");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { startBrowser, openPage } = require("./browser.js");

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "polynya-view-"));
const browser = startBrowser();
after(async () => {
  await (await browser).close();
  fs.rmSync(folder, { recursive: true, force: true });
});

module.exports = {
  test, before, fs, path, folder,
  assert: require("node:assert/strict"),
  /** Opens a page in that browser. */
  open: async (file, options) => openPage(await browser, file, options),
};
