// Runs of every kind, and a phone: the page opens without errors and shows all data of the run.
"use strict";
const { test, assert, fs, path, folder, open } = require("./bench.js");
const { makeRun, shippedRun, makePage, readNdjson, polynya, smallScene, ship } = require("./runs.js");

async function withPage(file, options, use) {
  const page = await open(file, options);
  await use(page);
  await page.context().close();
}
const runOf = (name, fields) => makeRun(folder, smallScene(name, fields));
const living = (page) => page.text("#living").then(Number);

test("no ships, nothing breaks: floes drift", async () => {
  await withPage(makePage(runOf("adrift", {})), {}, async (page) => {
    assert.equal(await living(page), 9);
    assert.ok(!(await page.locator("#plot").isVisible()));
    assert.ok(await page.locator("#follow").isDisabled());
    assert.match(await page.text("#event-card"), /Nothing broke/);
    await page.click("#play");
    await page.waitForFunction(() => window.polynyaPlayer.state.time > 0.2);
  });
});

test("several ships: a curve and a number each, followed in turn; a description that is markup is words", async () => {
  const description = '</script><!-- <b>"&amp;\\u2028 {{columns}}';
  const run = runOf("two-ships", { description, ships: [ship("north", 60), ship("south", 10)] });
  await withPage(makePage(run), {}, async (page) => {
    assert.equal(await page.locator("#load-now [data-column=surge_N]").count(), 2);
    for (const wanted of [0, 1, -1]) {
      await page.keyboard.press("f");
      assert.equal(await page.player(({ state }) => state.follow), wanted);
    }
    assert.equal(await page.title(), "two-ships – Polynya");
    assert.equal(await page.text("#description"), description);
  });
});

test("a run that was killed shows how far it came; one without frames shows its scene", async () => {
  const run = runOf("killed", { ships: [ship("a", 0)] });
  const summary = path.join(run, "summary.json");
  fs.writeFileSync(summary, fs.readFileSync(summary, "utf8").replace('"finished": true', '"finished": false'));
  const frames = path.join(run, "frames.bin");
  fs.truncateSync(frames, fs.statSync(frames).size - 10);
  await withPage(makePage(run), {}, async (page) => {
    assert.match(await page.text("#badge"), /^unfinished: 8\.0 of 10 s/);
    assert.equal(await living(page), 9);
  });
  fs.truncateSync(frames, 16);
  await withPage(makePage(run), {}, async (page) => {
    assert.match(await page.text("#notice"), /no frames/);
    assert.equal(await living(page), 9);
    assert.ok(await page.locator("#play").isDisabled());
  });
});

/** The rows of a CSV file's text as objects. */
const rowsOf = (text) => {
  const [header, ...lines] = text.trim().split("\n").map((line) => line.split(","));
  return lines.map((fields) => Object.fromEntries(header.map((name, k) => [name, fields[k]])));
};

test("the channel is that of `polynya channel`, carried with drifting and shearing water", async (t) => {
  const water = { drift_m_per_s: [0.05, 0.1], shear: { rate_per_s: 1e-4, direction_deg: 20, origin_m: [0, 40] } };
  const floes = [{ field: { corner_m: [0, -60], extent_m: [260, 120], floe_size_m: 9, concentration: 0.6 } }];
  const run = runOf("channelled", { water, floes, time: { step_s: 0.02, until_s: 120 }, ships: [ship("a", 0)],
    fracture: { cusp_fate: "float" } });
  let bounded = 0;
  await withPage(makePage(run), {}, async (page) => {
    const instants = await page.player(({ run: { columns } }) => [...columns.channel_measured_s]);
    assert.equal(instants.at(-1), 120);
    for (const time of [instants[Math.floor(instants.length / 4)], instants[Math.floor(instants.length / 2)], 120]) {
      const wanted = rowsOf(polynya("channel", run, "--at", String(time), "--out", folder, "--format", "csv"))
        .filter((row) => row.is_channel === "1");
      await page.act("goTo", time);
      const measured = await page.player((player) => player.stations(0));
      assert.equal(measured.length, wanted.length);
      bounded += wanted.length;
      wanted.forEach((row, k) => {
        assert.ok(Math.abs(Number(row.along_m) - measured[k].along) < 1e-3);
        for (const side of ["port", "starboard"])
          assert.ok(Math.abs(Number(row[`${side}_m`]) - measured[k][side]) < 1e-3);
      });
      const { features } = JSON.parse(fs.readFileSync(path.join(folder, "channel.geojson"), "utf8"));
      const ring = features.find((f) => f.properties.part === "swept band").geometry.coordinates[0][0];
      const middle = [0, 1].map((axis) => ring.reduce((sum, point) => sum + point[axis] / ring.length, 0));
      const [band, water] = await page.colours("ice", [middle, [-100, 0]]);
      assert.notEqual(band, water, "the band's middle is not plain water");
    }
    assert.match(await page.text("#channel-width"), /m wide, .* beams/);
  });
  t.diagnostic(`${bounded} stations that are a channel`);
  assert.ok(bounded > 10);
});

test("a moored ship in drifting ice has no channel, and its layer is off where no other ship sails", async () => {
  const moored = { ...ship("held", 0), propulsion: { thrust_N: 0 }, mooring: { surge_stiffness_N_per_m: 1e6,
    sway_stiffness_N_per_m: 1e6, yaw_stiffness_Nm_per_rad: 1e9 } };
  const scene = { water: { drift_m_per_s: [-0.8, 0] }, ships: [moored], time: { step_s: 0.02, until_s: 90 },
    floes: [{ field: { corner_m: [5, -30], extent_m: [120, 60], floe_size_m: 9, concentration: 0.7 } }] };
  await withPage(makePage(runOf("moored-in-drift", scene)), {}, async (page) => {
    assert.deepEqual(await page.player(({ state: { layers }, run: { columns } }) =>
      [layers.channel, columns.channel_ship.length]), [false, 0]);
  });
});

test("without a floe the ship sails, and there is no channel ahead of it", async () => {
  await withPage(makePage(runOf("ahead", { floes: [], ships: [ship("a", 0)] })), {}, async (page) => {
    assert.equal(await living(page), 0);
    const colourAt = async (time, x) => {
      await page.act("goTo", time);
      return (await page.colours("ice", [[x, 0]]))[0];
    };
    // The stem is 20 m before the centre, which goes from -20 m to 0 in 10 s.
    assert.equal(await colourAt(0, 10), await colourAt(5, 15), "still ahead of it both times");
    assert.notEqual(await colourAt(5, 15), await colourAt(10, -10), "behind it");
  });
});

test("ice under the hull is drawn through it, counted, and known by a click; what came up is ice again", async () => {
  const icebreaker = { ...ship("icebreaker", 0), hull: { ...ship("", 0).hull, draught_m: 2 } };
  const plate = { rectangle: { corner_m: [0, -40], size_m: [200, 80] } };
  const run = runOf("under-hull", { floes: [plate], ships: [icebreaker], time: { until_s: 60 } });
  const events = readNdjson(run, "events.ndjson");
  const floes = readNdjson(run, "floes.ndjson");
  const [went, up] = ["submerge", "resurface"].map((kind) =>
    new Map(events.filter((e) => e.kind === kind).map((e) => [e.floe, e])));
  const ends = ({ kind }) => !["submerge", "rejected_cut", "ship_contact"].includes(kind);
  const ended = new Map(events.filter(ends).map((e) => [e.floe, e.t_s]));
  assert.ok(went.size > 20 && up.size > 10);
  const stays = (floe, time) => !(ended.get(floe) <= time);
  await withPage(makePage(run, "--every", "2"), {}, async (page) => {
    for (const time of [10, 30, 60]) {
      await page.act("goTo", time);
      const under = [...went.values()].filter(({ t_s: at, floe }) => at <= time && stays(floe, time));
      const ids = under.map(({ floe }) => floe).sort((a, b) => a - b);
      assert.deepEqual(await page.player(({ places }) => [...places.under].sort((a, b) => a - b)), ids);
      assert.equal(await page.text("#under-now"), String(under.length));
      const cameUp = [...up.values()].filter(({ t_s: at }) => at <= time);
      assert.equal(await page.text("#came-up-now"), String(cameUp.length));
      const there = floes.filter(({ born_s: born, floe_id: floe }) => born <= time && stays(floe, time));
      assert.equal(await living(page), there.length - under.length, "what floats");
    }
    const time = 20;
    await page.act("goTo", time);
    await page.act("setFollow", 0);
    // A piece that surfaces, and that is visible on top at its centre.
    const came = [...up.values()].filter(({ floe, children, t_s: at }) => children.length > 0
      && went.get(floe).t_s < time && time < at);
    const onTop = await page.player(({ view, places, state, actions }, candidates) => candidates.find((floe) => {
      actions.hover(...view.toScreen(places.x[floe], places.y[floe]));
      return state.hovered === floe;
    }), came.map(({ floe }) => floe));
    const clicked = up.get(onTop);
    const placeOf = (floe) => page.player(({ places }, id) => [places.x[id], places.y[id]], floe);
    const colourAt = async (floe) => (await page.colours("marks", [await placeOf(floe)]))[0];
    const drawn = await colourAt(clicked.floe);
    const box = await page.locator("#stage").boundingBox();
    const [x, y] = await page.player(({ view }, ...at) => view.toScreen(...at), ...(await placeOf(clicked.floe)));
    await page.mouse.click(box.x + x, box.y + y);
    await page.waitForFunction((floe) => window.polynyaPlayer.state.selected === floe, clicked.floe);
    await page.waitForFunction(() => !document.querySelector("#floe-card").textContent.startsWith("Point at"));
    const card = await page.text("#floe-card");
    assert.match(card, /under the hullsince [\d.]+ s/);
    assert.ok(card.includes(`as floe ${clicked.children[0]}`), card);
    assert.match(await page.text("#legend"), /ice under the hull.*/);
    await page.act("goTo", clicked.t_s + 1e-6);
    assert.equal(await page.player(({ colourings }, id) => colourings.breakage.value(id), clicked.children[0]), 4);
    assert.notEqual(await colourAt(clicked.floe), drawn);
    assert.equal(await page.locator('#quantity option:text-is("Ice under the hull")').count(), 1);
  });
});

test("a mooring that breaks has a mark on the timeline, and a card with its force", async () => {
  const moored = { ...ship("tanker", 0), propulsion: { thrust_N: 2e5 },
    mooring: { surge_stiffness_N_per_m: 1e5, break_load_N: 1.2e5 } };
  const run = runOf("moored", { ships: [moored], floes: [], time: { step_s: 0.05, until_s: 20 } });
  const [broken, ...others] = readNdjson(run, "events.ndjson");
  assert.equal(broken.kind, "mooring_break");
  assert.deepEqual(others, []);
  await withPage(makePage(run), {}, async (page) => {
    const box = await page.locator("#track").boundingBox();
    const mark = [box.x + (broken.t_s / 20) * box.width, box.y + 7];
    await page.mouse.move(...mark);
    assert.match(await page.text("#timeline-tip"), /mooring break of tanker/);
    await page.mouse.click(...mark);
    assert.equal(await page.player(({ state }) => state.time), broken.t_s);
    const card = await page.text("#event-card");
    for (const words of ["mooring break", "tanker", `${Number((broken.force_N / 1000).toPrecision(4))} kN`, "120 kN",
      `(${broken.offset_m[0].toFixed(1)}, `])
      assert.ok(card.includes(words), `${words} in ${card}`);
    assert.match(await page.text("#facts"), /moorings broken1/);
    await page.keyboard.press("[");
    await page.keyboard.press("b"); // its mark on the map
  });
});

test("thinned, it still plays from end to end", async () => {
  const run = shippedRun(folder, "level-plate", "--until", "60");
  const file = makePage(run, "--every", "5", "--from", "11", "--until", "51");
  await withPage(file, {}, async (page) => {
    assert.deepEqual(await page.player(({ run: { frames } }) => Array.from(frames.times)), [12, 22, 32, 42, 50]);
    await page.keyboard.press("End");
    await page.waitForFunction(() => window.polynyaPlayer.state.time === 50);
  });
});

test("on a phone: nothing is cut off, a tap picks, two fingers zoom", async () => {
  const file = makePage(runOf("phone", { ships: [ship("a", 0)] }));
  const phone = { viewport: { width: 360, height: 740 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
  await withPage(file, phone, async (page) => {
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
    const at = await page.player(({ view, places }) => {
      const box = document.getElementById("stage").getBoundingClientRect();
      const [x, y] = view.toScreen(places.x[4], places.y[4]);
      return [box.left + x, box.top + y];
    });
    await page.touchscreen.tap(...at);
    await page.waitForFunction(() => window.polynyaPlayer.state.selected === 4);
    assert.match(await page.text("#chip"), /^floe 4/);
    const session = await page.context().newCDPSession(page);
    const touch = (type, spread) => session.send("Input.dispatchTouchEvent", { type, touchPoints: spread === null ? []
      : [-1, 1].map((side, id) => ({ x: 180 + side * spread, y: 250, id })) });
    const scale = () => page.player(({ view }) => view.scale);
    const first = await scale();
    await touch("touchStart", 40);
    for (const spread of [50, 60, 70, 80]) await touch("touchMove", spread);
    await touch("touchEnd", null);
    await page.drawn();
    assert.ok(Math.abs((await scale()) / first - 2) < 0.05, `zoomed by ${(await scale()) / first}`);
  });
});
