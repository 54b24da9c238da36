"use strict";
// node tests/browser/speed.js MODULE POLYNYA SCENE...: compares the processor time of a scene's run in WebAssembly with
// the time of the native program on one thread. Both write all files of the run folder. The runs alternate, and the
// least of three times counts.
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const { compile, makeSimulator } = require("./module.js");

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "polynya-speed-"));

/** Processor time of this process's children that have ended [s]: by the shell's `times`. */
function nativeTime(polynya, scene) {
  const script = "\"$0\" run \"$1\" --out \"$2\" --overwrite --threads 1 >/dev/null 2>&1; times";
  const words = execFileSync("bash", ["-c", script, polynya, scene, path.join(folder, "run")], { encoding: "utf8" });
  return words.trim().split("\n").at(-1).split(" ").reduce((sum, word) => {
    const [, minutes, seconds] = /(\d+)m([\d.]+)s/.exec(word);
    return sum + 60 * Number(minutes) + Number(seconds);
  }, 0);
}

async function browserTime(compiled, scene) {
  const simulator = await makeSimulator(compiled);
  const { until_s: until } = simulator.load(fs.readFileSync(scene, "utf8"));
  simulator.start();
  const before = process.cpuUsage();
  simulator.advance(Infinity, Infinity);
  simulator.finish("");
  const { user, system } = process.cpuUsage(before);
  return { seconds: (user + system) / 1e6, until, memory: simulator.memoryBytes() };
}

(async () => {
  const [wasm, polynya, ...scenes] = process.argv.slice(2);
  const compiled = await compile(wasm);
  await browserTime(compiled, scenes[0]); // the engine's optimising compiler has then seen the module
  for (const scene of scenes) {
    const runs = [];
    for (let k = 0; k < 3; ++k) runs.push([nativeTime(polynya, scene), await browserTime(compiled, scene)]);
    const native = Math.min(...runs.map(([seconds]) => seconds));
    const [, least] = runs.reduce((a, b) => (b[1].seconds < a[1].seconds ? b : a));
    console.log(`${path.basename(scene)}: ${least.until} s; native ${native.toFixed(2)} s, WebAssembly ${
      least.seconds.toFixed(2)} s: ${(native / least.seconds).toFixed(2)} of its speed, ${
      (least.until / least.seconds).toFixed(0)} x real time, ${(least.memory / 2 ** 20).toFixed(0)} MiB`);
  }
  fs.rmSync(folder, { recursive: true, force: true });
})();
