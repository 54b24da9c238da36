#!/usr/bin/env python3
"""The tanker Uikku in level ice beside five measured tests; the tables of docs/validation.md, "A ship that was
measured".

  studies/benches/uikku.py [--average S] [--set KEY=VALUE]...

Constant speed in fast ice that does not split, at four speeds within 3 % of a test's; 100 m are measured after the ice
reaches along all of the hull. The ice's edge slants by 2 to 6 degrees, another angle for each run: along a straight
edge a bow breaks mirror images. uikku_tests.csv has the tests: model scale 1:31.56, values in full scale. The angles of
the bow are doubtful, so both sets that are named for it are run. --average: running means of forces over so many
seconds, 0.1 if not given; --set: a key of the scene. Needs numpy.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import level_tests  # noqa: E402
from tables import Runs, Table, slant_of  # noqa: E402

# Stem from the horizontal and entrance from the centre line [°], friction of ice on the hull. "inverted": what the
# authors of the tests must have put into Lindqvist's formula to find the numbers that they state.
ANGLES = {"stated": {"stem": 30, "entrance": 21, "friction": 0.05},
          "inverted": {"stem": 28.5, "entrance": 25, "friction": 0.03}}
SHARES = (0.97, 0.99, 1.01, 1.03)


def scene(test, particulars, share, slant, settings):
    """A test at that share of its speed, the ice's edge with that slant [rad], with settings of the scene's keys."""
    ship = json.loads((HERE / "uikku.json").read_text(encoding="utf-8"))
    ship["hull"] |= {"entrance_angle_deg": particulars["entrance"], "stem_angle_deg": particulars["stem"]}
    whole = level_tests.scene(test, ship, particulars["friction"], share, slant=slant)
    for key, value in settings:
        *path, last = key.split(".")
        inner = whole
        for part in path:
            inner = inner.setdefault(part, {})
        inner[last] = value
    return whole


def measured(run, average):
    """Of the measured way: the resistance [kN], its part under the hull, the share of the time without contact."""
    contact, submerged = level_tests.measured(run)
    count = round(average / level_tests.AVERAGE)
    total = np.convolve(contact + submerged, np.full(count, 1 / count), "valid")
    return {"mean": total.mean(), "sd": total.std(ddof=1), "min": total.min(), "max": total.max(),
            "submerged": submerged.mean(), "without_contact": np.mean(contact < 1e-3 * contact.max())}


def table(runs, angles, average=level_tests.AVERAGE, settings=()):
    """The tests by one set of angles."""
    tests = level_tests.read_tests(HERE / "uikku_tests.csv")
    scenes = {(angles, test.name, number): scene(test, ANGLES[angles], share, slant_of(number), settings)
              for test in tests for number, share in enumerate(SHARES)}
    found, rows = runs.scenes("uikku", scenes), []
    for test in tests:
        each = [measured(found[angles, test.name, number], average) for number in range(len(SHARES))]
        ours = {key: float(np.mean([one[key] for one in each])) for key in each[0]}
        hers = {key: float(test.row[f"resistance_{key}_kN"]) for key in ("mean", "sd", "min", "max")}
        listed = lambda of: ", ".join(f"{of[key]:.0f}" for key in ("mean", "sd", "min", "max"))
        rows.append([test.name, f"{test.ice['thickness_m']:g}", f"{test.speed:g}", listed(hers), listed(ours),
                     f"{ours['submerged']:.0f}", f"{ours['mean'] / hers['mean']:.2f}, {ours['sd'] / hers['sd']:.2f}",
                     f"{100 * ours['without_contact']:.0f} %"])
    return Table(["test", "h [m]", "v [m/s]", "measured: mean, sd, least, largest [kN]",
                  "Polynya: mean, sd, least, largest [kN]", "of it submersion", "mean, sd over measured",
                  "without contact"], rows, within=0.1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--set", action="append", default=[], dest="settings", metavar="KEY=VALUE")
    parser.add_argument("--average", type=float, default=level_tests.AVERAGE, metavar="S")
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="build/studies")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    settings = [(key, json.loads(value)) for key, _, value in (of.partition("=") for of in arguments.settings)]
    for angles in ANGLES:
        runs = Runs(arguments.polynya, arguments.work, arguments.jobs)
        print(f"{angles}\n\n{table(runs, angles, arguments.average, settings)}")


if __name__ == "__main__":
    main()
