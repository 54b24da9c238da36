// Numbers and words as they are shown.

const byId = (id) => document.getElementById(id);

/** An element with attributes and children. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** "1 floe", "2 floes". */
const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

const minus = (text) => text.replace(/^-/, "\u2212");

/** A force [N] or moment [N m] in the unit that suits `largest`. */
function loadUnit(largest, base) {
  if (largest >= 1e6) return { factor: 1e-6, name: "M" + base };
  if (largest >= 1e3) return { factor: 1e-3, name: "k" + base };
  return { factor: 1, name: base };
}

/** A load [N] or moment [N m] in words, its number by `digits`. */
function loadWords(value, base, digits) {
  const unit = loadUnit(Math.abs(value), base);
  return `${digits(value * unit.factor)} ${unit.name}`;
}

/** The longest of 1, 2, 5 × 10ⁿ that is at most `room`. */
function roundBelow(room) {
  const decade = 10 ** Math.floor(Math.log10(room));
  return decade * (room >= 5 * decade ? 5 : room >= 2 * decade ? 2 : 1);
}

/** Six significant digits, without an exponent where they can be read without. */
function sixDigits(value) {
  const text = value.toPrecision(6);
  return text.includes("e") && Math.abs(value) < 1e12 && Math.abs(value) >= 1e-6 ? String(Number(text)) : text;
}

const shortNumber = (value) => String(Number(value.toPrecision(3)));

/** Gives a canvas a size [px] and clears it. Returns how many of its own pixels one is. */
function sizeCanvas(canvas, width, height) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  return ratio;
}

/** The same; its context has these pixels. */
function clearedCanvas(canvas, width, height) {
  const ratio = sizeCanvas(canvas, width, height);
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  return context;
}
