// The picture and the numbers at each tick of the screen.

/** Moves the time on by what passed [ms] since the last tick; the run stops at its end. */
function playOn({ state, range, actions }, passed) {
  state.time += (Math.min(100, passed) / 1000) * state.rate;
  if (state.time >= range[1]) {
    state.time = range[1];
    actions.play(false);
  }
  state.iceDirty = true;
}

function showNumbers({ run, state, places, plotPanel, sizePanel, timeline }) {
  const words = `${state.time.toFixed(1)} s`;
  byId("now").textContent = words;
  byId("living").textContent = String(places.count);
  byId("living-word").textContent = places.count === 1 ? "floe" : "floes";
  sizePanel.show();
  if (run.under.went > 0) showCountsUnderHulls(run, places, state.time);
  plotPanel.setTime(state.time);
  timeline.setTime(state.time, `${words}, ${places.count} floes`);
}

function startDrawing(player, canvases) {
  const { state, view, places, motions } = player;
  const drawIce = makeIcePicture(player, canvases[0]);
  const drawMarks = makeMarksPicture(player, canvases[1]);
  const shownFloe = makeShownFloe(player);

  /** Draws what has changed. */
  function draw() {
    if (state.iceDirty) {
      places.setTime(state.time);
      const pose = state.follow >= 0 ? motions.ship(state.follow) : null;
      if (pose) [view.x, view.y] = pose;
      drawIce();
      showNumbers(player);
    }
    if (state.iceDirty || state.marksDirty) {
      drawMarks(shownFloe.shown());
      shownFloe.showCard();
    }
    if (state.iceDirty || state.marksDirty) player.keepLink();
    state.iceDirty = state.marksDirty = false;
  }

  let last = 0;
  function tick(now) {
    if (state.isPlaying) playOn(player, now - last);
    last = now;
    const isDrawn = state.iceDirty;
    const before = performance.now();
    draw();
    if (isDrawn) {
      ++player.drawn;
      if (player.drawTimes.push(performance.now() - before) > 2000) player.drawTimes.length = 0;
    }
    requestAnimationFrame(tick);
  }
  requestAnimationFrame(tick);
}
