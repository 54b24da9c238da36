// Assembly of the page.

/** Returns a function that gives the page, and the worker, another text of the scene. */
function makeSceneSetter(page, parts) {
  let waiting = 0;
  function load() {
    page.hasNew = true;
    page.chosen = null;
    if (page.broken) return showBroken(page, parts, page.broken);
    if (page.isReading) parts.worker.replace();
    page.isReading = true;
    ++page.number;
    showPhase(page, "loading");
    parts.worker.ask("load", { text: page.text, number: page.number, files: [...page.files] });
    const { number } = page;
    setTimeout(() => page.isReading && number === page.number
      && showMessage("The scene is being read; large ones take a while.", true), 1500);
  }
  return function setScene(text, { isNew = false, keepsText = false, delay = 0 } = {}) {
    if (!isNew && text === page.text) return;
    if (isNew) page.undo = [], page.redo = [], showProblems([]);
    else page.undo.push(page.text), page.redo = [];
    page.text = text;
    page.isFitted = page.isFitted || isNew;
    if (!keepsText) byId("text").value = text;
    if (document.activeElement?.closest("#form") === null || isNew) parts.showForm();
    clearTimeout(waiting);
    if (delay > 0) waiting = setTimeout(load, delay);
    else load();
    linkOfScene(text).then((link) => link && !isNew && history.replaceState(null, "", link)).catch(() => {});
  };
}

/** Undo and redo: they exchange the present text with the previous or next one. */
function makeTurns(page, setScene) {
  const turn = (from, to) => () => {
    if (page[from].length === 0) return;
    const [undo, redo] = [[...page.undo], [...page.redo]];
    const stacks = { undo, redo };
    const text = stacks[from].pop();
    stacks[to].push(page.text);
    setScene(text);
    Object.assign(page, stacks);
    showPhase(page);
  };
  return { undo: turn("undo", "redo"), redo: turn("redo", "undo") };
}

/** Opens files from disk: a file whose name ends in .json is the scene, others are floe files that it names. */
async function openFiles(page, setScene, files) {
  let scene = null;
  for (const file of files) {
    if (file.size > 64e6) return toast(`${file.name} is too large for a page; use the native program.`);
    if (/\.json$/i.test(file.name) && scene === null) scene = await file.text();
    else page.files.set(file.name, new Uint8Array(await file.arrayBuffer()));
  }
  setScene(scene ?? page.text, { isNew: true });
}

function watchPage(page, parts, actions) {
  for (const [id, act] of Object.entries(actions)) {
    const control = byId(id);
    control.addEventListener(control.tagName === "SELECT" ? "change" : "click", () => act());
  }
  for (const button of document.querySelectorAll("[data-place]"))
    button.addEventListener("click", () => setTool(page, button.dataset.place));
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  byId("text").addEventListener("input", () => parts.setScene(byId("text").value, { keepsText: true, delay: 500 }));
  byId("files").addEventListener("change", () => openFiles(page, parts.setScene, [...byId("files").files]));
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer.files.length > 0) openFiles(page, parts.setScene, [...event.dataTransfer.files]);
  });
  byId("save-menu").addEventListener("click", ({ target }) => {
    if (target.tagName === "BUTTON") byId("save-menu").open = false;
  });
  new ResizeObserver(() => {
    page.view.resize();
    if (page.isFitted && page.run?.hasPlaces) page.view.fit(liveExtent(page.run));
    page.isDirty = true;
  }).observe(byId("stage"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", parts.refreshTheme);
}

function watchLiveKeys(page, parts, actions) {
  const keys = { " ": actions.run, ".": actions.step, r: actions.again, "+": actions["zoom-in"],
    "=": actions["zoom-in"],
    "-": actions["zoom-out"], f: actions.fit, Delete: actions.delete, Escape: () => setTool(page, null) };
  document.addEventListener("keydown", (event) => {
    const isText = event.target.closest("textarea, input[type=number], select");
    if ((event.ctrlKey || event.metaKey) && !event.altKey && !isText && /^[zy]$/i.test(event.key)) {
      event.preventDefault();
      return event.key.toLowerCase() === "y" || event.shiftKey ? actions.redo() : actions.undo();
    }
    if (event.ctrlKey || event.metaKey || event.altKey || isText) return;
    const isButton = event.target.closest("button, summary, input") && [" ", "Enter"].includes(event.key);
    const isSlider = event.target.matches("input[type=range]");
    const act = keys[event.key] ?? (!isSlider && parts.helm.ship >= 0 && ["running", "paused"].includes(page.phase)
      ? parts.helm.keys[event.key] : undefined);
    if (!act || isButton) return;
    event.preventDefault();
    act();
  });
}

/** Returns the first scene: that of the address, otherwise that of the program that wrote the page, otherwise the first
 * example. */
async function firstScene(texts, own) {
  const linked = await sceneOfLink(location.hash).catch(() => null);
  return linked ?? own ?? texts[0].text;
}

async function startPage() {
  const texts = JSON.parse(byId("scene-texts").textContent);
  const own = JSON.parse(byId("own-scene").textContent);
  const page = makePage();
  const parts = { texts, own, showForm: () => showForm(page, parts.setScene) };
  byId("scenes").replaceChildren(...(own === null ? [] : [make("option", { value: "own" }, "this scene")]),
    ...texts.map(({ title }, k) => make("option", { value: k }, title)));
  const { compiled, reason } = await compileModule();
  parts.refreshTheme = () => {
    page.colours = themeColours();
    page.plot.refresh();
    page.isDirty = true;
  };
  let answers = {};
  parts.worker = makeWorker(compiled, (message) => answers[message.kind]?.(message));
  parts.helm = makeHelm({ order: (ship, lever, angle) => parts.worker.ask("steer", { ship, lever, angle }),
    release: (ship) => parts.worker.ask("release", { ship }) });
  answers = makeAnswers(page, parts);
  parts.setScene = makeSceneSetter(page, parts);
  parts.turns = makeTurns(page, parts.setScene);
  const actions = makeLiveActions(page, parts);
  watchPage(page, parts, actions);
  watchLiveKeys(page, parts, actions);
  watchLiveMap(page, parts.setScene);
  page.view.resize();
  startDrawing(page, parts.worker, parts.helm);
  if (!compiled) showBroken(page, parts, reason);
  parts.setScene(await firstScene(texts, own), { isNew: true });
  window.polynyaPage = { page, parts, actions };
}
