// Ice at rest, drawn once and kept as a picture. Most floes of a large field do not move for a while: then only
// the others are drawn again. The picture serves as long as the view stays and none of its floes has to move.

function makeStillIce(run, places, motions) {
  const { floes } = run;
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const kept = { look: "", from: 0, until: -1, loose: [] };

  /** Whether a floe stays where it is for a time, to a quarter of a pixel. */
  function stays(id, view, duration, endFrame) {
    if (!motions.isSteady(id, endFrame)) return false;
    const speed = Math.hypot(places.vx[id], places.vy[id]) + Math.abs(places.spin[id]) * floes.reach[id];
    return speed * duration * view.scale < 0.25;
  }

  function rebuild(view, time, until, draw) {
    const endFrame = lastAtMost(run.frames.times, until) + 1;
    const still = [];
    kept.loose = [];
    for (const id of places.living.subarray(0, places.count)) {
      if (floes.floatsUntil[id] > until && stays(id, view, until - time, endFrame)) still.push(id);
      else kept.loose.push(id);
    }
    for (const child of bornBetween(time, until)) kept.loose.push(child);
    canvas.width = Math.round(view.width * view.ratio);
    canvas.height = Math.round(view.height * view.ratio);
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    draw(context, still);
    Object.assign(kept, { from: time, until });
  }

  function bornBetween(from, until) {
    const ids = [];
    for (let i = 0; i < floes.count; ++i) if (floes.born[i] > from && floes.born[i] <= until) ids.push(i);
    return ids;
  }

  /** Draws all ice alive at the time. `look` names the view and the colours; `ahead` [s] is how long a picture is to last. */
  return function drawAll(target, view, look, time, ahead, draw) {
    if (look !== kept.look) { // the view moves: no picture would serve twice
      Object.assign(kept, { look, until: -1 });
      draw(target, places.living.subarray(0, places.count));
      return;
    }
    if (time < kept.from || time > kept.until) rebuild(view, time, time + ahead, draw);
    target.resetTransform();
    target.drawImage(canvas, 0, 0);
    target.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    draw(target, kept.loose.filter((id) => places.isAlive(id, time)));
  };
}
