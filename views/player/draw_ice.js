// The ice on the map: each floe as a path of the browser's, and what stays as a picture.

/** Gives each floe's outline as a path in its body frame, from its centroid [m]; made when it is first asked for. */
function makeOutlines({ floes }) {
  const outlines = new Map();
  return (id) => {
    if (outlines.has(id)) return outlines.get(id);
    const outline = new Path2D();
    const points = floes.shape(id);
    let k = 0;
    for (let ring = floes.ringsOf[id]; ring < floes.ringsOf[id + 1]; ++ring) {
      for (const end = 2 * floes.ringEnds[ring]; k < end; k += 2)
        outline.lineTo(points[k] - floes.cx[id], points[k + 1] - floes.cy[id]);
      outline.closePath();
    }
    outlines.set(id, outline);
    return outline;
  };
}

/** The floes that float now, those that are under hulls or wait behind them, and where they are. */
function makePlaces(run, motions) {
  const { floes } = run;
  const column = () => new Float64Array(floes.count);
  const places = { living: new Int32Array(floes.count), count: 0, under: [], x: column(), y: column(), cos: column(),
    sin: column(), vx: column(), vy: column(), spin: column() };
  places.place = (id) => {
    const m = motions.floe(id);
    places.x[id] = m[0];
    places.y[id] = m[1];
    places.cos[id] = Math.cos(m[2]);
    places.sin[id] = Math.sin(m[2]);
    places.vx[id] = m[3];
    places.vy[id] = m[4];
    places.spin[id] = m[5];
  };
  places.isAlive = (id, time) => floes.born[id] <= time && time < floes.floatsUntil[id];
  places.isUnder = (id, time) => floes.wentUnder[id] <= time && time < floes.died[id];
  places.isThere = (id, time) => places.isAlive(id, time) || places.isUnder(id, time);
  places.setTime = (time) => {
    motions.setTime(time);
    places.count = 0;
    places.under = [];
    for (let i = 0; i < floes.count; ++i) {
      if (!places.isThere(i, time)) continue;
      places.place(i);
      if (places.isAlive(i, time)) places.living[places.count++] = i;
      else places.under.push(i);
    }
  };
  return places;
}

/** Draws of a floe `how` ("fill", "stroke"), where `places` have it. Its lines are in metres, as wide as `lineWidth` of
 * onMap(). */
function drawFloe(context, view, run, places, id, ...how) {
  const scale = view.scale * view.ratio;
  const [c, s] = [places.cos[id] * scale, places.sin[id] * scale];
  const [x, y] = view.toScreen(places.x[id], places.y[id]);
  context.setTransform(c, -s, -s, -c, x * view.ratio, y * view.ratio);
  const outline = run.outline(id);
  for (const name of how) context[name](outline);
}

/** Draws floes: lines have a width [px] and dashes [px]. */
function onMap(context, view, { width = 1, dash = [] }, draw) {
  context.save();
  context.lineWidth = width / view.scale;
  context.setLineDash(dash.map((length) => length / view.scale));
  context.lineJoin = "round";
  draw();
  context.restore();
}

/** The class of a value among growing edges. */
const classOf = (value, edges) => lastAtMost(edges, value) + 1;

const smallReach = 5; // [px]; floes that reach less far have no edge drawn

/** Draws the floes of these ids that show on the screen. `look` has their colours. */
function drawFloes(context, view, run, places, ids, look) {
  const { floes } = run;
  const buckets = look.fills.map(() => []);
  for (const id of ids)
    if (view.shows(places.x[id], places.y[id], floes.reach[id])) buckets[look.bucketOf(id)].push(id);
  const width = Math.min(1.1, Math.max(0.35, 0.4 * view.scale));
  onMap(context, view, { width }, () => buckets.forEach((bucket, k) => {
    context.fillStyle = look.fills[k];
    context.strokeStyle = look.edgeOf(k);
    for (const id of bucket) {
      const edge = floes.reach[id] * view.scale > smallReach ? ["stroke"] : [];
      drawFloe(context, view, run, places, id, "fill", ...edge);
    }
  }));
}

/** The scene's floes where they were at the start, so that open water shows what it was. */
function drawStartIce(context, view, run, start, places, time, colours) {
  context.fillStyle = colours["start-ice"];
  const { floes } = run;
  const isCovered = (id) => places.isAlive(id, time) &&
    Math.abs(places.x[id] - start.x[id]) + Math.abs(places.y[id] - start.y[id]) +
    Math.abs(places.sin[id] - start.sin[id]) * floes.reach[id] < 0.3 / view.scale;
  const seen = start.ids.filter((id) => view.shows(start.x[id], start.y[id], floes.reach[id]) && !isCovered(id));
  onMap(context, view, {}, () => seen.forEach((id) => drawFloe(context, view, run, start, id, "fill")));
}

/** Where floes of the scene are at the run's start. */
function startPlaces(run, motions, time) {
  const start = makePlaces(run, motions);
  start.setTime(time);
  start.ids = Array.from(start.living.subarray(0, start.count));
  return start;
}

// Ice that hardly moves, drawn once and kept as a picture. Most floes of a large field stay where they are for a while:
// then only the others are drawn again. The picture serves as long as the view stays and none of its floes has to move.

const mostLoose = 1000; // floes outside the picture; with more of them it serves for a shorter time

function makeStillIce(run, places, motions) {
  const { floes, frames: { times } } = run;
  const canvas = make("canvas");
  const kept = { look: "", from: 0, until: -1, loose: [] };

  /** Parts the floes into those that stay where they are until a time, to a quarter of a pixel, and the others. */
  function part(view, time, until) {
    const endFrame = lastAtMost(times, until) + 1;
    const isInOneFrame = until <= times[motions.frame + 1]; // then nothing changes its way
    const stays = (id) => {
      const speed = Math.hypot(places.vx[id], places.vy[id]) + Math.abs(places.spin[id]) * floes.reach[id];
      return floes.floatsUntil[id] > until && speed * (until - time) * view.scale < 0.25
        && (isInOneFrame || motions.isSteady(id, endFrame));
    };
    const [still, loose] = [[], []];
    for (const id of places.living.subarray(0, places.count)) (stays(id) ? still : loose).push(id);
    return { until, still, loose };
  }

  function rebuild(view, time, ahead, draw) {
    const soon = Math.min(time + ahead / 10, times[motions.frame + 1] ?? Infinity);
    let parts = part(view, time, time + ahead);
    if (parts.loose.length > mostLoose) parts = part(view, time, soon);
    const { until, still, loose } = parts;
    floes.born.forEach((born, id) => { if (born > time && born <= until) loose.push(id); });
    draw(clearedCanvas(canvas, view.width, view.height), still);
    Object.assign(kept, { from: time, until, loose });
  }

  /** Draws all ice alive at the time. `look` names the view and the colours; `ahead` [s] is how long a picture is to
   * last. */
  return function drawAll(target, view, look, time, ahead, draw) {
    if (look !== kept.look) { // the view moves: no picture would serve twice
      Object.assign(kept, { look, until: -1 });
      draw(target, places.living.subarray(0, places.count));
      return;
    }
    if (time < kept.from || time > kept.until) rebuild(view, time, ahead, draw);
    target.save();
    target.resetTransform();
    target.drawImage(canvas, 0, 0);
    target.restore();
    draw(target, kept.loose.filter((id) => places.isAlive(id, time)));
  };
}
