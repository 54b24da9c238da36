"use strict";
// The page where the simulator cannot go on: a run that fails numerically, and a module that is incomplete or none at
// all. The page must say so and stay alive. BROWSER=firefox tries it in Firefox.
const { test, after, before } = require("node:test");
const assert = require("node:assert/strict");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const zlib = require("node:zlib");
const { newPage, startBrowser, startFirefox, writeText } = require("../view/browser.js");

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "polynya-broken-"));
let browser = null;
before(async () => { browser = await (process.env.BROWSER === "firefox" ? startFirefox() : startBrowser()); });
after(async () => {
  await browser.close();
  fs.rmSync(folder, { recursive: true, force: true });
});

const inPhase = (page, ...phases) =>
  page.waitForFunction((all) => all.includes(document.body.dataset.phase), phases, { timeout: 60000 });
const messageOf = (page) => page.locator("#message span").textContent();

async function openPage(file) {
  const page = await newPage(browser, { viewport: { width: 1000, height: 800 } });
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => window.polynyaPage);
  return page;
}

// A mooring that is far too stiff for its tick: the ship's speed grows without end (tests/io/run_loop_test.cpp).
const moored = (stiffness) => JSON.stringify({ name: "moored", time: { step_s: 0.01, until_s: 3 },
  ships: [{ name: "moored", ship: "reference", position_m: [-90, 0], propulsion: { thrust_N: 0 },
    mooring: { position_m: [2000, 0], surge_stiffness_N_per_m: stiffness } }],
  floes: [{ rectangle: { corner_m: [0, -20], size_m: [40, 40] } }] });

test("a run that fails numerically ends with a message, and the next scene runs", async () => {
  const page = await openPage(process.env.PAGE);
  await inPhase(page, "ready");
  const run = async (text) => {
    await page.evaluate((words) => {
      document.body.dataset.phase = "waiting";
      window.polynyaPage.parts.setScene(words, { isNew: true });
    }, text);
    await inPhase(page, "ready");
    await page.selectOption("#rate", "Infinity");
    await page.click("#run");
    await inPhase(page, "ended");
  };
  await run(moored(5e6));
  assert.match(await messageOf(page), /The run failed at \d+\.\d+ s: .*no finite speed/);
  assert.equal(await page.locator("#save-run").isDisabled(), false, "what was run can be saved");
  await page.click("#again");
  await inPhase(page, "ready");
  await run(moored(5));
  assert.equal(await page.locator("#message").isHidden(), true);
  assert.match(await page.locator("#toast").textContent(), /at its end/);
  assert.deepEqual(page.errors, []);
});

/** Writes the page with other bytes for its packed module. */
function pageWith(name, change) {
  const html = fs.readFileSync(process.env.PAGE, "utf8");
  const changed = html.replace(/(<script type="text\/plain" id="module">)([^<]*)/, (_, tag, words) =>
    tag + change(Buffer.from(words, "base64")).toString("base64"));
  assert.notEqual(changed, html);
  fs.writeFileSync(path.join(folder, name), changed);
  return path.join(folder, name);
}

const half = (bytes) => bytes.subarray(0, bytes.length / 2);
const withWasm = (change) => (packed) => zlib.gzipSync(change(zlib.gunzipSync(packed)));
const broken = {
  "half of the packed module": half,
  "half of the module": withWasm(half),
  "a module of zeros": withWasm((bytes) => bytes.fill(0)),
  "a module with nothing in it": withWasm(() => Buffer.from([0, 97, 115, 109, 1, 0, 0, 0])),
  "no module": () => Buffer.alloc(0),
};
for (const [name, change] of Object.entries(broken)) {
  test(`with ${name} the page says that it cannot run, and the scene can be edited and saved`, async () => {
    const page = await openPage(pageWith("broken.html", change));
    await inPhase(page, "broken");
    const isSaid = async () => assert.match(await messageOf(page), /does not start in this browser: .{5,}\. Scenes/);
    await isSaid();
    await page.keyboard.press("r");
    await page.keyboard.press(" ");
    await page.selectOption("#scenes", { index: 1 });
    await writeText(page, `// mine\n${await page.inputValue("#text")}`);
    await page.waitForFunction(() => window.polynyaPage.page.text.startsWith("// mine"));
    await page.waitForTimeout(700); // longer than the delay after which a scene is read
    await isSaid();
    assert.equal(await page.locator("#run").isDisabled(), true);
    assert.equal(await page.locator("#save-scene").isDisabled(), false);
    await page.locator("#stage").focus();
    await page.keyboard.press("Control+z");
    await page.waitForFunction(() => !window.polynyaPage.page.text.startsWith("// mine"));
    const ofFirefox = /^Failed to read data from the ReadableStream/; // its own line about the packed bytes
    assert.deepEqual(page.errors.filter((words) => !ofFirefox.test(words)), []);
  });
}
