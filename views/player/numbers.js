// Numbers and words as the page shows them.

const byId = (id) => document.getElementById(id);

/** Makes an element with attributes and children, which are elements or texts. It is not yet part of the page. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** A count with its noun: "1 floe", "2 floes". The plural is always formed by an s. */
const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

/** A number as text with a true minus sign instead of a hyphen at its start. The hyphen of an exponent stays. */
const minus = (text) => text.replace(/^-/, "\u2212");

// Numbers for people: four digits, in a unit that suits the value, with spaces between thousands. A value that is so
// small that it can only be rounding is shown as 0.

/** The larger units of a base unit with the prefixes of the SI. */
const prefixed = (base) => [[1e9, `G${base}`], [1e6, `M${base}`], [1e3, `k${base}`]];
/** For each base unit, the larger units, largest first, and `least`: a smaller value is shown as 0, because it can only
 * be rounding [base unit]. A larger unit has the value from which it is used, its name, and its size if that is another
 * value: kilometres are used from 10 km on. */
const unitScales = {
  N: { larger: prefixed("N"), least: 0.1 }, "N\u00b7m": { larger: prefixed("N\u00b7m"), least: 0.1 },
  Pa: { larger: prefixed("Pa"), least: 0.1 }, W: { larger: prefixed("W"), least: 0.1 },
  J: { larger: prefixed("J"), least: 0.1 }, kg: { larger: [[1e3, "t"]], least: 1e-3 },
  m: { larger: [[1e4, "km", 1e3]], least: 1e-3 }, "m\u00b2": { larger: [[1e6, "km\u00b2"]], least: 1e-3 },
  s: { larger: [], least: 1e-3 }, "m/s": { larger: [], least: 1e-4 },
};
/** The same for all other units, such as "°/s", and for numbers without a unit: they have no larger units. */
const otherScale = { larger: [], least: 1e-4 };

/** Unit in which a value, or an axis of a plot up to that value, is shown: its name, and the factor by which a value in
 * the base unit is multiplied. A value that four digits round up to the next unit has that unit, so the limit is
 * 0.99995 of the unit: 999.96 kN is shown as 1 MN. */
function unitFor(value, base) {
  const { larger } = unitScales[base] ?? otherScale;
  const [, name, size] = larger.map(([from, word, step = from]) => [from, word, step])
    .find(([from]) => Math.abs(value) >= from * 0.99995) ?? [0, base, 1];
  return { factor: 1 / size, name };
}

/** A number with four significant digits, but from 1000 on with all digits before the point, rounded to a whole number,
 * and with narrow spaces between thousands. `isSteady` keeps zeros at the end, so that a number that changes while the
 * run plays keeps its width. */
function fourDigits(value, isSteady = false) {
  const size = Math.abs(value);
  const text = size >= 1000 ? String(Math.round(value)) : value.toPrecision(4);
  const plain = isSteady && size > 0 && size < 1000 ? text : String(Number(text));
  return minus(plain.replace(/\d(?=(\d{3})+$)/g, (digit, _, at, whole) =>
    (whole.includes(".") || whole.includes("e") ? digit : `${digit}\u202f`)));
}

/** A value in a base unit ("N", "kg", "m", \u2026) as text: "4 889 t", "0.5 m", "\u2212289.3 N", "0 N". A whole number
 * below 1000, such as a count, has no decimals even if `isSteady`. */
function valueWords(value, base, isSteady = false) {
  const { least } = unitScales[base] ?? otherScale;
  const shown = Math.abs(value) < least ? 0 : value;
  const { factor, name } = unitFor(shown, base);
  const isCount = Number.isInteger(shown) && Math.abs(shown) < 1000 && factor === 1;
  return `${isCount ? minus(String(shown)) : fourDigits(shown * factor, isSteady)} ${name}`.trim();
}

const metresPerSecondOfKnot = 1852 / 3600;

/** Speed of a ship [m/s] as text in both units in use, m/s and knots, for its card and for the short text about it on
 * the map. The knots have at most two decimals; 0.01 kn is 0.005 m/s. */
const shipSpeedWords = (speed) =>
  `${valueWords(speed, "m/s")} (${fourDigits(Number((speed / metresPerSecondOfKnot).toFixed(2)))} kn)`;

/** Largest of 1, 2, 5 × 10ⁿ that is at most `room`, in the unit of `room`, which must be positive. It is used for the
 * length of the scale bar [m], for the value of an arrow in the legend, and for the limits of classes of colours. */
function roundBelow(room) {
  const decade = 10 ** Math.floor(Math.log10(room));
  return decade * (room >= 5 * decade ? 5 : room >= 2 * decade ? 2 : 1);
}

/** A number in a short text, such as a floe size in the legend, a wind speed on the map of a scene or the bounds of an
 * area, with at most three significant digits, a hyphen as minus sign and no spaces. */
const shortNumber = (value) => String(Number(value.toPrecision(3)));

/** Sets the size of a canvas in pixels of the page, which also clears it. Returns the number of its own pixels per
 * pixel of the page: that of the screen, at most 2. With more, pictures on finer screens would be sharper, but drawing
 * takes longer. */
function sizeCanvas(canvas, width, height) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  return ratio;
}

/** Does the same as sizeCanvas(), but returns a context for drawing, which is scaled to pixels of the page. */
function clearedCanvas(canvas, width, height) {
  const ratio = sizeCanvas(canvas, width, height);
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  return context;
}
