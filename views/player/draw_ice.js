// The ice on the map: many floes pixel by pixel, few as paths, what stays as a picture.

// Fills small floes pixel by pixel, row by row between where their edges cross it. A browser without a GPU takes some
// 5 µs for a path of a few pixels, this takes a fifth of it.

const rasterReach = 24; // [device px]; floes that reach farther are the canvas' own work
const rasterRows = 2 * rasterReach + 3;
const mostCrossings = 16; // of a row; a floe of this size with more has its row left out

/** A CSS colour "#rrggbb", or one a part of the way to another, as a pixel: red in the lowest byte, alpha in the
 * highest. */
function pixelOf(colour, other = colour, part = 0) {
  const channel = (css, k) => parseInt(css.slice(1 + 2 * k, 3 + 2 * k), 16);
  const mixed = [0, 1, 2].map((k) => Math.round(channel(colour, k) + part * (channel(other, k) - channel(colour, k))));
  return -0x1000000 | (mixed[2] << 16) | (mixed[1] << 8) | mixed[0];
}

class FloeRaster {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d");
    this.crossings = new Float64Array(rasterRows * mostCrossings); // x of each row, not in order
    this.counts = new Int32Array(rasterRows);
    this.width = 0;
    this.height = 0;
    this.image = null;
    this.pixels = null;
  }

  begin(width, height) {
    if (this.width === width && this.height === height) {
      this.pixels.fill(0);
      return;
    }
    this.canvas.width = this.width = width;
    this.canvas.height = this.height = height;
    this.image = this.context.createImageData(width, height);
    this.pixels = new Int32Array(this.image.data.buffer);
  }

  /** Fills a floe; pixels at its edge get the colour `rim`. */
  add(floes, places, view, id, fill, rim) {
    const scale = view.scale * view.ratio;
    const reach = floes.reach[id] * scale;
    const x0 = ((places.x[id] - view.x) * view.scale + view.width / 2) * view.ratio;
    const centreY = ((view.y - places.y[id]) * view.scale + view.height / 2) * view.ratio;
    const top = Math.floor(centreY - reach);
    const y0 = centreY - top;
    const rows = Math.ceil(y0 + reach) + 1;
    this.counts.fill(0, 0, rows);
    this.crossEdges(floes, id, { x0, y0, c: places.cos[id] * scale, s: places.sin[id] * scale });
    for (let row = 0; row < rows; ++row) this.order(row);
    this.fillRows(top, rows, fill, rim);
  }

  /** Notes the crossings of a floe's edges, its centroid at (x0, y0) from the first row's top, turned and scaled by (c,
   * s). */
  crossEdges(floes, id, { x0, y0, c, s }) {
    const { ringsOf, ringEnds } = floes;
    const { points, first } = floes.shape(id);
    const cx = floes.cx[id];
    const cy = floes.cy[id];
    let k = first;
    for (let ring = ringsOf[id]; ring < ringsOf[id + 1]; ++ring) {
      const end = first + ringEnds[ring];
      const lastX = points[2 * end - 2] - cx;
      const lastY = points[2 * end - 1] - cy;
      let ax = x0 + c * lastX - s * lastY;
      let ay = y0 - s * lastX - c * lastY;
      for (; k < end; ++k) {
        const px = points[2 * k] - cx;
        const py = points[2 * k + 1] - cy;
        const bx = x0 + c * px - s * py;
        const by = y0 - s * px - c * py;
        if (k + 1 < end && Math.abs(bx - ax) < 0.5 && Math.abs(by - ay) < 0.5) continue;
        this.cross(ax, ay, bx, by);
        ax = bx;
        ay = by;
      }
    }
  }

  /** Notes where an edge crosses the middles of rows, y from the first row's top. */
  cross(ax, ay, bx, by) {
    const { crossings, counts } = this;
    const slope = (bx - ax) / (by - ay);
    const end = Math.ceil(Math.max(ay, by) - 0.5);
    for (let row = Math.ceil(Math.min(ay, by) - 0.5); row < end; ++row) {
      const count = counts[row];
      if (count === mostCrossings) continue;
      crossings[row * mostCrossings + count] = ax + (row + 0.5 - ay) * slope;
      counts[row] = count + 1;
    }
  }

  /** Puts a row's crossings in order. */
  order(row) {
    const { crossings } = this;
    const first = row * mostCrossings;
    const end = first + this.counts[row];
    for (let k = first + 1; k < end; ++k) {
      const x = crossings[k];
      let at = k;
      for (; at > first && crossings[at - 1] > x; --at) crossings[at] = crossings[at - 1];
      crossings[at] = x;
    }
  }

  /** Fills between the crossings of each row; the first row is `top` on the screen. */
  fillRows(top, rows, fill, rim) {
    const { crossings, counts, width } = this;
    const end = Math.min(rows, this.height - top);
    for (let row = Math.max(0, -top); row < end; ++row) {
      const first = row * mostCrossings;
      for (let n = 0; n + 1 < counts[row]; n += 2) {
        const left = crossings[first + n];
        const right = crossings[first + n + 1];
        this.fillSpan((top + row) * width, left, right, rim);
        if (rim !== fill && counts[row] === 2) this.fillInside((top + row) * width, row, left, right, fill);
      }
    }
  }

  /** Ice from left to right in the row that begins at pixel `at`: its ends in part, between them `rim`. */
  fillSpan(at, left, right, rim) {
    const { width, pixels } = this;
    const start = Math.floor(left);
    const end = Math.floor(right);
    if (end < 0 || start >= width) return;
    if (start >= 0) this.lay(at + start, rim, start === end ? right - left : start + 1 - left);
    const last = at + Math.min(end, width);
    for (let to = at + Math.max(start + 1, 0); to < last; ++to) pixels[to] = rim;
    if (end > start && end < width) this.lay(at + end, rim, right - end);
  }

  /** Where the rows above and below have ice too it is not the edge. */
  fillInside(at, row, left, right, fill) {
    const { counts, crossings, pixels } = this;
    if (row === 0 || counts[row - 1] !== 2 || counts[row + 1] !== 2) return;
    const above = (row - 1) * mostCrossings;
    const below = (row + 1) * mostCrossings;
    const start = Math.floor(Math.max(left, crossings[above], crossings[below]));
    const end = at + Math.min(this.width, Math.ceil(Math.min(right, crossings[above + 1], crossings[below + 1])) - 1);
    for (let to = at + Math.max(0, start + 1); to < end; ++to) pixels[to] = fill;
  }

  /** Covers a part of a pixel. Floes beside each other share it, so their parts add up; the larger gives the colour. */
  lay(at, colour, part) {
    const { pixels } = this;
    const old = pixels[at] >>> 24;
    const now = Math.round(255 * part);
    pixels[at] = (Math.min(255, old + now) << 24) | ((now > old ? colour : pixels[at]) & 0xffffff);
  }

  /** Lays what was added over a canvas of that size. */
  put(target, view) {
    this.context.putImageData(this.image, 0, 0);
    target.resetTransform();
    target.drawImage(this.canvas, 0, 0);
    target.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  }
}

// Places the floes alive at a time and draws them. Floes of one class go into paths of some fifty points
// each: far fewer calls than a path a floe, and far faster to fill than one path for all.

const pointsInPath = 50;
const smallReach = 5; // [px]; floes that reach less far have no edge drawn
const rimParts = [0, 0.1, 0.2, 0.3, 0.4,
  0.5]; // of the edge's colour at the edge of small floes, a part for each 5 px of reach
const manySmall = 1000; // floes; more than these are drawn pixel by pixel

/** Floe ids so that neighbours in the scene follow each other: a path of some of them covers little of the screen. */
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

/** Draws the floes of these ids that show on the screen: small ones pixel by pixel, the others as paths. `look` has
 * their colours. */
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

// Ice at rest, drawn once and kept as a picture. Most floes of a large field do not move for a while: then only
// the others are drawn again. The picture serves as long as the view stays and none of its floes has to move.

function makeStillIce(run, places, motions) {
  const { floes } = run;
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const kept = { look: "", from: 0, until: -1, loose: [] };

  /** Whether a floe stays where it is for a time, to a quarter of a pixel. */
  function stays(id, view, duration, endFrame) {
    if (!motions.isSteady(id, endFrame)) return false;
    const speed = Math.hypot(places.vx[id], places.vy[id]) + Math.abs(places.spin[id]) * floes.reach[id];
    return speed * duration * view.scale < 0.25;
  }

  function rebuild(view, time, until, draw) {
    const endFrame = lastAtMost(run.frames.times, until) + 1;
    const still = [];
    kept.loose = [];
    for (const id of places.living.subarray(0, places.count)) {
      if (floes.floatsUntil[id] > until && stays(id, view, until - time, endFrame)) still.push(id);
      else kept.loose.push(id);
    }
    for (const child of bornBetween(time, until)) kept.loose.push(child);
    canvas.width = Math.round(view.width * view.ratio);
    canvas.height = Math.round(view.height * view.ratio);
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    draw(context, still);
    Object.assign(kept, { from: time, until });
  }

  function bornBetween(from, until) {
    const ids = [];
    for (let i = 0; i < floes.count; ++i) if (floes.born[i] > from && floes.born[i] <= until) ids.push(i);
    return ids;
  }

  /** Draws all ice alive at the time. `look` names the view and the colours; `ahead` [s] is how long a picture is to
   * last. */
  return function drawAll(target, view, look, time, ahead, draw) {
    if (look !== kept.look) { // the view moves: no picture would serve twice
      Object.assign(kept, { look, until: -1 });
      draw(target, places.living.subarray(0, places.count));
      return;
    }
    if (time < kept.from || time > kept.until) rebuild(view, time, time + ahead, draw);
    target.resetTransform();
    target.drawImage(canvas, 0, 0);
    target.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    draw(target, kept.loose.filter((id) => places.isAlive(id, time)));
  };
}
