// The page's words and controls.

function fillPage({ run, range, state, plot, actions }) {
  const { info, frames, floes } = run;
  byId("scene").textContent = info.scene;
  for (const id of ["description", "description-whole"]) {
    byId(id).textContent = info.description;
    byId(id).classList.toggle("empty", info.description === "");
  }
  byId("end").textContent = `${range[1].toFixed(range[1] % 1 ? 1 : 0)} s`;
  if (!info.finished) {
    byId("badge").hidden = false;
    byId("badge").textContent = `unfinished: ${range[1].toFixed(1)} of ${info.until_s} s` + (info.stopped_by ? `, stopped by ${info.stopped_by}` : "");
  }
  const counts = { bend: 0, split: 0, grind: 0, rejected_cut: 0, submerge: 0, resurface: 0, stay_under: 0 };
  for (const event of info.events) ++counts[event.kind];
  const facts = {
    "floes in all": floes.count, bends: counts.bend, splits: counts.split, ...(counts.grind && { ground: counts.grind }), "rejected cuts": counts.rejected_cut,
    ...(counts.submerge && { "went under": counts.submerge, "came up": counts.resurface, ...(counts.stay_under && { "stayed under": counts.stay_under }) }),
    ships: info.ships.map((ship) => ship.name).join(", ") || "none",
    frames: info.frames === info.frames_of_run ? info.frames : `${info.frames} of ${info.frames_of_run}`,
    seed: info.seed, scene: info.scene_hash, polynya: info.polynya,
  };
  byId("facts").replaceChildren(...Object.entries(facts).flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, String(value))]));
  if (counts.submerge) byId("facts").prepend(...rowsUnderHulls());

  const onClick = {
    play: actions.togglePlay, "event-before": () => actions.stepEvent(-1), "event-after": () => actions.stepEvent(1),
    "zoom-in": () => actions.zoomCentre(1.4), "zoom-out": () => actions.zoomCentre(1 / 1.4), fit: actions.fit, follow: actions.follow,
    theme: actions.toggleTheme, "help-button": actions.toggleHelp, "help-close": actions.toggleHelp,
    "full-scale": actions.toggleFullScale, "whole-run": () => actions.zoomPlot(),
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
  byId("track").setAttribute("aria-valuemin", String(range[0]));
  byId("track").setAttribute("aria-valuemax", String(range[1]));
  document.body.classList.toggle("no-ships", info.ships.length === 0);
  byId("quantity").replaceChildren(...Object.entries(plot.quantities).map(([name, { label }]) => make("option", { value: name }, label)));
  byId("quantity").addEventListener("change", (event) => actions.plotQuantity(event.target.value));
}
