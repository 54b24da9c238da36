// What the plot shows in numbers: the values under the pointer, and the names and values of its curves at the present time.

/** A line and a box that show the values of all curves at the time under the pointer. */
function makePlotReading(run, plot) {
  const words = make("div", { class: "reading-words" });
  const element = make("div", { class: "reading", id: "reading", hidden: "" }, words);
  const { ships } = run.info;

  function rowOf(curve, time) {
    const values = ships.map((ship, k) => {
      const at = plot.valueAt(k, curve, time);
      return `${ships.length > 1 ? `${ship.name} ` : ""}${at ? valueWords(at.value, curve.base) : "\u2013"}`;
    });
    return make("div", {}, make("span", {}, curve.label || plot.quantities[plot.quantity].label), make("b", {}, values.join(", ")));
  }

  return {
    element,
    show(time, px) {
      const at = plot.valueAt(0, plot.curves()[0], time);
      words.replaceChildren(make("div", {}, make("span", {}, "row that ends at"), make("b", {}, at ? `${Number(at.time.toFixed(6))} s` : "\u2013")),
        ...plot.shownCurves().map((curve) => rowOf(curve, time)));
      element.hidden = false;
      element.style.left = `${px}px`;
      element.classList.toggle("to-left", px > plot.chart.over.clientWidth / 2);
    },
    hide() {
      element.hidden = true;
    },
  };
}

/** The plot's key: a box to tick, a line and the present value for each curve. Gives what shows the values. */
function fillPlotKey(run, plot, host, onChange) {
  const { ships } = run.info;
  const outputs = [];
  const curves = plot.curves();
  const rows = curves.map((curve) => {
    const values = ships.map((ship, k) => {
      const output = make("output", { "data-column": curve.column, "data-ship": ship.name });
      outputs.push({ curve, ship: k, output });
      return make("span", { class: "value", style: ships.length > 1 ? `color: var(--ship-${k % 5})` : "" },
        ships.length > 1 ? `${ship.name} ` : "", output);
    });
    if (curves.length === 1) return make("div", { class: "curve" }, ...values);
    const box = make("input", { type: "checkbox", id: `curve-${curve.kind}` });
    box.checked = plot.isShown(curve);
    box.addEventListener("change", () => {
      plot.hidden[box.checked ? "delete" : "add"](curve.kind);
      onChange();
    });
    return make("label", { class: "curve" }, box, make("i", { class: `line ${curve.kind}` }), make("span", {}, curve.label), ...values);
  });
  host.replaceChildren(...rows);
  return (time) => {
    for (const { curve, ship, output } of outputs) {
      const at = plot.valueAt(ship, curve, time);
      output.textContent = at ? valueWords(at.value, curve.base) : "\u2013";
      output.dataset.value = at ? String(at.value) : "";
      output.dataset.time = at ? String(at.time) : "";
    }
  };
}
