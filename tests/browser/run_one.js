"use strict";
// node run_one.js MODULE SCENE UNTIL_S: runs a scene in WebAssembly and prints its hash and how fast it was.
const fs = require("node:fs");
const { compile, makeSimulator } = require("./module.js");

(async () => {
  const [wasm, scene, until] = process.argv.slice(2);
  const simulator = await makeSimulator(await compile(wasm));
  try {
    const words = simulator.load(fs.readFileSync(scene, "utf8"));
    simulator.start();
    const before = performance.now();
    const end = until ? Number(until) : words.until_s;
    simulator.advance(end, Infinity);
    const wall = (performance.now() - before) / 1000;
    const { words: at } = simulator.snapshot();
    console.log(simulator.stateHash(), `${at.bends + at.splits} fractures, ${at.t_s} s in ${wall.toFixed(2)} s:`,
      `${(at.t_s / wall).toFixed(1)} x real time, ${(simulator.memoryBytes() / 2 ** 20).toFixed(0)} MiB`);
  } catch (failure) {
    console.log("failed:", failure, simulator.said.join(""));
    process.exit(1);
  }
})();
