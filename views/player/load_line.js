// The waterlines coloured by the loads that the ice has put on them up to the instant, by peaks of contacts.csv.

const loadPanel = 2.5; // along the waterline [m]
const loadSteps = 5;

/** A colour of q from 0 to 1: yellow to dark red, in steps. */
function loadColour(q) {
  const step = Math.min(loadSteps - 1, Math.floor(loadSteps * q)) / (loadSteps - 1);
  return `hsl(${55 - 55 * step} 95% ${60 - 30 * step}%)`;
}

/** A waterline from its stem to port (simulation/ship/waterline.cpp): its length, and the point at an arc. */
function waterlineOf(ring) {
  const most = Math.max(...ring.map(([x]) => x)) - 1e-9;
  const first = ring.findIndex(([x], k) => x >= most && ring.at(k - 1)[0] < most);
  const points = [...ring.slice(first), ...ring.slice(0, first + 1)];
  const arcs = [0];
  for (let k = 1; k < points.length; ++k)
    arcs.push(arcs[k - 1] + Math.hypot(points[k][0] - points[k - 1][0], points[k][1] - points[k - 1][1]));
  const length = arcs.at(-1);
  const stem = points[1][0] >= most ? arcs[1] / 2 : 0;
  return {
    length,
    at(arc) {
      const along = (((arc + stem) % length) + length) % length;
      const k = Math.min(lastAtMost(arcs, along), points.length - 2);
      const share = (along - arcs[k]) / (arcs[k + 1] - arcs[k]);
      return [0, 1].map((axis) => points[k][axis] + share * (points[k + 1][axis] - points[k][axis]));
    },
  };
}

/** The largest peak and the sum and number of all of each panel of each ship, up to an instant. Goes on from the last
 * instant where time goes on. */
function makeLoadLine({ info, columns }) {
  const lines = info.ships.map(({ waterline_m: ring }) => waterlineOf(ring));
  const sides = lines.map(({ length }) => Math.ceil(length / 2 / loadPanel));
  const empty = () => sides.map((n) => Array.from({ length: 2 * n }, () => ({ largest: 0, sum: 0, count: 0 })));
  const times = columns.peak_t_s;
  let [panels, next] = [empty(), 0];
  return {
    lines, sides,
    panelsAt(time) {
      if (next > 0 && times[next - 1] > time) [panels, next] = [empty(), 0];
      for (; next < times.length && times[next] <= time; ++next) {
        const ship = columns.peak_ship[next];
        const column = Math.floor(columns.peak_arc_m[next] / loadPanel) + sides[ship];
        const panel = panels[ship][Math.max(0, Math.min(2 * sides[ship] - 1, column))];
        const force = columns.peak_force_N[next];
        panel.largest = Math.max(panel.largest, force);
        panel.sum += force;
        ++panel.count;
      }
      return panels;
    },
    most: columns.peak_force_N.reduce((most, force) => Math.max(most, force), 0),
  };
}

/** Draws them along the hulls. Returns the notice to show where there are none. */
function drawLoadLine(context, view, loadLine, motions, time, isMean) {
  if (loadLine.most === 0) return "This run recorded no peaks of loads.";
  context.lineWidth = 5;
  context.lineCap = "butt";
  loadLine.panelsAt(time).forEach((panels, ship) => {
    const pose = motions.ship(ship);
    if (!pose) return;
    const [line, side, place] = [loadLine.lines[ship], loadLine.sides[ship], placedBy(pose)];
    panels.forEach(({ largest, sum, count }, k) => {
      if (count === 0) return;
      const [from, to] = [k - side, k - side + 1].map((n) =>
        Math.max(-line.length / 2, Math.min(line.length / 2 - 1e-6, n * loadPanel)));
      context.strokeStyle = loadColour((isMean ? sum / count : largest) / loadLine.most);
      traceLine(context, [0, 0.25, 0.5, 0.75, 1].map((share) =>
        view.toScreen(...place(...line.at(from + share * (to - from))))));
      context.stroke();
    });
  });
  return "";
}
