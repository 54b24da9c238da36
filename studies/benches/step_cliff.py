#!/usr/bin/env python3
"""Mean loads of a ship in level ice by thickness and speed, at the default tick and at a quarter of its shortest step.

Usage: studies/benches/step_cliff.py [BINARY] [--way M] [--ways H] [--places N] [--only THICKNESS,SPEED]
       BINARY is build/release/app/polynya by default. --way and --ways: the ship goes at least this many metres and
       this many ice thicknesses through the ice, because cusps grow with the thickness. --places: number of lateral
       places of the ship in ice of 0.3 m and more.

A ship of 80 m by 20 m goes at constant speed through fast ice that does not split. Each case is run twice: as a scene
that gives no tick, and with a tick (`time.step_s`) of a quarter of the shortest time step that the first run took
(`shortest_step_s` of summary.json). The mean is that of the surge by contact from the time at which the bow is in the
ice, whose edge is slanted by 2 to 6 degrees. Thick ice breaks in patterns that repeat, so both runs are the mean of
several places of the ship, fractions of a metre apart, each with its own slant. The standard error is that of 16 parts
of the way, at all places. A row whose two means differ by more than 5 % is marked.
"""

import argparse
import math
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from tables import ROOT, Runs, Table, slant_of, slanted_ice  # noqa: E402

THICKNESSES = (0.05, 0.3, 2)  # [m]
SPEEDS = (0.25, 1.5, 8)  # [m/s]
THICK = 0.3  # ice that is broken at several places [m]
BOW = 24  # the way after which the bow is in the ice [m]
PARTS = 16
ALLOWED = 0.05


def scene(thickness, speed, number, way, time):
    ship = {"hull": {"length_m": 80, "beam_m": 20, "entrance_angle_deg": 25, "stem_angle_deg": 28, "draught_m": 6},
            "mass_kg": 6e6, "moment_of_inertia_kg_m2": 2.5e9, "position_m": [-43, 0.37 * number],
            "propulsion": {"constant_speed_m_per_s": speed}}
    return {"name": "step-cliff", "time": {"until_s": (way + BOW) / speed, **time}, "ice": {"thickness_m": thickness},
            "ships": [ship], "floes": [slanted_ice(slant_of(number), way + 100)],
            "fracture": {"splitting": {"model": "none"}, "cusp_fate": "under_hull"},
            "record": {"frames_interval_s": 1e6, "forces_interval_s": max(0.1, round(1 / speed, 1)),
                       "contacts": "none"}}


def parts_of(run):
    """Surge by parts of the way [N]."""
    speed, forces = run.scene["ships"][0]["propulsion"]["constant_speed_m_per_s"], run.force_columns
    surge = -forces["surge_N"][forces["t_s"] * speed > BOW + 1]
    size = len(surge) // PARTS
    return [surge[i * size:(i + 1) * size].mean() for i in range(PARTS)]


class Mean:
    """Of runs that differ in the place of the ship."""

    def __init__(self, runs):
        parts = [part for run in runs for part in parts_of(run)]
        self.bends = sum(run.summary["counts"]["bends"] for run in runs)
        self.tick, self.shortest = runs[-1].summary["step_s"], min(run.summary["shortest_step_s"] for run in runs)
        self.mean = statistics.fmean(parts)
        self.error = statistics.stdev(parts) / math.sqrt(len(parts))


def table(runs, places=4, least_way=40, ways=200, only=None):
    rows = []
    for thickness, speed in [only] if only else [(h, v) for h in THICKNESSES for v in SPEEDS]:
        way = max(least_way, ways * thickness)
        numbers = range(places if thickness >= THICK else 1)

        def mean(time):
            scenes = {(f"{thickness:g}", f"{speed:g}", number, len(time)): scene(thickness, speed, number, way, time)
                      for number in numbers}
            return Mean(list(runs.scenes("step-cliff", scenes).values()))
        found = mean({})
        fine = mean({"step_s": found.shortest / 4})
        off, both = found.mean / fine.mean - 1, math.hypot(found.error, fine.error) / fine.mean
        mark = "**" if abs(off) > ALLOWED else ""
        rows.append([f"{thickness:g}", f"{speed:g}", f"{found.tick:g}", f"{found.mean / 1e3:.4g}",
                     f"{found.shortest:g}", f"{fine.mean / 1e3:.4g}",
                     f"{mark}{100 * off:+.1f}{mark}", f"{100 * both:.1f}",
                     f"{found.bends} / {fine.bends}"])
    return Table(["thickness [m]", "speed [m/s]", "tick [s]", "mean [kN]", "tick a quarter of [s]", "mean [kN]",
                  "differs [%]", "s.e. [%]", "bends"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", default=str(ROOT / "build/release/app/polynya"))
    parser.add_argument("--way", type=float, default=40)
    parser.add_argument("--ways", type=float, default=200)
    parser.add_argument("--places", type=int, default=4)
    parser.add_argument("--only")
    given = parser.parse_args()
    only = tuple(float(x) for x in given.only.split(",")) if given.only else None
    with tempfile.TemporaryDirectory() as folder:
        print(table(Runs(given.binary, folder, 2), given.places, given.way, given.ways, only))


if __name__ == "__main__":
    main()
