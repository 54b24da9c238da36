// The ruler: a line between two points of the map, with its length and direction.

/** Text beside a ruler, "123.4 m, 45.0°". The direction is counter-clockwise from the x axis. */
function rulerWords([[ax, ay], [bx, by]]) {
  return `${valueWords(Math.hypot(bx - ax, by - ay), "m")}, ${angleWords(Math.atan2(by - ay, bx - ax))}`;
}

function drawRuler(context, view, ends, { panel, ink, highlight }) {
  const [a, b] = ends.map((end) => view.toScreen(...end));
  const [length, tick] = [Math.hypot(b[0] - a[0], b[1] - a[1]), 7];
  if (length < 1) return;
  const [nx, ny] = [(-(b[1] - a[1]) * tick) / length, ((b[0] - a[0]) * tick) / length];
  context.beginPath();
  context.moveTo(...a);
  context.lineTo(...b);
  for (const [x, y] of [a, b]) {
    context.moveTo(x - nx, y - ny);
    context.lineTo(x + nx, y + ny);
  }
  strokeTwice(context, panel, highlight, 2);
  const words = rulerWords(ends);
  context.font = "600 12px system-ui, sans-serif";
  const half = 0.5 * context.measureText(words).width + 4;
  const inView = (value, room, end) => Math.min(end - room, Math.max(room, value));
  const [x, y] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) - 10];
  drawWords(context, words, inView(x, half, view.width), inView(y, 14, view.height), ink, panel);
}

/** Actions of the ruler. While it is on, dragging on the map measures. */
function rulerActions({ state, view }) {
  return {
    toggleRuler(isOn = !state.isMeasuring) {
      state.isMeasuring = isOn;
      state.ruler = null;
      state.marksDirty = true;
      byId("ruler").setAttribute("aria-pressed", String(isOn));
      byId("stage").classList.toggle("measures", isOn);
      if (isOn) showToast("drag on the map to measure; Esc or M ends it");
    },
    /** Starts a measurement at a point of the screen. */
    rulerFrom(px, py) {
      state.ruler = [view.toWorld(px, py), view.toWorld(px, py)];
      state.marksDirty = true;
    },
    rulerTo(px, py) {
      if (!state.ruler) return;
      state.ruler[1] = view.toWorld(px, py);
      state.marksDirty = true;
    },
  };
}
