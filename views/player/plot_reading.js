// What the plot shows in numbers: the values under the pointer, and the names and values of its curves at the present time.

/** A line and a box that show the values of all curves at the time under the pointer. */
function makePlotReading(run, plot) {
  const words = make("div", { class: "reading-words" });
  const element = make("div", { class: "reading", id: "reading", hidden: "" }, words);
  const { ships } = run.info;

  function rowOf(curve, time) {
    const values = plot.ships().map((k) => {
      const at = plot.valueAt(k, curve, time);
      return `${plot.ships().length > 1 ? `${ships[k].name} ` : ""}${at ? valueWords(at.value, curve.base) : "\u2013"}`;
    });
    const { label, isStack } = plot.shownQuantity();
    return make("div", {}, make("span", {}, ...(isStack ? [lineOf(curve)] : []), curve.label || label), make("b", {}, values.join(", ")));
  }

  return {
    element,
    show(time, px) {
      const at = plot.valueAt(plot.ships()[0], plot.curves()[0], time);
      const { isStack = false, sums = [] } = plot.shownQuantity();
      words.replaceChildren(make("div", {}, make("span", {}, "row that ends at"), make("b", {}, at ? `${Number(at.time.toFixed(6))} s` : "\u2013")),
        ...[...plot.shownCurves(), ...sums].map((curve) => rowOf(curve, time)));
      words.classList.toggle("many", isStack);
      element.hidden = false;
      element.style.left = `${px}px`;
      element.classList.toggle("to-left", px > plot.chart.over.clientWidth / 2);
    },
    hide() {
      element.hidden = true;
    },
  };
}

/** How a curve looks: a line, or the colour of an area. */
function lineOf({ kind, isArea = false }) {
  return make("i", isArea ? { class: "line area", style: `background: var(--cause-${kind})` } : { class: `line ${kind}` });
}

/** The plot's key: a box to tick, a line and the present value for each curve. Gives what shows the values. */
function fillPlotKey(run, plot, host, onChange) {
  const { ships } = run.info;
  const outputs = [];
  const curves = plot.curves();
  const rows = curves.map((curve) => {
    const isOfMany = plot.ships().length > 1;
    const values = plot.ships().map((k) => {
      const output = make("output", { "data-column": curve.column, "data-ship": ships[k].name });
      outputs.push({ curve, ship: k, output });
      return make("span", { class: "value", style: isOfMany ? `color: var(--ship-${k % 5})` : "" }, isOfMany ? `${ships[k].name} ` : "", output);
    });
    if (curves.length === 1) return make("div", { class: "curve" }, ...values);
    const box = make("input", { type: "checkbox", id: `curve-${curve.kind}` });
    box.checked = plot.isShown(curve);
    box.addEventListener("change", () => {
      plot.hidden[box.checked ? "delete" : "add"](curve.kind);
      onChange();
    });
    return make("label", { class: "curve" }, box, lineOf(curve), make("span", {}, curve.label), ...values);
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
