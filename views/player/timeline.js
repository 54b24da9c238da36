// The timeline: a slider with a mark for each fracture (split, bend or grind), rejected cut and broken mooring.
// A click on a mark moves to it; dragging moves through time.

const nearMark = 5; // largest distance between the pointer and a mark that is hit [px]
const markedHeight = 23; // marks are in this part of the timeline, measured from its top [px]
/** Distance of the centre of the mark of each kind of event from the top of the timeline [px]. */
const markHeights = { split: 7, bend: 18, grind: 18, rejected_cut: 18, mooring_break: 7 };

/** Returns true if an event has a mark. Ice that goes under a hull or surfaces has none, because there is one for each
 * cusp. */
const isMarked = ({ kind }) => kind in markHeights;

/** Returns true for rare events, whose marks are drawn above the others. */
const isAbove = ({ kind }) => kind === "split" || kind === "mooring_break";

/** Makes the slider. `pixelOf` and `timeOf` convert between times [s] and pixels from its left end. */
function makeTimeline(run, track, range, actions) {
  const { events } = run.info;
  const thumb = track.querySelector(".thumb");
  const part = track.querySelector(".part");
  const timeline = { left: 0, width: 1, part: range, time: range[0] };
  const placeThumb = () => { thumb.style.transform = `translateX(${timeline.pixelOf(timeline.time)}px)`; };
  timeline.pixelOf = (time) => ((time - range[0]) / (range[1] - range[0] || 1)) * timeline.width;
  timeline.timeOf = (px) => range[0] + (Math.min(1, Math.max(0, px / timeline.width))) * (range[1] - range[0]);

  timeline.place = (left, width, colours) => {
    timeline.left = left;
    timeline.width = width;
    track.style.marginLeft = `${left}px`;
    track.style.width = `${width}px`;
    drawTimeline(track, timeline, events, colours);
    placeThumb();
    timeline.setPart(timeline.part);
  };
  /** Marks the part of the run that the plot shows, unless it is the whole run. */
  timeline.setPart = (span) => {
    timeline.part = span;
    part.hidden = span === range;
    part.style.left = `${timeline.pixelOf(span[0])}px`;
    part.style.width = `${timeline.pixelOf(span[1]) - timeline.pixelOf(span[0])}px`;
  };
  timeline.setTime = (time, words) => {
    timeline.time = time;
    placeThumb();
    track.setAttribute("aria-valuenow", time.toFixed(1));
    track.setAttribute("aria-valuetext", words);
  };
  watchTimeline(track, timeline, run, actions);
  return timeline;
}

function drawTimeline(track, { width, pixelOf }, events, colours) {
  const height = track.clientHeight;
  const context = clearedCanvas(track.querySelector("canvas"), width, height);
  context.fillStyle = colours.line;
  context.fillRect(0, height - 6, width, 3);
  context.globalAlpha = 0.75;
  for (const event of events.filter((one) => isMarked(one) && !isAbove(one))) {
    context.fillStyle = colours[event.kind];
    context.fillRect(pixelOf(event.t_s) - 0.75, 13, 1.5, 9);
  }
  context.globalAlpha = 1;
  for (const event of events.filter(isAbove))
    drawEventMark(context, pixelOf(event.t_s), markHeights[event.kind], event.kind, 4.5, colours);
}

/** Index of the event whose mark is within `nearMark` of a point and nearest to it; null if there is none. The
 * distance is measured along the timeline. A mark more than 9 px above or below the point, which is in the other row of
 * marks, counts as 3 px farther, so that marks of the pointer's row are preferred. */
function eventAt(events, { pixelOf }, px, py) {
  let best = null;
  let least = nearMark;
  events.forEach((event, index) => {
    if (!isMarked(event)) return;
    const distance = Math.abs(pixelOf(event.t_s) - px) + (Math.abs(markHeights[event.kind] - py) > 9 ? 3 : 0);
    if (distance < least) {
      least = distance;
      best = index;
    }
  });
  return best;
}

/** Handles pointers on the timeline. Dragging, or a click beside the marks, moves to the time there; a click on a mark
 * moves to its event. A tooltip describes the mark under the pointer. */
function watchTimeline(track, timeline, run, actions) {
  const { events } = run.info;
  const tip = byId("timeline-tip");
  let from = 0; // position at which the pointer was pressed [px]
  let mark = null; // event whose mark was pressed, until the pointer moves away from it
  const goTo = (px) => actions.goTo(timeline.timeOf(px));
  watchPointers(track, {
    start(event, [px, py]) {
      from = px;
      mark = py < markedHeight ? eventAt(events, timeline, px, py) : null;
      if (mark === null) goTo(px);
    },
    drag([px]) {
      if (Math.abs(px - from) > clickSlop) mark = null;
      if (mark === null) goTo(px);
    },
    end({ type }) {
      if (type === "pointerup" && mark !== null) actions.goToEvent(mark);
    },
    hover(event, [px, py]) {
      const found = eventAt(events, timeline, px, py);
      tip.hidden = found === null || event.pointerType === "touch";
      if (tip.hidden) return;
      tip.textContent = eventWords(events[found]);
      const right = Math.max(0, track.parentElement.clientWidth - tip.offsetWidth - 8);
      tip.style.left = `${Math.min(timeline.left + px, right)}px`;
    },
  });
  track.addEventListener("pointerleave", () => { tip.hidden = true; });
}

const kindWords = (kind) => kind.replaceAll("_", " ");

function eventWords(event) {
  const what = "floe" in event ? `floe ${event.floe}` : event.ship;
  return `${event.t_s.toFixed(2)} s: ${kindWords(event.kind)} of ${what}`;
}
