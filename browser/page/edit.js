// Editing a scene with the mouse. Moving an object changes the text of the scene.

const handleReach = 14; // largest distance from the middle of a handle at which it can be grabbed [px]

const rounded = (value, digits) => Number(value.toFixed(digits));
/** A position in the form of scenes, with as many digits as a pixel resolves. */
const placeWords = (view, [x, y]) => {
  const digits = Math.max(0, Math.min(3, Math.ceil(Math.log10(view.scale))));
  return [rounded(x, digits), rounded(y, digits)];
};

/** Position of the handle that turns a ship. */
function bowOf(run, view, ship) {
  const pose = run.motions.ship(ship);
  const reach = Math.max(...run.info.ships[ship].waterline_m.map(([x]) => x)) + 26 / view.scale;
  return view.toScreen(...placedBy(pose)(reach, 0));
}

/** Paths of the text's entries for hulls: ships, structures, walls, in this order. */
function hullPaths(text) {
  const root = parseText(text);
  return ["ships", "structures", "walls"].flatMap((list) =>
    (nodeAt(root, [list])?.items ?? []).map((_, k) => [list, k]));
}

/** Paths and positions of the waypoints in the text. */
function waypointsOf(text) {
  const root = parseText(text);
  return (nodeAt(root, ["ships"])?.items ?? []).flatMap((_, ship) => {
    const path = ["ships", ship, "pilot", "route", "waypoints"];
    return (nodeAt(root, path)?.items ?? []).map((__, k) =>
      ({ path: [...path, k, "position_m"], at: valueOf(nodeAt(root, [...path, k, "position_m"])) }));
  });
}

/** Floes that are written one by one, each with one of its points. */
function floeEntries(text) {
  const root = parseText(text);
  return (nodeAt(root, ["floes"])?.items ?? []).flatMap((item, k) => {
    const value = valueOf(item);
    if (value.rectangle) return [{ path: ["floes", k], key: ["rectangle", "corner_m"], at: value.rectangle.corner_m,
      size: [value.rectangle.size_m].flat() }];
    return value.polygon ? [{ path: ["floes", k], key: ["polygon", "outer_m"], ring: value.polygon.outer_m }] : [];
  });
}

const isInRing = ([x, y], ring) => ring.reduce((isIn, [ax, ay], k) => {
  const [bx, by] = ring[(k + 1) % ring.length];
  return (ay > y) !== (by > y) && x < ((bx - ax) * (y - ay)) / (by - ay) + ax ? !isIn : isIn;
}, false);

const ringOf = ({ at, size, ring }) => ring ?? [at, [at[0] + size[0], at[1]],
  [at[0] + size[0], at[1] + (size[1] ?? size[0])], [at[0], at[1] + (size[1] ?? size[0])]];

/** Finds the object at a point of the screen [px]: the turning handle of a ship, a waypoint, a hull, a floe, or null.
 * */
function findHandle(run, view, text, at) {
  const isNear = ([x, y]) => Math.hypot(x - at[0], y - at[1]) < handleReach;
  const paths = hullPaths(text);
  const turned = run.info.ships.findIndex((ship, k) => paths[k]?.[0] === "ships" && isNear(bowOf(run, view, k)));
  if (turned >= 0) return { kind: "turn", path: paths[turned], hull: turned };
  const waypoint = waypointsOf(text).find((point) => isNear(view.toScreen(...point.at)));
  if (waypoint) return { kind: "waypoint", ...waypoint };
  const world = view.toWorld(...at);
  const hull = run.info.ships.findIndex(({ waterline_m: ring }, k) =>
    isInRing(world, ring.map((point) => placedBy(run.motions.ship(k))(...point))));
  if (hull >= 0 && paths[hull] && paths[hull][0] !== "walls") return { kind: "hull", path: paths[hull], hull };
  const floe = floeEntries(text).findLast((entry) => isInRing(world, ringOf(entry)));
  return floe ? { kind: "floe", ...floe } : null;
}

/** Returns the text after the held object was moved from one point of the map to another [m]. */
function movedText(text, run, view, held, from, to) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const shifted = ([x, y]) => placeWords(view, [x + dx, y + dy]);
  if (held.kind === "turn") {
    const [x, y] = run.motions.ship(held.hull);
    const heading = (Math.atan2(to[1] - y, to[0] - x) * 180) / Math.PI;
    return withValue(text, [...held.path, "heading_deg"], rounded(heading, 1));
  }
  if (held.kind === "waypoint") return withValue(text, held.path, placeWords(view, to));
  if (held.kind === "hull") {
    const path = [...held.path, "position_m"];
    return withValue(text, path, shifted(readValue(text, path) ?? [0, 0]));
  }
  const path = [...held.path, ...held.key];
  return withValue(text, path, held.ring ? held.ring.map(shifted) : shifted(held.at));
}

/** Objects that can be placed: the name of their list, and the entry for a position. */
const placeable = {
  floe: ["floes", ([x, y]) => ({ rectangle: { corner_m: [x - 10, y - 7], size_m: [20, 14] } })],
  structure: ["structures", (at) => ({ radius_m: 10, position_m: at })],
  wall: ["walls", ([x, y]) => ({ from_m: [x, y - 50], to_m: [x, y + 50] })],
  waypoint: ["", null],
};

/** Returns the text with another object at a position. A waypoint is added to the route of the first ship. */
function withPlaced(text, view, kind, at) {
  const place = placeWords(view, at);
  if (kind === "waypoint") {
    const path = ["ships", 0, "pilot", "route", "waypoints"];
    const count = nodeAt(parseText(text), path)?.items.length ?? 0;
    if (count > 0) return withValue(text, [...path, count], { position_m: place, speed_m_per_s: 3 });
    return withValue(text, ["ships", 0, "pilot"], { route: { waypoints: [{ position_m: place, speed_m_per_s: 3 }] } });
  }
  const [list, item] = placeable[kind];
  const count = nodeAt(parseText(text), [list])?.items?.length ?? 0;
  return withValue(text, [list, count], item(place));
}

/** Outlines the selected object and draws the handles of ships. */
function drawChosen(context, view, run, { handles, held }, colours) {
  for (const ship of handles) {
    const [x, y] = bowOf(run, view, ship);
    context.beginPath();
    context.arc(x, y, 7, 0, 2 * Math.PI);
    fillWith(context, colours.panel);
    strokeWith(context, colours.highlight, 2.5);
  }
  if (!held) return;
  const ring = held.kind === "hull" ? run.info.ships[held.hull].waterline_m.map((point) =>
    placedBy(run.motions.ship(held.hull))(...point)) : held.kind === "floe" ? ringOf(held) : null;
  if (!ring) return;
  traceLine(context, ring.map((point) => view.toScreen(...point)));
  context.closePath();
  strokeWith(context, colours.highlight, 2.5);
}
