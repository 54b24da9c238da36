// Runs for the tests of the player: made by the polynya under test, and read back from their files here.
"use strict";
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");

const polynya = process.env.POLYNYA_BINARY;
const scenes = path.resolve(__dirname, "../../scenes");

exports.polynya = (...words) =>
  execFileSync(polynya, words, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "pipe"] });

/** Runs a scene, for its page. */
exports.makeRun = (folder, scene, ...options) => {
  const run = path.join(folder, scene.name.replace(/\W/g, "-"));
  fs.writeFileSync(`${run}.json`, JSON.stringify(scene));
  exports.polynya("run", `${run}.json`, "--out", run, "--overwrite", "--progress", "none", ...options);
  return run;
};
/** A run of a shipped scene in the folder of runs that all files of tests share (`tests/view/run` empties it). */
exports.shippedRun = (folder, name, ...options) => {
  const run = path.join(process.env.POLYNYA_SHARED_RUNS ?? folder, name);
  if (!fs.existsSync(run)) exports.polynya("run", path.join(scenes, `${name}.json`), "--out", run, ...options);
  return run;
};
exports.makePage = (run, ...options) => {
  exports.polynya("view", run, ...options);
  return path.join(run, "view.html");
};

exports.readLines = (run, file) => fs.readFileSync(path.join(run, file), "utf8").trim().split("\n").filter(Boolean);
exports.readNdjson = (run, file) => exports.readLines(run, file).map((line) => JSON.parse(line));

/** Gives the rows of forces.csv known loads: loadsOf(k) has those of row k by column. The rows, as objects. */
exports.giveLoads = (run, loadsOf) => {
  const [header, ...lines] = exports.readLines(run, "forces.csv");
  const names = header.split(",");
  const rows = lines.map((line, k) => {
    const fields = line.split(",");
    for (const [column, load] of Object.entries(loadsOf(k))) fields[names.indexOf(column)] = String(load);
    return fields;
  });
  fs.writeFileSync(path.join(run, "forces.csv"), `${[names, ...rows].map((row) => row.join(",")).join("\n")}\n`);
  return rows.map((fields) => Object.fromEntries(fields.map((field, k) => [names[k], Number(field)])));
};

/** The table of `polynya inspect RUN --at T`, by floe. */
exports.inspectAt = (run, time) => {
  const [names, ...rows] = exports.polynya("inspect", run, "--at", String(time)).trim().split("\n").map((row) =>
    row.trim().split(/\s+/));
  return new Map(rows.map((cells) => {
    const of = Object.fromEntries(cells.map((cell, k) => [names[k], cell]));
    return [Number(of.floe), { parent: of.parent, born: of.born_s, area: of.area_m2, mass: of.mass_kg,
      thickness: of.thickness_m, speed: of.m_per_s }];
  }));
};

/** A small scene: floes of 15 m, with the ships and other fields that are given. */
exports.smallScene = (name, fields) => ({
  name,
  time: { step_s: 0.01, until_s: 10 },
  floes: [{ lattice: { origin_m: [20, 0], columns: 3, rows: 3, pitch_m: 18, size_m: 15 }, velocity_m_per_s: [0.2, 0] }],
  ...fields,
});
/** A ship breaks cusps that float from a plate, beside a floe that nobody touches. */
exports.plateAndFloe = (name, fields) => exports.smallScene(name, {
  time: { step_s: 0.01, until_s: 30 }, fracture: { cusp_fate: "float", splitting: { model: "michel" } },
  floes: [[[2, 0], [90, 60]], [[2, 80], [20, 20]]].map(([corner_m, size_m]) => ({ rectangle: { corner_m, size_m } })),
  ...fields,
});
exports.ship = (name, y) => ({
  name,
  hull: { length_m: 40, beam_m: 8, entrance_angle_deg: 27, stem_angle_deg: 30 },
  mass_kg: 1e6, moment_of_inertia_kg_m2: 1e8, position_m: [-20, y], heading_deg: 0,
  propulsion: { constant_speed_m_per_s: 2 },
});
