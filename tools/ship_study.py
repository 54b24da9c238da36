#!/usr/bin/env python3
"""A ship in level ice beside published formulas and reported speeds; the tables of docs/validation.md, "A ship in level
ice".

  tools/ship_study.py resistance   the reference ship at constant speed, .25-3 m/s and .25-1.5 m, beside four formulas
  tools/ship_study.py smooth       the same of a hull as smooth (friction .05) as those that Spencer and Jones come from
  tools/ship_study.py exponents    how it grows with thickness, speed, strength and friction, beside Lindqvist's
  tools/ship_study.py speeds       what ships with reported speeds reach under full power (polynya performance)

All but speeds are means of four runs at .97 to 1.03 of the speed, each cusp of its own strength: ice scatters, and
without that, cusps of thick ice settle into patterns. --spread S is its deviation over the mean (.2; 0: none);
--decks wet leaves out the water that is missing on turning cusps. Options of all: --polynya PROGRAM, --work FOLDER
(run folders; they are overwritten), --jobs N. Needs numpy.
"""
import argparse
import csv
import json
import os
import subprocess

import numpy as np

from study import DRAUGHT, FEW_RECORDS, HULL, LENGTH, REFERENCE, SHIP, formulas, rows_of, run_all, run_scene
from polynya.performance.level_ice import ENDLESS  # study.py has found the package

SHARES = (0.97, 0.99, 1.01, 1.03)
FULL, MEASURED = 2 * LENGTH, 120  # way until the hull is full, and after it [m]
KEINONEN = 330, 510  # [kN] at .5 m and 1 m/s, of the project's physics notes (recall)


def level_ice(h, v, **ice):
    """The reference ship at constant speed in a plate of fast ice that does not split; nothing comes up behind it."""
    way = FULL + MEASURED
    return {"name": "level", "time": {"step_s": min(0.01, 0.01 / v), "until_s": (way + 2) / v},
            "ice": {"thickness_m": h} | ice,
            "fracture": ENDLESS,
            "ships": [SHIP | {"hull": HULL | {"draught_m": DRAUGHT}, "position_m": [-62, 0],
                              "propulsion": {"constant_speed_m_per_s": v}}],
            "floes": [{"rectangle": {"corner_m": [0, -75], "size_m": [way + LENGTH, 150]}, "fast_ice": True}]}


def run(arguments, name, scene):
    """Means over the measured way [kN]: contact, submerged ice."""
    folder, summary = run_scene(arguments, name, scene | FEW_RECORDS)
    speed = scene["ships"][0]["propulsion"]["constant_speed_m_per_s"]
    rows = [r for r in rows_of(folder, "forces.csv") if float(r["t_s"]) > FULL / speed]
    mean = lambda key: -1e-3 * np.mean([float(r[key]) for r in rows])
    return {"contact": mean("surge_N"), "submerged": mean("surge_from_submerged_ice_N"),
            "real_time": summary["real_time_factor"]}


def means(arguments, points):
    """Of each point's scene, by keys, the means of four runs, and the standard error of the sum [kN]."""
    scenes = {}
    for key, (h, v, ice) in points.items():
        for number, share in enumerate(SHARES):
            one = level_ice(h, v * share, **ice)
            bending = {"strength_spread": arguments.spread, "decks": arguments.decks}
            scenes[(*key, str(number))] = one | {"seed": number + 1, "fracture": one["fracture"] | {"bending": bending}}
    results = run_all(arguments, run, scenes)
    found = {}
    for key in points:
        each = [results[(*key, str(number))] for number in range(len(SHARES))]
        found[key] = {part: np.mean([r[part] for r in each]) for part in each[0]}
        found[key]["error"] = np.std([r["contact"] + r["submerged"] for r in each], ddof=1) / len(each) ** 0.5
    return found


def keinonen(h, v):
    """His band at 1 m/s, by h^1.25 (recall) from .5 m; of other speeds nothing is known here."""
    return "-".join(f"{r * (h / 0.5) ** 1.25:.0f}" for r in KEINONEN) if v == 1 else ""


def resistance(arguments):
    points = [(0.5, v) for v in (0.25, 0.5, 1, 2, 3)] + [(h, 1) for h in (0.25, 0.75, 1, 1.5)]
    results = means(arguments, {(f"{h:g}", f"{v:g}"): (h, v, {}) for h, v in points})
    print("| h [m] | v [m/s] | crushing and bending | submersion | sum | Lindqvist: R_c + R_b | R_s | sum | Riska | "
          "Spencer, Jones | Keinonen |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for h, v in points:
        r, ice = results[f"{h:g}", f"{v:g}"], formulas.Ice(h)
        crushing, bending, submersion = (1e-3 * part for part in formulas.lindqvist(REFERENCE, ice, v))
        print(f"| {h:g} | {v:g} | {r['contact']:.0f} | {r['submerged']:.0f} | "
              f"{r['contact'] + r['submerged']:.0f} ± {r['error']:.0f} | {crushing + bending:.0f} | "
              f"{submersion:.0f} | {crushing + bending + submersion:.0f} | "
              f"{1e-3 * formulas.riska(REFERENCE, ice, v):.0f} | "
              f"{1e-3 * formulas.spencer_jones(REFERENCE, ice, v):.0f} | {keinonen(h, v)} |")


def smooth(arguments):
    points = [(h, 1) for h in (0.25, 0.5, 1, 1.5)]
    results = means(arguments, {("smooth", h, v): (h, v, {"friction": 0.05}) for h, v in points})
    print("| h [m] | crushing and bending | submersion | sum | Spencer, Jones | Lindqvist |\n|---|---|---|---|---|---|")
    for h, v in points:
        r, ice = results["smooth", h, v], formulas.Ice(h, friction=0.05)
        print(f"| {h:g} | {r['contact']:.0f} | {r['submerged']:.0f} | {r['contact'] + r['submerged']:.0f} | "
              f"{1e-3 * formulas.spencer_jones(REFERENCE, ice, v):.0f} | "
              f"{1e-3 * sum(formulas.lindqvist(REFERENCE, ice, v)):.0f} |")


def exponents(arguments):
    """Of the sum and of the contact part, by least squares of the logarithms."""
    series = {"thickness h": [(h, (h, 1, {}), formulas.Ice(h), 1) for h in (0.25, 0.5, 0.75, 1, 1.5)],
              "speed v": [(v, (0.5, v, {}), formulas.Ice(0.5), v) for v in (0.5, 1, 2, 3)],
              "strength σ_f": [(s, (0.5, 1, {"flexural_strength_Pa": s}), formulas.Ice(0.5, flexural_strength=s), 1)
                               for s in (0.4e6, 0.8e6, 1.6e6)],
              "friction μ": [(m, (0.5, 1, {"friction": m}), formulas.Ice(0.5, friction=m), 1)
                             for m in (0.05, 0.1, 0.2)]}
    results = means(arguments, {(name.split()[0], f"{x:g}"): point
                                for name, points in series.items() for x, point, _, _ in points})
    print("| resistance grows with | as | crushing and bending as | Lindqvist's as | his R_c + R_b as |")
    print("|---|---|---|---|---|")
    for name, points in series.items():
        x = np.log([p[0] for p in points])
        ours = [results[name.split()[0], f"{p[0]:g}"] for p in points]
        his = [formulas.lindqvist(REFERENCE, ice, v) for _, _, ice, v in points]
        slope = lambda y: np.polyfit(x, np.log(y), 1)[0]
        print(f"| {name} | {slope([o['contact'] + o['submerged'] for o in ours]):.2f} | "
              f"{slope([o['contact'] for o in ours]):.2f} | "
              f"{slope([sum(h) for h in his]):.2f} | {slope([h[0] + h[1] for h in his]):.2f} |")


REPORTED = {"araon": ["--thickness", "1.0", "--flexural-strength", "630e3"], "polaris": ["--thickness", "1.2,1.8"],
            "nordica": ["--thickness", "0.8"],
            "oden": ["--thickness", "1.8,1.9"], "xuelong-2": ["--thickness", "1.5"]}


def speeds(arguments):
    print("| ship | h [m] | reported [m/s] | Polynya [m/s] | Lindqvist | Riska | Spencer, Jones |")
    print("|---|---|---|---|---|---|---|")
    for ship, options in REPORTED.items():
        folder = os.path.join(arguments.work, f"performance-{ship}")
        subprocess.run([arguments.polynya, "performance", ship, *options, "--out",
                        folder, "--jobs", str(arguments.jobs)], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        preset = json.loads(subprocess.run([arguments.polynya, "ships", ship, "--json"],
                                           check=True, capture_output=True, text=True).stdout)
        with open(os.path.join(folder, "performance.csv"), encoding="utf-8") as file:
            rows = {float(row["thickness_m"]): row for row in csv.DictReader(file)}
        for point in preset["reported"]:
            row = {key: float(value) for key, value in rows[point["thickness_m"]].items() if key.endswith("_s")}
            print(f"| {ship} | {point['thickness_m']:g} | {point['speed_m_per_s']:.2f} | {row['speed_m_per_s']:.2f} ± "
                  f"{row['error_m_per_s']:.2f} | "
                  f"{row['lindqvist_m_per_s']:.2f} | {row['riska_m_per_s']:.2f} | {row['spencer_jones_m_per_s']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    studies = {"resistance": resistance, "smooth": smooth, "exponents": exponents, "speeds": speeds}
    parser.add_argument("study", choices=studies)
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/ship-study")
    parser.add_argument("--spread", type=float, default=0.2)
    parser.add_argument("--decks", choices=("flood", "wet"), default="flood")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    studies[arguments.study](arguments)


if __name__ == "__main__":
    main()
