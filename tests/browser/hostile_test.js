"use strict";
// Scenes that are meant to bring the page down, one after the other in one page: after each, the page answers, has said
// something, and runs a good scene.
const { test, after, before } = require("node:test");
const assert = require("node:assert/strict");
const { startBrowser } = require("../view/browser.js");
const hostile = require("./hostile.js");

const longest = 8000; // [ms], for one scene to be read and run
let browser = null;
let page = null;
const errors = [];
before(async () => {
  browser = await startBrowser();
  page = await (await browser.newContext({ viewport: { width: 1000, height: 800 } })).newPage();
  page.on("pageerror", (error) => errors.push(error.stack));
  page.on("dialog", (dialog) => { errors.push("a dialog"); dialog.dismiss(); });
  page.on("crash", () => errors.push("the page is dead"));
  await page.goto(`file://${process.env.PAGE}`);
  await page.waitForFunction(() => document.body.dataset.phase === "ready");
});
after(() => browser.close());

/** Gives the page a scene, and lets it run where it can; gives what the page is then, with what it says. */
const tried = (text) => page.evaluate(async ([words, most]) => {
  const { parts, actions } = window.polynyaPage;
  const start = performance.now();
  const until = (isSo) => new Promise((done) => {
    const look = () => (isSo() || performance.now() - start > most ? done() : setTimeout(look, 20));
    look();
  });
  document.body.dataset.phase = "waiting";
  parts.setScene(words, { isNew: true });
  await until(() => ["ready", "refused"].includes(document.body.dataset.phase));
  if (document.body.dataset.phase === "ready") {
    document.getElementById("rate").value = "Infinity";
    actions.run();
    await until(() => document.body.dataset.phase === "ended" || performance.now() - start > most / 4);
  }
  const phase = document.body.dataset.phase;
  if (["loading", "waiting"].includes(phase)) actions.stop();
  const said = document.getElementById("message").textContent + document.getElementById("problems").textContent;
  return { phase, said: said.trim(), took: performance.now() - start };
}, [text, longest]);

test(`${hostile.length} hostile scenes leave the page alive, with a message where they cannot run`, async () => {
  const good = JSON.stringify({ name: "good", time: { until_s: 1 }, floes: [{ rectangle: { corner_m: [0, 0],
    size_m: [9, 9] } }] });
  for (const [name, text] of hostile) {
    const { phase, said, took } = await tried(text);
    if (process.env.VERBOSE) console.log(`# ${name}: ${phase}, ${took.toFixed(0)} ms: ${said.slice(0, 110)}`);
    if (phase !== "ended" && phase !== "running") assert.ok(said.length > 8, `${name}: ${phase}, and nothing is said`);
    assert.deepEqual(errors, [], name);
  }
  await tried(good);
  assert.equal(await page.evaluate(() => window.polynyaPage.page.run.words.name), "good");
  assert.equal(await page.evaluate(() => window.hacked), undefined);
});
