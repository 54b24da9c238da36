// Measures the player: node tools/measure_player.js PAGE.html [seconds]     (playwright-core in NODE_PATH)
// Prints how long the page took to open, the time between frames and in drawing while it plays, and the processor time
// of all the browser's processes for a frame, which other work on the machine changes little (Linux).
"use strict";
const fs = require("node:fs");
const path = require("node:path");
const { startBrowser, openPage } = require("../tests/view/browser.js");

/** Processor time of this process' descendants [ms]. */
function processorTime() {
  const processes = new Map();
  for (const id of fs.readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = fs.readFileSync(`/proc/${id}/stat`, "utf8").replace(/.*\) /, "").split(" ");
      processes.set(id, { parent: fields[1], ticks: Number(fields[11]) + Number(fields[12]) });
    } catch { /* it has ended */ }
  }
  const isBelow = (id) => processes.has(id) && (processes.get(id).parent === String(process.pid)
    || isBelow(processes.get(id).parent));
  return [...processes.keys()].filter(isBelow).reduce((sum, id) => sum + 10 * processes.get(id).ticks, 0);
}

async function playFor(page, seconds) {
  const before = processorTime();
  const played = await page.evaluate(async (duration) => {
    const player = window.polynyaPlayer ?? window.polynyaPair.players[0];
    const { actions } = player;
    const clock = window.polynyaPair?.clock ?? player.state;
    const between = [];
    actions.play(true);
    let last = performance.now();
    const end = last + duration;
    player.drawTimes.length = 0;
    while (last < end && clock.isPlaying) {
      await new Promise(requestAnimationFrame);
      const now = performance.now();
      between.push(now - last);
      last = now;
    }
    actions.play(false);
    return { between, draw: player.drawTimes.slice() };
  }, 1000 * seconds);
  return { ...played, processor: (processorTime() - before) / played.between.length };
}

const at = (values, part) => [...values].sort((a, b) => a - b)[Math.floor(part * (values.length - 1))].toFixed(1);

async function main() {
  const browser = await startBrowser();
  const page = await openPage(browser, path.resolve(process.argv[2]));
  const seconds = Number(process.argv[3] ?? 5);
  const floes = await page.evaluate(() => (window.polynyaPair?.players ?? [window.polynyaPlayer]).map(({ places }) =>
    places.count).join(" and "));
  console.log(`opened and drawn after ${page.openedAfter} ms; ${floes} floes`);
  const show = (words, { between, draw, processor }) => {
    const rate = (1000 * between.length / between.reduce((a, b) => a + b, 0)).toFixed(0);
    console.log(`${words}: ${rate} frames/s, between frames ` +
      `${at(between, 0.5)} ms (95 %: ${at(between, 0.95)}), of which script ` +
      `${at(draw, 0.5)} ms (95 %: ${at(draw, 0.95)}); processor ${processor.toFixed(1)} ms a frame`);
  };
  await playFor(page, 2); // the browser compiles what runs often
  const act = (name, ...words) =>
    page.evaluate(([action, list]) => (window.polynyaPlayer ?? window.polynyaPair.players[0]).actions[action](...list),
      [name, words]);
  await act("goToEnd", false);
  show("whole run, playing", await playFor(page, seconds));
  await act("goToEnd", false);
  await act("setFollow", 0);
  show("following the ship", await playFor(page, seconds));
  await browser.close();
}
main();
