"use strict";
// Every scene of the goldens in WebAssembly, under node: the state's hash is the native program's, which tests/golden
// compares with the same file. MODULE names the module.
const { test } = require("node:test");
const assert = require("node:assert");
const fs = require("node:fs");
const path = require("node:path");
const { makeSimulator, compile, source } = require("./module.js");

const compiled = compile(process.env.MODULE);
const goldens = fs.readFileSync(path.join(source, "tests/golden/goldens.txt"), "utf8").trim().split("\n")
  .map((line) => line.split(" "));

/** Runs a scene, also beyond its end as the golden test does, and gives the hash. */
async function hashOf(scene, until) {
  const simulator = await makeSimulator(await compiled);
  simulator.load(fs.readFileSync(path.join(source, `scenes/${scene}.json`), "utf8"));
  simulator.start();
  simulator.advanceBeyond(Number(until));
  return { hash: simulator.stateHash(), fractures: simulator.snapshot().words };
}

for (const [scene, until, hash, fractures] of goldens) {
  test(`${scene} gives the native program's state after ${until} s`, async () => {
    const found = await hashOf(scene, until);
    assert.equal(found.hash, hash);
    assert.equal(found.fractures.bends + found.fractures.splits, Number(fractures));
  });
}

test("a scene that is no JSON is refused with the reader's messages and places", async () => {
  const simulator = await makeSimulator(await compiled);
  assert.throws(() => simulator.load("{\"time\": {\"until_s\": }}"), ({ message }) => {
    const [problem] = JSON.parse(message);
    assert.equal(problem.line, 1);
    assert.equal(problem.severity, "error");
    return true;
  });
  assert.throws(() => simulator.load("{\"ice\": {\"thickness_m\": -1}}"), /thickness_m/);
  simulator.load("{\"floes\": [{\"rectangle\": {\"corner_m\": [0, 0], \"size_m\": [9, 9]}}]}"); // and goes on
});
