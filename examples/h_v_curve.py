#!/usr/bin/python3
"""An h-v curve: the speed that a ship keeps in level ice under full power, by the ice's thickness.

    python3 examples/h_v_curve.py            (--out FOLDER; --ship NAME; --short: one thickness, five ship lengths)

Shows polynya.performance as a library: each thickness is a run in a plate of fast ice, as long as the mean speed needs
to be steady, beside three published formulas; points outside the range of validation (docs/ships.md) are marked.
Finished runs are kept in the folder: a second time it only draws. `polynya performance SHIP` does the same from the
command line. Draws h-v-curve.png.
"""
import argparse
import concurrent.futures
import os
import pathlib

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

from polynya import formulas
from polynya.performance import figure
from polynya.performance.__main__ import hull_of, print_table, ship_of
from polynya.performance.curve import Curve
from polynya.program import program

THICKNESSES = (0.3, 0.6, 0.9, 1.2)  # [m]
ICE = formulas.Ice(thickness=0, flexural_strength=500e3, friction=0.1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"),
                        help="folder of the runs and the picture")
    parser.add_argument("--ship", default="polaris", help="a preset: polynya ships lists them")
    parser.add_argument("--short", action="store_true", help="one thickness, with a coarse step")
    options = parser.parse_args()
    found = ship_of(options.ship)
    ship, reported = found["ship"], found["reported"]
    folder = options.out / "h-v-runs"
    folder.mkdir(parents=True, exist_ok=True)
    error, step = (0.5, 0.05) if options.short else (0.03, 0.01)
    curve = Curve(ship, hull_of(ship), found["engine"], ICE, folder, program(), error, step)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:  # each waits for a process of its own
        rows = list(pool.map(curve.point, THICKNESSES[-1:] if options.short else THICKNESSES))
    print_table(rows)
    for point in reported:
        print(f"reported: {point['thickness_m']:g} m at {point['speed_m_per_s']:.2f} m/s, {point['source']}")
    figure.draw(rows, f"{found['title']}: level ice, full power\nσf {ICE.flexural_strength / 1e3:g} kPa, μ "
                f"{ICE.friction:g}", reported,
                options.out / "h-v-curve.png")
    print(options.out / "h-v-curve.png")


if __name__ == "__main__":
    main()
