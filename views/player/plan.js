// A scene before it runs: routes, wind and current, warnings of `polynya validate`, and positions to copy. The data is
// in `plan` of the page's options (views/player/scene_plan.cpp).

const currentCell = 110; // distance between the arrows of the current [px]
const longestArrow = 40; // length of the arrow of the fastest current on the screen [px]

/** Draws arrows of the current over ground at the start of the scene. Returns the speed of the fastest one [m/s]; water
 * outside the visible part of the map may be faster. */
function drawCurrent(context, view, run, colours) {
  const arrows = [];
  for (let px = currentCell / 2; px < view.width; px += currentCell) {
    for (let py = currentCell / 2; py < view.height; py += currentCell) {
      const [x, y] = view.toWorld(px, py);
      const [toX, toY] = run.carry(x, y, 0, 1); // displacement in one second
      arrows.push([px, py, toX - x, toY - y]);
    }
  }
  const fastest = Math.max(0, ...arrows.map(([, , vx, vy]) => Math.hypot(vx, vy)));
  if (fastest === 0) return 0;
  context.beginPath();
  for (const [px, py, vx, vy] of arrows) {
    const length = (longestArrow * Math.hypot(vx, vy)) / fastest;
    if (length >= 3) traceArrow(context, px - (0.5 * length * vx) / Math.hypot(vx, vy),
      py + (0.5 * length * vy) / Math.hypot(vx, vy), vx, vy, length);
  }
  strokeTwice(context, colours.panel, colours.accent, 1.6);
  return fastest;
}

/** Draws the wind as one arrow in the direction to which it blows, of the same length at every speed, and the speeds
 * of wind and current as text. */
function drawWindAndWords(context, view, [wx, wy], fastest, { panel, ink }) {
  const wind = Math.hypot(wx, wy);
  if (wind > 0) {
    context.beginPath();
    traceArrow(context, view.width - 44 - (24 * wx) / wind, 34 + (24 * wy) / wind, wx, wy, 48);
    strokeTwice(context, panel, ink, 3);
    drawWords(context, `wind ${shortNumber(wind)} m/s`, view.width - 84, 38, ink, panel, "right");
  }
  if (fastest > 0)
    drawWords(context, `current up to ${shortNumber(fastest)} m/s`, view.width - 16, wind > 0 ? 78 : 26, ink, panel,
      "right");
}

/** Draws a route: the legs from the ship's position at the start, which is the first point, and at each waypoint its
 * number and the speed on the leg to it. */
function drawRoute(context, view, { points_m: points, speeds_m_per_s: speeds }, { panel, ink, highlight }) {
  traceLine(context, points.map((point) => view.toScreen(...point)));
  context.setLineDash([10, 4]);
  strokeTwice(context, panel, highlight, 2);
  context.setLineDash([]);
  points.slice(1).forEach((point, k) => {
    const [x, y] = view.toScreen(...point);
    context.beginPath();
    context.arc(x, y, 4.5, 0, 2 * Math.PI);
    fillWith(context, highlight);
    const [side, align] = x > view.width - 80 ? [-8, "right"] : [8, "left"];
    drawWords(context, `${k + 1}: ${shortNumber(speeds[k])} m/s`, x + side, y - 6, ink, panel, align);
  });
}

/** Draws a triangle above the place of a problem, with its number in the list. Hints and warnings differ in colour. */
function drawProblem(context, view, problem, number, colours) {
  const [x, y] = view.toScreen(...problem.point_m);
  traceLine(context, [[x, y - 32], [x + 11, y - 13], [x - 11, y - 13]]);
  context.closePath();
  fillWith(context, problem.severity === "hint" ? colours.accent : colours.split);
  strokeWith(context, colours.panel, 1.5);
  drawWords(context, String(number), x, y - 15, colours.ink, colours.panel);
}

function drawPlan(context, { plan, view, run, colours, state }) {
  const fastest = drawCurrent(context, view, run, colours);
  plan.routes.forEach((route) => drawRoute(context, view, route, colours));
  plan.problems.forEach((problem, k) => problem.point_m && drawProblem(context, view, problem, k + 1, colours));
  drawWindAndWords(context, view, plan.wind_m_per_s, fastest, colours);
  if (!state.place) return;
  const [x, y] = view.toScreen(...state.place);
  traceLine(context, [[x - 9, y], [x + 9, y], [x, y], [x, y - 9], [x, y + 9]]);
  strokeTwice(context, colours.panel, colours.highlight, 2);
}

/** Marks a position and copies its coordinates to the clipboard in the form of a scene: [x, y] in metres, with as many
 * digits as a pixel resolves. */
function pickPlace({ view, state }, px, py) {
  const digits = Math.max(0, Math.ceil(Math.log10(view.scale)));
  state.place = view.toWorld(px, py).map((value) => Number(value.toFixed(digits)));
  state.marksDirty = true;
  const words = `[${state.place.join(", ")}]`;
  copyText(words, `${words} m, copied`, `${words} m`);
}

/** Shows the problems of a scene instead of a run, and hides everything that needs time. A page of `polynya view
 * --watch` looks for a newer version each second. */
function fillPlan({ plan, run }) {
  document.body.classList.add("plan");
  byId("badge").textContent = `not run; until ${run.info.until_s} s`;
  byId("fit").title = "Whole scene (0)";
  byId("facts").previousElementSibling.textContent = "Scene";
  if (plan.problems.length > 0) {
    const lines = plan.problems.map(({ severity, path, words, line }) =>
      make("li", {}, `${severity}${line > 0 ? `, line ${line}` : ""}: ${path}: ${words}`));
    byId("facts").closest("section").before(make("section", { id: "problems" }, make("h2", {}, "validate warns"),
      make("ol", {}, ...lines)));
  }
  if (plan.stamp_file) setInterval(() => lookForNewer(plan), 1000);
}

/** Reloads the page if a newer version has been written. A script beside the page has the stamp of the newest version;
 * pages on disk may load scripts but not other files. */
function lookForNewer({ stamp, stamp_file: file }) {
  const script = make("script", { src: `${encodeURIComponent(file)}?${Date.now()}` });
  script.onload = script.onerror = () => {
    script.remove();
    if (window.polynyaStamp && window.polynyaStamp !== stamp) location.reload();
  };
  document.head.append(script);
}
