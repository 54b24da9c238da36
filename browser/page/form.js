// The form with numbers and choices of the scene. Names, ranges and meanings come from the JSON Schema.

/** Fields that are shown even if the text does not have them. */
const alwaysInForm = [["time", "until_s"], ["seed"], ["ice", "thickness_m"], ["ice", "flexural_strength_Pa"],
  ["ice", "compressive_strength_Pa"], ["water", "drift_m_per_s"]];
/** Lists of points are edited with the mouse or in the text, not in the form. */
const notInForm = new Set(["outer_m", "holes_m", "waterline_m", "outline_m", "centreline_m", "rows", "corners_m"]);
const mostInForm = 120; // largest number of fields; further values can be edited in the text

const schemaAt = (schema, path) => path.reduce((at, step) =>
  (typeof step === "number" ? at?.items : at?.properties?.[step]), schema);

/** The part of a schema that describes one number; among alternatives, the one that does. */
const numberSchema = (schema) => [schema, ...(schema?.oneOf ?? [])].find(({ type } = {}) =>
  type === "number" || type === "integer");

/** Paths of the form's fields in the order of the text. */
function formPaths(text, schema) {
  const paths = [];
  const known = new Set();
  const add = (path) => {
    const key = path.join(".");
    if (known.has(key) || paths.length >= mostInForm) return;
    known.add(key);
    paths.push(path);
  };
  alwaysInForm.forEach(add);
  (function walk(node, path) {
    if (notInForm.has(path.at(-1))) return;
    if (node.kind === "object") node.members.forEach(({ key, value }) => walk(value, [...path, key]));
    else if (node.kind === "array" && node.items.every(({ value }) => typeof value === "number")) {
      if (node.items.length === 2) add(path);
    } else if (node.kind === "array") node.items.slice(0, 8).forEach((item, k) => walk(item, [...path, k]));
    else if (["number", "boolean"].includes(typeof node.value) || schemaAt(schema, path)?.enum) add(path);
  }(parseText(text), []));
  return paths.filter((path) => schemaAt(schema, path));
}

/** Label of a field: "thickness [m]" for "thickness_m", "flexural strength [Pa]" for "flexural_strength_Pa". */
function labelOf(path, schema) {
  const key = String(path.findLast((step) => typeof step === "string"));
  const unit = /\[([^\]]+)\]\s*$/.exec(schema?.description ?? "")?.[1];
  const plain = key.replace(/_(?:m|s|Pa|N|kg|deg|m2|kN|kW|MW|W|m_per_s|deg_per_s|per_s|N_per_m|kg_per_m3)$/, "");
  return `${plain.replaceAll("_", " ")}${unit ? ` [${unit}]` : ""}`;
}

/** Heading of a field: "ships 1: hull" for ["ships", 0, "hull", "beam_m"]. */
function groupOf(path) {
  const words = path.slice(0, -1).map((step) => (typeof step === "number" ? step + 1 : step.replaceAll("_", " ")));
  return words.length === 0 ? "scene" : words.join(" ");
}

function numberField(path, part, schema, value, change) {
  const range = numberSchema(part === null ? schema : schema.items) ?? {};
  const input = make("input", { type: "number", step: range.type === "integer" ? "1" : "any" });
  if (range.minimum !== undefined) input.min = range.minimum;
  if (range.maximum !== undefined) input.max = range.maximum;
  input.value = value ?? "";
  input.addEventListener("change", () => input.value !== "" && change(path, part, Number(input.value)));
  return input;
}

function choiceField(path, schema, value, change) {
  if (schema.type === "boolean") {
    const box = make("input", { type: "checkbox" });
    box.checked = value === true;
    box.addEventListener("change", () => change(path, null, box.checked));
    return box;
  }
  const select = make("select", {}, ...schema.enum.map((choice) => make("option", { value: choice }, choice)));
  select.value = value;
  select.addEventListener("change", () => change(path, null, select.value));
  return select;
}

const isPair = (value) => Array.isArray(value) && value.length === 2;

/** Inputs of a field, according to its schema: a choice, two numbers, or one number; none for anything else. */
function fieldsOf(path, schema, given, change) {
  const value = given ?? schema.default;
  if (schema.enum || schema.type === "boolean") return [choiceField(path, schema, value, change)];
  const list = [schema, ...(schema.oneOf ?? [])].find(({ type }) => type === "array");
  if (list && isPair(value)) return value.map((_, k) => numberField(path, k, list, value[k], change));
  return numberSchema(schema) ? [numberField(path, null, schema, value, change)] : [];
}

/** A field with its label. A list of two numbers has two inputs. Returns nothing if the form has no input for it. */
function formRow(path, schema, given, change) {
  const label = labelOf(path, schema);
  const fields = fieldsOf(path, schema, given, change);
  const partOf = (k) => (fields.length > 1 ? ` ${"xy"[k]}` : "");
  fields.forEach((field, k) => field.setAttribute("aria-label", `${groupOf(path)}: ${label}${partOf(k)}`));
  const title = `${path.join(".")}: ${schema.description ?? ""}`;
  return fields.length > 0 ? [make("label", { title }, make("span", {}, label), ...fields)] : [];
}

/** Fills the form from the text. `change(path, value)` is called after a field was changed. */
function fillForm(form, text, schema, change) {
  const root = parseText(text);
  const changed = (path, part, value) => {
    if (part === null) return change(path, value);
    const node = nodeAt(root, path);
    const list = [...(node ? valueOf(node) : schemaAt(schema, path).default)];
    list[part] = value;
    return change(path, list);
  };
  const groups = new Map();
  for (const path of formPaths(text, schema)) {
    const node = nodeAt(root, path);
    const group = groupOf(path);
    if (!groups.has(group)) groups.set(group, []);
    groups.get(group).push(...formRow(path, schemaAt(schema, path), node && valueOf(node), changed));
  }
  const filled = [...groups].filter(([, rows]) => rows.length > 0);
  form.replaceChildren(...filled.map(([group, rows]) => make("fieldset", {}, make("legend", {}, group), ...rows)));
}
