// tools/measure_player.js measures the player. Nothing here asserts how fast that is.
"use strict";
const { test, assert, folder } = require("./bench.js");
const { execFileSync } = require("node:child_process");
const path = require("node:path");
const { makeRun, makePage, smallScene, ship } = require("./runs.js");

test("tools/measure_player.js measures a run with a ship", () => {
  const page = makePage(makeRun(folder, smallScene("measured", { ships: [ship("one", 10)] })));
  const said = execFileSync(process.execPath, [path.resolve(__dirname, "../../tools/measure_player.js"), page, "1"],
    { encoding: "utf8" });
  assert.match(said, /opened and drawn after \d+ ms; 9 floes/);
  for (const what of ["whole run, playing", "following the ship"])
    assert.match(said, new RegExp(`${what}: [1-9]\\d* frames/s, .*; processor \\d+\\.\\d ms a frame`));
});
