// Mouse, pen and fingers on the map: drag to pan, wheel or two fingers to zoom, point to identify, click to keep.

const clickSlop = 5; // [px]

function watchGestures(stage, view, actions) {
  const fingers = new Map(); // pointer id → [x, y]
  let moved = 0;
  let lastTap = -Infinity;
  const local = (event) => {
    const box = stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = ([a, b]) => ({ x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, size: Math.hypot(a[0] - b[0], a[1] - b[1]) });

  stage.addEventListener("pointerdown", (event) => {
    if (event.target.closest("button")) return;
    stage.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, local(event));
    if (fingers.size === 1) moved = 0;
    else moved = Infinity;
  });
  stage.addEventListener("pointermove", (event) => {
    const at = local(event);
    const before = fingers.get(event.pointerId);
    if (!before) {
      if (event.pointerType !== "touch") actions.hover(...at);
      return;
    }
    const [dx, dy] = [at[0] - before[0], at[1] - before[1]];
    moved += Math.hypot(dx, dy);
    if (fingers.size === 1) {
      if (moved > clickSlop) actions.pan(dx, dy);
      if (moved <= clickSlop) return;
    } else if (fingers.size === 2) {
      const was = spread([...fingers.values()]);
      fingers.set(event.pointerId, at);
      const is = spread([...fingers.values()]);
      actions.pan(is.x - was.x, is.y - was.y);
      actions.zoom(is.x, is.y, is.size / Math.max(1, was.size));
    }
    fingers.set(event.pointerId, at);
  });
  const lift = (event) => {
    if (!fingers.delete(event.pointerId) || event.type === "pointercancel") return;
    if (moved > clickSlop || fingers.size > 0) return;
    const at = local(event);
    const isDouble = event.timeStamp - lastTap < 300;
    lastTap = isDouble ? -Infinity : event.timeStamp;
    if (isDouble) actions.zoom(...at, 2);
    else actions.click(...at);
  };
  stage.addEventListener("pointerup", lift);
  stage.addEventListener("pointercancel", lift);
  stage.addEventListener("pointerleave", () => actions.leave());
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    const step = event.deltaMode === 1 ? 33 * event.deltaY : event.deltaY;
    actions.zoom(...local(event), Math.exp(-step * (event.ctrlKey ? 0.01 : 0.0015)));
  }, { passive: false });
}
