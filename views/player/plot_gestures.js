// Pointers on the plot: a drag goes to a time, the wheel and two fingers zoom, Shift and a drag choose a part of the run,
// a double click shows all of it again.

function watchPlot(plot, range, onTime, reading) {
  const { over } = plot.chart;
  const pointers = new Map(); // pointer id → pixel from the left
  const chosen = make("div", { class: "chosen-span", hidden: "" });
  over.append(chosen);
  let chosenFrom = null; // [px]
  const pixel = (event) => Math.min(over.clientWidth, Math.max(0, event.clientX - over.getBoundingClientRect().left));
  const timeAt = (px) => plot.span[0] + (px / over.clientWidth) * (plot.span[1] - plot.span[0]);

  function showChosen(px) {
    chosen.hidden = chosenFrom === null;
    if (chosen.hidden) return;
    chosen.style.left = `${Math.min(px, chosenFrom)}px`;
    chosen.style.width = `${Math.abs(px - chosenFrom)}px`;
  }

  /** Moves and zooms so that the times under two fingers stay under them. */
  function pinch(before, after) {
    const times = before.map(timeAt);
    const perPixel = Math.abs(times[1] - times[0]) / Math.max(8, Math.abs(after[1] - after[0]));
    const middle = (times[0] + times[1]) / 2 - ((after[0] + after[1]) / 2) * perPixel;
    plot.show(middle, middle + over.clientWidth * perPixel);
  }

  over.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    over.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, pixel(event));
    if (event.shiftKey) chosenFrom = pixel(event);
    else if (pointers.size === 1) onTime(timeAt(pixel(event)));
  });
  over.addEventListener("pointermove", (event) => {
    const px = pixel(event);
    reading.show(timeAt(px), px);
    if (!pointers.has(event.pointerId)) return;
    const before = [...pointers.values()];
    pointers.set(event.pointerId, px);
    if (chosenFrom !== null) showChosen(px);
    else if (pointers.size === 1) onTime(timeAt(px));
    else if (pointers.size === 2) pinch(before, [...pointers.values()]);
  });
  const lift = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.pointerType === "touch") reading.hide();
    if (chosenFrom === null) return;
    const ends = [chosenFrom, pixel(event)].sort((a, b) => a - b);
    chosenFrom = null;
    showChosen();
    if (event.type === "pointerup" && ends[1] - ends[0] > 4) plot.show(timeAt(ends[0]), timeAt(ends[1]));
  };
  over.addEventListener("pointerup", lift);
  over.addEventListener("pointercancel", lift);
  over.addEventListener("pointerleave", reading.hide);
  over.addEventListener("dblclick", () => plot.show(...range));
  over.addEventListener("wheel", (event) => {
    const step = event.deltaMode === 1 ? 33 : 1;
    const length = plot.span[1] - plot.span[0];
    if (Math.abs(event.deltaX) > Math.abs(event.deltaY) || event.shiftKey) {
      const way = ((event.deltaX || event.deltaY) * step * length) / over.clientWidth;
      const move = Math.min(range[1] - plot.span[1], Math.max(range[0] - plot.span[0], way));
      if (plot.isZoomed()) event.preventDefault();
      return plot.show(plot.span[0] + move, plot.span[1] + move);
    }
    if (event.deltaY > 0 && !plot.isZoomed()) return undefined; // the page scrolls on
    event.preventDefault();
    const at = timeAt(pixel(event));
    const factor = Math.exp(event.deltaY * step * (event.ctrlKey ? 0.01 : 0.0015));
    return plot.show(at - factor * (at - plot.span[0]), at + factor * (plot.span[1] - at));
  }, { passive: false });
}
