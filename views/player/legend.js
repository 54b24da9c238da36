// The legend below the map: what the colours, marks and arrows mean that are shown now.

function makeLegend(player) {
  const { run, state, colourings } = player;
  // As wide as its longest words from the start: the legend must not grow and shrink while the run plays.
  const channelWidth = make("output", { id: "channel-width", style: `flex: 0 1 ${23 * run.info.ships.length}ch` });

  function swatchRow(colour, ...words) {
    const swatch = make("i");
    swatch.style.background = colour;
    return make("span", {}, swatch, ...words);
  }
  function arrowRow(pixels, words) {
    const arrow = make("i", { class: "arrow" });
    arrow.style.width = `${pixels}px`;
    return make("span", {}, arrow, words);
  }
  function velocityRow() {
    const speed = roundBelow(60 / player.arrowScale);
    return arrowRow(speed * player.arrowScale, `${Number(speed.toPrecision(2))} m/s`);
  }
  function forceRows(colours) {
    const force = roundBelow(60 / player.forceScale);
    const unit = loadUnit(force, "N");
    return [arrowRow(force * player.forceScale, `${shortNumber(force * unit.factor)} ${unit.name}`),
      swatchRow(colours.split, "crushing"), swatchRow(colours.bend, "not crushing")];
  }

  return {
    show() {
      const { colours } = player;
      const colouring = colourings[state.colourBy];
      const rows = colouring.words.flatMap((words, k) => (colouring.isUsed?.(k) ?? true ? [swatchRow(colouring.colours[k], words)] : []));
      if (state.colourBy === "size") rows.reverse();
      if (state.sizes) rows.push(make("span", { class: "pale" }, `pale: not ${sizeRangeWords(state.sizes)}`));
      if (run.under.went > 0) rows.push(make("span", {}, make("i", { class: "under-hull" }), "ice under the hull or waiting behind it"));
      if (state.layers.startIce) rows.push(swatchRow(colours["start-ice"], "ice at the start"));
      if (state.layers.channel) rows.push(swatchRow(colours.swept, "swept by the hull"), swatchRow(colours.channel, "open from ice to ice ", channelWidth));
      if (state.layers.velocities) rows.push(velocityRow());
      if (state.layers.forces) rows.push(...forceRows(colours));
      byId("legend").replaceChildren(make("b", {}, colouring.title), ...rows);
    },
    showWidths: (words) => { channelWidth.textContent = words.join("; ") || "\u2013"; },
  };
}
