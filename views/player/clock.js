// Time, and how fast it goes.

/** How many times as fast as the run it may be played: the choices of the page. */
const playRates = () => Array.from(byId("rate").options, ({ value }) => Number(value));

/** The clock of a page between the ends of its axis [s]. `onChange` is called whenever it shows something else. */
function makeClock(axis, onChange) {
  const clock = {
    time: axis[0],
    isPlaying: false,
    rate: 1,
    goTo(time) {
      clock.time = Math.min(axis[1], Math.max(axis[0], time));
      onChange();
    },
    goToEnd: (isEnd) => clock.goTo(axis[isEnd ? 1 : 0]),
    play(isPlaying) {
      if (isPlaying && clock.time >= axis[1]) clock.time = axis[0];
      clock.isPlaying = isPlaying && axis[1] > axis[0];
      byId("play").setAttribute("aria-pressed", String(clock.isPlaying));
      byId("play").setAttribute("aria-label", clock.isPlaying ? "Pause" : "Play");
      onChange();
    },
    togglePlay: () => clock.play(!clock.isPlaying),
    setRate(rate) {
      clock.rate = Number(rate);
      byId("rate").value = String(rate);
      onChange();
    },
    changeRate(step) {
      const all = playRates();
      clock.setRate(all[Math.min(all.length - 1, Math.max(0, all.indexOf(clock.rate) + step))]);
    },
  };
  return clock;
}

/** What others may do with a clock. */
const clockActions = ({ goTo, goToEnd, play, togglePlay, setRate, changeRate }) =>
  ({ goTo, goToEnd, play, togglePlay, setRate, changeRate });

/** Calls `draw` at each tick of the screen, with the clock moved on while it plays, up to its end. */
function runClock(clock, axis, draw) {
  let last = performance.now();
  function tick(now) {
    if (clock.isPlaying) {
      clock.goTo(clock.time + (Math.min(100, now - last) / 1000) * clock.rate);
      if (clock.time >= axis[1]) clock.play(false);
    }
    last = now;
    draw();
    requestAnimationFrame(tick);
  }
  requestAnimationFrame(tick);
}
