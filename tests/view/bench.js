// Common start of all tests of the player: an empty folder and a browser, which are removed and closed at the end.
"use strict";
const { test, before, after } = require("node:test");
const assert = require("node:assert/strict");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { startBrowser, openPage } = require("./browser.js");

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "polynya-view-"));
const browser = startBrowser();
const opened = [];
after(async () => {
  await (await browser).close();
  fs.rmSync(folder, { recursive: true, force: true });
  assert.deepEqual(opened.flatMap(({ errors }) => errors), [], "errors of the pages");
});

module.exports = {
  test, before, fs, path, folder, assert,
  /** Opens a page in that browser, in which nothing may go wrong. */
  open: async (file, options) => {
    const page = await openPage(await browser, file, options);
    opened.push(page);
    return page;
  },
};
