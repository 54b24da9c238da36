// The timeline: a slider with a mark for every event. A click on a mark goes there.

const nearMark = 5; // [px]

function makeTimeline(run, track, range, actions) {
  const canvas = track.querySelector("canvas");
  const thumb = track.querySelector(".thumb");
  const part = track.querySelector(".part");
  const tip = byId("timeline-tip");
  const { events } = run.info;
  const rows = { split: 7, bend: 18, rejected_cut: 18 }; // [px]
  const timeline = { left: 0, width: 1, part: range };

  timeline.place = (left, width, colours) => {
    timeline.left = left;
    timeline.width = width;
    track.style.marginLeft = `${left}px`;
    track.style.width = `${width}px`;
    draw(colours);
    timeline.setPart(timeline.part);
  };
  /** The part of the run that the plot shows, marked where it is not the whole. */
  timeline.setPart = (span) => {
    timeline.part = span;
    part.hidden = span === range;
    part.style.left = `${pixelOf(span[0])}px`;
    part.style.width = `${pixelOf(span[1]) - pixelOf(span[0])}px`;
  };
  const pixelOf = (time) => ((time - range[0]) / (range[1] - range[0] || 1)) * timeline.width;
  const timeOf = (px) => range[0] + (Math.min(1, Math.max(0, px / timeline.width))) * (range[1] - range[0]);

  function draw(colours) {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const height = track.clientHeight;
    canvas.width = Math.round(timeline.width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    context.clearRect(0, 0, timeline.width, height);
    context.fillStyle = colours.line;
    context.fillRect(0, height - 6, timeline.width, 3);
    for (const event of events) {
      const x = pixelOf(event.t_s);
      if (event.kind === "split") continue;
      context.fillStyle = colours[event.kind];
      context.globalAlpha = 0.75;
      context.fillRect(x - 0.75, 13, 1.5, 9);
    }
    context.globalAlpha = 1;
    for (const event of events) {
      if (event.kind === "split") drawEventMark(context, pixelOf(event.t_s), rows.split, "split", 4.5, colours);
    }
  }

  /** The event whose mark is under the point, nearest first. Splits stand above bends. */
  function eventAt(px, py) {
    let best = null;
    let least = nearMark;
    events.forEach((event, index) => {
      const distance = Math.abs(pixelOf(event.t_s) - px) + (Math.abs(rows[event.kind] - py) > 9 ? 3 : 0);
      if (distance < least) {
        least = distance;
        best = index;
      }
    });
    return best;
  }

  timeline.setTime = (time, words) => {
    thumb.style.transform = `translateX(${pixelOf(time)}px)`;
    track.setAttribute("aria-valuenow", time.toFixed(1));
    track.setAttribute("aria-valuetext", words);
  };

  const local = (event) => {
    const box = track.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  let isDown = false;
  track.addEventListener("pointerdown", (pointer) => {
    const [px, py] = local(pointer);
    track.setPointerCapture(pointer.pointerId);
    isDown = true;
    const found = py < 23 ? eventAt(px, py) : null;
    if (found !== null) {
      isDown = false;
      actions.goToEvent(found);
    } else actions.goTo(timeOf(px));
  });
  track.addEventListener("pointermove", (pointer) => {
    const [px, py] = local(pointer);
    if (isDown) actions.goTo(timeOf(px));
    const found = eventAt(px, py);
    tip.hidden = found === null || pointer.pointerType === "touch";
    if (tip.hidden) return;
    tip.textContent = eventWords(run, events[found]);
    tip.style.left = `${Math.min(timeline.left + px, Math.max(0, track.parentElement.clientWidth - tip.offsetWidth - 8))}px`;
  });
  track.addEventListener("pointerleave", () => { tip.hidden = true; });
  for (const name of ["pointerup", "pointercancel"]) track.addEventListener(name, () => { isDown = false; });
  timeline.pixelOf = pixelOf;
  return timeline;
}

const kindWords = { bend: "bend", split: "split", rejected_cut: "rejected cut" };

function eventWords(run, event) {
  return `${event.t_s.toFixed(2)} s: ${kindWords[event.kind]} of floe ${event.floe}`;
}
