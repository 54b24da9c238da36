// Finds the floe under a point and shows its data.

/** Floe at a point of the world: the smallest floating one, because outlines may overlap; otherwise a floe under a
 * hull; −1 if there is none. */
function floeAt(run, places, x, y) {
  const found = floeAmong(run, places, places.living.subarray(0, places.count), x, y);
  return found >= 0 ? found : floeAmong(run, places, places.under, x, y);
}

// A canvas that is not shown; it tests whether a point is inside an outline. Points in holes are outside.
const probe = make("canvas").getContext("2d");

/** Id of the smallest of some floes that contain a point of the world; −1 if none does. */
function floeAmong({ floes, outline }, places, ids, x, y) {
  let best = -1;
  for (const id of ids) {
    const [dx, dy, c, s] = [x - places.x[id], y - places.y[id], places.cos[id], places.sin[id]];
    if (Math.hypot(dx, dy) > floes.reach[id] || (best >= 0 && floes.area[id] >= floes.area[best])) continue;
    if (probe.isPointInPath(outline(id), c * dx + s * dy, -s * dx + c * dy, "evenodd")) best = id;
  }
  return best;
}

/** The floes that broke one from the other until this one, oldest first, this one last. */
function lineageOf(floes, id) {
  const ids = [];
  for (let at = id; at >= 0; at = floes.parent[at]) ids.unshift(at);
  return ids;
}

/** Substitute for a floe at a time: itself while it exists, before that the floe that it was part of, later its largest
 * piece; itself again if no such floe exists at that time. */
function standIn(run, places, id, time) {
  const { floes } = run;
  for (let at = id; at >= 0; at = floes.parent[at]) {
    if (places.isThere(at, time)) return at;
    if (floes.born[at] <= time) break;
  }
  let best = id;
  const queue = [id];
  while (queue.length > 0) {
    const at = queue.pop();
    if (places.isThere(at, time) && (best === id || floes.area[at] > floes.area[best])) best = at;
    queue.push(...(floes.children.get(at) ?? []));
  }
  return best;
}

/** Data of a floe: for each name the text, the exact number of the run, and its unit if it has one. lastFacts() in
 * motion.js adds when it went under a hull, and when it broke, surfaced or stayed under the ice. */
function floeFacts(run, places, motions, id) {
  const { floes } = run;
  const speed = motions.isRecorded(id) ? Math.hypot(places.vx[id], places.vy[id]) : null;
  return {
    floe: [String(id), id],
    parent: [floes.parent[id] < 0 ? "none, of the scene" : String(floes.parent[id]), floes.parent[id]],
    generation: [String(floes.generation[id]), floes.generation[id]],
    area: [valueWords(floes.area[id], "m\u00b2"), floes.area[id], "m\u00b2"],
    mass: [valueWords(floes.mass[id], "kg"), floes.mass[id], "kg"],
    thickness: [valueWords(floes.thickness[id], "m"), floes.thickness[id], "m"],
    "flexural strength": [valueWords(floes.flexuralStrength[id], "Pa"), floes.flexuralStrength[id], "Pa"],
    speed: [speed === null ? "\u2013 (lived between two frames)" : valueWords(speed, "m/s"), speed, "m/s"],
    born: [valueWords(floes.born[id], "s"), floes.born[id], "s"],
    ...lastFacts(run, id),
  };
}

/** `chosen` is the floe that was clicked, `id` is its substitute at the present time. */
function showFloeCard(host, run, places, motions, chosen, id, time, actions) {
  if (id < 0) {
    host.replaceChildren(make("p", { class: "hint" }, "Point at a floe, or tap it. A click keeps it."));
    return;
  }
  const facts = floeFacts(run, places, motions, id);
  if (!places.isThere(id, time)) facts.speed = ["\u2013 (not alive now)", null];
  const list = make("dl");
  for (const [name, [words, value, unit]] of Object.entries(facts))
    list.append(make("dt", {}, name), make("dd", { "data-fact": name, "data-value": String(value),
      ...(unit && value !== null && { title: `${value} ${unit}` }) }, words));
  if (chosen !== id) {
    const words = run.floes.born[chosen] > time
      ? `what floe ${chosen} was part of` : `the largest piece of floe ${chosen} now`;
    list.append(make("dt", {}, "this is"), make("dd", {}, words));
  }
  host.replaceChildren(list, make("h3", {}, "Fracture lineage"), lineageList(run, id, actions));
}

// Number of floes of a lineage that the card lists, with the floe itself; of a longer one the first and the last are
// listed, because the list would hide the rest of the panel.
const longestLineage = 8;

/** Links to the ancestors of a floe and to the floe itself, each with the event that ended it (a fracture, surfacing,
 * or staying under the ice), and to its pieces. */
function lineageList(run, id, actions) {
  const { floes, info } = run;
  const breaks = run.breakOf;
  const ids = lineageOf(floes, id);
  const list = make("ol", { class: "lineage" });
  const skipped = Math.max(0, ids.length - longestLineage);
  const shown = skipped > 0 ? [ids[0], ...ids.slice(skipped + 1)] : ids;
  shown.forEach((floe, k) => {
    if (k === 1 && skipped > 0) list.append(make("li", { class: "hint" }, `\u2026 ${skipped} more`));
    const item = make("li", floe === id ? { class: "self" } : {});
    item.append(button(`floe ${floe}`, () => actions.visit(floe)));
    if (breaks.has(floe)) {
      const event = info.events[breaks.get(floe)];
      item.append(" ", button(`${kindWords(event.kind)} ${event.t_s.toFixed(1)} s`, () =>
        actions.goToEvent(breaks.get(floe))));
    }
    list.append(item);
  });
  const children = floes.children.get(id) ?? [];
  if (children.length > 0) {
    const item = make("li", {}, "became ");
    for (const child of children) item.append(button(String(child), () => actions.visit(child)), " ");
    list.append(item);
  }
  return list;
}

function button(words, onClick) {
  const element = make("button", { type: "button", class: "link" }, words);
  element.addEventListener("click", onClick);
  return element;
}

/** Returns the text for the value of one field of an event. */
function eventValue(key, value, unit) {
  if (key === "kind") return kindWords(value);
  if (key === "children") return value.join(", ") || "\u2013";
  if (Array.isArray(value)) return `(${value.map((v) => minus(v.toFixed(1))).join(", ")}) ${unit}`;
  if (unit === "s") return `${value.toFixed(3)} s`;
  return unit ? valueWords(value, unit) : String(value) || "\u2013";
}

/** Returns the fields of an event that have labels (io::event_fields()), including those of its criterion. If the
 * criterion is a rule such as "load >= capacity", the two sides of the rule are the labels of its load and its
 * capacity. */
function eventRows({ event_labels: labels }, { criterion = {}, ...event }) {
  const { kind: rule = "", ...sides } = criterion;
  const [, load, capacity] = /^(.+) >=? (.+)$/.exec(rule) ?? [];
  return Object.entries({ ...event, ...sides }).flatMap(([key, value]) => {
    if (!(key in labels)) return [];
    return [[{ load_N: load, capacity_N: capacity }[key] ?? labels[key].label,
      eventValue(key, value, labels[key].unit)]];
  });
}

function showEventCard(host, run, event) {
  if (!event) {
    host.replaceChildren(make("p", { class: "hint" }, run.info.events.length > 0
      ? "Click a mark on the timeline." : "Nothing broke in this run."));
    return;
  }
  const list = make("dl");
  for (const [name, words] of eventRows(run.info, event)) list.append(make("dt", {}, name), make("dd", {}, words));
  host.replaceChildren(list);
}

// The selected floe, or the floe under the pointer: its card, and a line of text in the top left corner of the map, the
// chip.

/** Returns functions for the shown floe. showCard() updates the card and the chip when floe or time change, or when
 * `cardIsStale` reports another selection. While the run plays it leaves both alone if a link of the card has the
 * focus, because the focus would be lost. After a pause the card then stays as it is until floe or time change. */
function makeShownFloe(player) {
  const { run, state, places, motions } = player;
  let cardShown = "";

  const chosen = () => (state.selected >= 0 ? state.selected : state.hovered);
  /** Substitute for the floe at the present time; −1 if there is none. */
  const shown = () => (chosen() < 0 ? -1 : standIn(run, places, chosen(), state.time));

  function showCard() {
    const id = shown();
    const key = `${id} ${state.time} ${state.hoveredShip}`;
    if (key === cardShown && !player.cardIsStale) return;
    cardShown = key;
    player.cardIsStale = false;
    const host = byId("floe-card");
    if (host.contains(document.activeElement) && state.isPlaying) return;
    showFloeCard(host, run, places, motions, chosen(), id, state.time, player.actions);
    const chip = byId("chip");
    chip.hidden = id < 0 && state.hoveredShip < 0;
    if (id < 0 && state.hoveredShip >= 0) chip.textContent = shipLine(run, motions, state.hoveredShip);
    if (id < 0) return;
    const facts = floeFacts(run, places, motions, id);
    const speed = places.isThere(id, state.time) ? facts.speed[0] : "not alive now";
    chip.textContent = `floe ${id} \u00b7 ${valueWords(run.floes.area[id], "m\u00b2")} \u00b7 ${speed}`;
  }
  return { shown, showCard };
}
