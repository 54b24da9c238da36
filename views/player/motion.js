// Where floes and ships are at a time, by the rules of docs/run-folder.md (and io/run/motion_index.cpp).

/** The last index whose value is at most x, or −1; values grow. */
function lastAtMost(values, x, from = 0, end = values.length) {
  while (from < end) {
    const middle = (from + end) >> 1;
    if (values[middle] <= x) from = middle + 1;
    else end = middle;
  }
  return from - 1;
}

function makeMotions(run) {
  const { frames, floes } = run;
  const { times, doubles, recordsOf, recordFrame, recordAt } = frames;
  const reference = floeReferences(run);
  const motion = new Float64Array(6); // x, y, angle, vx, vy, spin
  const recorded = new Float64Array(6);
  let time = 0;
  let frame = 0; // the last one not after time
  let part = 0; // of the way to the next

  function carry(out, at, duration) {
    for (let k = 3; k < 6; ++k) out[k] = doubles[at + k];
    for (let k = 0; k < 3; ++k) out[k] = doubles[at + k] + duration * out[k + 3];
  }

  function setTime(t) {
    time = t;
    frame = Math.max(0, lastAtMost(times, t));
    part = frame + 1 < times.length ? (t - times[frame]) / (times[frame + 1] - times[frame]) : 0;
  }

  /** Motion of a floe that frames record. */
  function ofRecorded(floe) {
    const first = recordsOf[floe];
    const end = recordsOf[floe + 1];
    const slot = Math.max(first, lastAtMost(recordFrame, frame, first, end));
    const recordTime = times[recordFrame[slot]];
    carry(motion, recordAt[slot], time - recordTime);
    const hasNext = slot + 1 < end && recordFrame[slot + 1] === frame + 1;
    if (recordTime > time || !hasNext) return motion;
    carry(recorded, recordAt[slot], times[frame] - recordTime);
    for (let k = 0; k < 6; ++k) motion[k] = recorded[k] + part * (doubles[recordAt[slot + 1] + k] - recorded[k]);
    return motion;
  }

  /** Motion of any floe. One that lived between two frames moves with what it broke from. */
  function floe(id) {
    const by = reference[id];
    if (by < 0) return motion.set([floes.cx[id], floes.cy[id], 0, 0, 0, 0]), motion;
    ofRecorded(by);
    if (by === id) return motion;
    const c = Math.cos(motion[2]);
    const s = Math.sin(motion[2]);
    const dx = floes.cx[id] - floes.cx[by];
    const dy = floes.cy[id] - floes.cy[by];
    motion[0] += c * dx - s * dy;
    motion[1] += s * dx + c * dy;
    return motion;
  }

  function shipInFrame(ship, index) {
    const at = frames.shipAt[index] + 6 * ship;
    return doubles.subarray(at, at + 6);
  }

  function ship(index) {
    if (times.length === 0) return null;
    const a = shipInFrame(index, frame);
    if (frame + 1 >= times.length) return Float64Array.from(a);
    const b = shipInFrame(index, frame + 1);
    return a.map((value, k) => value + part * (b[k] - value));
  }

  return {
    setTime,
    floe,
    ship,
    shipInFrame,
    frame: () => frame,
    /** Whether no frame from the present one to that one records the floe. */
    isSteady(id, endFrame) {
      const by = reference[id];
      if (by < 0) return true;
      const slot = Math.max(recordsOf[by], lastAtMost(recordFrame, frame, recordsOf[by], recordsOf[by + 1]));
      return slot + 1 >= recordsOf[by + 1] || recordFrame[slot + 1] > endFrame;
    },
    /** Whether frames record the floe itself. */
    isRecorded: (id) => reference[id] === id,
  };
}

/** For each floe the one whose records place it: itself, else the nearest ancestor, else a descendant. */
function floeReferences({ floes, frames }) {
  const reference = new Int32Array(floes.count).fill(-1);
  for (let i = 0; i < floes.count; ++i) {
    if (frames.recordsOf[i + 1] > frames.recordsOf[i]) reference[i] = i;
    else if (floes.parent[i] >= 0) reference[i] = reference[floes.parent[i]];
  }
  for (let i = floes.count - 1; i >= 0; --i) {
    const parent = floes.parent[i];
    if (parent >= 0 && reference[parent] < 0) reference[parent] = reference[i];
  }
  return reference;
}
