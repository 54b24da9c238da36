// The map of a growing run, drawn by the player's functions, and of a scene before it runs, with routes and problems.

const generationEdges = [1, 2, 3, 5, 10];

/** Colours of the floes. */
function liveLook(run, by, colours) {
  const edgeOf = () => colours["ice-edge"];
  const { floes, places } = run;
  if (by === "speed") {
    const edges = [0.05, 0.1, 0.2, 0.5, 1];
    return { fills: ramps.speed, edgeOf, title: "Speed [m/s]", edges,
      bucketOf: (id) => classOf(Math.hypot(places.vx[id], places.vy[id]), edges) };
  }
  if (by === "size") {
    const edges = roundEdges(Math.sqrt(floes.area.reduce((most, area) => Math.max(most, area), 1)));
    return { fills: ramps.size, edgeOf, title: "Size √area [m]", edges,
      bucketOf: (id) => classOf(Math.sqrt(floes.area[id]), edges) };
  }
  return { fills: ramps.generation, edgeOf, title: "Generations since the scene", edges: generationEdges,
    bucketOf: (id) => classOf(floes.generation[id], generationEdges) };
}

/** Box around everything in the scene [m]. */
function liveExtent(run) {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  const { places, floes } = run;
  for (const id of places.living) {
    includePoint(box, places.x[id] - floes.reach[id], places.y[id] - floes.reach[id]);
    includePoint(box, places.x[id] + floes.reach[id], places.y[id] + floes.reach[id]);
  }
  run.info.ships.forEach(({ waterline_m: ring }, k) => {
    const place = placedBy(run.motions.ship(k));
    for (const point of ring) includePoint(box, ...place(...point));
  });
  for (const { points_m: points } of run.words.options.plan.routes)
    for (const point of points) includePoint(box, ...point);
  if (!(box.right > box.left)) return { left: -50, right: 50, bottom: -50, top: 50 };
  box.right += 0.07 * (box.right - box.left); // leaves room for the buttons
  return box;
}

function drawEvents(context, view, run, colours) {
  for (const event of run.events.slice(-400)) {
    if (!event.point_m || run.time - event.t_s > 3 || !["bend", "split"].includes(event.kind)) continue;
    drawEventMark(context, ...view.toScreen(...event.point_m), event.kind, event.kind === "split" ? 5 : 3, colours);
  }
}

/** Draws a run in its present state. `chosen` is the object selected with the mouse (edit.js). */
function drawLive(context, view, run, { by, colours, isPlan, chosen }) {
  context.resetTransform();
  context.scale(view.ratio, view.ratio);
  context.fillStyle = colours.water;
  context.fillRect(0, 0, view.width, view.height);
  if (!run?.hasPlaces) return;
  drawFloes(context, view, run, run.places, run.places.living, liveLook(run, by, colours));
  const { plan } = run.words.options;
  if (isPlan) plan.routes.forEach((route) => drawRoute(context, view, route, colours));
  run.tracks.forEach((track) => {
    if (track.length > 1) drawDashed(context, view, track, colours.track, 2, [8, 5]);
  });
  run.info.ships.forEach((ship, k) => drawShip(context, view, ship, run.motions.ship(k), colours));
  drawIceUnderHulls(context, view, run, run.places, colours);
  drawEvents(context, view, run, colours);
  if (isPlan) plan.problems.forEach((problem, k) =>
    problem.point_m && drawProblem(context, view, problem, k + 1, colours));
  if (chosen) drawChosen(context, view, run, chosen, colours);
  drawWindAndWords(context, view, plan.wind_m_per_s, 0, colours);
  drawScaleBar(context, view, colours);
}
