// A link to an instant of two runs: that of the first run, with `floe2`, the floe chosen in the second.

function momentOfPair([first, second], clock) {
  const words = { ...momentOf(first), t: Number(clock.time.toFixed(4)) };
  if (second.state.selected >= 0) words.floe2 = second.state.selected;
  return words;
}

/** Goes where a link leads; gives what of it was not understood. */
function goToMomentOfPair([first, second], link) {
  const words = new URLSearchParams(link.replace(/^#/, ""));
  const ofSecond = words.get("floe2");
  words.delete("floe2");
  return [...goToMoment(first, words.toString()), ...(ofSecond === null ? [] : goToMoment(second, `floe=${ofSecond}`))];
}
