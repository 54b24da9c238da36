// What became of each floe, from its lineage and its area: whole, cut, split off, broken off by bending, or come up from under a hull.

const breakages = { whole: 0, cut: 1, split: 2, bend: 3, cameUp: 4 };
const cutShare = 0.2; // of the area of the scene's floe: a piece that holds as much is what is left of it

/**
 * For each floe one of `breakages`. Whole: no fracture since the scene. Cut: what is left of a floe of the scene: the
 * largest piece of each bend, and every piece that holds a fifth of it. Off: all else, by the kind of fracture that freed it;
 * the largest piece of a piece that broke off stays what that was. What came up from under a hull stays that, and its pieces too.
 */
function breakagesOf({ floes, info, breakOf }) {
  const of = new Uint8Array(floes.count);
  for (let i = 0; i < floes.count; ++i) {
    const parent = floes.parent[i];
    if (parent < 0) continue;
    const isBend = info.events[breakOf.get(parent)]?.kind !== "split";
    const isLargest = floes.children.get(parent).every((other) => floes.area[other] <= floes.area[i]);
    const isLeft = of[parent] <= breakages.cut;
    if (floes.cameUp[i]) of[i] = breakages.cameUp;
    else if (isLeft && ((isBend && isLargest) || floes.area[i] >= cutShare * floes.area[floes.oldest[i]])) of[i] = breakages.cut;
    else if (!isLeft && isLargest) of[i] = of[parent];
    else of[i] = isBend ? breakages.bend : breakages.split;
  }
  return of;
}
