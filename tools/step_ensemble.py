"""Mean surge in level ice by the tick, as the mean of runs whose thickness differs by 0.3 % each.

Usage: python3 tools/step_ensemble.py THICKNESS SPEED STEP... [--members N] [--binary BINARY] [--way M] [--slanted]
       STEP: ticks (`time.step_s`) [s]. The program takes a tick in parts where it is longer than loads allow
       (docs/theory/steps.md), so the table also has the shortest time step of the runs.
       --way: through the ice, 150 m if not given. --slanted: thicknesses within 3 %, and edges of the ice that slant by
       2 to 6 degrees, because in even ice a bow breaks mirror images, alike in all members for some 40 m.

Thick ice breaks in patterns that repeat themselves, and jumps between them, so one run is one draw. The reference ship
goes at constant speed through fast ice that does not split. The mean is that from the way of 32 m on, brought to the
first run's thickness by h^1.8.
"""

import argparse
import math
import pathlib
import statistics
import tempfile

from study import measured_run, rows_of, slant_of, slanted_ice

ROOT = pathlib.Path(__file__).resolve().parent.parent
HULL = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30, "draught_m": 6}
BOW = 32  # [m]
APART = 0.003  # of the thickness


def members(count, is_slanted):
    """Of each its factor on the thickness, and the slant of its edge."""
    if not is_slanted:
        return [(1 + APART * i, 0) for i in range(count)]
    return [(0.97 + 0.06 * (i + 0.5) / count, slant_of(i)) for i in range(count)]


def surge(binary, thickness, speed, step, slant, way):
    """The mean surge [N], and the shortest time step [s]."""
    ship = {"hull": HULL, "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0],
            "propulsion": {"constant_speed_m_per_s": speed}}
    scene = {"name": "step-ensemble", "time": {"until_s": (way + 30) / speed, "step_s": step},
             "ice": {"thickness_m": thickness}, "record": {"frames_interval_s": 10}, "ships": [ship],
             "fracture": {"splitting": {"model": "none"}, "cusp_fate": "under_hull"},
             "floes": [slanted_ice(slant, way + 250)]}
    with tempfile.TemporaryDirectory() as folder:
        run, summary, _ = measured_run(binary, folder, scene, "--no-map")
        mean = statistics.fmean(-float(row["surge_N"]) for row in rows_of(run, "forces.csv")
                                if float(row["t_s"]) * speed > BOW)
        return mean, summary["shortest_step_s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("thickness", type=float)
    parser.add_argument("speed", type=float)
    parser.add_argument("steps", type=float, nargs="+")
    parser.add_argument("--members", type=int, default=8)
    parser.add_argument("--way", type=float, default=150)
    parser.add_argument("--slanted", action="store_true")
    parser.add_argument("--binary", default=str(ROOT / "build/release/app/polynya"))
    given = parser.parse_args()
    print("| tick, s | shortest step, s | mean, kN | runs, kN |\n|---|---|---|---|")
    for step in given.steps:
        found, shortest = [], step
        for factor, slant in members(given.members, given.slanted):
            mean, shortest_of_run = surge(given.binary, given.thickness * factor, given.speed, step, slant, given.way)
            found.append(mean / factor**1.8 / 1e3)
            shortest = min(shortest, shortest_of_run)
        error = statistics.stdev(found) / math.sqrt(len(found))
        print(f"| {step:g} | {shortest:g} | {statistics.fmean(found):.1f} ± {error:.1f} "
              f"| {', '.join(f'{x:.0f}' for x in found)} |", flush=True)


if __name__ == "__main__":
    main()
