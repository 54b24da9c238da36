// The simulator in a worker. It steps between messages of the page, so that the page never has to wait.

/* global makeSimulator, SimulatorFailure */

const longestSlice = 0.016; // longest time of stepping between two looks at messages [s]; longer: the page reacts later
let simulator = null;
let opened = null; // settles when the module has started: other orders may arrive before
let pace = { rate: 1, from: 0, since: 0 }; // the run should be at `from` [s] when the clock is at `since` [ms]
let isRunning = false;
let isPictureWanted = true;
let hasEnded = false;
let byHand = false;

const say = (kind, words = {}, given = []) => postMessage({ kind, ...words }, given);

function sendSnapshot() {
  isPictureWanted = false;
  const { words, columns } = simulator.snapshot();
  say("snapshot", { words, columns, memory: simulator.memoryBytes() }, [Object.values(columns)[0].buffer]);
  return words.t_s;
}

function end(reason, kind, words) {
  isRunning = false;
  hasEnded = true;
  sendSnapshot();
  simulator.finish(reason);
  say(kind, { words });
}

/** Steps for a slice of time, then allows messages to arrive. */
function slice() {
  if (!isRunning) return;
  const wanted = pace.rate === Infinity ? Infinity : pace.from + (pace.rate * (performance.now() - pace.since)) / 1000;
  try {
    if (simulator.advance(wanted, longestSlice))
      return end(byHand ? "steered by hand in a page" : "", "finished", simulator.stateHash());
    if (isPictureWanted) sendSnapshot();
  } catch (failure) {
    if (!(failure instanceof SimulatorFailure)) throw failure;
    return end(failure.message, "failed", failure.message);
  }
  turn.port2.postMessage(null);
}

// A message channel lets other messages arrive between two slices. Timers would wait for some milliseconds each time.
const turn = new MessageChannel();
turn.port1.onmessage = slice;

/** From now on, keeps the run at the pace of the clock. */
const keepPace = (rate, from) => { pace = { rate, from, since: performance.now() }; };

const orders = {
  async open({ compiled }) {
    opened = makeSimulator(compiled);
    simulator = await opened;
    say("ready", { schema: simulator.schema(), version: simulator.version() });
  },
  /** Reads a scene and prepares its start. */
  load({ text, files, number }) {
    isRunning = hasEnded = byHand = false;
    for (const [name, bytes] of files ?? []) simulator.files.write(name, bytes);
    const words = simulator.load(text);
    say("read", { number, words });
    if (words.memory_at_start_bytes > words.limit_bytes) return;
    simulator.start();
    sendSnapshot();
    say("started", { number });
  },
  run({ rate, from }) {
    if (hasEnded || isRunning) return;
    keepPace(rate, from);
    isRunning = true;
    slice();
  },
  pause() {
    isRunning = false;
    sendSnapshot();
    say("paused");
  },
  pace: ({ rate, from }) => keepPace(rate, from),
  step() {
    if (hasEnded) return;
    isRunning = false;
    const { t_s: before } = simulator.snapshot().words;
    if (simulator.advance(before + 1e-6, 1)) return end(byHand ? "steered by hand in a page" : "", "finished",
      simulator.stateHash());
    sendSnapshot();
  },
  more() {
    isPictureWanted = true;
  },
  steer({ ship, lever, angle }) {
    byHand = true;
    simulator.steer(ship, lever, angle);
  },
  release: ({ ship }) => simulator.release(ship),
  /** Returns the run so far as files, and in the form that the player reads. */
  read_back({ number }) {
    isRunning = false;
    if (!hasEnded) simulator.finish("stopped in a page");
    hasEnded = true;
    const { info, bytes } = simulator.readBack();
    say("run", { number, info, bytes }, [bytes.buffer]);
  },
  folder({ number }) {
    isRunning = false;
    if (!hasEnded) simulator.finish("stopped in a page");
    hasEnded = true;
    say("folder", { number, files: simulator.files.below("run").map(([name, bytes]) => [name, bytes.slice()]) });
  },
};

onmessage = async ({ data }) => {
  if (data.order !== "open" && await opened.then(() => false, () => true)) return; // "open" has said that it failed
  try {
    await orders[data.order](data);
  } catch (failure) {
    const isOfScene = failure instanceof SimulatorFailure;
    if (isOfScene) say("refused", { order: data.order, number: data.number, words: failure.message });
    else say("broken", { order: data.order, number: data.number, words: String(failure) });
  }
};
