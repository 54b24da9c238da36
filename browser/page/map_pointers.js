// Pointers on the map. Dragging an object that can be edited moves it; any other dragging moves the map.

/** Holds an object with the pointer. It is shown at the pointer, and the scene is changed when it is released. */
function makeGrip(page, setScene) {
  const { view } = page;
  const grip = { held: null, from: null };
  /** Returns the object that can be edited at a point of the screen; null if there is none. */
  grip.find = (at) => {
    try {
      return page.isEditable() ? findHandle(page.run, view, page.text, at) : null;
    } catch {
      return null; // the text is not valid JSON
    }
  };
  grip.take = (at, isAlone) => {
    grip.held = isAlone && !page.tool ? grip.find(at) : null;
    grip.from = view.toWorld(...at);
    if (grip.held?.hull !== undefined) grip.held.pose = [...page.run.motions.ship(grip.held.hull)];
    page.chosen = grip.held;
    showPhase(page);
  };
  grip.preview = (at) => {
    const { held, from } = grip;
    const [x, y] = view.toWorld(...at);
    const pose = page.run.motions.ship(held.hull);
    if (held.kind === "turn") pose[2] = Math.atan2(y - pose[1], x - pose[0]);
    if (held.kind === "hull") [pose[0], pose[1]] = [held.pose[0] + x - from[0], held.pose[1] + y - from[1]];
  };
  const edit = (change) => {
    try {
      setScene(change());
    } catch (fault) {
      toast(`this cannot be edited by mouse: ${fault.message}`);
    }
  };
  grip.drop = (at) => edit(() => movedText(page.text, page.run, view, grip.held, grip.from, view.toWorld(...at)));
  grip.place = (tool, at) => edit(() => withPlaced(page.text, view, tool, view.toWorld(...at)));
  return grip;
}

function setTool(page, tool) {
  page.tool = page.tool === tool ? null : tool;
  for (const button of document.querySelectorAll("[data-place]"))
    button.setAttribute("aria-pressed", String(button.dataset.place === page.tool));
}

/** Actions that move and zoom the map. */
function mapMoves(page) {
  const { view } = page;
  const moved = (move) => (...words) => {
    move(...words);
    page.isFitted = false;
    page.isDirty = true;
  };
  return {
    pan: moved((at, before) => view.panBy(at[0] - before[0], at[1] - before[1])),
    zoom: moved((at, factor) => view.zoomAt(...at, factor)),
    pinch: moved((after, before) => {
      const size = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
      const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
      view.panBy(...middle(after).map((value, k) => value - middle(before)[k]));
      view.zoomAt(...middle(after), size(after) / Math.max(1, size(before)));
    }),
  };
}

function watchLiveMap(page, setScene) {
  const stage = byId("stage");
  const grip = makeGrip(page, setScene);
  const moves = mapMoves(page);
  let way = 0; // distance that the pointer has moved since it was pressed [px]
  watchPointers(stage, {
    start(event, at, count) {
      way = 0;
      grip.take(at, count === 1);
      page.isDirty = true;
    },
    hover: (event, at) => { stage.style.cursor = page.tool ? "crosshair" : grip.find(at) ? "move" : ""; },
    drag(at, before) {
      way += Math.hypot(at[0] - before[0], at[1] - before[1]);
      if (!grip.held) return moves.pan(at, before);
      grip.preview(at);
      page.isDirty = true;
      return undefined;
    },
    pinch: moves.pinch,
    end({ type }, at) {
      const { tool } = page;
      if (type === "pointercancel") return;
      if (tool && way < clickSlop) {
        setTool(page, null);
        grip.place(tool, at);
      } else if (grip.held && way >= clickSlop) grip.drop(at);
      grip.held = null;
    },
  });
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    moves.zoom(pointIn(stage, event), Math.exp(-wheelTurn(event)));
  }, { passive: false });
}
