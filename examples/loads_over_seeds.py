#!/usr/bin/python3
"""Loads over ten seeds: what a single run's force is worth, with confidence intervals.

    python3 examples/loads_over_seeds.py     (--out FOLDER; --short: three seeds, some seconds)

Shows runs of one scene in different random fields, two at a time in two threads, and the estimators of
polynya.statistics: the mean resistance and the largest one of each run, with 95 % intervals of their means. Draws
loads-over-seeds.png. For more than a dozen runs use `polynya study` (docs/studies.md): it plans, resumes and reports
them.
"""
import argparse
import concurrent.futures
import pathlib

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "scipy", "matplotlib")

import numpy
from matplotlib.figure import Figure

from polynya import statistics

CONCENTRATIONS = (0.4, 0.6)
SEEDS = 10


def scene(concentration, seed):
    return {
        "name": "pack-ice", "seed": seed,
        "time": {"step_s": 0.01, "until_s": 120},
        "record": {"forces_interval_s": 0.1},
        "ice": {"thickness_m": 0.5},
        "ships": [{
            "name": "icebreaker", "hull": {"length_m": 100, "beam_m": 20, "entrance_angle_deg": 27,
                                           "stem_angle_deg": 30},
            "mass_kg": 8e6, "moment_of_inertia_kg_m2": 4e9, "position_m": [-52, 100],
            "propulsion": {"constant_speed_m_per_s": 2},
        }],
        "floes": [{"field": {"corner_m": [0, 0], "extent_m": [300, 200], "floe_size_m": 20, "size_spread": 0.25,
                             "concentration": concentration}}],
    }


def loads(concentration, seed, until):
    """Mean and largest resistance of a run [N], of .1 s means."""
    simulation = polynya.Simulation(scene(concentration, seed))
    rows = []
    while simulation.time < until - 1e-9:
        simulation.run(until=simulation.time + 0.1)  # releases the interpreter: another run goes on meanwhile
        rows.append(-simulation.ships[0].forces["surge_N"])
    return float(numpy.mean(rows)), float(numpy.max(rows))


def draw(table, path):
    figure = Figure(figsize=(6.7, 3.2), layout="constrained")
    for axes, column, title in zip(figure.subplots(1, 2), (0, 1), ("mean of the run", "largest of the run, .1 s")):
        for x, (concentration, rows) in enumerate(table.items()):
            values = 1e-3 * rows[:, column]
            interval = statistics.mean(values)
            axes.plot(numpy.full(len(values), x) - 0.12, values, "o", color="#777777", markersize=3)
            axes.errorbar(x + 0.12, interval.value, yerr=[[interval.value - interval.low],
                                                          [interval.high - interval.value]], fmt="s",
                          color="#0072b2", markersize=5, capsize=4)
        axes.set(xticks=range(len(table)), xticklabels=[f"{100 * c:.0f} %" for c in table],
                 xlim=(-0.5, len(table) - 0.5), ylim=(0, None),
                 xlabel="ice cover", ylabel="resistance [kN]", title=title)
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="three seeds and some seconds only")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    seeds, until = (range(1, 4), 6) if options.short else (range(1, SEEDS + 1), 120)
    table = {}
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as threads:
        for concentration in CONCENTRATIONS:
            table[concentration] = numpy.array(list(threads.map(lambda seed: loads(concentration, seed, until), seeds)))
    for concentration, rows in table.items():
        for name, values in zip(("mean", "largest"), 1e-3 * rows.T):
            interval = statistics.mean(values)
            print(f"{100 * concentration:.0f} % cover: {name} resistance {interval.value:.0f} kN, 95 %: "
                  f"{interval.low:.0f} to {interval.high:.0f} kN "
                  f"({len(values)} runs)")
    draw(table, options.out / "loads-over-seeds.png")
    print(options.out / "loads-over-seeds.png")


if __name__ == "__main__":
    main()
