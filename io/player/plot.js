// The plot of loads against time, in step with the picture. Drawn by uPlot; the moment is a line laid over it.

const quantities = {
  surge_N: { label: "Surge force of the ice", base: "N" },
  sway_N: { label: "Sway force of the ice", base: "N" },
  yaw_Nm: { label: "Yaw moment of the ice", base: "N\u00b7m" },
  surge_j_over_tau_c_N: { label: "Peak surge j/\u03c4c", base: "N" },
  sway_j_over_tau_c_N: { label: "Peak sway j/\u03c4c", base: "N" },
  yaw_j_over_tau_c_Nm: { label: "Peak yaw j/\u03c4c", base: "N\u00b7m" },
  speed_m_per_s: { label: "Speed over ground", base: "m/s" },
  thrust_N: { label: "Thrust", base: "N" },
  force_contacts: { label: "Contacts at the hull", base: "" },
};

/** `onPlaced` is told the left end and the width of the axis of times [px]. */
function makePlot(run, host, onTime, onPlaced) {
  const plot = { quantity: "surge_N", chart: null };
  const cursor = make("div", { class: "now-line" });
  const { forces, info } = run;

  function unitOf(quantity) {
    const base = quantities[quantity].base;
    if (!base.startsWith("N")) return { factor: 1, name: base };
    let largest = 0;
    for (const rows of forces) for (const value of rows[quantity]) largest = Math.max(largest, Math.abs(value));
    return loadUnit(largest, base);
  }

  /** All ships over one axis of times, as uPlot wants it. */
  function table(quantity, factor) {
    const scaled = forces.map((rows) => Array.from(rows[quantity], (value) => value * factor));
    if (forces.length === 1) return [forces[0].force_t_s, scaled[0]];
    return uPlot.join(forces.map((rows, k) => [Array.from(rows.force_t_s), scaled[k]]));
  }

  function axis(colours, label) {
    return { stroke: colours.muted, grid: { stroke: colours.line, width: 1 }, ticks: { stroke: colours.line, width: 1, size: 4 },
      font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif", label, labelSize: 16, size: label ? 50 : 22, gap: 3 };
  }

  plot.build = (colours, range) => {
    plot.chart?.destroy();
    host.replaceChildren();
    const unit = unitOf(plot.quantity);
    plot.unit = unit;
    const height = host.clientHeight;
    const padding = [6, 24, 0, 0];
    plot.chart = new uPlot({
      width: host.clientWidth, height, padding,
      legend: { show: false },
      cursor: { show: false },
      hooks: { ready: [(chart) => onPlaced(chart.over.offsetLeft, chart.over.offsetWidth)] },
      scales: { x: { time: false, range: () => range } },
      axes: [{ ...axis(colours), values: (_, splits) => splits.map((t) => `${t} s`) },
        { ...axis(colours, unit.name ? `[${unit.name}]` : ""), size: 46, values: (_, splits) => splits.map((v) => minus(String(Number(v.toPrecision(6))))) }],
      series: [{}, ...info.ships.map((ship, k) => ({ label: ship.name, stroke: shipColour(colours, k), width: 1, points: { show: false } }))],
    }, forces.some((rows) => rows.force_t_s.length) ? table(plot.quantity, unit.factor) : [[], ...forces.map(() => [])], host);
    plot.chart.over.append(cursor);
    dragTime(plot.chart.over, (px) => onTime(plot.chart.posToVal(px, "x")));
  };

  plot.setTime = (time) => {
    plot.time = time;
    if (plot.chart?.over.offsetWidth) cursor.style.transform = `translateX(${plot.chart.valToPos(time, "x")}px)`;
  };

  /** A value in the unit that suits it. */
  plot.words = (value) => {
    const { base } = quantities[plot.quantity];
    const unit = base.startsWith("N") ? loadUnit(Math.abs(value), base) : { factor: 1, name: base };
    return minus(`${value === 0 ? "0" : Number.isInteger(value) ? value : (value * unit.factor).toPrecision(4)} ${unit.name}`.trim());
  };

  /** The row of forces.csv whose interval holds the time. */
  plot.valueAt = (ship, time) => {
    const times = forces[ship].force_t_s;
    if (times.length === 0) return null;
    const row = Math.min(times.length - 1, lastAtMost(times, time - 1e-9) + 1);
    return { time: times[row], value: forces[ship][plot.quantity][row] };
  };
  return plot;
}

/** Calls back with the pixel from the left while the pointer is held down on an element. */
function dragTime(element, onPixel) {
  let isDown = false;
  const tell = (event) => onPixel(event.clientX - element.getBoundingClientRect().left);
  element.addEventListener("pointerdown", (event) => {
    isDown = true;
    element.setPointerCapture(event.pointerId);
    tell(event);
  });
  element.addEventListener("pointermove", (event) => { if (isDown) tell(event); });
  for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, () => { isDown = false; });
}
