#!/usr/bin/env python3
"""What a run through level ice costs, with pieces under the hull and brash behind it; the tables of docs/validation.md.

  tools/level_cost.py cost    five cases of thickness and speed on one core, the median of --repeat runs
  tools/level_cost.py step    mean resistance and number of bends by step, four lateral offsets

The reference ship breaks 270 m into fast ice of 600 x 200 m. Time is that of the processor, user's and system's
together: of `polynya run --no-map`, as the factor that a run prints, and what its picture takes beside it. Other work
on the machine still takes caches and shared units away.

Options of both: --polynya PROGRAM (more than one, comma-separated: alternated run by run), --work FOLDER, --repeat N.
"""
import argparse
import math
import os
import statistics
import tempfile

import numpy as np

from study import HULL, SHIP, measured_run, rows_of, run_scene

CASES = [(0.5, 1), (1, 1), (0.25, 1), (0.5, 2), (0.5, 3)]
STEP = 0.01
FULL, MEASURED = 182, 150  # the ship goes in by its length and 60 m, then this much is measured [m]


def level_ice(h, v, y=0.3, step=STEP):
    return {"name": "level", "time": {"step_s": step, "until_s": (FULL + MEASURED) / v}, "ice": {"thickness_m": h},
            "fracture": {"splitting": {"model": "none"}, "cusp_fate": "under_hull"},
            "record": {"forces_interval_s": 0.1, "frames_interval_s": 1000, "contacts": "none"},
            "ships": [SHIP | {"hull": HULL | {"draught_m": 6}, "position_m": [-62, y],
                              "propulsion": {"constant_speed_m_per_s": v}}],
            "floes": [{"rectangle": {"corner_m": [0, -100], "size_m": [600, 200]}, "fast_ice": True}]}


def cost(arguments):
    programs = arguments.polynya.split(",")
    columns = " processor [s] | × real time | its picture [s] |"
    print("| h [m] | v [m/s] | step [s] | bends | came up |" + columns * len(programs))
    print("|---|---|---|---|---|" + "---|---|---|" * len(programs))
    for h, v in CASES:
        scene = level_ice(h, v)
        runs, drawn = ({program: [] for program in programs} for _ in range(2))
        for _ in range(arguments.repeat):
            for program in programs:
                drawn[program].append(measured_run(program, arguments.work, scene)[2])
                _, summary, seconds = measured_run(program, arguments.work, scene, "--no-map")
                runs[program].append(seconds)
        counts = summary["counts"]
        row = f"| {h:g} | {v:g} | {STEP:g} | {counts['bends']} | {counts['came_up']} |"
        for program in programs:
            run, whole = statistics.median(runs[program]), statistics.median(drawn[program])
            row += f" {run:.2f} | {(FULL + MEASURED) / v / run:.0f} | {whole - run:.2f} |"
        print(row, flush=True)


def resistance(arguments, h, v, y, step):
    """Mean over the measured way, contact and submersion [kN], and bends."""
    folder, summary = run_scene(arguments, "level", level_ice(h, v, y, step))
    rows = [row for row in rows_of(folder, "forces.csv") if float(row["t_s"]) > FULL / v]
    contact, under = (np.mean([-float(row[name]) for row in rows]) / 1e3
                      for name in ("surge_N", "surge_from_submerged_ice_N"))
    return contact, under, summary["counts"]["bends"]


def step(arguments):
    offsets = (0, 0.3, 0.7, 1.1)
    print("| h [m] | v [m/s] | step [s] | contact [kN] | submersion [kN] | bends |\n|---|---|---|---|---|---|")
    for h, v in CASES:
        for dt in (STEP, STEP / 3):
            values = np.array([resistance(arguments, h, v, y, dt) for y in offsets])
            mean, error = values.mean(axis=0), values.std(axis=0, ddof=1) / math.sqrt(len(offsets))
            print(f"| {h:g} | {v:g} | {dt:.4f} | " + " | ".join(f"{m:.1f} ± {e:.1f}" for m, e in zip(mean, error))
                  + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("cost", "step"))
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work")
    parser.add_argument("--repeat", type=int, default=5)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        arguments.work = arguments.work or folder
        os.makedirs(arguments.work, exist_ok=True)
        {"cost": cost, "step": step}[arguments.what](arguments)


if __name__ == "__main__":
    main()
