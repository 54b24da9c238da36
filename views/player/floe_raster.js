// Fills small floes pixel by pixel, row by row between where their edges cross it. A browser without a GPU takes some
// 5 µs for a path of a few pixels, this takes a fifth of it.

const rasterReach = 24; // [device px]; floes that reach farther are the canvas' own work
const rasterRows = 2 * rasterReach + 3;
const mostCrossings = 16; // of a row; a floe of this size with more has its row left out

/** A CSS colour "#rrggbb", or one a part of the way to another, as a pixel: red in the lowest byte, alpha in the highest. */
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

  /** Notes the crossings of a floe's edges, its centroid at (x0, y0) from the first row's top, turned and scaled by (c, s). */
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
