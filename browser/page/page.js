// The page: its scene, its worker, its controls.

/** Unpacks and compiles the bytes of the module. Returns it as `compiled`, or the reason why there is none. */
async function compileModule() {
  if (!window.WebAssembly || !window.DecompressionStream)
    return { compiled: null, reason: "it is too old, it has no WebAssembly or no DecompressionStream" };
  try {
    const packed = bytesOfBase64(byId("module").textContent.trim());
    byId("module").remove();
    return { compiled: await WebAssembly.compile(await throughStream(packed, new DecompressionStream("gzip"))) };
  } catch (failure) {
    return { compiled: null, reason: failure.message };
  }
}

/** Makes a worker with the simulator; `hear` receives its messages. A worker that is stopped is replaced by a new one.
 * Without a module (null) there is no worker, and orders have no effect: the scene can still be edited and saved. */
function makeWorker(compiled, hear) {
  const address = URL.createObjectURL(new Blob([byId("worker-script").textContent], { type: "text/javascript" }));
  let worker = null;
  const start = () => {
    if (!compiled) return;
    worker = new Worker(address);
    worker.onmessage = ({ data }) => hear(data);
    worker.onerror = (event) => {
      event.preventDefault();
      hear({ kind: "broken", words: event.message });
    };
    worker.postMessage({ order: "open", compiled });
  };
  start();
  return { ask: (order, words = {}) => worker?.postMessage({ order, ...words }),
    end() {
      worker?.terminate();
      worker = compiled = null;
    },
    replace() {
      worker?.terminate();
      start();
    } };
}

/** Makes the state of the page and the objects that belong to it. */
function makePage() {
  const canvas = byId("ice");
  const page = { text: "", number: 0, run: null, broken: "",
    phase: "loading", undo: [], redo: [], files: new Map(), isDirty: true,
    by: "generation", colours: themeColours(), chosen: null, tool: null, isFitted: true, schema: null, frames: [],
    errors: 0 };
  page.view = makeMapView(byId("stage"), [canvas]);
  page.context = canvas.getContext("2d", { alpha: false });
  page.plot = makeLivePlot(byId("plot"), byId("quantity"), () => page.colours);
  // A refused scene can be edited too, because the position of an object may be the reason.
  page.isEditable = () => ["ready", "refused"].includes(page.phase) && page.run?.hasPlaces && page.run.time === 0;
  return page;
}

const phaseWords = { loading: "Run", ready: "Run", running: "Pause", paused: "Run", ended: "Run", refused: "Run",
  broken: "Run" };

/** Enables the controls that can be used in the present phase. */
function showPhase(page, phase = page.phase) {
  page.phase = phase = page.broken ? "broken" : phase;
  const canRun = ["ready", "running", "paused"].includes(phase);
  byId("run").textContent = phaseWords[phase];
  byId("run").disabled = !canRun;
  byId("step").disabled = !["ready", "paused"].includes(phase);
  byId("again").disabled = ["loading", "broken"].includes(phase) || !page.run;
  byId("study").disabled = byId("save-run").disabled = !["paused", "ended", "running"].includes(phase);
  byId("edit-bar").classList.toggle("off", !["ready", "refused", "loading"].includes(phase));
  byId("undo").disabled = page.undo.length === 0;
  byId("redo").disabled = page.redo.length === 0;
  byId("delete").disabled = !page.chosen || !["hull", "floe", "waypoint"].includes(page.chosen.kind);
  document.body.dataset.phase = phase;
}

/** Says that the simulator cannot run here. The scene's text can still be edited and saved. */
function showBroken(page, parts, reason) {
  page.broken = reason;
  page.isReading = false;
  parts.worker.end();
  showPhase(page);
  showTab("text"); // the form is made from the module's schema
  showMessage(`The simulator does not start in this browser: ${reason}. Scenes can be edited and saved here, but not `
    + "run. The file of this page may be incomplete; get it again.");
}

function showMessage(words, canStop = false) {
  byId("message").hidden = !words;
  byId("message").firstElementChild.textContent = words;
  byId("stop").hidden = !canStop;
}

let toastTimer = 0;
function toast(words) {
  byId("toast").hidden = false;
  byId("toast").textContent = words;
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => { byId("toast").hidden = true; }, 3500);
}

/** Shows the reader's problems and hints. The line of each is a button that goes to the line in the text. */
function showProblems(problems) {
  byId("problems").replaceChildren(...problems.slice(0, 60).map(({ severity, line, path, message }) => {
    const words = `${severity}${line ? `, line ${line}` : ""}: ${path}: ${message}`;
    const item = make("li", { class: severity }, words);
    if (!line) return item;
    const go = make("button", { type: "button", "aria-label": `Go to line ${line}` }, "go");
    go.addEventListener("click", () => goToLine(line));
    item.append(" ", go);
    return item;
  }));
}

function showTab(name) {
  for (const tab of ["form", "text"]) {
    byId(`tab-${tab}`).setAttribute("aria-selected", String(tab === name));
    byId(`${tab}-panel`).hidden = tab !== name;
  }
}

function goToLine(line) {
  showTab("text");
  const area = byId("text");
  const lines = area.value.split("\n");
  const from = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  area.focus();
  area.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
  area.scrollTop = Math.max(0, (line - 5) * 17);
}

/** Fills the form. It stays unchanged if the text is not valid JSON. */
function showForm(page, setScene) {
  if (!page.schema) return;
  try {
    fillForm(byId("form"), page.text, page.schema, (path, value) => {
      try {
        setScene(withValue(page.text, path, value));
      } catch (fault) {
        toast(`the text is no JSON: ${fault.message}`);
      }
    });
  } catch (fault) {
    if (!(fault instanceof TextFault)) throw fault;
  }
}

/** Shows the numbers beside the plot. */
function showNumbers(page, isRunning) {
  const { run } = page;
  byId("now").textContent = `${run.time.toFixed(1)} s`;
  const { bends, splits } = run.counts;
  byId("counts").textContent = `${counted(run.places.count, "floe")}, ${counted(bends, "bend")}, ${
    counted(splits, "split")}`;
  const now = performance.now();
  page.frames.push([now, run.time]);
  while (page.frames.length > 2 && now - page.frames[0][0] > 1000) page.frames.shift();
  const [[t0, s0]] = page.frames;
  page.speed = now > t0 ? (1000 * (run.time - s0)) / (now - t0) : 0;
  page.perSecond = now > t0 ? (1000 * (page.frames.length - 1)) / (now - t0) : 0;
  byId("speed").textContent = isRunning && page.frames.length > 4
    ? `${fourDigits(Number(page.speed.toPrecision(2)))} × real time, ${Math.round(page.perSecond)}/s` : "";
}

function showLegend(page) {
  if (!page.run) return;
  const { title, fills, edges } = liveLook(page.run, page.by, page.colours);
  const words = [`below ${edges[0]}`, ...edges.map((edge, k) => (k + 1 < edges.length ? String(edge) : `${edge} +`))];
  byId("legend").replaceChildren(`${title}: `, ...fills.map((fill, k) => {
    const swatch = make("i", {});
    swatch.style.background = fill;
    return make("span", {}, swatch, page.by === "generation" && k === 0 ? "none" : words[k]);
  }));
}

/** At each refresh of the screen, draws what has changed and then asks the worker for the next picture. */
function startDrawing(page, worker, helm) {
  function tick() {
    requestAnimationFrame(tick);
    if (!page.isDirty) return;
    page.isDirty = false;
    const isPlan = page.isEditable();
    const handles = isPlan && page.run ? page.run.info.ships.flatMap((ship, k) => (k < page.run.words.ships ? [k] : []))
      : [];
    drawLive(page.context, page.view, page.run, { by: page.by, colours: page.colours, isPlan,
      chosen: isPlan ? { handles, held: page.chosen } : null });
    if (!page.hasNews || !page.run) return;
    page.hasNews = false;
    showNumbers(page, page.phase === "running");
    page.plot.grow();
    helm.follow(page.run.motions.ship(helm.ship));
    ++page.drawn;
    if (page.phase === "running") worker.ask("more");
  }
  page.drawn = 0;
  requestAnimationFrame(tick);
}
