// Colours the waterlines by the ice loads up to the present time, from the peaks of contacts.csv.

// Length of the panels into which a waterline is divided [m]. `polynya loads` uses the same unless the scene records
// panels or --panel is given. Longer panels collect more peaks and show less detail.
const loadPanel = 2.5;
const loadSteps = 5; // number of colours of the scale

/** Colour for q from 0 to 1, from yellow to dark red in steps. */
function loadColour(q) {
  const step = Math.min(loadSteps - 1, Math.floor(loadSteps * q)) / (loadSteps - 1);
  return `hsl(${55 - 55 * step} 95% ${60 - 30 * step}%)`;
}

/** Length of a waterline, whose ring runs counter-clockwise, and distance along it from its first vertex to its stem
 * [m]. The stem is the foremost vertex or the middle of a foremost edge, as in simulation/ship/waterline.cpp, so that
 * peaks lie where they were recorded. */
function waterlineOf(ring) {
  const next = (k) => ring.at(k - ring.length + 1);
  const sides = ring.map(([x, y], k) => Math.hypot(x - next(k)[0], y - next(k)[1]));
  const most = Math.max(...ring.map(([x]) => x)) - 1e-9;
  const first = ring.findIndex(([x], k) => x >= most && ring.at(k - 1)[0] < most);
  const isEdge = next(first)[0] >= most;
  const sumOf = (lengths) => lengths.reduce((sum, length) => sum + length, 0);
  return { ring, length: sumOf(sides), stem: sumOf(sides.slice(0, first)) + (isEdge ? sides[first] / 2 : 0) };
}

/** Makes the loads along the hulls from peaks, which are sorted by time: those in the page's range of time, also from
 * floes that the page lacks. A peak is the largest normal force of one contact with ice (docs/run-folder.md,
 * contacts.csv). panelsAt() gives the largest peak [N], and the sum [N] and number of all peaks, for each panel of each
 * ship up to a time; it continues from the previous time if time advances. A ship has `sides` panels on each side of
 * its stem, in ascending order of the arc length from the stem, which is positive to port. `most` is the largest peak
 * of all ships and times of the page [N], so that the scale of colours does not change. */
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

/** Draws the largest load of each panel along the hulls, or with `isMean` the mean of its peaks; if both layers are on,
 * the largest. Returns a notice if the page has no peaks: the scene records no contacts, or ice pressed too little. */
function drawLoadLine(context, view, loadLine, motions, time, isMean) {
  if (loadLine.most === 0) return "This run recorded no peaks of loads.";
  loadLine.panelsAt(time).forEach((panels, ship) => {
    const pose = motions.ship(ship);
    if (!pose) return;
    const [{ ring, length, stem }, side] = [loadLine.lines[ship], loadLine.sides[ship]];
    inShipFrame(context, view, pose, (pixel) => {
      traceLine(context, ring);
      context.closePath();
      panels.forEach(({ largest, sum, count }, k) => { // draw a dash as long as the panel at its place
        if (count === 0) return;
        const [from, to] = [k - side, k - side + 1].map((n) =>
          Math.max(-length / 2, Math.min(length / 2, n * loadPanel)));
        context.setLineDash([to - from, length - (to - from)]);
        context.lineDashOffset = -(stem + from);
        strokeWith(context, loadColour((isMean ? sum / count : largest) / loadLine.most), 5 * pixel);
      });
    });
  });
}
