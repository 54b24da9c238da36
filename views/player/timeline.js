// The timeline: a slider with a mark for every fracture, rejected cut and broken mooring. A click on a mark goes there,
// a drag scrubs.

const nearMark = 5; // [px]
const markedHeight = 23; // of the timeline from its top, where marks are [px]
/** Of each kind of mark, from the top [px]. */
const markHeights = { split: 7, bend: 18, grind: 18, rejected_cut: 18, mooring_break: 7 };

/** Whether an event has a mark. What goes under hulls and comes up has none: there is one for each cusp. */
const isMarked = ({ kind }) => kind in markHeights;

/** Rare events stand above the others. */
const isAbove = ({ kind }) => kind === "split" || kind === "mooring_break";

/** The slider; `pixelOf` and `timeOf` convert between times [s] and pixels from its left. */
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
  /** The part of the run that the plot shows, marked where it is not the whole. */
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

/** The event whose mark is under the point, nearest first. Splits stand above bends. */
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

/** Pointers on the timeline: a drag goes to a time, wherever it begins; so does a click, or to the event whose mark it
 * hits. The words of the mark under the pointer stand in the tip. */
function watchTimeline(track, timeline, run, actions) {
  const { events } = run.info;
  const tip = byId("timeline-tip");
  let from = 0; // of the press [px]
  let mark = null; // the event whose mark is there, until the pointer moves away from it
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
