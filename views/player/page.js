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
  const counts = { bend: 0, split: 0, rejected_cut: 0 };
  for (const event of info.events) ++counts[event.kind];
  const facts = {
    "floes in all": floes.count, bends: counts.bend, splits: counts.split, "rejected cuts": counts.rejected_cut,
    ships: info.ships.map((ship) => ship.name).join(", ") || "none",
    frames: info.frames === info.frames_of_run ? info.frames : `${info.frames} of ${info.frames_of_run}`,
    seed: info.seed, scene: info.scene_hash, polynya: info.polynya,
  };
  byId("facts").replaceChildren(...Object.entries(facts).flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, String(value))]));

  byId("play").addEventListener("click", actions.togglePlay);
  byId("event-before").addEventListener("click", () => actions.stepEvent(-1));
  byId("event-after").addEventListener("click", () => actions.stepEvent(1));
  byId("event-before").disabled = byId("event-after").disabled = info.events.length === 0;
  byId("play").disabled = frames.times.length < 2;
  byId("rate").replaceChildren(...rates.map((rate) => make("option", { value: String(rate) }, `${rate}\u00d7`)));
  byId("rate").value = String(state.rate);
  byId("rate").addEventListener("change", (event) => actions.setRate(Number(event.target.value)));
  byId("zoom-in").addEventListener("click", () => actions.zoomCentre(1.4));
  byId("zoom-out").addEventListener("click", () => actions.zoomCentre(1 / 1.4));
  byId("fit").addEventListener("click", actions.fit);
  byId("follow").addEventListener("click", actions.follow);
  byId("follow").disabled = info.ships.length === 0;
  byId("theme").addEventListener("click", actions.toggleTheme);
  byId("help-button").addEventListener("click", actions.toggleHelp);
  byId("help-close").addEventListener("click", actions.toggleHelp);
  for (const what of ["breakage", "generation", "speed", "size"]) byId(`by-${what}`).addEventListener("change", () => actions.colourBy(what));
  for (const name of Object.keys(state.layers)) {
    byId(`layer-${name}`).checked = state.layers[name];
    byId(`layer-${name}`).addEventListener("change", (event) => actions.toggleLayer(name, event.target.checked));
  }
  byId("track").setAttribute("aria-valuemin", String(range[0]));
  byId("track").setAttribute("aria-valuemax", String(range[1]));
  if (info.ships.length === 0) return document.body.classList.add("no-ships");
  byId("quantity").replaceChildren(...Object.entries(plot.quantities).map(([name, { label }]) => make("option", { value: name }, label)));
  byId("quantity").addEventListener("change", (event) => actions.plotQuantity(event.target.value));
  byId("full-scale").addEventListener("click", actions.toggleFullScale);
  byId("whole-run").addEventListener("click", () => actions.zoomPlot());
  return undefined;
}
