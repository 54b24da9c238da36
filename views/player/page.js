// The page's words and controls.

/** The panel with the numbers of the whole run. */
function fillFacts({ run: { info, floes }, name }) {
  const counts = { bend: 0, split: 0, grind: 0, rejected_cut: 0, submerge: 0, resurface: 0, stay_under: 0, mooring_break: 0 };
  for (const event of info.events) ++counts[event.kind];
  const facts = {
    "floes in all": floes.count, bends: counts.bend, splits: counts.split, ...(counts.grind && { ground: counts.grind }), "rejected cuts": counts.rejected_cut,
    ...(counts.submerge && { "went under": counts.submerge, "came up": counts.resurface, ...(counts.stay_under && { "stayed under": counts.stay_under }) }),
    ...(counts.mooring_break && { "moorings broken": counts.mooring_break }),
    ships: info.ships.map((ship) => ship.name).join(", ") || "none",
    frames: info.frames === info.frames_of_run ? info.frames : `${info.frames} of ${info.frames_of_run}`,
    ...(name !== info.scene && { "scene's name": info.scene }), seed: info.seed, scene: info.scene_hash, polynya: info.polynya,
  };
  byId("facts").replaceChildren(...Object.entries(facts).flatMap(([fact, value]) => [make("dt", {}, fact), make("dd", {}, String(value))]));
  if (counts.submerge) byId("facts").prepend(...rowsUnderHulls());
}

/** What the plot can show, forces by cause apart. */
function quantityGroups(quantities) {
  return [[false, "Quantities"], [true, "Stacked areas"]].flatMap(([stacks, label]) => {
    const group = Object.entries(quantities).filter(([, { isStack = false }]) => isStack === stacks);
    return group.length > 0 ? [make("optgroup", { label }, ...group.map(([name, { label: words }]) => make("option", { value: name }, words)))] : [];
  });
}

function fillPage(player) {
  const { run, range, name, isOneOfTwo, axis, state, plot, actions } = player;
  const { info, frames } = run;
  byId("scene").textContent = name;
  document.body.classList.toggle("one-of-two", isOneOfTwo);
  for (const id of ["description", "description-whole"]) {
    byId(id).textContent = info.description;
    byId(id).classList.toggle("empty", info.description === "");
  }
  byId("end").textContent = `${Number(range[1].toFixed(1))} s`;
  if (!info.finished) {
    byId("badge").hidden = false;
    byId("badge").textContent = `unfinished: ${range[1].toFixed(1)} of ${info.until_s} s` + (info.stopped_by ? `, stopped by ${info.stopped_by}` : "");
  }
  fillFacts(player);

  const onClick = {
    play: () => actions.togglePlay(), "event-before": () => actions.stepEvent(-1), "event-after": () => actions.stepEvent(1),
    "zoom-in": () => actions.zoomCentre(1.4), "zoom-out": () => actions.zoomCentre(1 / 1.4), fit: actions.fit, follow: actions.follow,
    theme: actions.toggleTheme, "help-button": actions.toggleHelp, "help-close": actions.toggleHelp,
    "full-scale": actions.toggleFullScale, "whole-run": () => actions.zoomPlot(), "save-plot": actions.savePlot, "save-map": actions.saveMap,
    "copy-link": actions.copyLink,
  };
  for (const [id, act] of Object.entries(onClick)) byId(id).addEventListener("click", act);
  byId("event-before").disabled = byId("event-after").disabled = info.events.length === 0;
  byId("play").disabled = frames.times.length < 2;
  byId("rate").replaceChildren(...rates.map((rate) => make("option", { value: String(rate) }, `${rate}\u00d7`)));
  byId("rate").value = String(state.rate);
  byId("rate").addEventListener("change", (event) => actions.setRate(Number(event.target.value)));
  byId("follow").disabled = info.ships.length === 0;
  for (const what of ["breakage", "generation", "speed", "size"]) byId(`by-${what}`).addEventListener("change", () => actions.colourBy(what));
  for (const name of Object.keys(state.layers)) {
    byId(`layer-${name}`).checked = state.layers[name];
    byId(`layer-${name}`).addEventListener("change", (event) => actions.toggleLayer(name, event.target.checked));
  }
  byId("track").setAttribute("aria-valuemin", String(axis[0]));
  byId("track").setAttribute("aria-valuemax", String(axis[1]));
  document.body.classList.toggle("no-ships", info.ships.length === 0);
  byId("quantity").replaceChildren(...quantityGroups(plot.quantities));
  byId("quantity").addEventListener("change", (event) => actions.plotQuantity(event.target.value));
}
