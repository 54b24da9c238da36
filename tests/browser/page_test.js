"use strict";
// The page in a browser: running, editing, steering, saving and reloading a scene, and its messages about wrong scenes.
// PAGE is the path of the page, POLYNYA_BINARY the native program. BROWSER=firefox tries it in Firefox: its driver has
// neither downloads nor touch, so that what the page offers for download is taken from it, and the mouse steers.
const { test, after, before } = require("node:test");
const assert = require("node:assert/strict");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { newPage, startBrowser, startFirefox, writeText } = require("../view/browser.js");

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "polynya-page-"));
const source = path.resolve(__dirname, "../..");
let browser = null;
const isFirefox = process.env.BROWSER === "firefox";
before(async () => { browser = await (isFirefox ? startFirefox() : startBrowser()); });
after(async () => {
  await browser.close();
  fs.rmSync(folder, { recursive: true, force: true });
});

/** Waits until the page is in a phase. */
const inPhase = (page, ...phases) =>
  page.waitForFunction((all) => all.includes(document.body.dataset.phase), phases, { timeout: 60000 });

/** Opens the page, in which nothing may go wrong. `link` is what follows its address. */
async function openPage({ link = "", by = browser, ...options } = {}) {
  const page = await newPage(by, { viewport: { width: 1440, height: 900 }, acceptDownloads: true, ...options });
  await page.goto(`file://${process.env.PAGE}${link}`);
  await inPhase(page, "ready", "refused");
  return page;
}

const text = (page) => page.evaluate(() => window.polynyaPage.page.text);
const messageOf = (page) => page.locator("#message span").textContent();
const setText = async (page, words) => {
  await page.click("#tab-text");
  await writeText(page, words);
  await page.evaluate(() => { document.body.dataset.phase = "waiting"; });
  await inPhase(page, "ready", "refused");
};

const small = JSON.stringify({ name: "small", time: { until_s: 5 },
  ships: [{ name: "icebreaker", ship: "reference", position_m: [-90, 0],
    pilot: { route: { waypoints: [{ position_m: [300, 40], speed_m_per_s: 3 }] } } }],
  floes: [{ rectangle: { corner_m: [0, -20], size_m: [40, 40] } }] }, null, 2);

/** Where a place of the world is on the screen [px]. */
async function onScreen(page, point) {
  const at = await page.evaluate((place) => window.polynyaPage.page.view.toScreen(...place), point);
  const box = await page.locator("#stage").boundingBox();
  return [box.x + at[0], box.y + at[1]];
}

async function drag(page, from, to) {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 });
  await page.mouse.move(...to, { steps: 3 });
  await page.evaluate(() => { document.body.dataset.phase = "waiting"; });
  await page.mouse.up();
  await inPhase(page, "ready", "refused");
}

/** What a link would have saved, in Firefox. */
async function offeredBy(page, click) {
  await page.evaluate(() => {
    window.offered = new Promise((done) => {
      HTMLAnchorElement.prototype.click = async function offer() {
        const bytes = new Uint8Array(await (await fetch(this.href)).arrayBuffer());
        done({ name: this.download, base64: btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")) });
      };
    });
  });
  await click();
  return page.evaluate(() => window.offered);
}

async function savedBy(page, click) {
  if (isFirefox) {
    const { name, base64 } = await offeredBy(page, click);
    fs.writeFileSync(path.join(folder, name), Buffer.from(base64, "base64"));
    return path.join(folder, name);
  }
  const [download] = await Promise.all([page.waitForEvent("download"), click()]);
  const file = path.join(folder, download.suggestedFilename());
  await download.saveAs(file);
  return file;
}

const fromMenu = (page, id) => async () => {
  await page.click("#save-menu summary");
  await page.click(id);
};

test("it opens from disk without asking the network, and runs to the state of the native program", async () => {
  const page = await openPage();
  await setText(page, small);
  await page.selectOption("#rate", "Infinity");
  await page.click("#run");
  await inPhase(page, "ended");
  const hash = await page.evaluate(() => window.polynyaPage.page.hash);
  fs.writeFileSync(path.join(folder, "small.json"), small);
  const [file, run] = ["small.json", "small"].map((name) => path.join(folder, name));
  execFileSync(process.env.POLYNYA_BINARY, ["run", file, "--out", run]);
  const states = fs.readFileSync(path.join(folder, "small/states.csv"), "utf8").trim().split("\n");
  assert.equal(states.at(-1).split(",")[2], hash);
  assert.ok(await page.evaluate(() => window.polynyaPage.page.plot.rows() > 5), "the plot has grown");
  assert.deepEqual(page.requests.filter((url) => !/^(file|blob|data):/.test(url)), []);
  assert.deepEqual(page.errors, []);
});

test("the run's .zip is the folder that the native program reads, with the same records", async () => {
  const page = await openPage();
  await setText(page, small);
  await page.selectOption("#rate", "Infinity");
  await page.click("#run");
  await inPhase(page, "ended");
  const zip = await savedBy(page, fromMenu(page, "#save-run"));
  execFileSync("python3", ["-m", "zipfile", "-e", zip, path.join(folder, "unpacked")]);
  const run = path.join(folder, "unpacked/small");
  assert.match(execFileSync(process.env.POLYNYA_BINARY, ["inspect", run], { encoding: "utf8" }), /1600/);
  for (const words of [["channel", run], ["loads", run], ["view", run, "--out", path.join(folder, "small.html")]])
    execFileSync(process.env.POLYNYA_BINARY, words);
  execFileSync(process.env.POLYNYA_BINARY, ["run", path.join(run, "scene.json"), "--out", path.join(folder, "native")]);
  for (const name of ["forces.csv", "events.ndjson", "floes.ndjson", "frames.bin", "states.csv", "contacts.csv"])
    assert.ok(fs.readFileSync(path.join(run, name)).equals(fs.readFileSync(path.join(folder, "native", name))), name);
  assert.deepEqual(page.errors, []);
});

test("ships, waypoints and floes are moved by mouse, ships are turned, and undone", async () => {
  const page = await openPage();
  await setText(page, small);
  const scene = async () => JSON.parse(await text(page));
  await drag(page, await onScreen(page, [-90, 0]), await onScreen(page, [-90, 60]));
  assert.ok(Math.abs((await scene()).ships[0].position_m[1] - 60) < 3);
  const bow = await page.evaluate(() => {
    const { page: { run, view } } = window.polynyaPage;
    return bowPlace(run, view);
    function bowPlace({ motions, info }, { scale }) {
      const [x, y] = motions.ship(0);
      return [x + Math.max(...info.ships[0].waterline_m.map((p) => p[0])) + 26 / scale, y];
    }
  });
  await drag(page, await onScreen(page, bow), await onScreen(page, [-90, 110]));
  assert.ok(Math.abs((await scene()).ships[0].heading_deg - 90) < 5);
  await drag(page, await onScreen(page, [300, 40]), await onScreen(page, [250, -30]));
  const [waypoint] = (await scene()).ships[0].pilot.route.waypoints;
  assert.ok(Math.hypot(waypoint.position_m[0] - 250, waypoint.position_m[1] + 30) < 3);
  await drag(page, await onScreen(page, [20, 0]), await onScreen(page, [60, 20]));
  assert.ok(Math.abs((await scene()).floes[0].rectangle.corner_m[0] - 40) < 3);
  for (let k = 0; k < 4; ++k) {
    await page.click("#undo");
    await inPhase(page, "ready", "refused");
  }
  assert.equal(await text(page), small);
  await page.click("[data-place=structure]");
  await page.mouse.click(...await onScreen(page, [120, 50]));
  await page.waitForFunction(() => window.polynyaPage.page.text.includes("radius_m"));
  assert.deepEqual(page.errors, []);
});

test("the form changes the text where the value stands, and comments stay", async () => {
  const page = await openPage();
  await setText(page, `// a comment\n${small}`);
  await page.click("#tab-form");
  const field = page.locator("input[aria-label='ice: thickness [m]']");
  await field.fill("0.8");
  await field.press("Enter");
  await page.waitForFunction(() => window.polynyaPage.page.text.includes("0.8"));
  const changed = await text(page);
  assert.match(changed, /^\/\/ a comment/);
  assert.equal(JSON.parse(changed.replace(/^.*\n/, "")).ice.thickness_m, 0.8);
  assert.deepEqual(page.errors, []);
});

test(`a ship is steered by keys and by ${isFirefox ? "mouse" : "touch"}, and its rudder follows`, async () => {
  const page = await openPage({ hasTouch: !isFirefox });
  await setText(page, small.replace("\"until_s\": 5", "\"until_s\": 500"));
  await page.selectOption("#rate", "10");
  await page.click("#run");
  await page.locator("#stage").focus();
  for (let k = 0; k < 4; ++k) await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => window.polynyaPage.page.run.motions.ship(0)[7] > 0.2);
  const slider = await page.locator("#lever").boundingBox();
  const end = [slider.x + 2, slider.y + slider.height / 2];
  await (isFirefox ? page.mouse.click(...end) : page.touchscreen.tap(...end));
  await page.waitForFunction(() => window.polynyaPage.page.run.motions.ship(0)[6] < 0);
  assert.equal(await page.locator("#take-helm").getAttribute("aria-pressed"), "true");
  assert.deepEqual(page.errors, []);
});

test("a link and a saved file hold the scene, and the run opens in the player", async () => {
  const page = await openPage();
  await setText(page, small);
  await fromMenu(page, "#copy-link")();
  await page.waitForFunction(() => location.hash.startsWith("#scene="));
  await page.reload();
  await inPhase(page, "ready");
  assert.equal(await text(page), small);
  const file = await savedBy(page, fromMenu(page, "#save-scene"));
  assert.equal(fs.readFileSync(file, "utf8"), small);
  await page.selectOption("#rate", "Infinity");
  await page.click("#run");
  await inPhase(page, "ended");
  await page.click("#study");
  const frame = await (await page.waitForSelector("#study-page iframe")).contentFrame();
  await frame.waitForFunction(() => window.polynyaPlayer?.drawn > 0);
  assert.equal(await frame.evaluate(() => window.polynyaPlayer.run.info.finished), true);
  assert.equal(await frame.locator("#scene").textContent(), "small");
  await page.click("#study-close");
  assert.deepEqual(page.errors, []);
});

test("problems stand at their lines, and a hint does not hinder", async () => {
  const page = await openPage();
  await setText(page, small.replace("\"size_m\": [", "\"size\": ["));
  assert.match(await page.locator("#problems li").first().textContent(), /error, line \d+: floes\[0\]/);
  assert.match(await messageOf(page), /problem/);
  await page.locator("#problems button").first().click();
  const chosen = await page.evaluate(() => {
    const area = document.getElementById("text");
    return area.value.slice(area.selectionStart, area.selectionEnd);
  });
  assert.match(chosen, /rectangle|size/);
  await setText(page, "{\"floes\": [");
  assert.match(await page.locator("#problems li").first().textContent(), /error, line 1/);
  await setText(page, small);
  await inPhase(page, "ready");
  assert.deepEqual(page.errors, []);
});

for (const width of [360, 768, 1440]) {
  for (const colorScheme of ["light", "dark"]) {
    test(`at ${width} px, ${colorScheme}, all controls are on the page and have names`, async (t) => {
      const own = isFirefox ? await startFirefox(colorScheme) : null; // its colour scheme is a setting of the program
      t.after(() => own?.close());
      const page = await openPage({ by: own ?? browser, viewport: { width, height: 800 }, colorScheme });
      const isDark = await page.evaluate(() => matchMedia("(prefers-color-scheme: dark)").matches);
      assert.equal(isDark, colorScheme === "dark");
      const wrong = await page.evaluate(() => {
        const shown = [...document.querySelectorAll("button, select, input, textarea, summary")].filter((control) =>
          control.checkVisibility() && !control.closest("#study-page"));
        const nameOf = (control) => control.getAttribute("aria-label") || control.textContent.trim()
          || control.closest("label")?.textContent.trim();
        return shown.filter((control) => {
          const { left, right, height } = control.getBoundingClientRect();
          return left < -1 || right > innerWidth + 1 || height < 24 - (control.type === "checkbox" ? 12 : 0)
            || !nameOf(control);
        }).map((control) => `${control.id} ${control.outerHTML.slice(0, 90)}`);
      });
      assert.deepEqual(wrong, []);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth + 1), "no side scroll");
      if (process.env.SHOTS) {
        await page.selectOption("#rate", "100");
        await page.click("#run");
        await page.waitForTimeout(1500);
        const name = `${process.env.BROWSER ?? "chromium"}-${width}-${colorScheme}.png`;
        await page.screenshot({ path: path.join(process.env.SHOTS, name) });
      }
      assert.deepEqual(page.errors, []);
    });
  }
}

test("keys alone are enough to run, pause and start again", async () => {
  const page = await openPage();
  await page.keyboard.press(" ");
  await inPhase(page, "running");
  await page.keyboard.press(" ");
  await inPhase(page, "paused");
  await page.keyboard.press(".");
  await page.keyboard.press("r");
  await inPhase(page, "ready");
  assert.equal(await page.evaluate(() => window.polynyaPage.page.run.time), 0);
  assert.deepEqual(page.errors, []);
});

module.exports = { source };
