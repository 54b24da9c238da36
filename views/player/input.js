// Input by pointers and keys.

// Mouse, pen and fingers on the map: dragging pans, the wheel or two fingers zoom, pointing identifies, a click
// selects.

// Largest motion of a press that is still a click [px]. Larger values accept less steady hands, but dragging starts
// later. On the map it limits the length of the path, on the time axis the distance from the start.
const clickSlop = 5;

/** Position of a pointer in an element [px]. */
function pointIn(element, { clientX, clientY }) {
  const box = element.getBoundingClientRect();
  return [clientX - box.left, clientY - box.top];
}

/** Rotation of a wheel, as the logarithm of the factor by which the map shrinks: 0.0015 per px, so that a notch of some
 * 100 px zooms by 16 %. Some browsers give it in lines, here of 33 px. Pinching on a touchpad has ctrlKey and smaller
 * turns, hence 0.01 per px. Larger factors zoom faster. A wheel that scrolls by pages is not converted. */
function wheelTurn({ deltaY, deltaMode, ctrlKey }) {
  return (deltaMode === 1 ? 33 * deltaY : deltaY) * (ctrlKey ? 0.01 : 0.0015);
}

/** Tracks the pointers that are pressed on an element (map, plot, timeline, histogram); of a mouse only its main
 * button. Positions `at` are in pixels of the element. It calls `start(event, at, count)` when a pointer is pressed, as
 * one of `count`, `drag(at, before)` when a single pressed pointer moves, `pinch(after, before)` when one of two moves,
 * and `end(event, at)` when the last is lifted or the browser cancels it. `hover(event, at)` is called for every move,
 * pressed or not. Moves of three or more pressed pointers neither drag nor pinch. */
function watchPointers(element, { start, drag, pinch, hover, end }) {
  const pressed = new Map(); // pointer id → [x, y]
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    element.setPointerCapture(event.pointerId);
    pressed.set(event.pointerId, pointIn(element, event));
    start?.(event, pointIn(element, event), pressed.size);
  });
  element.addEventListener("pointermove", (event) => {
    const at = pointIn(element, event);
    hover?.(event, at);
    if (!pressed.has(event.pointerId)) return;
    const before = [...pressed.values()];
    pressed.set(event.pointerId, at);
    if (pressed.size === 1) drag?.(at, before[0]);
    else if (pressed.size === 2) pinch?.([...pressed.values()], before);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    element.addEventListener(name, (event) => {
      if (pressed.delete(event.pointerId) && pressed.size === 0) end?.(event, pointIn(element, event));
    });
  }
}

/** Connects the map to the actions. While isMeasuring() returns true, a drag measures and a click does nothing. A
 * second click or tap within 300 ms of the first doubles the scale there, wherever the first was; the first has already
 * selected. */
function watchMap(stage, actions, isMeasuring) {
  let moved = 0; // distance moved since the press [px]; with two fingers large, so that the press is no click
  let waiting = [0, 0]; // motion that is still too small to be more than a click [px]
  let lastTap = -Infinity;
  watchPointers(stage, {
    start(event, at, count) {
      moved = count === 1 ? 0 : Infinity;
      waiting = [0, 0];
      if (count === 1 && isMeasuring()) actions.rulerFrom(...at);
    },
    hover: (event, at) => event.buttons === 0 && event.pointerType !== "touch" && actions.hover(...at),
    drag(at, before) {
      if (isMeasuring()) return actions.rulerTo(...at);
      const step = [at[0] - before[0], at[1] - before[1]];
      moved += Math.hypot(...step);
      waiting = waiting.map((way, k) => way + step[k]);
      if (moved <= clickSlop) return;
      actions.pan(...waiting);
      waiting = [0, 0];
    },
    pinch(after, before) {
      const spread = ([a, b]) =>
        ({ x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, size: Math.hypot(a[0] - b[0], a[1] - b[1]) });
      const [was, is] = [spread(before), spread(after)];
      actions.pan(is.x - was.x, is.y - was.y);
      actions.zoom(is.x, is.y, is.size / Math.max(1, was.size));
    },
    end({ type, timeStamp }, at) {
      if (moved > clickSlop || type === "pointercancel" || isMeasuring()) return;
      const isDouble = timeStamp - lastTap < 300;
      lastTap = isDouble ? -Infinity : timeStamp;
      if (isDouble) actions.zoom(...at, 2);
      else actions.click(...at);
    },
  });
  stage.addEventListener("pointerleave", () => actions.leave());
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    actions.zoom(...pointIn(stage, event), Math.exp(-wheelTurn(event)));
  }, { passive: false });
}

// Controls and keys. A control describes itself by attributes: `data-do` names its action, `data-with` is the argument
// of the action, and `data-keys` are its keys, separated by spaces ("Space" is the space bar), which click the control.
// An argument that is a number other than 0 is passed as a number, any other as text. A list passes its value instead.
// Check boxes pass no state: their actions toggle or read it.

function watchControls(actions) {
  for (const control of document.querySelectorAll("[data-do]")) {
    const { do: name, with: given } = control.dataset;
    const words = () => (control.tagName === "SELECT" ? [control.value] : given ? [Number(given) || given] : []);
    control.addEventListener(control.tagName === "BUTTON" ? "click" : "change", () => actions[name](...words()));
  }
  // A button, check box or radio button that was used by a pointer returns the focus to the page, so that Space plays.
  // A control reached by keys keeps it, and so do lists and number fields.
  let isByPointer = false;
  const giveBack = () => isByPointer && document.activeElement.closest("button, input:not([type=number])")?.blur();
  for (const name of ["pointerdown", "keydown"])
    document.addEventListener(name, () => { isByPointer = name === "pointerdown"; }, true);
  for (const name of ["change", "click"]) document.addEventListener(name, giveBack);
}

/** Returns true if a key is for the control with the focus. Enter opens a list, because Space belongs to the page. */
function isForControl({ target, key }) {
  if (target.closest("select")) return /^(Arrow|Enter|Home|End|Page)/.test(key);
  if (target.closest("input[type=number]")) return key !== "Escape";
  if (target.type === "radio" && key.startsWith("Arrow")) return true;
  return Boolean(target.closest("button, input")) && (key === " " || key === "Enter");
}

/** Connects the keys: W, A, S and D move the camera up, left, down and right by 60 px; arrows step by one frame, or
 * with Shift by ten; < and > choose the next lower or higher rate of playback; I saves the map, with Shift the plot;
 * Escape closes or deselects (letGo()). Keys in `data-keys` replace those here. A capital letter without an action of
 * its own acts as the small one. If the control with the focus needs a key (isForControl()), the key does nothing else.
 * Keys with Ctrl, Meta or Alt belong to the browser. */
function watchKeys(actions) {
  const keys = {
    ArrowLeft: ({ shiftKey }) => actions.stepFrames(shiftKey ? -10 : -1),
    ArrowRight: ({ shiftKey }) => actions.stepFrames(shiftKey ? 10 : 1),
    Home: () => actions.goToEnd(false),
    End: () => actions.goToEnd(true),
    "<": () => actions.changeRate(-1),
    ">": () => actions.changeRate(1),
    w: () => actions.pan(0, 60),
    a: () => actions.pan(60, 0),
    s: () => actions.pan(0, -60),
    d: () => actions.pan(-60, 0),
    i: ({ shiftKey }) => (shiftKey ? actions.savePlot() : actions.saveMap()),
    Escape: () => actions.letGo(),
  };
  for (const control of document.querySelectorAll("[data-keys]"))
    for (const key of control.dataset.keys.split(" ")) keys[key === "Space" ? " " : key] = () => control.click();
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const isList = event.key === "Enter" && event.target.closest("select");
    const action = isList ? () => event.target.showPicker?.() : keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!action || (!isList && isForControl(event))) return;
    event.preventDefault();
    action(event);
  });
}
