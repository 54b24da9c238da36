// Places the floes alive at a time and draws them. Floes of one class go into paths of some fifty points
// each: far fewer calls than a path a floe, and far faster to fill than one path for all.

const pointsInPath = 50;
const smallReach = 5; // [px]; floes that reach less far have no edge drawn
const rimParts = [0, 0.1, 0.2, 0.3, 0.4, 0.5]; // of the edge's colour at the edge of small floes, a part for each 5 px of reach
const manySmall = 1000; // floes; more than these are drawn pixel by pixel

/** Floe ids so that neighbours in the scene follow each other: a path of some of them then covers little of the screen. */
function neighbourOrder(floes) {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (let i = 0; i < floes.count; ++i) {
    box.left = Math.min(box.left, floes.cx[i]);
    box.right = Math.max(box.right, floes.cx[i]);
    box.bottom = Math.min(box.bottom, floes.cy[i]);
    box.top = Math.max(box.top, floes.cy[i]);
  }
  const cell = Math.sqrt(((box.right - box.left) * (box.top - box.bottom)) / (floes.count / 16)) || 1;
  const keys = Float64Array.from({ length: floes.count }, (_, i) =>
    Math.floor((floes.cy[i] - box.bottom) / cell) * 1e6 + Math.floor((floes.cx[i] - box.left) / cell));
  return Int32Array.from({ length: floes.count }, (_, i) => i).sort((a, b) => keys[a] - keys[b] || a - b);
}

/** The floes that float now, those that are under hulls or wait behind them, and where they are. */
function makePlaces(run, motions) {
  const { floes } = run;
  const order = neighbourOrder(floes);
  const places = {
    living: new Int32Array(floes.count),
    count: 0,
    under: [],
    x: new Float64Array(floes.count),
    y: new Float64Array(floes.count),
    cos: new Float64Array(floes.count),
    sin: new Float64Array(floes.count),
    vx: new Float64Array(floes.count),
    vy: new Float64Array(floes.count),
    spin: new Float64Array(floes.count),
  };
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
    for (const i of order) {
      if (!places.isThere(i, time)) continue;
      places.place(i);
      if (places.isAlive(i, time)) places.living[places.count++] = i;
      else places.under.push(i);
    }
  };
  return places;
}

/** Adds a floe's rings to the path, in pixels. Points nearer than half a pixel are left out. */
function traceFloe(context, view, floes, places, id) {
  const c = places.cos[id] * view.scale;
  const s = places.sin[id] * view.scale;
  const x0 = (places.x[id] - view.x) * view.scale + view.width / 2;
  const y0 = (view.y - places.y[id]) * view.scale + view.height / 2;
  const { ringsOf, ringEnds } = floes;
  const { points, first } = floes.shape(id);
  const [cx, cy] = [floes.cx[id], floes.cy[id]];
  let k = first;
  let traced = 0;
  for (let ring = ringsOf[id]; ring < ringsOf[id + 1]; ++ring) {
    let lastX = NaN;
    let lastY = NaN;
    for (const end = first + ringEnds[ring]; k < end; ++k) {
      const px = points[2 * k] - cx;
      const py = points[2 * k + 1] - cy;
      const x = x0 + c * px - s * py;
      const y = y0 - s * px - c * py;
      if (Math.abs(x - lastX) < 0.5 && Math.abs(y - lastY) < 0.5) continue;
      if (Number.isNaN(lastX)) context.moveTo(x, y);
      else context.lineTo(x, y);
      lastX = x;
      lastY = y;
      ++traced;
    }
    context.closePath();
  }
  return traced;
}

/** The class of a value among growing edges. */
function classOf(value, edges) {
  let k = 0;
  while (k < edges.length && value >= edges[k]) ++k;
  return k;
}

/** The ids whose floes show on the screen, by what fills them: small ones, and others. */
function bucketsInView(view, floes, places, ids, look) {
  const buckets = look.fills.map(() => ({ large: [], small: [] }));
  let small = 0;
  for (const id of ids) {
    if (!view.shows(places.x[id], places.y[id], floes.reach[id])) continue;
    const bucket = buckets[look.bucketOf(id)];
    const isSmall = floes.reach[id] * view.scale * view.ratio < rasterReach;
    (isSmall ? bucket.small : bucket.large).push(id);
    small += isSmall;
  }
  return { buckets, small };
}

function rasterSmall(context, view, floes, places, raster, buckets, look) {
  raster.begin(context.canvas.width, context.canvas.height);
  buckets.forEach((bucket, k) => {
    const fill = pixelOf(look.fills[k]);
    const rims = rimParts.map((part) => pixelOf(look.fills[k], look.edgeOf(k), part));
    const rimOf = (id) => rims[Math.min(rims.length - 1, Math.floor((floes.reach[id] * view.scale) / smallReach))];
    for (const id of bucket.small) raster.add(floes, places, view, id, fill, rimOf(id));
  });
  raster.put(context, view);
}

/** Draws the floes of these ids that show on the screen: small ones pixel by pixel, the others as paths. `look` has their colours. */
function drawFloes(context, view, run, places, raster, ids, look) {
  const { floes } = run;
  const { buckets, small } = bucketsInView(view, floes, places, ids, look);
  const isRastered = small > manySmall;
  if (isRastered) rasterSmall(context, view, floes, places, raster, buckets, look);
  context.lineWidth = Math.min(1.1, Math.max(0.35, 0.4 * view.scale));
  context.lineJoin = "round";
  buckets.forEach((bucket, k) => {
    context.fillStyle = look.fills[k];
    context.strokeStyle = look.edgeOf(k);
    const trace = (id) => traceFloe(context, view, floes, places, id);
    const hasEdge = (id) => floes.reach[id] * view.scale > smallReach;
    if (!isRastered) {
      drawChunks(context, bucket.small.filter((id) => !hasEdge(id)), trace, false);
      drawChunks(context, bucket.small.filter(hasEdge), trace);
    }
    drawChunks(context, bucket.large, trace);
  });
}

/** Fills and strokes what `trace` adds to the path for each id, a few floes at a time. */
function drawChunks(context, ids, trace, strokes = true) {
  let traced = 0;
  const flush = () => {
    context.fill();
    if (strokes) context.stroke();
    context.beginPath();
    traced = 0;
  };
  context.beginPath();
  for (const id of ids) {
    traced += trace(id);
    if (traced >= pointsInPath) flush();
  }
  if (traced > 0) flush();
}

/** The scene's floes where they were at the start, so that open water shows what it was. */
function drawStartIce(context, view, run, start, places, time, colours) {
  context.fillStyle = colours["start-ice"];
  const { floes } = run;
  const isCovered = (id) => places.isAlive(id, time) &&
    Math.abs(places.x[id] - start.x[id]) + Math.abs(places.y[id] - start.y[id]) +
    Math.abs(places.sin[id] - start.sin[id]) * floes.reach[id] < 0.3 / view.scale;
  const seen = start.ids.filter((id) => view.shows(start.x[id], start.y[id], floes.reach[id]) && !isCovered(id));
  drawChunks(context, seen, (id) => traceFloe(context, view, floes, start, id), false);
}

/** Where floes of the scene are at the run's start. */
function startPlaces(run, motions, time) {
  const start = makePlaces(run, motions);
  start.setTime(time);
  start.ids = Array.from(start.living.subarray(0, start.count));
  return start;
}
