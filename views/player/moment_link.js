// A link to an instant of the run: #t=330&floe=42. It contains the time and, of the settings that docs/view.md lists
// under "A link", all that differ from the opening of the page. Layers and the speed of playback are not in it.

/** Returns the parameters of a link for the present state of the page. `width` [m] is the width of a map that follows a
 * ship; `map` is the centre and width of any other [m]. Numbers are rounded to keep the link short: the time to 0.1 ms,
 * the map to 1 cm, the width to four digits. */
function momentOf(player) {
  const { state, view, plot, run } = player;
  const words = { t: Number(state.time.toFixed(4)) };
  if (state.selected >= 0) words.floe = state.selected;
  if (state.colourBy !== "breakage") words.by = state.colourBy;
  if (state.sizes) words.sizes = [state.sizes.from, state.sizes.below].map((size) =>
    (Number.isFinite(size) ? Number(size.toPrecision(6)) : "")).join("-");
  if (state.ship >= 0) words.ship = run.info.ships[state.ship].name;
  if (plot.quantity !== Object.keys(plot.quantities)[0]) words.plot = plot.quantity;
  if (player.plotPanel.further().length > 0) words.below = player.plotPanel.further();
  if (state.follow >= 0) words.follow = run.info.ships[state.follow].name;
  if (state.follow >= 0 && !state.isFitted) words.width = Number((view.width / view.scale).toPrecision(4));
  if (state.follow < 0 && !state.isFitted) words.map = [view.x, view.y, view.width / view.scale].map((v) =>
    Number(v.toFixed(2))).join(",");
  return words;
}

const written = (value) => encodeURIComponent(value).replaceAll("%2C", ",");
/** Returns the link for these parameters. A list becomes one parameter for each item. */
const linkOf = (words) => `#${Object.entries(words).flatMap(([key, value]) => [value].flat().map((one) =>
  `${key}=${written(one)}`)).join("&")}`;

/** Sets the width of the map [m]. The scale [px per m] stays within the limits of zooming in map_view.js. */
function showWidth({ state, view }, width) {
  view.scale = Math.min(400, Math.max(1e-3, view.width / width));
  state.isFitted = false;
  state.iceDirty = true;
}

/** For each parameter of a link, a function that applies its text. It returns a message about a wrong value, or
 * nothing. A range of sizes without its second number, such as "20-", has no upper limit. Selecting a floe does not
 * change the time, and on a page of an area an id of the run that the page lacks is not reported. Plots beyond the
 * largest number (plot_panel.js) are left out without a message. */
const momentWords = {
  t(player, text) {
    const { actions, axis } = player;
    const time = Number(text);
    if (text === "" || !Number.isFinite(time)) return "no time";
    actions.play(false);
    actions.goTo(time);
    return time < axis[0] || time > axis[1] ? `the run goes from ${axis[0]} to ${axis[1]} s` : undefined;
  },
  floe({ actions, run }, text) {
    if (!/^\d+$/.test(text) || Number(text) >= run.floes.count) return `floes go from 0 to ${run.floes.count - 1}`;
    actions.select(Number(text));
  },
  by({ actions, colourings }, text) {
    if (!Object.hasOwn(colourings, text)) return `colours are by ${Object.keys(colourings).join(", ")}`;
    actions.colourBy(text);
  },
  sizes({ actions }, text) {
    const [from, below] = text.split("-").map((end) => (end === "" ? Infinity : Number(end)));
    if (!(from >= 0 && below > from)) return "two sizes in metres, the smaller one first";
    actions.chooseSizes({ from, below });
  },
  plot({ actions, plot }, text) {
    if (!Object.hasOwn(plot.quantities, text)) return "no such quantity in this run";
    actions.plotQuantity(text);
  },
  below({ actions, plot }, text) {
    if (!Object.hasOwn(plot.quantities, text)) return "no such quantity in this run";
    actions.addPlot(text);
  },
  ship({ actions, run }, text) {
    const ship = run.info.ships.findIndex(({ name }) => name === text);
    if (ship < 0) return "no such ship";
    actions.selectShip(ship);
  },
  follow({ actions, run }, text) {
    const ship = run.info.ships.findIndex(({ name }) => name === text);
    if (ship < 0) return "no such ship";
    actions.setFollow(ship);
  },
  width(player, text) {
    if (!(Number(text) > 0)) return "no width";
    showWidth(player, Number(text));
  },
  map(player, text) {
    const [x, y, width] = text.split(",").map(Number);
    if (![x, y, width].every(Number.isFinite) || width <= 0) return "x, y and a width in metres";
    player.actions.setFollow(-1);
    Object.assign(player.view, { x, y });
    showWidth(player, width);
  },
};

/** Applies the parameters of a link (URLSearchParams). Returns messages about parts that were not understood. Settings
 * that the link does not name stay. */
function applyWords(player, words) {
  const problems = [];
  for (const [key, text] of words) {
    const problem = Object.hasOwn(momentWords, key) ? momentWords[key](player, text) : "unknown";
    if (problem) problems.push(`${key}=${text}: ${problem}`);
  }
  return problems;
}

/** Goes to the instant of a link, as applyWords() does. Further plots are removed first, because each `below` adds one.
 * */
function goToMoment(player, link) {
  player.actions.showPlots([]);
  return applyWords(player, new URLSearchParams(link.replace(/^#/, "")));
}

/** Address of this page with these parameters. */
const addressOf = (words) => `${location.href.split("#")[0]}${linkOf(words)}`;

/**
 * Updates the address of the page when its state changes, and the state when another address is entered. `words`
 * returns the parameters of the present state; `goTo` applies a link and returns messages about it. Returns a function
 * that must be called when something has changed: `keepLink` of a player, or of both in pair.js, which has parameters
 * of its own for two runs.
 */
function watchMoment({ words, goTo, isPlaying }) {
  let link = linkOf(words());
  let timer = 0;
  const open = () => {
    const problems = goTo(location.hash);
    if (problems.length > 0) showToast(`link: ${problems.join("; ")}`);
  };
  addEventListener("hashchange", open);
  if (location.hash.length > 1) open();
  return () => {
    if (timer !== 0 || isPlaying()) return;
    timer = setTimeout(() => { // browsers accept only a few changes per second
      timer = 0;
      const now = linkOf(words());
      if (isPlaying() || now === link) return;
      link = now;
      history.replaceState(null, "", now);
    }, 300);
  };
}

/** Copies a text, a link or a place of a scene (plan.js), to the clipboard, and shows `done`. If the browser refuses
 * its clipboard interface, the older copy command is tried; if that fails, too, `otherwise` is shown. */
async function copyText(text, done, otherwise) {
  try {
    await navigator.clipboard.writeText(text);
    showToast(done);
  } catch {
    const field = document.body.appendChild(make("textarea", {}, text));
    field.select();
    const isCopied = document.execCommand("copy");
    field.remove();
    showToast(isCopied ? done : otherwise);
  }
}

const copyLink = (address) => copyText(address, "link copied", "copy the link from the address bar");

/** Shows a message on the map for a short time. */
function showToast(words) {
  const toast = byId("toast");
  toast.textContent = words;
  toast.hidden = false;
  clearTimeout(showToast.timer);
  showToast.timer = setTimeout(() => { toast.hidden = true; }, 4000);
}
