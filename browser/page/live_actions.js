// Actions of the controls, by the ids of these.

/** Actions that control the run. */
function runActions(page, { worker, setScene }) {
  const rate = () => Number(byId("rate").value);
  return {
    run() {
      if (page.phase === "running") return worker.ask("pause");
      if (!["ready", "paused"].includes(page.phase)) return undefined;
      page.frames = [];
      showPhase(page, "running");
      worker.ask("more");
      return worker.ask("run", { rate: rate(), from: page.run.time });
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
      setScene(page.text, { isNew: true });
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
  };
}

/** Actions that save and open files. */
const fileActions = (page, { worker }) => ({
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
});

/** Actions that edit, and that change the appearance of the page. */
function viewActions(page, parts) {
  const moves = mapMoves(page);
  const middle = () => [page.view.width / 2, page.view.height / 2];
  return {
    undo: parts.turns.undo,
    redo: parts.turns.redo,
    delete() {
      const { chosen } = page;
      if (!chosen || !page.isEditable()) return;
      const path = chosen.kind === "waypoint" ? chosen.path.slice(0, -1) : chosen.path;
      page.chosen = null;
      parts.setScene(withoutItem(page.text, path));
    },
    "zoom-in": () => moves.zoom(middle(), 1.4),
    "zoom-out": () => moves.zoom(middle(), 1 / 1.4),
    fit() {
      page.isFitted = page.isDirty = true;
      if (page.run?.hasPlaces) page.view.fit(liveExtent(page.run));
    },
    theme() {
      const isDark = getComputedStyle(document.documentElement).colorScheme.includes("dark");
      document.documentElement.dataset.theme = isDark ? "light" : "dark";
      parts.refreshTheme();
    },
    "tab-form": () => showTab("form"),
    "tab-text": () => showTab("text"),
    by() {
      page.by = byId("by").value;
      showLegend(page);
      page.isDirty = true;
    },
    scenes() {
      const chosen = byId("scenes").value;
      page.files.clear();
      history.replaceState(null, "", location.pathname + location.search);
      showMessage("");
      parts.setScene(chosen === "own" ? parts.own : parts.texts[chosen].text, { isNew: true });
    },
  };
}

const makeLiveActions = (page, parts) =>
  ({ ...runActions(page, parts), ...fileActions(page, parts), ...viewActions(page, parts) });
