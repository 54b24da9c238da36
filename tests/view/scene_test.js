// The page of a scene that has not run: the contents that it shows, selects and renews.
"use strict";
const { spawn } = require("node:child_process");
const os = require("node:os");
const { test, assert, fs, path, folder, open } = require("./bench.js");
const { polynya, ship, smallScene } = require("./runs.js");

const routed = { name: "pathfinder", ship: "reference", position_m: [-80, 10],
  pilot: { route: { waypoints: [{ position_m: [300, 40], speed_m_per_s: 3 }] } } };
const scene = smallScene("planned", {
  wind: { velocity_m_per_s: [10, 0] },
  water: { drift_m_per_s: [0.1, 0], shear: { rate_per_s: 1e-3 } },
  structures: [{ name: "pier", radius_m: 6, position_m: [120, 60] }],
});

const write = (name, fields = {}) => {
  const file = path.join(folder, name);
  fs.writeFileSync(file, JSON.stringify({ ...scene, ...fields }));
  return file;
};

/** How many pixels of the marks are nearly of a colour of the theme. */
const pixelsOf = (page, name) => page.player(({ colours }, colour) => {
  const canvas = document.getElementById("marks");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const wanted = [1, 3, 5].map((k) => parseInt(colours[colour].slice(k, k + 2), 16));
  let count = 0;
  for (let i = 0; i < data.length; i += 4)
    if (data[i + 3] > 200 && wanted.every((value, k) => Math.abs(value - data[i + k]) < 12)) ++count;
  return count;
}, name);

test("a scene is shown with its route, wind, current and names, and without what needs time", async () => {
  const file = write("routed.json", { ships: [routed] });
  assert.match(polynya("view", file), /routed\.html {2}9 floes, 2 hulls/);
  const page = await open(file.replace(".json", ".html"));
  assert.equal(await page.locator("footer").isVisible(), false);
  assert.match(await page.text("#badge"), /not run; until 10 s/);
  const { floes, routes, wind, right } = await page.player(({ run, plan, box }) =>
    ({ floes: run.floes.count, routes: plan.routes, wind: plan.wind_m_per_s, right: box.right }));
  assert.equal(floes, 9);
  assert.deepEqual(routes, [{ points_m: [[-80, 10], [300, 40]], speeds_m_per_s: [3] }]);
  assert.deepEqual(wind, [10, 0]);
  assert.ok(right >= 300, "the whole route is on the map");
  assert.ok((await pixelsOf(page, "highlight")) > 200, "the route");
  assert.ok((await pixelsOf(page, "accent")) > 200, "arrows of the current");
  assert.deepEqual(fs.readdirSync(os.tmpdir()).filter((name) => name.startsWith("polynya-scene-")), []);
  assert.equal(page.requests.length, 1);
});

test("a click gives coordinates to copy", async () => {
  const file = write("picked.json", { ships: [ship("icebreaker", 30)] });
  polynya("view", file, "--out", path.join(folder, "picked.html"));
  const page = await open(path.join(folder, "picked.html"), { permissions: ["clipboard-read", "clipboard-write"] });
  const at = await page.player(({ view }) => view.toScreen(70, 20));
  const stage = await page.locator("#stage").boundingBox();
  await page.mouse.click(stage.x + at[0], stage.y + at[1]);
  const [x, y] = await page.player(({ state }) => state.place);
  assert.ok(Math.hypot(x - 70, y - 20) < 1);
  await page.locator("#toast").waitFor();  // the clipboard answers later
  assert.match(await page.locator("#toast").textContent(), new RegExp(`\\[${x}, ${y}\\] m`));
  assert.deepEqual(JSON.parse(await page.evaluate(() => navigator.clipboard.readText())), [x, y]);
});

test("what validate warns of is listed, and marked where it has a place", async () => {
  const far = { ...ship("far", 5000), position_m: [-20, 90000] };
  const file = write("warned.json", { ships: [ship("icebreaker", 30), far], ice: { thickness_m: 19 } });
  polynya("view", file);
  const page = await open(file.replace(".json", ".html"));
  const problems = await page.player(({ plan }) => plan.problems);
  const warned = JSON.parse(polynya("validate", "--json", file));
  assert.ok(warned.length > 0, "the scene is unusual");
  assert.equal(problems.length, warned.length);
  assert.equal(await page.locator("#problems li").count(), problems.length);
  const ofShips = problems.filter(({ path: key }) => key.startsWith("ships["));
  for (const problem of ofShips) assert.equal(problem.point_m.length, 2);
});

test("a watched scene is shown again when its file is saved", async () => {
  const file = write("watched.json", { ships: [ship("icebreaker", 30)] });
  const watching = spawn(process.env.POLYNYA_BINARY, ["view", file, "--watch"], { stdio: ["ignore", "pipe", "pipe"] });
  const ended = new Promise((resolve) => { watching.on("exit", resolve); });
  await new Promise((resolve) => { watching.stdout.once("data", resolve); });
  const page = await open(file.replace(".json", ".html"));
  assert.equal(await page.player(({ run }) => run.floes.count), 9);
  write("watched.json", { floes: "wrong" });
  write("watched.json", { ships: [ship("icebreaker", 30)], floes: [{ rectangle: { corner_m: [20, 0], size_m: 30 } }] });
  await page.waitForFunction(() => window.polynyaPlayer?.run.floes.count === 1, null, { timeout: 20000 });
  watching.kill("SIGTERM");
  assert.equal(await ended, 0);
  assert.equal(fs.existsSync(file.replace(".json", ".html.js")), false);
});
