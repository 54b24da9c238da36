// The module with its files. Its functions take and return texts and columns instead of addresses.

/* global makeFiles, makeSystem */
/* exported makeSimulator */

const typesOfColumns = { f64: Float64Array, i32: Int32Array, u8: Uint8Array };

/** Thrown if a call of the module fails. Its message is a text for the page. */
class SimulatorFailure extends Error {}

/** Returns the columns of a snapshot by their names. */
function columnsOf(table, bytes) {
  return Object.fromEntries(table.map(({ name, type, offset, count }) =>
    [name, new typesOfColumns[type](bytes.buffer, bytes.byteOffset + offset, count)]));
}

/** Functions that pass texts and columns to and from a module, by its exports. */
function makeExchange(exports) {
  const bytesAt = (at, size) => new Uint8Array(exports.memory.buffer, at >>> 0, size >>> 0).slice();
  const output = () => new TextDecoder().decode(bytesAt(exports.output_data(), exports.output_size()));
  return {
    output,
    columns: () => bytesAt(exports.columns_data(), exports.columns_size()),
    give(text) {
      const bytes = new TextEncoder().encode(text);
      const at = exports.input_buffer(bytes.length) >>> 0;
      new Uint8Array(exports.memory.buffer).set(bytes, at);
    },
    check(isGood) {
      if (!isGood) throw new SimulatorFailure(output());
    },
  };
}

/** Calls of a module with texts and columns. */
function simulatorCalls(exports) {
  const { output, columns, give, check } = makeExchange(exports);
  return {
    /** Reads a scene. If it fails, the message has the problems as JSON. */
    load(text) {
      give(text);
      check(exports.load());
      return JSON.parse(output());
    },
    start: () => check(exports.start()),
    /** Steps up to a time [s], for at most `wall` seconds of real time. Returns true at the scene's end. */
    advance(until, wall) {
      const state = exports.advance(until, wall);
      check(state === 0 || state === 1);
      return state === 1;
    },
    /** Steps up to a time [s], also beyond the scene's end. */
    advanceBeyond: (until) => check(exports.advance_beyond(until)),
    steer: (ship, lever, angle) => exports.steer(ship, lever, angle),
    release: (ship) => exports.release(ship),
    snapshot() {
      check(exports.snapshot());
      const words = JSON.parse(output());
      return { words, columns: columnsOf(words.columns, columns()) };
    },
    finish(reason) {
      give(reason);
      check(exports.finish());
    },
    /** Returns the run in the form that the player reads: {info, bytes} (views/player/run_data.js). */
    readBack() {
      check(exports.read_back());
      return { info: JSON.parse(output()), bytes: columns() };
    },
    stateHash: () => (exports.state_hash(), output()),
    schema: () => (exports.schema(), JSON.parse(output())),
    version: () => (exports.version(), output()),
    memoryBytes: () => exports.memory.buffer.byteLength,
  };
}

/**
 * Starts a compiled module. Its calls throw SimulatorFailure if a scene or a run fails. Any other exception means that
 * the module itself has ended; it must then be made again from the text of the scene.
 */
async function makeSimulator(compiled) {
  const files = makeFiles();
  const said = [];
  let exports = null;
  const system = makeSystem(files, () => exports.memory, (text) => said.push(text));
  const instance = await WebAssembly.instantiate(compiled, { wasi_snapshot_preview1: system });
  exports = instance.exports;
  exports._initialize();
  return { files, said, ...simulatorCalls(exports) };
}
