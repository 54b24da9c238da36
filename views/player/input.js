// Pointers and keys.

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
  const spread = ([a, b]) =>
    ({ x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, size: Math.hypot(a[0] - b[0], a[1] - b[1]) });
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

// Keys. The list is also the help.

const keyHelp = [
  ["Space", "play, pause"],
  ["\u2190 \u2192", "back, forward one frame; with Shift ten"],
  ["Home End", "start, end"],
  ["[ ]", "event before, event after"],
  ["< >", "slower, faster"],
  ["+ \u2212", "zoom"],
  ["W A S D", "move the map"],
  ["0", "whole run"],
  ["F", "follow the ship (the next ship)"],
  ["1 2 3 4", "colour by breakage, generation, speed, size"],
  ["H", "channel"], ["C", "contact circles"], ["V", "velocities"], ["P", "contact forces"], ["B", "fracture marks"],
  ["L", "copy a link to this instant"], ["I", "save the map as a picture (PNG); with Shift the plot"],
  ["X", "plot: full scale, or without spikes"],
  ["T", "light, dark"],
  ["Esc", "let go of the floe; close this"],
  ["?", "this help"],
];

/** Whether a key is for the control with the focus. Space and Escape are the page's on a list, which Enter opens. */
function isForControl({ target, key }) {
  if (target.closest("select")) return key !== " " && key !== "Escape";
  if (target.closest("input[type=number]")) return key !== "Escape";
  if (target.type === "radio" && key.startsWith("Arrow")) return true;
  return Boolean(target.closest("button, input")) && (key === " " || key === "Enter");
}

/** A control that a pointer has used gives the focus back to the page,
  so that Space plays; one that keys have reached keeps it, but
 * for a list once its choice is made. */
function returnFocus() {
  let byPointer = false;
  let lastKey = "";
  document.addEventListener("pointerdown", () => { byPointer = true; }, true);
  document.addEventListener("keydown", (event) => {
    byPointer = false;
    lastKey = event.key;
    if (event.key === "Enter" && event.target.closest("select") && event.target.showPicker) {
      event.preventDefault();
      event.target.showPicker();
    }
  }, true);
  const giveBack = ({ type, target }) => {
    const control = target.closest("button, select, input:not([type=number])");
    if (!control || control !== document.activeElement) return;
    const isList = control.tagName === "SELECT";
    if (isList ? type === "change" && (byPointer || !lastKey.startsWith("Arrow")) : byPointer) control.blur();
  };
  for (const name of ["change", "click"]) document.addEventListener(name, giveBack);
}

function watchKeys(actions) {
  const keys = {
    " ": () => actions.togglePlay(),
    ArrowLeft: (event) => actions.stepFrames(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => actions.stepFrames(event.shiftKey ? 10 : 1),
    Home: () => actions.goToEnd(false),
    End: () => actions.goToEnd(true),
    "[": () => actions.stepEvent(-1),
    "]": () => actions.stepEvent(1),
    "<": () => actions.changeRate(-1),
    ">": () => actions.changeRate(1),
    "+": () => actions.zoomCentre(1.4),
    "=": () => actions.zoomCentre(1.4),
    "-": () => actions.zoomCentre(1 / 1.4),
    0: () => actions.fit(),
    w: () => actions.pan(0, 60),
    a: () => actions.pan(60, 0),
    s: () => actions.pan(0, -60),
    d: () => actions.pan(-60, 0),
    f: () => actions.follow(),
    1: () => actions.colourBy("breakage"),
    2: () => actions.colourBy("generation"),
    3: () => actions.colourBy("speed"),
    4: () => actions.colourBy("size"),
    h: () => actions.toggleLayer("channel"),
    c: () => actions.toggleLayer("circles"),
    v: () => actions.toggleLayer("velocities"),
    p: () => actions.toggleLayer("forces"),
    b: () => actions.toggleLayer("fractures"),
    l: () => actions.copyLink(),
    i: (event) => (event.shiftKey ? actions.savePlot() : actions.saveMap()),
    x: () => actions.toggleFullScale(),
    t: () => actions.toggleTheme(),
    "?": () => actions.toggleHelp(),
    Escape: () => actions.letGo(),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!action || isForControl(event)) return;
    event.preventDefault();
    action(event);
  });
  returnFocus();
  byId("keys").replaceChildren(...keyHelp.flatMap(([key, words]) => [make("dt", {}, key), make("dd", {}, words)]));
}
