// A link to an instant, pictures of map and plot, and the histogram of floe sizes.
"use strict";
const { test, before, assert, fs, folder, open } = require("./bench.js");
const { makeRun, makePage, readNdjson, plateAndFloe, ship } = require("./runs.js");

let page, run, file;
before(async () => {
  run = makeRun(folder, plateAndFloe("moments", { ships: [ship("north", 60), ship("a b", 10)] }));
  file = makePage(run);
  page = await open(`${file}#t=12.5&floe=1&by=size&plot=yaw_Nm&follow=a%20b`);
});

const state = (of = page) =>
  of.player(({ state: { time, selected, colourBy, follow, sizes }, plot: { quantity } }) =>
    ({ time, selected, colourBy, follow, sizes, quantity }));
const act = (...words) => page.act(...words);
const drawn = () => page.drawn();

test("a link opens the page at its instant", async () => {
  assert.deepEqual(await state(), { time: 12.5, selected: 1, colourBy: "size", follow: 1, sizes: null,
    quantity: "yaw_Nm" });
  assert.equal(await page.locator("#now").textContent(), "12.5 s");
});

test("the address follows the page, and a copy of it opens the same", async () => {
  await act("setFollow", -1);
  await act("goTo", 17.25);
  await act("chooseSizes", { from: 2, below: 30 });
  await act("zoom", 300, 300, 1.5);
  await page.waitForFunction(() => location.href === window.polynyaPlayer.address()); // the address follows 0.3 s later
  for (const word of ["t=17.25", "map=", "sizes=2-30"]) assert.ok(page.url().includes(word), page.url());
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.click("#copy-link");
  await page.waitForFunction(() => document.getElementById("toast").textContent === "link copied");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(link, page.url());
  const other = await open(link.replace("file://", ""));
  assert.deepEqual(await state(other), await state());
  const viewOf = (of) => of.player(({ view: { x, y, scale } }) => [x, y, scale]);
  const [mine, its] = [await viewOf(page), await viewOf(other)];
  mine.forEach((value, k) => assert.ok(Math.abs(value - its[k]) < 0.01 * Math.max(1, Math.abs(value))));
  // An address that is entered while the page is open changes its time, too.
  await other.evaluate(() => { location.hash = "#t=3&floe=0"; });
  await other.waitForFunction(() => window.polynyaPlayer.state.time === 3 && window.polynyaPlayer.state.selected === 0);
  await other.context().close();
});

test("while it plays the address stays; when it stops it is that instant's", async () => {
  await act("goTo", 5);
  await page.waitForFunction(() => location.hash.includes("t=5&"));
  await page.selectOption("#rate", "10");
  await page.click("#play");
  await page.waitForFunction(() => window.polynyaPlayer.state.time > 8);
  assert.match(page.url(), /#t=5&/);
  await page.click("#play");
  const { time } = await state();
  await page.waitForFunction((at) => location.hash.startsWith(`#t=${at}&`), Number(time.toFixed(4)));
});

test("what a link has wrong is stated, the rest is done", async () => {
  const other = await open(`${file}#t=now&floe=100000&plot=toString&sizes=5-2&follow=west&by=speed&colour=red`);
  const words = await other.locator("#toast").textContent();
  for (const part of ["t=now", "floe=100000: floes go from 0 to ", "plot=toString", "sizes=5-2",
    "follow=west: no such ship", "colour=red: unknown"])
    assert.ok(words.includes(part), `${part} in ${words}`);
  assert.equal((await state(other)).colourBy, "speed");
  await other.context().close();
});

/** Clicks, and gives the picture that is saved: its name, its width and what it has at points [px from its left and
 * top]. */
async function saved(button, points) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  const bytes = fs.readFileSync(await download.path());
  assert.equal(bytes.subarray(1, 4).toString(), "PNG");
  const read = await page.evaluate(async ([base64, all]) => {
    const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const context = Object.assign(document.createElement("canvas"), { width: picture.width,
      height: picture.height }).getContext("2d");
    context.drawImage(picture, 0, 0);
    return { width: picture.width, height: picture.height, colours: all.map(([x, y]) =>
      [...context.getImageData(x, y, 1, 1).data].join()) };
  }, [bytes.toString("base64"), points]);
  return { name: download.suggestedFilename(), ...read };
}

test("the map and the plot are saved as pictures, under a title, over their keys", async () => {
  await act("fit");
  await act("goTo", 20);
  await drawn();
  const places = await page.player(({ view, places: { x, y, living, count } }) => {
    const context = document.getElementById("ice").getContext("2d");
    return Array.from(living.subarray(0, count), (id) => view.toScreen(x[id], y[id]).map(Math.round))
      .filter(([px, py]) => px > 0 && py > 0 && px < view.width && py < view.height)
      .map(([px, py]) => ({ at: [px, py + 34], ice: [...context.getImageData(px, py, 1, 1).data].join() }));
  });
  const stage = await page.locator("#stage").boundingBox();
  const map = await saved("#save-map", places.map(({ at }) => at));
  assert.equal(map.name, "moments-20.0s-map.png");
  assert.equal(map.width, Math.round(stage.width));
  assert.ok(map.height > stage.height + 34 + 20, "with a title and a legend");
  const same = places.filter(({ ice }, k) => map.colours[k] === ice).length; // marks lie over some
  assert.ok(same > 0.6 * places.length && places.length >= 4, `${same} of ${places.length} floes`);
  const plot = await saved("#save-plot", []);
  const host = await page.locator("#plot").boundingBox();
  assert.equal(plot.name, "moments-20.0s-plot.png");
  assert.ok(plot.height > host.height + 34 + 20 && plot.width === Math.round(host.width));
});

test("the histogram has every floe that floats, by number or by area; a range is counted and the others are pale",
  async () => {
  await act("goToEnd", true);
  await act("chooseSizes", null);
  await act("colourBy", "breakage");
  for (const layer of ["track", "channel", "startIce"]) await act("toggleLayer", layer, false);
  await drawn();
  const births = readNdjson(run, "floes.ndjson");
  const broken = new Set(readNdjson(run, "events.ndjson").filter(({ kind }) =>
    ["bend", "split", "grind"].includes(kind)).map(({ floe }) => floe));
  const living = births.filter(({ floe_id: id }) => !broken.has(id));
  const colours = async () => {
    const floating = await page.player(({ places: { x, y, living: ids, count }, run: { floes } }) =>
      Array.from(ids.subarray(0, count), (id) => ({ at: [x[id], y[id]], size: Math.sqrt(floes.area[id]) })));
    const found = await page.colours("ice", floating.map(({ at }) => at));
    return floating.map(({ size }, k) => [size, found[k]]);
  };
  const before = await colours();
  await page.fill("#size-from", "3");
  await page.fill("#size-below", "25");
  await page.press("#size-below", "Enter");
  await drawn();
  assert.deepEqual((await state()).sizes, { from: 3, below: 25 });
  const chosen = living.filter(({ area_m2: area }) => Math.sqrt(area) >= 3 && Math.sqrt(area) < 25);
  const words = await page.text("#size-words");
  assert.ok(words.startsWith(`${chosen.length} of ${living.length} floes`), words);
  const area = chosen.reduce((sum, floe) => sum + floe.area_m2, 0);
  const all = living.reduce((sum, floe) => sum + floe.area_m2, 0);
  assert.ok(words.includes(`(${((100 * area) / all).toFixed(1)} % of the ice)`), words);
  assert.match(await page.locator("#legend").textContent(), /pale: not from 3 to 25 m/);
  (await colours()).forEach(([size, colour], k) => { // the centre of one above 8 m is its own
    if (size > 8) assert.equal(colour === before[k][1], size >= 3 && size < 25, `a floe of ${size} m`);
  });
  assert.ok(before.some(([size]) => size > 25) && before.some(([size]) => size > 8 && size < 25));
});

test("a drag over the histogram chooses whole classes, a double click all; it counts on while the run plays",
  async () => {
  await act("chooseSizes", null);
  await page.locator("#sizes").scrollIntoViewIfNeeded();
  const box = await page.locator("#sizes").boundingBox();
  await page.drag([box.x + 0.3 * box.width, box.y + 40], [box.x + 0.6 * box.width, box.y + 40]);
  const { sizes } = await state();
  const round = [0.1, 1, 10, 100].flatMap((d) => [1, 1.25, 1.6, 2, 2.5, 3.2, 4, 5, 6.3, 8].map((r) => r * d));
  for (const edge of [sizes.from, sizes.below])
    assert.ok(round.some((value) => Math.abs(edge - value) < 1e-9 * value), `${edge}`);
  assert.ok(sizes.below > 1.5 * sizes.from);
  assert.equal(await page.inputValue("#size-from"), String(sizes.from));
  await act("goTo", 0);
  await drawn();
  assert.match(await page.text("#size-words"), /of 2 floes/);
  await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 40);
  assert.equal((await state()).sizes, null);
  await drawn();
  assert.ok(await page.locator("#size-all").isDisabled());
  await page.fill("#size-from", "9");
  await page.press("#size-from", "Enter");
  assert.equal((await state()).sizes.below, Infinity);
  await page.fill("#size-below", "4"); // no range: nothing changes
  await page.press("#size-below", "Enter");
  assert.equal(await page.inputValue("#size-below"), "");
  await page.click("#size-all");
});
