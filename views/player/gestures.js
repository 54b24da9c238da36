// Mouse, pen and fingers on the map: drag to pan, wheel or two fingers to zoom, point to identify, click to keep.

const clickSlop = 5; // [px]

/** Where a pointer is in an element [px]. */
function pointIn(element, { clientX, clientY }) {
  const box = element.getBoundingClientRect();
  return [clientX - box.left, clientY - box.top];
}

/** How far a wheel was turned: the logarithm of the zoom it asks for. */
function wheelTurn({ deltaY, deltaMode, ctrlKey }) {
  return (deltaMode === 1 ? 33 * deltaY : deltaY) * (ctrlKey ? 0.01 : 0.0015);
}

/** Pans and zooms by a move of one of two fingers. */
function pinch(before, after, actions) {
  const spread = ([a, b]) => ({ x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, size: Math.hypot(a[0] - b[0], a[1] - b[1]) });
  const [was, is] = [spread(before), spread(after)];
  actions.pan(is.x - was.x, is.y - was.y);
  actions.zoom(is.x, is.y, is.size / Math.max(1, was.size));
}

function watchGestures(stage, actions) {
  const fingers = new Map(); // pointer id → [x, y]
  let moved = 0;
  let lastTap = -Infinity;

  stage.addEventListener("pointerdown", (event) => {
    if (event.target.closest("button")) return;
    stage.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, pointIn(stage, event));
    moved = fingers.size === 1 ? 0 : Infinity;
  });
  stage.addEventListener("pointermove", (event) => {
    const at = pointIn(stage, event);
    const last = fingers.get(event.pointerId);
    if (!last) {
      if (event.pointerType !== "touch") actions.hover(...at);
      return;
    }
    const [dx, dy] = [at[0] - last[0], at[1] - last[1]];
    moved += Math.hypot(dx, dy);
    if (fingers.size === 1 && moved <= clickSlop) return;
    const before = [...fingers.values()];
    fingers.set(event.pointerId, at);
    if (fingers.size === 1) actions.pan(dx, dy);
    else if (fingers.size === 2) pinch(before, [...fingers.values()], actions);
  });
  const lift = (event) => {
    if (!fingers.delete(event.pointerId) || event.type === "pointercancel") return;
    if (moved > clickSlop || fingers.size > 0) return;
    const at = pointIn(stage, event);
    const isDouble = event.timeStamp - lastTap < 300;
    lastTap = isDouble ? -Infinity : event.timeStamp;
    if (isDouble) actions.zoom(...at, 2);
    else actions.click(...at);
  };
  for (const name of ["pointerup", "pointercancel"]) stage.addEventListener(name, lift);
  stage.addEventListener("pointerleave", () => actions.leave());
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    actions.zoom(...pointIn(stage, event), Math.exp(-wheelTurn(event)));
  }, { passive: false });
}
