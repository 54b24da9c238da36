// Ships in the player: the card of the selected ship, names beside hulls, the ruler, and several plots.
"use strict";
const { test, before, assert, folder, open } = require("./bench.js");
const { makeRun, makePage, readLines, smallScene, ship } = require("./runs.js");

const sailing = (name, y) => ({ name, position_m: [-30, y], speed_m_per_s: 3,
  hull: { length_m: 40, beam_m: 9, entrance_angle_deg: 27, stem_angle_deg: 30, draught_m: 3, block_coefficient: 0.6 },
  propulsion: { engine: { power_MW: 3, propeller_diameter_m: 2.2, open_water_speed_m_per_s: 6 } },
  steering: { rudder: {} }, pilot: { constant: { steering_deg: 10, lever: 0.7 } } });

let run, page, rows;
before(async () => {
  run = makeRun(folder, smallScene("three-ships", { ships: [sailing("north", 30), sailing("south", 0),
    ship("held", 60)], record: { forces_interval_s: 0.5 } }));
  const [header, ...lines] = readLines(run, "forces.csv").map((line) => line.split(","));
  rows = lines.map((fields) => Object.fromEntries(fields.map((field, k) => [header[k], Number.isNaN(Number(field))
    ? field : Number(field)])));
  page = await open(makePage(run), { viewport: { width: 1440, height: 900 } });
});

const act = (...words) => page.act(...words);
const state = () => page.player(({ state: { ship: chosen, ruler } }) => ({ chosen, ruler }));
const facts = async () => {
  await page.drawn(); // a click is answered at once, its card is drawn with the next frame
  return page.locator("#ship-card dd").evaluateAll((all) => Object.fromEntries(all.map((dd) =>
    [dd.dataset.fact, { words: dd.textContent, value: dd.dataset.value }])));
};
/** Where a point of a ship's frame is in the window. */
const placeOn = async (index, x, y) => {
  const box = await page.locator("#stage").boundingBox();
  const [px, py] = await page.player(({ view, motions }, k, dx, dy) => {
    const [sx, sy, angle] = motions.ship(k);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return view.toScreen(sx + dx * c - dy * s, sy + dx * s + dy * c);
  }, index, x, y);
  return [box.x + px, box.y + py];
};

test("a click on a ship shows its card, another one lets go of it; beside the hull there is none", async () => {
  await act("goTo", 5);
  await page.mouse.click(...await placeOn(1, -15, 0));
  assert.equal((await state()).chosen, 1);
  assert.equal((await facts()).ship.words, "south");
  await page.waitForTimeout(350); // no double click
  await page.mouse.click(...await placeOn(1, 19, 4.2)); // beside the bow, within the box about the hull
  assert.equal((await state()).chosen, 1, "nothing is there");
  await page.waitForTimeout(350);
  await page.mouse.click(...await placeOn(1, -15, 0));
  assert.equal((await state()).chosen, -1);
  await page.mouse.move(...await placeOn(1, 0, 12));
  await page.waitForFunction(() => document.getElementById("chip").hidden);
  assert.match(await page.text("#ship-card"), /Click a ship/);
});

test("the card has the numbers of forces.csv at every time, and the causes add up to their sum", async () => {
  await act("selectShip", 0);
  for (const time of [0.3, 4, 9.75]) {
    await act("goTo", time);
    const row = rows.find((one) => one.ship === "north" && one.t_s >= time - 1e-9);
    const card = await facts();
    assert.equal(Number(card["thrust lever"].value), row.lever);
    assert.equal(Number(card.rudder.value), row.steering_deg);
    assert.equal(Number(card.power.value), row.delivered_power_W);
    assert.match(card.speed.words, /^[\d.]+ m\/s \([\d.]+ kn\)$/);
    const [metres, knots] = card.speed.words.match(/[\d.]+/g).map(Number);
    assert.ok(Math.abs(metres - knots * (1852 / 3600)) < 0.006, card.speed.words);
    const table = await page.locator("#ship-card tr[data-cause]").evaluateAll((all) => all.map((tr) =>
      [tr.dataset.cause, [...tr.querySelectorAll("td")].map((td) => (td.dataset.value === undefined ? null
        : Number(td.dataset.value)))]));
    const sums = table.at(-1)[1];
    for (const [k, sum] of sums.entries()) {
      const added = table.slice(0, -1).reduce((all, [, cells]) => all + (cells[k] ?? 0), 0);
      assert.ok(Math.abs(sum - added) <= 1e-9 * Math.abs(sum) + 1e-6);
    }
    assert.equal(Object.fromEntries(table).thrust[0], row.thrust_N);
  }
  await act("selectShip", 2);
  assert.ok(!("rudder" in await facts()), "a ship at constant speed has none");
  await page.keyboard.press("Escape");
  assert.equal((await state()).chosen, -1);
});

test("numbers are in units that people read, with their own digits at hand", async () => {
  const words = await page.evaluate(() => [[4889150, "kg"], [0.5, "m"], [-3.388e-21, "N"], [0, "N"], [289.34, "N"],
    [-71790, "N"], [1e6, "N"], [999960, "N"], [227.976776, "m\u00b2"], [52812.4, "m\u00b2"], [800e3, "Pa"],
    [12.3456, "s"], [0.00004, "m/s"], [3, ""], [12000, "m"], [-1234567, "N\u00b7m"]].map(([value, unit]) =>
    window.polynyaPlayer.valueWords(value, unit).replace(/\u202f/g, "_")));
  assert.deepEqual(words, ["4_889 t", "0.5 m", "0 N", "0 N", "289.3 N", "\u221271.79 kN", "1 MN", "1 MN", "228 m\u00b2",
    "52_812 m\u00b2", "800 kPa", "12.35 s", "0 m/s", "3", "12 km", "\u22121.235 MN\u00b7m"]);
});

test("names lie on no hull and on no other name, at every time and zoom", async () => {
  for (const [time, zoom] of [[0, 1], [3, 1.5], [6, 1], [10, 0.4], [10, 3]]) {
    await act("fit");
    await act("goTo", time);
    await act("zoomCentre", zoom);
    const problems = await page.player(({ view, run: { info }, motions, namesAt }) => {
      const ring = info.ships.map(({ waterline_m: waterline }, k) => {
        const [x, y, angle] = motions.ship(k);
        return waterline.map(([px, py]) => view.toScreen(x + px * Math.cos(angle) - py * Math.sin(angle),
          y + px * Math.sin(angle) + py * Math.cos(angle)));
      });
      const isIn = (points, x, y) => points.reduce((inside, [ax, ay], k) => {
        const [bx, by] = points.at(k - 1);
        return (ay > y) !== (by > y) && x < ax + ((y - ay) / (by - ay)) * (bx - ax) ? !inside : inside;
      }, false);
      const found = [];
      const boxes = namesAt();
      boxes.forEach(({ name, box }, k) => {
        for (let x = box.left; x <= box.right; x += 2)
          for (let y = box.top; y <= box.bottom; y += 2)
            if (ring.some((points) => isIn(points, x, y))) found.push(`${name} covers a hull`);
        for (const { name: other, box: b } of boxes.slice(k + 1))
          if (box.left < b.right && b.left < box.right && box.top < b.bottom && b.top < box.bottom)
            found.push(`${name} covers ${other}`);
      });
      return { found: [...new Set(found)], names: boxes.length };
    });
    assert.deepEqual(problems.found, [], `${time} s, zoom ${zoom}`);
    if (zoom <= 1) assert.equal(problems.names, 3);
  }
  await act("fit");
});

test("the ruler measures by a drag, does not move the map, and goes by Escape", async () => {
  const view = () => page.player(({ view: { x, y, scale } }) => [x, y, scale]);
  const before = await view();
  await page.click("#ruler");
  const box = await page.locator("#stage").boundingBox();
  await page.drag([box.x + 200, box.y + 200], [box.x + 320, box.y + 110]);
  await page.drawn();
  const { ruler } = await state();
  assert.deepEqual(await view(), before);
  const [[ax, ay], [bx, by]] = ruler;
  assert.ok(Math.abs(Math.hypot(bx - ax, by - ay) * before[2] - 150) < 1);
  assert.match(await page.player(({ rulerWords }) => rulerWords([[0, 0], [30, 40]])), /^50 m, 53\.1°$/);
  await page.keyboard.press("Escape");
  assert.equal((await state()).ruler, null);
  assert.equal(await page.locator("#ruler").getAttribute("aria-pressed"), "false");
  await page.drag([box.x + 200, box.y + 200], [box.x + 320, box.y + 110]);
  assert.notDeepEqual(await view(), before, "a drag moves the map again");
  await act("fit");
});

test("plots are added one below the other, share the part of the run, and go into the link", async () => {
  await act("goTo", 5);
  for (let k = 0; k < 3; ++k) await page.click("#add-plot");
  assert.equal(await page.locator(".plot").count(), 4);
  assert.ok(await page.locator("#add-plot").isDisabled());
  await page.locator(".further-plot select").first().selectOption("lever");
  await page.locator(".further-plot button").nth(2).click();
  assert.equal(await page.locator(".plot").count(), 3);
  const shown = await page.player(({ plotPanel }) => plotPanel.further());
  assert.equal(shown[0], "lever");
  await act("zoomPlot", 2, 6);
  const spans = await page.player(({ plotPanel }) => plotPanel.views.map(({ plot }) => plot.span.join()));
  assert.equal(new Set(spans).size, 1);
  const lefts = await page.locator(".plot .u-over").evaluateAll((all) => all.map((e) => {
    const { left, right } = e.getBoundingClientRect();
    return `${Math.round(left)} ${Math.round(right)}`;
  }));
  assert.equal(new Set(lefts).size, 1, `their axes of times lie above each other: ${lefts}`);
  await act("selectShip", 1);
  const link = await page.player(({ address }) => address());
  assert.ok(link.includes("below=lever&below=") && link.includes("ship=south"), link);
  const other = await open(link.replace("file://", ""));
  assert.deepEqual(await other.player(({ plotPanel, state: s }) => [plotPanel.further(), s.ship]), [shown, 1]);
  await other.context().close();
  const map = await page.locator("#stage").boundingBox();
  assert.ok(map.height > 150, `the map is ${map.height} px high beside three plots`);
  await act("showPlots", []);
  await act("zoomPlot");
});

test("sizes below the histogram do not collide at any width", async () => {
  for (const width of [360, 700, 768, 800, 1024, 1440, 1920]) {
    await page.setViewportSize({ width, height: 900 });
    await page.drawn();
    const labels = await page.locator("#sizes span").evaluateAll((all) => all.filter((e) => e.checkVisibility()).map(
      (e) => {
        const { left, right } = e.getBoundingClientRect();
        return { left, right, words: e.textContent };
      }));
    assert.ok(labels.length >= 2, `${width} px`);
    labels.slice(1).forEach(({ left, words }, k) => assert.ok(left >= labels[k].right + 3,
      `${width} px: ${labels[k].words} and ${words}`));
    const end = await page.locator("#sizes").evaluate((e) => e.getBoundingClientRect().right);
    assert.ok(labels.at(-1).right <= end + 1.5);
  }
  await page.setViewportSize({ width: 1440, height: 900 });
});
