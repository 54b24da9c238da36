// The floe that was chosen or is pointed at: its card, and its line on the map.

function makeShownFloe(player) {
  const { run, state, places, motions } = player;
  let cardShown = "";

  const chosen = () => (state.selected >= 0 ? state.selected : state.hovered);
  /** The floe that stands for it at the present time; −1 where there is none. */
  const shown = () => (chosen() < 0 ? -1 : standIn(run, places, chosen(), state.time));

  function showCard() {
    const id = shown();
    const key = `${id} ${state.time}`;
    if (key === cardShown && !player.cardIsStale) return;
    cardShown = key;
    player.cardIsStale = false;
    const host = byId("floe-card");
    if (host.contains(document.activeElement) && state.isPlaying) return;
    showFloeCard(host, run, places, motions, chosen(), id, state.time, player.actions);
    const chip = byId("chip");
    chip.hidden = id < 0;
    if (id < 0) return;
    const facts = floeFacts(run, places, motions, id);
    chip.textContent = `floe ${id} \u00b7 ${sixDigits(run.floes.area[id])} m\u00b2 \u00b7 ${places.isThere(id, state.time) ? facts.speed[0] : "not alive now"}`;
  }
  return { shown, showCard };
}
