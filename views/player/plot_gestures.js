// Pointers on the plot: a drag goes to a time, the wheel and two fingers zoom, Shift and a drag choose a part of the run,
// a double click shows all of it again.

/** Pixels of the plot from its left, and the times there. */
function plotAxis(plot) {
  const { over } = plot.chart;
  return {
    pixel: (event) => Math.min(over.clientWidth, Math.max(0, pointIn(over, event)[0])),
    timeAt: (px) => plot.span[0] + (px / over.clientWidth) * (plot.span[1] - plot.span[0]),
  };
}

/** Moves and zooms the plot so that the times under two fingers stay under them. */
function pinchPlot(plot, { timeAt }, before, after) {
  const times = before.map(timeAt);
  const perPixel = Math.abs(times[1] - times[0]) / Math.max(8, Math.abs(after[1] - after[0]));
  const middle = (times[0] + times[1]) / 2 - ((after[0] + after[1]) / 2) * perPixel;
  plot.show(middle, middle + plot.chart.over.clientWidth * perPixel);
}

/** Moves the plot by the wheel where it is turned sideways or with Shift, else zooms it at the pointer. */
function turnPlot(plot, { pixel, timeAt }, range, event) {
  const length = plot.span[1] - plot.span[0];
  if (Math.abs(event.deltaX) > Math.abs(event.deltaY) || event.shiftKey) {
    const turned = (event.deltaX || event.deltaY) * (event.deltaMode === 1 ? 33 : 1);
    const way = (turned * length) / plot.chart.over.clientWidth;
    const move = Math.min(range[1] - plot.span[1], Math.max(range[0] - plot.span[0], way));
    if (plot.isZoomed()) event.preventDefault();
    plot.show(plot.span[0] + move, plot.span[1] + move);
    return;
  }
  if (event.deltaY > 0 && !plot.isZoomed()) return; // the page scrolls on
  event.preventDefault();
  const at = timeAt(pixel(event));
  const factor = Math.exp(wheelTurn(event));
  plot.show(at - factor * (at - plot.span[0]), at + factor * (plot.span[1] - at));
}

/** The part of the plot that is being chosen, from where on [px]; null where none is. */
function makeChosenSpan(over) {
  const element = make("div", { class: "chosen-span", hidden: "" });
  over.append(element);
  return {
    from: null,
    show(px) {
      element.hidden = this.from === null;
      if (element.hidden) return;
      element.style.left = `${Math.min(px, this.from)}px`;
      element.style.width = `${Math.abs(px - this.from)}px`;
    },
  };
}

function watchPlot(plot, range, onTime, reading) {
  const { over } = plot.chart;
  const axis = plotAxis(plot);
  const { pixel, timeAt } = axis;
  const pointers = new Map(); // pointer id → pixel from the left
  const chosen = makeChosenSpan(over);

  over.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    over.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, pixel(event));
    if (event.shiftKey) chosen.from = pixel(event);
    else if (pointers.size === 1) onTime(timeAt(pixel(event)));
  });
  over.addEventListener("pointermove", (event) => {
    const px = pixel(event);
    reading.show(timeAt(px), px);
    if (!pointers.has(event.pointerId)) return;
    const before = [...pointers.values()];
    pointers.set(event.pointerId, px);
    if (chosen.from !== null) chosen.show(px);
    else if (pointers.size === 1) onTime(timeAt(px));
    else if (pointers.size === 2) pinchPlot(plot, axis, before, [...pointers.values()]);
  });
  const lift = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.pointerType === "touch") reading.hide();
    if (chosen.from === null) return;
    const ends = [chosen.from, pixel(event)].sort((a, b) => a - b);
    chosen.from = null;
    chosen.show();
    if (event.type === "pointerup" && ends[1] - ends[0] > 4) plot.show(timeAt(ends[0]), timeAt(ends[1]));
  };
  for (const name of ["pointerup", "pointercancel"]) over.addEventListener(name, lift);
  over.addEventListener("pointerleave", reading.hide);
  over.addEventListener("dblclick", () => plot.show(...range));
  over.addEventListener("wheel", (event) => turnPlot(plot, axis, range, event), { passive: false });
}
