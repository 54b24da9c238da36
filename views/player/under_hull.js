// Ice under hulls: what goes under, comes up behind and stays (docs/theory.md, "Ice that goes under").

/** How many pieces went under, and when each came up, in order [s]. */
function readIceUnderHulls(events) {
  const timesOf = (kind) => Float64Array.from(events.filter((event) => event.kind === kind), (event) => event.t_s);
  return { went: timesOf("submerge").length, cameUpAt: timesOf("resurface") };
}

/** Outlines of what is under hulls, or waits for room behind them: through the ship, which shows between them. */
function drawIceUnderHulls(context, view, run, places, colours) {
  const { floes } = run;
  const seen = places.under.filter((id) => view.shows(places.x[id], places.y[id], floes.reach[id]));
  if (seen.length === 0) return;
  context.save();
  context.fillStyle = context.strokeStyle = colours["under-hull"];
  context.lineWidth = Math.min(1.2, Math.max(0.5, 0.4 * view.scale));
  context.setLineDash([3, 2]);
  for (const id of seen) {
    context.beginPath();
    traceFloe(context, view, floes, places, id);
    context.globalAlpha = 0.25;
    context.fill();
    context.globalAlpha = 1;
    context.stroke();
  }
  context.restore();
}

/** The two rows of the present time above the numbers of the whole run. */
function rowsUnderHulls() {
  return [["under-now", "under the hull or waiting"], ["came-up-now", "come up until now"]].flatMap(([id, name]) =>
    [make("dt", {}, name), make("dd", { id }, "0")]);
}

function showCountsUnderHulls({ under }, places, time) {
  byId("under-now").textContent = String(places.under.length);
  byId("came-up-now").textContent = String(lastAtMost(under.cameUpAt, time) + 1);
}

/** When a floe went under and how it ended: it broke, came up as another, or stayed under the ice. */
function lastFacts({ floes, info, breakOf }, id) {
  const facts = {};
  const seconds = (time) => `${sixDigits(time)} s`;
  if (Number.isFinite(floes.wentUnder[id])) facts["under the hull"] = [`since ${seconds(floes.wentUnder[id])}`, floes.wentUnder[id]];
  const last = info.events[breakOf.get(id)];
  if (last?.kind === "resurface") {
    const as = last.children.length > 0 ? `as floe ${last.children.join(", ")}` : "as brash";
    return { ...facts, "came up": [`at ${seconds(last.t_s)} ${as}`, last.t_s] };
  }
  if (last?.kind === "stay_under") return { ...facts, stayed: [`under the ice, at ${seconds(last.t_s)}`, last.t_s] };
  return { ...facts, broke: [Number.isFinite(floes.died[id]) ? seconds(floes.died[id]) : "not in this run", floes.died[id]] };
}

/** Rows of the event card. */
function pathRows({ path_m: path, waited_s: waited }) {
  return { "ship came over it": `${shortNumber(path)} m`, "waited for room": `${shortNumber(waited)} s` };
}

function tiltRows({ deflection_m: deflection, least_deflection_m: least }) {
  return least > 0 ? { deflection: `${shortNumber(deflection)} m of at least ${shortNumber(least)} m` } : {};
}
