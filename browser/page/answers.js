// Changes of the page after messages of the worker.

const gigabytes = (bytes) => `${(bytes / 2 ** 30).toPrecision(2)} GiB`;

function problemsIn(words) {
  try {
    return JSON.parse(words);
  } catch {
    return null;
  }
}

/** Opens the player with the run as it was read back. */
function openStudy({ info, bytes }) {
  const template = JSON.parse(byId("player-page").textContent);
  const parts = { title: "Run", options: "{}", info: JSON.stringify(info).replaceAll("<", "\\u003c"),
    columns: base64Of(bytes) };
  const frame = make("iframe", { title: "The run in the player" });
  frame.srcdoc = template.replace(/\{\{(title|options|info|columns)\}\}/g, (_, name) => parts[name]);
  byId("study-page").append(frame);
  byId("study-page").hidden = false;
  byId("study-close").focus();
}

/** Returns true if an answer belongs to an earlier text of the scene. */
const isOld = (page, { number }) => number !== undefined && number !== page.number;

/** Answers about reading a scene. */
const sceneAnswers = (page, parts) => ({
  ready({ schema, version }) {
    page.schema = schema;
    byId("about").textContent = `Polynya ${version}: the program itself, in this page; nothing leaves it. Floe files `
      + "in degrees are imported with the native program.";
    parts.showForm();
  },
  read(message) {
    if (isOld(page, message)) return;
    const { words } = message;
    page.run = makeLiveRun(words);
    page.hasNew = true;
    byId("description").textContent = words.description;
    byId("of").textContent = `of ${words.until_s} s`;
    showProblems(words.hints);
    const [needed, limit] = [words.memory_bytes, words.limit_bytes].map(gigabytes);
    if (words.memory_at_start_bytes > words.limit_bytes) {
      page.isReading = false;
      showMessage(`This scene needs ${gigabytes(words.memory_at_start_bytes)} of memory before its first step, and `
        + `a page has ${limit}. Make it smaller, or run it with the native program.`);
      showPhase(page, "refused");
    } else if (words.memory_bytes > words.limit_bytes)
      page.warning = `With all ice moving this scene takes ${needed} of memory, and a page has ${limit}: `
        + "the run may end before its time.";
    else page.warning = "";
  },
  started(message) {
    if (isOld(page, message)) return;
    page.isReading = false;
    showMessage(page.warning);
    page.plot.show(page.run);
    parts.helm.show(page.run.info.ships);
    showPhase(page, "ready");
  },
  refused(message) {
    if (isOld(page, message)) return;
    page.isReading = false;
    const problems = message.order === "load" && problemsIn(message.words);
    if (problems) {
      showProblems(problems);
      const errors = problems.filter(({ severity }) => severity === "error").length;
      showMessage(`The scene has ${counted(errors || problems.length, "problem")}; the list beside the map has each `
        + "with its line.");
    } else showMessage(message.words);
    showPhase(page, message.order === "load" ? "refused" : "ended");
  },
});

/** Answers about a run. */
const runAnswers = (page, parts) => ({
  snapshot({ words, columns }) {
    if (!page.run) return;
    page.run.take({ words, columns });
    if (page.hasNew && page.isFitted) page.view.fit(liveExtent(page.run));
    if (page.hasNew) showLegend(page);
    page.hasNew = false;
    page.hasNews = page.isDirty = true;
  },
  paused: () => page.phase === "running" && showPhase(page, "paused"),
  finished({ words }) {
    page.hash = words;
    showPhase(page, "ended");
    toast(`The run is at its end; its state's hash is ${words}.`);
  },
  failed({ words }) {
    showMessage(`The run failed at ${page.run.time.toFixed(2)} s: ${words}. The scene can be changed and started `
      + "again.");
    showPhase(page, "ended");
  },
  broken({ words, order }) {
    if (order === "open") return showBroken(page, parts, words);
    showMessage(`The simulator broke down${order === "load" ? " while it read this scene" : ""} (${words}). It was `
      + "started anew; change the scene, or choose another.");
    parts.worker.replace();
    page.isReading = false;
    return showPhase(page, "refused");
  },
  run: openStudy,
  async folder({ files }) {
    const { name } = page.run.words;
    page.lastZip = await zipOf(files.map(([file, bytes]) => [`${name}/${file}`, bytes]));
    download(page.lastZip, `${name}.zip`);
  },
});

/** Handlers for messages of the worker, by their kinds. */
const makeAnswers = (page, parts) => ({ ...sceneAnswers(page, parts), ...runAnswers(page, parts) });
