"use strict";
// Scenes that are wrong, huge, or fail numerically: a name and a text each.

const ship = { name: "s", ship: "reference", position_m: [-90, 0] };
const square = { rectangle: { corner_m: [0, -20], size_m: [40, 40] } };
const field = (fields) => ({ field: { corner_m: [0, 0], extent_m: [1000, 1000], concentration: 0.8, floe_size_m: 10,
  ...fields } });
const scene = (fields) => JSON.stringify({ ships: [ship], floes: [square], time: { until_s: 5 }, ...fields });

const noScenes = [["empty", ""], ["a brace", "{"], ["null", "null"], ["a number", "42"], ["a list", "[]"],
  ["an empty object", "{}"], ["bytes", "\u0000\u0001\uffff"], ["deep", "[".repeat(100000)],
  ["deep objects", "{\"a\":".repeat(50000)], ["a long text", `"${"x".repeat(3e6)}"`],
  ["a comment without end", "/* "], ["HTML", "<script>alert(1)</script>"], ["half a scene", scene({}).slice(0, 60)],
  ["a key twice", "{\"seed\": 1, \"seed\": 2}"], ["a number out of range", "{\"seed\": 1e999}"],
  ["NaN", "{\"seed\": NaN}"], ["a million keys", `{${Array.from({ length: 1e5 }, (_, k) => `"k${k}": 1`).join(",")}}`]];

const wrong = [["no ice", { ice: null }], ["thin ice", { ice: { thickness_m: -1 } }],
  ["ice like a mountain", { ice: { thickness_m: 1e9 } }], ["a text for a number", { seed: "x" }],
  ["an unknown key", { evil: 1 }], ["overlapping floes", { floes: [square, square] }],
  ["a floe without area", { floes: [{ polygon: { outer_m: [[0, 0], [1, 1], [2, 2]] } }] }],
  ["a crossing floe", { floes: [{ polygon: { outer_m: [[0, 0], [10, 10], [10, 0], [0, 10]] } }] }],
  ["coordinates beyond", { floes: [{ polygon: { outer_m: [[0, 0], [1e300, 0], [0, 1e300]] } }] }],
  ["a file that is not there", { floes: [{ file: "none.geojson" }] }],
  ["a file beyond the folder", { floes: [{ file: "../../etc/passwd" }] }],
  ["a ship in a floe", { ships: [{ ...ship, position_m: [20, 0] }] }],
  ["two ships in one place", { ships: [ship, { ...ship, name: "t" }] }],
  ["a tick of nothing", { time: { until_s: 5, step_s: 1e-300 } }],
  ["a tick of a year", { time: { until_s: 5, step_s: 3e7 } }], ["no time", { time: { until_s: 0 } }],
  ["time without end", { time: { until_s: 1e300 } }], ["a hundred and one ships", { ships: Array(101).fill(ship) }],
  ["an unknown preset", { ships: [{ ship: "titanic" }] }], ["a waterline of two points",
    { ships: [{ hull: { waterline_m: [[0, 0], [1, 1]] }, propulsion: { thrust_N: 1 } }] }],
  ["a name with tags", { name: "<img src=x onerror=alert(1)>" }], ["a description with tags",
    { description: "</script><script>window.hacked = 1</script>" }]];

const huge = [["a million floes", { floes: [{ lattice: { columns: 1000, rows: 1000, pitch_m: 10, size_m: 9 } }] }],
  ["more than a million floes", { floes: [{ lattice: { columns: 2000, rows: 2000, pitch_m: 10, size_m: 9 } }] }],
  ["a field of a million", { floes: [field({ extent_m: [10000, 10000], floe_size_m: 9 })] }],
  ["a field without end", { floes: [field({ extent_m: [1e6, 1e6], floe_size_m: 0.1 })] }],
  ["a polygon of a hundred thousand points", { floes: [{ polygon: { outer_m: Array.from({ length: 1e5 }, (_, k) =>
    [500 * Math.cos((k * 2 * Math.PI) / 1e5), 500 * Math.sin((k * 2 * Math.PI) / 1e5)]) } }] }],
  ["records at each step", { record: { forces_interval_s: 1e-9, frames_interval_s: 1e-9 } }]];

const failing = [["a fast ship", { ships: [{ ...ship, speed_m_per_s: 20 }] }],
  ["a floe thrown", { floes: [{ ...square, velocity_m_per_s: [1e6, 0] }] }],
  ["a thrust of giants", { ships: [{ name: "s", hull: { length_m: 120, beam_m: 24, entrance_angle_deg: 27 },
    mass_kg: 1, moment_of_inertia_kg_m2: 1, position_m: [-90, 0], propulsion: { thrust_N: 1e9 } }] }],
  ["a crushing wall", { walls: [{ from_m: [60, -50], to_m: [60, 50], velocity_m_per_s: [-20, 0] }] }],
  ["wind of a star", { wind: { velocity_m_per_s: [1e4, 0] } }]];

module.exports = [...noScenes, ...[...wrong, ...huge, ...failing].map(([name, fields]) => [name, scene(fields)])];
