// The clock of the player: time, and speed of playback.

/** Playback speeds that the page offers, as multiples of real time. */
const playRates = () => Array.from(byId("rate").options, ({ value }) => Number(value));

/** Makes the clock of a page. `axis` are its first and last time [s]; `time` stays between them. `rate` is the speed of
 * playback as a multiple of real time; changeRate() moves it by `step` places in the list of the page, and a rate that
 * is not in the list counts as the place before the first. play(true) at the end starts again from the beginning.
 * `onChange` is called whenever the clock changes. */
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

/** The functions of a clock that other parts may call as actions. */
const clockActions = ({ goTo, goToEnd, play, togglePlay, setRate, changeRate }) =>
  ({ goTo, goToEnd, play, togglePlay, setRate, changeRate });

/** Calls `draw` at each refresh of the screen, also if nothing has changed. While the clock plays, it is advanced
 * before, until its end. A refresh advances it by at most 100 ms × `rate`, so that it does not jump after the page was
 * hidden or drawing was slow. */
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
