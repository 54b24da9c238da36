// The camera of the map. y points up in the world and down on the screen.

/** Makes the camera of an element, `stage`, in which `canvases` lie. (x, y) is the point of the world in the middle
 * [m], `scale` the size of a metre [px]. Zooming limits it to 0.001, at which 1000 px show 1000 km, and 400, at
 * which they show 2.5 m; `fit` may exceed these limits. `width` and `height` are those of the element [px];
 * `ratio` is the number of the canvas's own pixels per pixel of the page, at most 2. */
function makeMapView(stage, canvases) {
  const view = { x: 0, y: 0, scale: 1, width: 1, height: 1, ratio: 1 };

  view.resize = () => {
    const box = stage.getBoundingClientRect();
    view.width = Math.max(1, box.width);
    view.height = Math.max(1, box.height);
    for (const canvas of canvases) view.ratio = sizeCanvas(canvas, view.width, view.height);
  };
  view.toScreen = (x, y) => [(x - view.x) * view.scale + view.width / 2, (view.y - y) * view.scale + view.height / 2];
  view.toWorld = (px, py) => [(px - view.width / 2) / view.scale + view.x,
    view.y - (py - view.height / 2) / view.scale];

  /** Zooms so that the point of the world under the given screen point stays there. */
  view.zoomAt = (px, py, factor) => {
    const [x, y] = view.toWorld(px, py);
    view.scale = Math.min(400, Math.max(1e-3, view.scale * factor));
    const [newX, newY] = view.toWorld(px, py);
    view.x += x - newX;
    view.y += y - newY;
  };
  /** Moves the map by a distance on the screen [px]. */
  view.panBy = (dx, dy) => {
    view.x -= dx / view.scale;
    view.y += dy / view.scale;
  };
  /** Shows a box of the world [m], whose width and height must not both be 0, with a margin of 2 % of its size on each
   * side; on one axis the margins may be larger. */
  view.fit = (box) => {
    const margin = 1.04;
    view.x = (box.left + box.right) / 2;
    view.y = (box.bottom + box.top) / 2;
    view.scale = Math.min(view.width / ((box.right - box.left) * margin),
      view.height / ((box.top - box.bottom) * margin));
  };
  /** Returns true if the square around a disc of the world [m] overlaps the screen. */
  view.shows = (x, y, radius) =>
    Math.abs(x - view.x) - radius < view.width / 2 / view.scale
      && Math.abs(y - view.y) - radius < view.height / 2 / view.scale;
  return view;
}

/** Extends a box so that it contains a point. */
function includePoint(box, x, y) {
  box.left = Math.min(box.left, x);
  box.right = Math.max(box.right, x);
  box.bottom = Math.min(box.bottom, y);
  box.top = Math.max(box.top, y);
}

/** Box around the floating floes of a run at the times of `range`, its start and end, and around the ships in all
 * frames [m]. Each ship has the room of its hull at any heading. Without floes and ships it is a square with a side of
 * 100 m. Floes are not considered at times between. `places` is left at the end of `range` until the first drawing.
 * `player.box`, to which the map is fitted, also has planned routes, and with two runs side by side the other run. */
function extentOf(run, motions, places, range) {
  const { floes, info, frames } = run;
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  const include = (x, y) => includePoint(box, x, y);
  for (const time of range) {
    places.setTime(time);
    for (const i of places.living.subarray(0, places.count)) {
      const place = placedBy([places.x[i], places.y[i], Math.atan2(places.sin[i], places.cos[i])]);
      const points = floes.shape(i);
      for (let k = 0; k < points.length; k += 2)
        include(...place(points[k] - floes.cx[i], points[k + 1] - floes.cy[i]));
    }
  }
  info.ships.forEach((ship, index) => {
    const reach = Math.max(...ship.waterline_m.map(([x, y]) => Math.hypot(x, y)));
    for (let f = 0; f < frames.times.length; ++f) {
      const [x, y] = motions.shipInFrame(index, f);
      include(x - reach, y - reach);
      include(x + reach, y + reach);
    }
  });
  if (!(box.right > box.left)) return { left: -50, right: 50, bottom: -50, top: 50 };
  return box;
}
