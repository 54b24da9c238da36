// Places of all bodies at a time, on the water and under hulls.

// Motion of floes and ships at a time, by the rules of docs/run-folder.md. MotionIndex in io/run/run_reader.cpp applies
// the same rules; if only one of the two is changed, the player and the other commands place floes differently.

/** Last index from `from` to before `end` whose value is at most x; from − 1 if there is none. Values are in ascending
 * order. */
function lastAtMost(values, x, from = 0, end = values.length) {
  while (from < end) {
    const middle = (from + end) >> 1;
    if (values[middle] <= x) from = middle + 1;
    else end = middle;
  }
  return from - 1;
}

/** Returns a function that transforms points from a body's frame to the world, for a pose of the body. */
function placedBy([x, y, angle]) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return (px, py) => [x + c * px - s * py, y + s * px + c * py];
}

/** Motion of any body at the time that setTime() has set, which must not be before the first frame. The functions for
 * floes return `motion`, which the next call overwrites. Angles are continuous: frames do not reduce them to one turn,
 * so they can be interpolated. */
class Motions {
  constructor({ frames, floes }) {
    this.frames = frames;
    this.floes = floes;
    this.reference = floeReferences({ frames, floes });
    this.motion = new Float64Array(6); // x, y [m], angle [rad], velocity in x and y [m/s], angular velocity [rad/s]
    this.recorded = new Float64Array(6);
    this.time = 0;
    this.frame = 0; // the last frame that is not after the time
    this.part = 0; // fraction of the interval to the next frame
  }

  setTime(time) {
    const { times } = this.frames;
    this.time = time;
    this.frame = Math.max(0, lastAtMost(times, time));
    const next = this.frame + 1;
    this.part = next < times.length ? (time - times[this.frame]) / (times[next] - times[this.frame]) : 0;
  }

  /** Writes the motion recorded at a position in the frames, extrapolated by a duration [s], to `out`. */
  carry(out, at, duration) {
    const { doubles } = this.frames;
    for (let k = 3; k < 6; ++k) out[k] = doubles[at + k];
    for (let k = 0; k < 3; ++k) out[k] = doubles[at + k] + duration * out[k + 3];
  }

  /** Last record of a floe that is not after the present frame; its first record if there is none. */
  slotOf(floe) {
    const { recordsOf, recordFrame } = this.frames;
    return Math.max(recordsOf[floe], lastAtMost(recordFrame, this.frame, recordsOf[floe], recordsOf[floe + 1]));
  }

  /** Motion of a floe that frames record. A frame leaves out the floes whose last record, extrapolated at its velocity,
   * is right within the tolerances of io/run/frames.hpp (1 mm, 1e-5 rad, and of the velocities). So if the next frame
   * records the floe too, the motion is interpolated up to that record; otherwise the last record is extrapolated. */
  ofRecorded(floe) {
    const { times, doubles, recordsOf, recordFrame, recordAt } = this.frames;
    const { motion, recorded, time, frame, part } = this;
    const slot = this.slotOf(floe);
    const recordTime = times[recordFrame[slot]];
    this.carry(motion, recordAt[slot], time - recordTime);
    const hasNext = slot + 1 < recordsOf[floe + 1] && recordFrame[slot + 1] === frame + 1;
    if (recordTime > time || !hasNext) return motion;
    this.carry(recorded, recordAt[slot], times[frame] - recordTime);
    for (let k = 0; k < 6; ++k) motion[k] = recorded[k] + part * (doubles[recordAt[slot + 1] + k] - recorded[k]);
    return motion;
  }

  /** Motion of any floe. A floe that existed only between two frames moves with the floe from which it broke: the body
   * frames of both have parallel axes, and centroids (cx, cy) are in the frame of the floe of the scene. Without any
   * record, as in a run without frames, a floe lies where the scene has it. */
  floe(id) {
    const { floes, motion } = this;
    const by = this.reference[id];
    if (by < 0) return motion.set([floes.cx[id], floes.cy[id], 0, 0, 0, 0]), motion;
    this.ofRecorded(by);
    if (by === id) return motion;
    [motion[0], motion[1]] = placedBy(motion)(floes.cx[id] - floes.cx[by], floes.cy[id] - floes.cy[by]);
    return motion;
  }

  /** Pose and velocity of a ship in a frame, in the order of `motion`. */
  shipInFrame(ship, frame) {
    const at = this.frames.shipAt[frame] + 6 * ship;
    return this.frames.doubles.subarray(at, at + 6);
  }

  /** The same at the present time, interpolated between frames; null if there are no frames. */
  ship(index) {
    const { times } = this.frames;
    if (times.length === 0) return null;
    const a = this.shipInFrame(index, this.frame);
    if (this.frame + 1 >= times.length) return Float64Array.from(a);
    const b = this.shipInFrame(index, this.frame + 1);
    return a.map((value, k) => value + this.part * (b[k] - value));
  }

  /** Returns true if no frame after the present one, up to and including `endFrame`, records the floe: until then it
   * moves at constant velocity, and draw_ice.js can predict how far. */
  isSteady(id, endFrame) {
    const { recordsOf, recordFrame } = this.frames;
    const by = this.reference[id];
    if (by < 0) return true;
    const next = this.slotOf(by) + 1;
    return next >= recordsOf[by + 1] || recordFrame[next] > endFrame;
  }

  /** Returns true if frames record the floe itself. Otherwise the velocity is that of another floe, and the card of the
   * floe shows none. */
  isRecorded(id) {
    return this.reference[id] === id;
  }
}

/** For each floe, the floe whose records place it: itself, otherwise the nearest ancestor with records, otherwise a
 * descendant with records, of several children the one with the highest id. */
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

// Ice that goes under hulls, surfaces behind them or stays under the ice (docs/theory/under-hull.md).

/** Number of floes that went under a hull in the run, and the times at which they surfaced, in ascending order [s]. */
function readIceUnderHulls(events) {
  const timesOf = (kind) => Float64Array.from(events.filter((event) => event.kind === kind), (event) => event.t_s);
  return { went: timesOf("submerge").length, cameUpAt: timesOf("resurface") };
}

/** Outlines ice that is under hulls or waits behind them for room, with lines of 0.5 to 1.2 px, thinner where the map
 * is small. It is drawn over the ship, which stays visible through the pale fill (0.25 of its colour). */
function drawIceUnderHulls(context, view, run, places, colours) {
  onMap(context, view, { width: Math.min(1.2, Math.max(0.5, 0.4 * view.scale)), dash: [3, 2] }, () => {
    context.fillStyle = context.strokeStyle = colours["under-hull"];
    for (const id of places.under) {
      if (!view.shows(places.x[id], places.y[id], run.floes.reach[id])) continue;
      context.globalAlpha = 0.25;
      drawFloe(context, view, run, places, id, "fill");
      context.globalAlpha = 1;
      drawFloe(context, view, run, places, id, "stroke");
    }
  });
}

/** The two rows with present values above the numbers of the whole run; only a run in which ice went under has them. */
function rowsUnderHulls() {
  return [["under-now", "under the hull or waiting"], ["came-up-now", "come up until now"]].flatMap(([id, name]) =>
    [make("dt", {}, name), make("dd", { id }, "0")]);
}

function showCountsUnderHulls({ under }, places, time) {
  byId("under-now").textContent = String(places.under.length);
  byId("came-up-now").textContent = String(lastAtMost(under.cameUpAt, time) + 1);
}

/** Rows of a floe's card, [text, exact time [s]] by name: when the floe went under and how it ended: it broke, surfaced
 * as new floes or, without any, as brash only, or stayed under the ice. Only tests read the exact times. */
function lastFacts({ floes, info, breakOf }, id) {
  const facts = {};
  const seconds = (time) => valueWords(time, "s");
  if (Number.isFinite(floes.wentUnder[id])) facts["under the hull"] = [`since ${seconds(floes.wentUnder[id])}`,
    floes.wentUnder[id]];
  const last = info.events[breakOf.get(id)];
  if (last?.kind === "resurface") {
    const as = last.children.length > 0 ? `as floe ${last.children.join(", ")}` : "as brash";
    return { ...facts, "came up": [`at ${seconds(last.t_s)} ${as}`, last.t_s] };
  }
  if (last?.kind === "stay_under") return { ...facts, stayed: [`under the ice, at ${seconds(last.t_s)}`, last.t_s] };
  return { ...facts, broke: [Number.isFinite(floes.died[id]) ? seconds(floes.died[id]) : "not in this run",
    floes.died[id]] };
}
