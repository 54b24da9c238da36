#!/usr/bin/python3
"""A first run: a ship breaks its way into a plate of ice, from Python, without a file.

    python3 examples/first_run.py            (--out FOLDER; --short: the first seconds)

Shows how a scene is a dict, how it is checked and stepped, and what can be read while it runs: the force on the ship,
what broke, and the floes as numpy arrays. Draws first-run.png: the ice at the end, and the force against time.
"""
import argparse
import pathlib

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

import numpy
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from polynya.results.hulls import waterline

SCENE = {
    "name": "first-run",
    "time": {"step_s": 0.005, "until_s": 60},
    "record": {"forces_interval_s": 0.1},
    "ice": {"thickness_m": 0.5, "flexural_strength_Pa": 500e3},
    "ships": [{
        "name": "breaker",
        "hull": {"length_m": 80, "beam_m": 18, "entrance_angle_deg": 28, "stem_angle_deg": 30, "draught_m": 6},
        "mass_kg": 5e6, "moment_of_inertia_kg_m2": 2e9, "position_m": [-42, 0],
        "propulsion": {"constant_speed_m_per_s": 2},
    }],
    "floes": [{"rectangle": {"corner_m": [0, -60], "size_m": [180, 120]}, "fast_ice": True}],
}


def run(until):
    """The simulation at a time, and rows of time [s] and surge force [N] up to it."""
    scene = polynya.Scene(SCENE)
    for problem in scene.validate():
        print(problem)
    simulation = polynya.Simulation(scene)
    rows = []
    while simulation.time < until - 1e-9:
        simulation.run(until=simulation.time + 0.1)
        rows.append((simulation.time, simulation.ships[0].forces["surge_N"]))
    return simulation, numpy.array(rows)


def draw(simulation, rows, path):
    floes, ship = simulation.floes, simulation.ships[0]
    outlines = [floes.world_vertices[floes.ring_offsets[r]:floes.ring_offsets[r + 1]] for r in floes.floe_offsets[:-1]]
    figure = Figure(figsize=(6.7, 4.6), layout="constrained")
    ice, force = figure.subplots(2, 1, height_ratios=(3, 1))
    ice.set_facecolor("#8fb8d0")
    colours = numpy.where(floes.generations > 0, "#fbeec2", "#ffffff")
    ice.add_collection(PolyCollection(outlines, facecolors=colours, edgecolors="#3d5261", linewidths=0.4))
    c, s = numpy.cos(ship.heading), numpy.sin(ship.heading)
    hull = waterline(polynya.Scene(SCENE).resolved["ships"][0]) @ numpy.array([[c, s], [-s, c]]) + ship.position
    ice.fill(*hull.T, facecolor="#2b2b2b", alpha=0.85)
    ice.set(aspect="equal", xlim=(-85, 185), ylim=(-65, 65), xlabel="x [m]", ylabel="y [m]",
            title=f"{len(floes)} floes after {simulation.time:.0f} s")
    force.plot(rows[:, 0], 1e-6 * rows[:, 1], color="#000000", linewidth=0.6)
    force.set(xlabel="time [s]", ylabel="surge force [MN]", xlim=(0, rows[-1, 0]))
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="the first seconds only")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    simulation, rows = run(until=8 if options.short else 60)
    kinds = [event["kind"] for event in simulation.events()]
    print(f"{simulation.time:g} s: {kinds.count('bend')} cusps bent off, {kinds.count('split')} splits, "
          f"{len(simulation.floes)} floes; "
          f"mean surge force {1e-3 * rows[:, 1].mean():.0f} kN")
    draw(simulation, rows, options.out / "first-run.png")
    print(options.out / "first-run.png")


if __name__ == "__main__":
    main()
