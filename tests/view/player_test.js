// The player in a real browser. Started by tests/view/run; POLYNYA_BINARY names the program under test.
"use strict";
const { test, before, assert, fs, path, folder, open } = require("./bench.js");
const { shippedRun, makePage, readLines, readNdjson, inspectAt, polynya } = require("./runs.js");

let run, file, page;

before(async () => {
  run = shippedRun(folder, "sawamura2017-fig4b");
  file = makePage(run);
  page = await open(file);
});

const text = (id) => page.text(`#${id}`);
const timeShown = async () => parseFloat(await text("now"));
const time = () => page.player(({ state }) => state.time);
const act = (...words) => page.act(...words);
const drawn = () => page.drawn();
const picture = () => page.locator("#stage").screenshot();
const stageBox = () => page.locator("#stage").boundingBox();

test("the paper's run opens from disk, small, alone and without errors", async (t) => {
  const megabytes = fs.statSync(file).size / 1e6;
  t.diagnostic(`${megabytes.toFixed(2)} MB, opened and drawn after ${page.openedAfter} ms`);
  assert.ok(megabytes < 10);
  assert.equal(await page.title(), "sawamura2017-fig4b – Polynya");
  assert.deepEqual(page.requests.filter((url) => url !== `file://${file}` && url !== "data:,"), []);
});

test("it plays and pauses", async () => {
  const before = await picture();
  await page.click("#play");
  await page.waitForFunction(() => window.polynyaPlayer.state.time > 20);
  await page.click("#play");
  const stopped = await time();
  assert.notDeepEqual(await picture(), before);
  await page.waitForTimeout(100);
  assert.equal(await time(), stopped);
  await page.keyboard.press("Space");
  await page.waitForFunction((at) => window.polynyaPlayer.state.time > at, stopped);
  await page.keyboard.press("Space");
  assert.equal(await page.locator("#play").getAttribute("aria-label"), "Play");
});

test("it scrubs: on the timeline, on the plot, by keys", async () => {
  for (const id of ["track", "plot .u-over"]) {
    const box = await page.locator(`#${id}`).boundingBox();
    const y = box.y + box.height - 3;
    for (const part of [0.25, 0.8]) {
      await page.drag([box.x + 0.5 * box.width, y], [box.x + part * box.width, y]);
      await drawn();
      assert.ok(Math.abs((await timeShown()) - part * 550) < 550 / box.width, `${id}: ${await timeShown()} s`);
    }
  }
  await act("goTo", 100.5);
  for (const [keys, shown] of [[["ArrowRight"], 102], [["ArrowLeft", "ArrowLeft"], 98], [["End"], 550]]) {
    for (const key of keys) await page.keyboard.press(key);
    await drawn();
    assert.equal(await timeShown(), shown);
  }
  assert.equal(await page.locator("#track").getAttribute("aria-valuenow"), "550.0");
});

test("a click on an event's mark goes there", async () => {
  const events = readNdjson(run, "events.ndjson");
  for (const split of events.filter((event) => event.kind === "split")) {
    const box = await page.locator("#track").boundingBox();
    await page.mouse.click(box.x + (split.t_s / 550) * box.width, box.y + 6);
    await drawn();
    assert.equal(await time(), split.t_s);
    const card = await text("event-card");
    assert.ok(card.includes(`floe${split.floe}`) && card.includes(split.children.join(", ")), card);
  }
  await act("goToEnd", false);
  for (const event of events.slice(0, 3)) {
    await page.keyboard.press("]");
    assert.equal(await time(), event.t_s);
  }
});

/** Points at each of these floes' centroids, for a frame: facts of the card, by the floes that were found there. */
const factsOf = (floes) => page.player(async ({ view, places, state, actions }, ids) => {
  const facts = [];
  for (const id of ids) {
    actions.hover(...view.toScreen(places.x[id], places.y[id]));
    await new Promise(requestAnimationFrame);
    if (state.hovered === id) facts.push([id, Object.fromEntries(Array.from(document.querySelectorAll("#floe-card dd"),
      (dd) => [dd.dataset.fact, { words: dd.textContent, value: dd.dataset.value }]))]);
  }
  return facts;
}, floes);

/** Whether words begin with a number to four digits, with spaces between thousands. */
function isAbout(words, value) {
  const shown = Number(words.replaceAll("\u202f", "").replace("\u2212", "-").split(" ")[0]);
  return Math.abs(shown - value) <= 5.1e-4 * Math.abs(value) + 1e-4;
}

test("the floe under the pointer has the numbers that `polynya inspect` prints and the files hold", async (t) => {
  const births = readNdjson(run, "floes.ndjson");
  let picked = 0;
  for (const time of [0, 231, 301.37, 550]) {
    await act("fit");
    await act("goTo", time);
    const table = inspectAt(run, time);
    assert.equal(Number(await text("living")), table.size);
    for (const [id, facts] of await factsOf([...table.keys()].filter((_, k) => k % 7 === 0 || k > table.size - 8))) {
      const row = table.get(id);
      assert.equal(facts.floe.words, String(id));
      assert.equal(facts.parent.words, row.parent === "-" ? "none, of the scene" : row.parent);
      assert.ok(isAbout(facts.area.words, Number(row.area)), facts.area.words);
      assert.equal(Number(facts.area.value), births[id].area_m2);
      assert.equal(Number(facts.mass.value), births[id].mass_kg);
      const perUnit = facts.mass.words.endsWith(" t") ? 1e-3 : 1;
      assert.ok(isAbout(facts.mass.words, Number(row.mass) * perUnit), facts.mass.words);
      assert.equal(parseFloat(facts.thickness.words), Number(row.thickness));
      assert.equal(Number(facts.thickness.value), 0.5);
      if (row.speed === "-") assert.equal(facts.speed.words, "– (lived between two frames)");
      else assert.ok(isAbout(facts.speed.words, Number(row.speed)) && facts.speed.words.endsWith(" m/s"));
      ++picked;
    }
  }
  t.diagnostic(`${picked} floes picked`);
  assert.ok(picked > 60);
});

test("a floe's lineage is that of the files", async () => {
  await act("goToEnd", true);
  const births = readNdjson(run, "floes.ndjson");
  const last = births.at(-1).floe_id;
  const parents = [];
  for (let at = last; at !== null; at = births[at].parent_id) parents.unshift(at);
  const box = await stageBox();
  const [x, y] = await page.player(({ view, places }, id) => view.toScreen(places.x[id], places.y[id]), last);
  await page.mouse.move(box.x + x, box.y + y);
  assert.equal(await page.player(({ state }) => state.hovered), last);
  await page.mouse.click(box.x + x, box.y + y);
  const shown = await page.locator(".lineage li > button:first-child").evaluateAll((all) =>
    all.map((b) => b.textContent));
  assert.deepEqual(shown.filter((words) => words.startsWith("floe")), [parents[0], ...parents.slice(-7)].map((id) =>
    `floe ${id}`));
  const events = readNdjson(run, "events.ndjson");
  await page.locator(".lineage li > button:nth-child(2)").first().click();
  assert.equal(await time(), events.find((e) => e.floe === parents[0]).t_s);
  await page.keyboard.press("Escape");
});

test("a floe that was chosen is followed through its fractures, to its largest piece", async () => {
  const births = readNdjson(run, "floes.ndjson");
  const plate = readNdjson(run, "events.ndjson")[0].floe;
  const comesFrom = (id) => id === plate || (births[id].parent_id !== null && comesFrom(births[id].parent_id));
  await act("goTo", 0);
  await act("select", plate);
  assert.equal(await page.text("[data-fact=floe]"), String(plate));
  for (const at of [200, 550]) {
    await act("goTo", at);
    const pieces = [...inspectAt(run, at).keys()].filter(comesFrom);
    const largest = pieces.reduce((best, id) => (births[id].area_m2 > births[best].area_m2 ? id : best));
    assert.equal(await page.text("[data-fact=floe]"), String(largest));
  }
  await page.keyboard.press("Escape");
});

test("floes are drawn where final.geojson has them", async () => {
  await act("goToEnd", true);
  const { features } = JSON.parse(fs.readFileSync(path.join(run, "final.geojson"), "utf8"));
  const placed = await page.player(({ places, run: { floes } }) => {
    const rings = {};
    for (const id of places.living.subarray(0, places.count)) {
      const points = floes.shape(id);
      rings[id] = [];
      for (let k = 0; k < floes.ringEnds[floes.ringsOf[id]]; ++k) {
        const [px, py] = [points[2 * k] - floes.cx[id], points[2 * k + 1] - floes.cy[id]];
        rings[id].push([places.x[id] + places.cos[id] * px - places.sin[id] * py,
          places.y[id] + places.sin[id] * px + places.cos[id] * py]);
      }
    }
    return rings;
  });
  assert.equal(Object.keys(placed).length, features.length);
  for (const { properties, geometry } of features) {
    const ring = geometry.coordinates[0].slice(0, -1);
    const mine = placed[properties.floe_id];
    assert.equal(mine.length, ring.length);
    // Frames are right to 1 mm and 1e-5 rad.
    ring.forEach(([x, y], k) => assert.ok(Math.hypot(x - mine[k][0], y - mine[k][1]) < 1.5e-3 + 1e-5 * 150,
      `floe ${properties.floe_id}`));
  }
});

test("the loads shown are the row of forces.csv", async () => {
  const [header, ...lines] = readLines(run, "forces.csv");
  const names = header.split(",");
  const columns = { surge_N: ["surge_N", "surge_max_N", "surge_j_over_tau_c_N"],
    yaw_Nm: ["yaw_Nm", "yaw_max_Nm", "yaw_j_over_tau_c_Nm"], speed_m_per_s: ["speed_m_per_s"] };
  for (const [quantity, wanted] of Object.entries(columns)) {
    await page.selectOption("#quantity", quantity);
    for (const row of [0, 1845, 3917, lines.length - 1]) {
      const fields = lines[row].split(",");
      await act("goTo", Number(fields[0]) - 0.01);
      const shown = await page.locator("#load-now output").evaluateAll((all) =>
        all.map((output) => ({ ...output.dataset })));
      assert.deepEqual(shown.map(({ column }) => column), wanted);
      for (const { column, time, value } of shown) {
        assert.equal(Number(time), Number(fields[0]));
        assert.equal(Number(value), Number(fields[names.indexOf(column)]));
      }
    }
  }
  await page.selectOption("#quantity", "surge_N");
});

test("the contact forces shown are those of contacts.csv, at the hull, and go with the ship", async (t) => {
  const [header, ...lines] = readLines(run, "contacts.csv");
  const names = header.split(",");
  const rows = lines.map((line) => Object.fromEntries(line.split(",").map((field, k) => [names[k], field])))
    .filter((row) => row.ended_by === "");
  await act("setFollow", 0);
  await act("toggleLayer", "track", false);
  await act("toggleLayer", "forces", true);
  let shown = 0;
  for (const time of [20, ...new Set(rows.map((row) => Number(row.t_s)).filter((_, k) => k % 40 === 0)), 550]) {
    const wanted = rows.filter((row) => Number(row.t_s) === time);
    await act("goTo", time);
    const arrows = await page.evaluate(() => {
      const canvas = document.getElementById("marks");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const is = (k, [r, g, b]) => data[k] === r && data[k + 1] === g && data[k + 2] === b && data[k + 3] === 255;
      let pixels = 0;
      for (let k = 0; k < data.length; k += 4) if (is(k, [0xd5, 0x5e, 0]) || is(k, [0, 0x72, 0xb2])) ++pixels;
      return pixels;
    });
    if (wanted.some((row) => Math.hypot(row.fx_N, row.fy_N) > 1e5)) assert.ok(arrows > 20,
      `${time} s: ${arrows} pixels`);
    if (wanted.length === 0) assert.equal(arrows, 0, `${time} s`);
    const held = await page.player((player) => player.contacts());
    assert.deepEqual(held.map(({ x, y, fx, fy, byFloe, isCrushing }) => [x, y, fx, fy, byFloe, isCrushing]),
      wanted.map((row) => [row.x_m, row.y_m, row.fx_N, row.fy_N, row.by_floe_id, row.is_crushing].map(Number)));
    shown += wanted.length;
  }
  t.diagnostic(`${shown} contacts`);
  assert.ok(shown > 5);
  assert.match(await text("legend"), /[kM]N.*crushing/);
  await act("toggleLayer", "forces", false);
  await act("toggleLayer", "track", true);
  await act("setFollow", -1);
  await act("fit");
});

test("the present time of plot and timeline is at one place with the time", async () => {
  for (const [time, quantity] of [[0, "surge_N"], [137, "surge_N"], [550, "surge_N"], [550, "contacts"],
    [550, "surge_N"]]) {
    await act("goTo", time);
    await act("plotQuantity", quantity); // its axes may leave the plot another width
    const [line, thumb, over] = await Promise.all([".now-line", ".thumb", "#plot .u-over"].map((css) =>
      page.locator(css).boundingBox()));
    assert.ok(Math.abs(line.x + line.width / 2 - (over.x + (time / 550) * over.width)) < 1.5);
    assert.ok(Math.abs(thumb.x + thumb.width / 2 - (line.x + line.width / 2)) < 1.5);
  }
});

test("layers, colours, themes and the ship's company change the picture", async () => {
  await act("goTo", 300);
  await act("setFollow", 0);
  const seen = new Set([(await picture()).toString("base64")]);
  for (const key of ["2", "3", "4", "v", "h", "p", "b", "t", "+"]) {
    await page.keyboard.press(key);
    await drawn();
    const now = (await picture()).toString("base64");
    assert.ok(!seen.has(now), `key ${key} changed nothing`);
    seen.add(now);
  }
  for (const key of ["1", "v", "h", "p", "b", "t", "0"]) await page.keyboard.press(key);
  await page.keyboard.press("?");
  assert.ok(await page.locator("#help").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(!(await page.locator("#help").isVisible()));
});

test("following keeps the ship in the middle", async () => {
  await page.click("#follow");
  for (const time of [50, 400]) {
    await act("goTo", time);
    const off = await page.player(({ view, motions }) => {
      const [x, y] = view.toScreen(...motions.ship(0).subarray(0, 2));
      return Math.hypot(x - view.width / 2, y - view.height / 2);
    });
    assert.ok(off < 1e-6);
  }
  await page.click("#fit");
});

test("wheel and drag keep what is under the pointer under it", async () => {
  const box = await stageBox();
  const [left, top] = [Math.round(box.x + 300), Math.round(box.y + 200)]; // pointers are at whole pixels
  const under = (dx, dy) => page.player(({ view }, ...at) => view.toWorld(...at), left + dx - box.x, top + dy - box.y);
  const first = await under(0, 0);
  const scale = await page.player(({ view }) => view.scale);
  await page.mouse.move(left, top);
  await page.mouse.wheel(0, -600);
  await page.waitForFunction((before) => window.polynyaPlayer.view.scale > 2 * before, scale);
  const zoomed = await under(0, 0);
  assert.ok(Math.hypot(zoomed[0] - first[0], zoomed[1] - first[1]) < 1e-6);
  await page.drag([left, top], [left + 80, top + 60]);
  const moved = await under(80, 60);
  assert.ok(Math.hypot(moved[0] - first[0], moved[1] - first[1]) < 1e-6);
  await page.click("#fit");
});

test("an unknown run is refused", () => {
  assert.throws(() => polynya("view", path.join(folder, "none")), { status: 5 });
});
