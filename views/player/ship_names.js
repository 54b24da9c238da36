// Places the names of ships on the map beside their hulls, so that a name covers no hull and no other name.

const nameHeight = 15; // height of a name [px]
const nameStep = 4; // step by which a name is moved away from its ship until it is free [px]
const farthestName = 240; // a name is not moved farther than this; then it is not drawn [px]
// A name changes its side only if it is nearer to its ship there by this distance, so that it does not jump [px].
const keepsSide = 14;

/** Returns true if the segments from a to b and from c to d cross. */
function areCrossing([ax, ay], [bx, by], [cx, cy], [dx, dy]) {
  const side = (px, py, qx, qy, rx, ry) => (qx - px) * (ry - py) - (qy - py) * (rx - px);
  return side(ax, ay, bx, by, cx, cy) * side(ax, ay, bx, by, dx, dy) < 0
    && side(cx, cy, dx, dy, ax, ay) * side(cx, cy, dx, dy, bx, by) < 0;
}

/** Returns true if a rectangle overlaps the area inside a ring of points. */
function touchesRing({ left, right, top, bottom }, ring) {
  const corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
  const isInRectangle = ([x, y]) => x > left && x < right && y > top && y < bottom;
  return ring.some(isInRectangle) || isInRing(ring, left, top) || ring.some((point, k) =>
    corners.some((corner, n) => areCrossing(ring.at(k - 1), point, corners.at(n - 1), corner)));
}

const touchesBox = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** Directions from a ship in which a place for its name is tried, as [x, y] on the screen. Of equally near places the
 * earlier direction is taken. */
const nameSides = [[0, -1], [0, 1], [1, 0], [-1, 0], [0.7, -0.7], [-0.7, -0.7], [0.7, 0.7], [-0.7, 0.7]];

/** Returns the distance [px] by which a name must be moved from a ship's centre in a direction until it is free, and
 * the name's place there; only the distance Infinity if it never is. Half the width of the name is added sideways. */
function freeDistance([x, y], [sx, sy], width, isFree) {
  for (let far = 0; far <= farthestName; far += nameStep) {
    const [middle, centre] = [x + sx * (far + 0.5 * width * Math.abs(sx)), y + sy * far];
    const box = { left: middle - 0.5 * width - 3, right: middle + 0.5 * width + 3, top: centre - 0.5 * nameHeight,
      bottom: centre + 0.5 * nameHeight };
    if (isFree(box)) return { far, box };
  }
  return { far: Infinity };
}

/** Returns a function that draws the names of ships and returns their places, which tests check. `ships` have names and
 * outlines on the screen. The function remembers the side on which each name was. */
function makeNamePlacer() {
  const sides = new Map();
  return (context, view, ships, colours) => {
    context.font = "600 12px system-ui, sans-serif";
    const taken = [];
    const placed = [];
    const screen = { left: 0, right: view.width, top: 0, bottom: view.height };
    const isFree = (box) => box.left >= screen.left && box.right <= screen.right && box.top >= screen.top
      && box.bottom <= screen.bottom && !taken.some((other) => touchesBox(box, other))
      && !ships.some(({ ring }) => touchesRing(box, ring));
    for (const { name, centre, ring } of ships) {
      if (!ring.some(([x, y]) => x > 0 && y > 0 && x < view.width && y < view.height)) continue;
      const width = context.measureText(name).width;
      const found = nameSides.map((side, k) => ({ k, ...freeDistance(centre, side, width, isFree) }));
      const nearest = found.reduce((best, one) => (one.far < best.far ? one : best));
      const before = found[sides.get(name) ?? nearest.k];
      const { far, box, k } = before.far <= nearest.far + keepsSide ? before : nearest;
      if (far === Infinity) continue;
      sides.set(name, k);
      taken.push(box);
      placed.push({ name, box });
      drawWords(context, name, 0.5 * (box.left + box.right), box.bottom - 3.5, colours.ink, colours.panel);
    }
    return placed;
  };
}
