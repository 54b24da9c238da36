// The page, put together: what is done with what the worker says, and with controls, keys and pointers.

/** Answers to messages of the worker, each with what changes in the page. */
function makeAnswers(page, parts) {
  const isOld = ({ number }) => number !== undefined && number !== page.number;
  function brokenDown({ words, order }) {
    showMessage(`The simulator broke down${order === "load" ? " while it read this scene" : ""} (${words}). It was `
      + "started anew; change the scene, or choose another.");
    parts.worker.replace();
    page.isReading = false;
    showPhase(page, "refused");
  }
  return {
    ready({ schema, version }) {
      page.schema = schema;
      byId("about").textContent = `Polynya ${version}: the program itself, in this page; nothing leaves it. Floe files `
        + "in degrees are imported with the native program.";
      parts.showForm();
    },
    read(message) {
      if (isOld(message)) return;
      const { words } = message;
      page.run = makeLiveRun(words);
      page.hasNew = true;
      byId("description").textContent = words.description;
      byId("of").textContent = `of ${words.until_s} s`;
      showProblems(words.hints);
      if (words.memory_at_start_bytes > words.limit_bytes) {
        page.isReading = false;
        showMessage(`This scene needs ${gigabytes(words.memory_at_start_bytes)} of memory before its first step, and a `
          + `page has ${gigabytes(words.limit_bytes)}. Make it smaller, or run it with the native program.`);
        return showPhase(page, "refused");
      }
      showMessage(words.memory_bytes > words.limit_bytes ? `With all ice moving this scene takes ${
        gigabytes(words.memory_bytes)} of memory, and a page has ${gigabytes(words.limit_bytes)}: it may be stopped.` : "");
    },
    started(message) {
      if (isOld(message)) return;
      page.isReading = false;
      page.plot.show(page.run);
      parts.helm.show(page.run.info.ships);
      showPhase(page, "ready");
    },
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
      showMessage(`The run failed at ${page.run.time.toFixed(2)} s: ${words}. The scene can be changed and started again.`);
      showPhase(page, "ended");
    },
    refused(message) {
      if (isOld(message)) return;
      page.isReading = false;
      const problems = message.order === "load" && problemsIn(message.words);
      if (problems) {
        showProblems(problems);
        const errors = problems.filter(({ severity }) => severity === "error").length;
        showMessage(`The scene has ${counted(errors || problems.length, "problem")}; the list beside the map has `
          + "each with its line.");
      } else showMessage(message.words);
      showPhase(page, message.order === "load" ? "refused" : "ended");
    },
    broken: brokenDown,
    run: (message) => openStudy(message),
    folder: ({ files }) => zipOf(files.map(([name, bytes]) => [`${page.run.words.name}/${name}`, bytes])).then((blob) => {
      page.lastZip = blob;
      download(blob, `${page.run.words.name}.zip`);
    }),
  };
}

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

/** Gives the page another text of its scene, and the worker too. */
function makeSceneSetter(page, parts) {
  let waiting = 0;
  function load() {
    page.hasNew = true;
    page.chosen = null;
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
    if (isNew) page.undo = [], page.redo = [];
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

/** Undo and redo: the text before, the text after. */
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

/** Pointers on the map: what can be edited is dragged, all else moves the map. */
function watchLiveMap(page, setScene) {
  const { view } = page;
  const stage = byId("stage");
  let held = null;
  let from = null;
  let moved = 0;
  const redraw = () => { page.isDirty = true; };
  function tryEdit(change) {
    try {
      setScene(change());
    } catch (fault) {
      toast(`this cannot be edited by mouse: ${fault.message}`);
    }
  }
  function find(at) {
    try {
      return page.isEditable() ? findHandle(page.run, view, page.text, at) : null;
    } catch {
      return null;
    }
  }
  /** Shows what is held where the pointer is, until it is let go. */
  function preview(at) {
    const [x, y] = view.toWorld(...at);
    const pose = page.run.motions.ship(held.hull);
    if (held.kind === "turn") pose[2] = Math.atan2(y - pose[1], x - pose[0]);
    if (held.kind === "hull") [pose[0], pose[1]] = [held.pose[0] + x - from[0], held.pose[1] + y - from[1]];
  }
  watchPointers(stage, {
    start(event, at, count) {
      moved = 0;
      held = count === 1 && !page.tool ? find(at) : null;
      from = view.toWorld(...at);
      if (held?.hull !== undefined) held.pose = [...page.run.motions.ship(held.hull)];
      page.chosen = held;
      showPhase(page);
      redraw();
    },
    hover: (event, at) => { stage.style.cursor = page.tool ? "crosshair" : find(at) ? "move" : ""; },
    drag(at, before) {
      moved += Math.hypot(at[0] - before[0], at[1] - before[1]);
      if (held) preview(at);
      else {
        view.panBy(at[0] - before[0], at[1] - before[1]);
        page.isFitted = false;
      }
      redraw();
    },
    pinch(after, before) {
      const size = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
      const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
      view.panBy(...middle(after).map((value, k) => value - middle(before)[k]));
      view.zoomAt(...middle(after), size(after) / Math.max(1, size(before)));
      page.isFitted = false;
      redraw();
    },
    end({ type }, at) {
      if (type === "pointercancel") return;
      if (page.tool && moved < clickSlop) {
        const { tool } = page;
        setTool(page, null);
        tryEdit(() => withPlaced(page.text, view, tool, view.toWorld(...at)));
      } else if (held && moved >= clickSlop)
        tryEdit(() => movedText(page.text, page.run, view, held, from, view.toWorld(...at)));
      held = null;
    },
  });
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoomAt(...pointIn(stage, event), Math.exp(-wheelTurn(event)));
    page.isFitted = false;
    redraw();
  }, { passive: false });
}

function setTool(page, tool) {
  page.tool = page.tool === tool ? null : tool;
  for (const button of document.querySelectorAll("[data-place]"))
    button.setAttribute("aria-pressed", String(button.dataset.place === page.tool));
}

/** What the controls do, by their ids. */
function makeLiveActions(page, parts) {
  const { worker } = parts;
  const rate = () => Number(byId("rate").value);
  const fit = () => {
    page.isFitted = true;
    if (page.run) page.view.fit(liveExtent(page.run));
    page.isDirty = true;
  };
  const zoom = (factor) => {
    page.view.zoomAt(page.view.width / 2, page.view.height / 2, factor);
    page.isFitted = false;
    page.isDirty = true;
  };
  const actions = {
    run() {
      if (page.phase === "running") return worker.ask("pause");
      if (!["ready", "paused"].includes(page.phase)) return;
      page.frames = [];
      showPhase(page, "running");
      worker.ask("more");
      worker.ask("run", { rate: rate(), from: page.run.time });
    },
    step() {
      if (!["ready", "paused"].includes(page.phase)) return;
      showPhase(page, "paused");
      worker.ask("step");
    },
    again() {
      worker.replace();
      page.isReading = false;
      showMessage("");
      parts.setScene(page.text, { isNew: true });
    },
    stop() {
      worker.replace();
      page.isReading = false;
      showMessage("Reading was stopped.");
      showPhase(page, "refused");
    },
    rate: () => page.run && worker.ask("pace", { rate: rate(), from: page.run.time }),
    study() {
      toast("The run is read…");
      worker.ask("read_back", {});
      showPhase(page, "ended");
    },
    "study-close"() {
      byId("study-page").hidden = true;
      byId("study-page").querySelector("iframe")?.remove();
    },
    "save-scene": () => download(new Blob([page.text], { type: "application/json" }),
      `${page.run?.words.name ?? "scene"}.json`),
    "save-run"() {
      worker.ask("folder", {});
      showPhase(page, "ended");
    },
    async "copy-link"() {
      const link = await linkOfScene(page.text);
      if (!link) return toast("This scene is too long for a link; save it as a file.");
      history.replaceState(null, "", link);
      await navigator.clipboard?.writeText(location.href).catch(() => {});
      return toast("A link to this scene is in the clipboard and in the address bar.");
    },
    "open-files": () => byId("files").click(),
    theme() {
      const isDark = getComputedStyle(document.documentElement).colorScheme.includes("dark");
      document.documentElement.dataset.theme = isDark ? "light" : "dark";
      parts.refreshTheme();
    },
    undo: parts.turns.undo,
    redo: parts.turns.redo,
    delete() {
      const { chosen } = page;
      if (!chosen || !page.isEditable()) return;
      const path = chosen.kind === "waypoint" ? chosen.path.slice(0, -1) : chosen.path;
      page.chosen = null;
      parts.setScene(withoutItem(page.text, path));
    },
    "zoom-in": () => zoom(1.4), "zoom-out": () => zoom(1 / 1.4), fit,
    "tab-form": () => showTab("form"), "tab-text": () => showTab("text"),
    by() {
      page.by = byId("by").value;
      showLegend(page);
      page.isDirty = true;
    },
    scenes: () => {
      const { own, texts } = parts;
      const chosen = byId("scenes").value;
      page.files.clear();
      history.replaceState(null, "", location.pathname + location.search);
      parts.setScene(chosen === "own" ? own : texts[chosen].text, { isNew: true });
    },
  };
  return actions;
}

/** Scenes and floe files from disk: the file that ends in .json is the scene, others are files that it names. */
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
  const keys = { " ": actions.run, ".": actions.step, r: actions.again, "+": actions["zoom-in"], "=": actions["zoom-in"],
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

/** The scene to begin with: of the address, of the file that wrote the page, or the first. */
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
  if (!window.WebAssembly || !window.DecompressionStream)
    return showMessage("This browser is too old for the simulator: it needs WebAssembly and DecompressionStream.");
  let compiled = null;
  try {
    compiled = await compileModule();
  } catch (failure) {
    return showMessage(`The simulator does not start in this browser: ${failure.message}`);
  }
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
  parts.setScene(await firstScene(texts, own), { isNew: true });
  window.polynyaPage = { page, parts, actions };
  return undefined;
}
