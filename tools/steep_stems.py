#!/usr/bin/env python3
"""Hulls that hardly press ice down: the tables of docs/theory/bow.md, "Steep stems" and "Shoulders".

  tools/steep_stems.py stems       the load by the stem's angle, half a metre of fast ice at 1 m/s
  tools/steep_stems.py shoulders   loads by place, 1.5 m of ice at .25 m/s, by what edges bear, step and strength

Options: --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N.
"""
import argparse
import concurrent.futures
import json
import math
import os

from study import rows_of, run_scene

SETTLED = 30  # s of the stems' runs that are left out: the bow is not all in the ice
SHIP = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}
PLACES = (("stem", 1), ("flanks", 22), ("shoulders", 25), ("sides", 120))  # up to so far behind the stem [m]


def stem_scene(stem_deg):
    hull = SHIP | {"stem_angle_deg": stem_deg, "draught_m": 6, "block_coefficient": 0.579}
    return {"time": {"until_s": 70}, "record": {"forces_interval_s": 0.1, "frames_interval_s": 1e4},
            "fracture": {"splitting": {"model": "none"}},
            "ships": [{"name": "a", "hull": hull, "position_m": [-61, 0],
                       "propulsion": {"constant_speed_m_per_s": 1}}],
            "floes": [{"rectangle": {"corner_m": [0, -60], "size_m": [142, 120]}, "fast_ice": True}]}


def stem_row(arguments, stem_deg):
    path, _ = run_scene(arguments, f"stem-{stem_deg:g}", stem_scene(stem_deg))
    rows = rows_of(path, "forces.csv")
    settled = [row for row in rows if float(row["t_s"]) > SETTLED]
    mean = lambda column: -sum(float(row[column]) for row in settled) / len(settled)
    largest = max(abs(float(row["surge_max_N"])) for row in rows)
    with open(os.path.join(path, "summary.json"), encoding="utf-8") as file:
        bends = json.load(file)["counts"]["bends"]
    return (f"| {stem_deg:g} | {mean('surge_N') / 1e6:.2f} | {largest / 1e6:.1f} | "
            f"{mean('surge_from_submerged_ice_N') / 1e6:.2f} | {bends} |")


def stems(arguments):
    print("| stem [°] | mean [MN] | largest step [MN] | ice that goes under, mean [MN] | cusps |")
    print("|---|---|---|---|---|")
    angles = [*range(60, 90, 2), 89, 89.5, 89.75, 89.95]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for row in pool.map(lambda angle: stem_row(arguments, angle), angles):
            print(row, flush=True)


def squeeze_scene(changes):
    scene = {"time": {"step_s": 0.005, "until_s": 800},
             "ice": {"thickness_m": 1.5, "flexural_strength_Pa": 8e5},
             "fracture": {"bending": {}},
             "record": {"forces_interval_s": 0.1, "frames_interval_s": 0.25},
             "ships": [{"name": "s", "hull": SHIP | {"stem_angle_deg": 30}, "mass_kg": 1e7,
                        "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0],
                        "propulsion": {"constant_speed_m_per_s": 0.25}}],
             "floes": [{"rectangle": {"corner_m": [0, -2000], "size_m": [4000, 4000]}}]}
    for section, values in changes.items():
        target = scene["fracture"]["bending"] if section == "bending" else scene[section]
        target.update(values)
    return scene


def place_of(station_m):
    return next(name for name, end in PLACES if station_m <= end)


def force_of(row):
    return math.hypot(float(row["fx_N"]), float(row["fy_N"]))


def squeeze_row(arguments, name, changes):
    path, _ = run_scene(arguments, f"shoulders-{name.replace(' ', '-')}", squeeze_scene(changes))
    rows = [row for row in rows_of(path, "forces.csv") if float(row["t_s"]) > 100]
    sums = dict.fromkeys((place for place, _ in PLACES), 0.0)
    for row in rows_of(path, "contacts.csv"):
        if row["ended_by"] or float(row["t_s"]) <= 100:
            continue
        if row["station_m"]:
            sums[place_of(float(row["station_m"]))] -= float(row["fx_N"])
    count = 700 / 0.25
    peak = max((row for row in rows_of(path, "contacts.csv") if row["ended_by"]), key=force_of)
    largest = max(abs(float(row["surge_max_N"])) for row in rows)
    mean = -sum(float(row["surge_N"]) for row in rows) / len(rows)
    return (f"| {name} | {mean / 1e3:.0f} | {largest / 1e6:.2f} | "
            + ", ".join(f"{value / count / 1e3:.0f}" for value in sums.values())
            + f" | {force_of(peak) / 1e6:.2f} at {float(peak['station_m']):.1f} m, "
            f"{-float(peak['fx_N']) / 1e6:.2f} of it surge |")


def shoulders(arguments):
    cases = {"as the scene": {}, "step 0.02 s": {"time": {"step_s": 0.02}},
             "step 0.00125 s": {"time": {"step_s": 0.00125}},
             "strength spread 0.2": {"bending": {"strength_spread": 0.2}},
             "outline wedge": {"bending": {"outline": "wedge"}}}
    print("| 1.5 m, .25 m/s | mean 100 to 800 s [kN] | largest step [MN] | stem, flanks, shoulders, sides [kN] | "
          "largest contact [MN] |")
    print("|---|---|---|---|---|")
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for row in pool.map(lambda case: squeeze_row(arguments, *case), cases.items()):
            print(row, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("stems", "shoulders"))
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/steep-stems")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    (stems if arguments.study == "stems" else shoulders)(arguments)


if __name__ == "__main__":
    main()
