"use strict";
// Loads the module under node from browser/page's scripts, joined as in the page.

const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");

const source = path.resolve(__dirname, "../..");
const parts = ["files.js", "simulator.js"].map((name) =>
  fs.readFileSync(path.join(source, "browser/page", name), "utf8"));
const context = vm.createContext({ WebAssembly, TextEncoder, TextDecoder, performance, console });
vm.runInContext(`${parts.join("\n")}\nglobalThis.made = { makeSimulator, SimulatorFailure };`, context);

const compile = (wasm) => WebAssembly.compile(fs.readFileSync(wasm));

module.exports = { ...context.made, compile, source };
