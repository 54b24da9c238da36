// Draws the ice on the map. Each floe is a path of the browser; floes that hardly move are kept as a picture. The page
// that runs a simulation (browser/page) draws its floes with the functions of this file, but without that picture.

/** Returns a function that gives the outline of a floe as a path in its body frame, relative to its centroid [m]. An
 * outline is made when it is first needed and then kept. Holes run clockwise, so filling leaves them open. */
function makeOutlines({ floes }) {
  const outlines = new Map();
  return (id) => {
    if (outlines.has(id)) return outlines.get(id);
    const outline = new Path2D();
    const points = floes.shape(id);
    let k = 0;
    for (let ring = floes.ringsOf[id]; ring < floes.ringsOf[id + 1]; ++ring) {
      outline.moveTo(points[k] - floes.cx[id], points[k + 1] - floes.cy[id]);
      for (const end = 2 * floes.ringEnds[ring]; k < end; k += 2)
        outline.lineTo(points[k] - floes.cx[id], points[k + 1] - floes.cy[id]);
      outline.closePath();
    }
    outlines.set(id, outline);
    return outline;
  };
}

/** The floes that float at the present time (`living`, of which the first `count` are valid), those that are under
 * hulls or wait behind them (`under`), and their poses and velocities (`spin` is the angular one [rad/s]). Poses of
 * other floes are out of date. A floe `isAlive` while it floats. setTime() also sets the time of `motions`, for ships
 * too. */
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

/** Draws a floe at its place in `places`. `how` are methods of the canvas ("fill", "stroke"). Lengths are in metres;
 * the line is as wide as onMap() has set. */
function drawFloe(context, view, run, places, id, ...how) {
  const scale = view.scale * view.ratio;
  const [c, s] = [places.cos[id] * scale, places.sin[id] * scale];
  const [x, y] = view.toScreen(places.x[id], places.y[id]);
  context.setTransform(c, -s, -s, -c, x * view.ratio, y * view.ratio);
  const outline = run.outline(id);
  for (const name of how) context[name](outline);
}

/** Calls `draw` with a line width [px] and dashes [px], which are converted to metres for drawFloe(). */
function onMap(context, view, { width = 1, dash = [] }, draw) {
  context.save();
  context.lineWidth = width / view.scale;
  context.setLineDash(dash.map((length) => length / view.scale));
  context.lineJoin = "round";
  draw();
  context.restore();
}

/** Index of the class of a value. `edges` are the limits between classes in ascending order. */
const classOf = (value, edges) => lastAtMost(edges, value) + 1;

// Radius [px] of a floe on the screen up to which its edge is not drawn; smaller: drawing takes longer.
const smallReach = 5;

/** Draws the floes of these ids that are visible, one class of colours after the other. `look` has their colours:
 * `bucketOf` gives the class of a floe, `fills` and `edgeOf` the fill and the edge of a class. Edges are thinner where
 * the map is small, so that edges do not cover small floes. */
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

/** Draws the floes of startPlaces() where they were then, so that open water shows where ice was. A floe that has moved
 * by less than 0.3 px is left out, because it covers its place. */
function drawStartIce(context, view, run, start, places, time, colours) {
  context.fillStyle = colours["start-ice"];
  const { floes } = run;
  const isCovered = (id) => places.isAlive(id, time) &&
    Math.abs(places.x[id] - start.x[id]) + Math.abs(places.y[id] - start.y[id]) +
    Math.abs(places.sin[id] - start.sin[id]) * floes.reach[id] < 0.3 / view.scale;
  const seen = start.ids.filter((id) => view.shows(start.x[id], start.y[id], floes.reach[id]) && !isCovered(id));
  onMap(context, view, {}, () => seen.forEach((id) => drawFloe(context, view, run, start, id, "fill")));
}

/** Places of the floes that float at a time. The player passes the time of the first frame on its page, which is later
 * than the start of the run if the page was written with `--from`. */
function startPlaces(run, motions, time) {
  const start = makePlaces(run, motions);
  start.setTime(time);
  start.ids = Array.from(start.living.subarray(0, start.count));
  return start;
}

// Ice that hardly moves is drawn once and kept as a picture, because most floes of a large field stay in place for a
// while; only the other floes are drawn each time. The picture can be used as long as the view does not change and none
// of its floes moves.

// Largest number of floes outside the picture; if there are more, the picture is made for a shorter time. A larger
// number makes each refresh draw more floes; a smaller one makes the picture anew more often.
const mostLoose = 1000;

/** Returns drawAll(), which draws the floating ice with such a picture. Between its floes the picture is transparent,
 * so that the ice at the start and the channel below it stay visible. */
function makeStillIce(run, places, motions) {
  const { floes, frames: { times } } = run;
  const canvas = make("canvas");
  const kept = { look: "", from: 0, until: -1, loose: [] };

  /** Divides the floes into those that stay in place until a time, to within a quarter of a pixel, and the others. */
  function part(view, time, until) {
    const endFrame = lastAtMost(times, until) + 1;
    const isInOneFrame = until <= times[motions.frame + 1]; // no further record then changes the motion of a floe
    const stays = (id) => {
      const speed = Math.hypot(places.vx[id], places.vy[id]) + Math.abs(places.spin[id]) * floes.reach[id];
      return floes.floatsUntil[id] > until && speed * (until - time) * view.scale < 0.25
        && (isInOneFrame || motions.isSteady(id, endFrame));
    };
    const [still, loose] = [[], []];
    for (const id of places.living.subarray(0, places.count)) (stays(id) ? still : loose).push(id);
    return { until, still, loose };
  }

  /** Makes the picture for the next `ahead` seconds, or for a tenth of them, at most until the next frame, if too many
   * floes would move in that time. */
  function rebuild(view, time, ahead, draw) {
    const soon = Math.min(time + ahead / 10, times[motions.frame + 1] ?? Infinity);
    let parts = part(view, time, time + ahead);
    if (parts.loose.length > mostLoose) parts = part(view, time, soon);
    const { until, still, loose } = parts;
    floes.born.forEach((born, id) => { if (born > time && born <= until) loose.push(id); });
    draw(clearedCanvas(canvas, view.width, view.height), still);
    Object.assign(kept, { from: time, until, loose });
  }

  /** Draws all floating ice at a time. It calls `draw(context, ids)`, which draws these floes at their present places:
   * the picture's floes once, the others over the picture each time. `look` is a text that identifies the view and the
   * colours; a picture is discarded if it changes. A picture is made for the next `ahead` [s of the run]. A larger
   * value makes pictures last longer, but leaves more floes outside of them. */
  return function drawAll(target, view, look, time, ahead, draw) {
    if (look !== kept.look) { // the view is changing, so that a picture could not be used twice
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
