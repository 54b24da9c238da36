#!/usr/bin/env python3
"""The tanker Uikku in level ice beside five measured tests; the table of docs/validation.md, "A ship that was
measured".

  tools/uikku_bench.py [TESTS.csv]   mean, standard deviation, largest, least, and share of the time without contact

Constant speed into fast ice that does not split; 100 m are measured after the hull is full; step min(.02 s, .01 m / v).
The ice's edge slants by 2 to 6 degrees, each run's by another: along a straight one a bow breaks mirror images.
TESTS.csv has the columns of tools/uikku_tests.csv (the default: scale 1:31.56, values in full scale). The angles of the
bow are doubtful, so that both sets that are named for it are run; --angles chooses one. Options: --set KEY=VALUE of the
scene, several times; --speeds N runs each test at N speeds within 3 %; --average S: running means of forces over S [s],
.1 if not given; --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. Needs numpy.
"""
import argparse
import json
import os
import pathlib
import sys

import numpy as np

import level_tests
from study import run_all, run_scene, slant_of

HERE = pathlib.Path(__file__).parent
# Stem from the horizontal and entrance from the centre line [°], friction of ice on the hull. "inverted": what the
# authors of the tests must have put into Lindqvist's formula to find the numbers that they state.
ANGLES = {"stated": {"stem": 30, "entrance": 21, "friction": 0.05},
          "inverted": {"stem": 28.5, "entrance": 25, "friction": 0.03}}


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


def run(arguments, name, one):
    """Of the measured way: the resistance [kN], its part under the hull, the share of the time without contact."""
    folder, summary = run_scene(arguments, name, one)
    contact, submerged = level_tests.measured(pathlib.Path(folder), one)
    count = round(arguments.average / level_tests.AVERAGE)
    total = np.convolve(contact + submerged, np.full(count, 1 / count), "valid")
    return {"mean": total.mean(), "sd": total.std(ddof=1), "max": total.max(), "min": total.min(),
            "submerged": submerged.mean(),
            "without_contact": np.mean(contact < 1e-3 * contact.max()), "real_time": summary["real_time_factor"]}


def table(tests, results, angles, speeds):
    print(f"\n{angles}: " + ", ".join(f"{key} {value:g}" for key, value in ANGLES[angles].items()) + "\n")
    print("| test | h [m] | v [m/s] | measured: mean, sd, least, largest [kN] | Polynya: mean, sd, least, largest [kN] "
          "| of it submersion "
          "| mean, sd over measured | without contact | × real time |\n|" + "---|" * 9)
    ratios = []
    for test in tests:
        each = [results[angles, test.name, number] for number in range(speeds)]
        r = {key: float(np.mean([one[key] for one in each])) for key in each[0]}
        measured = [float(test.row[f"resistance_{key}_kN"]) for key in ("mean", "sd", "min", "max")]
        ratios.append((r["mean"] / measured[0], r["sd"] / measured[1]))
        print(f"| {test.name} | {test.ice['thickness_m']:g} | {test.speed:g} | "
              + ", ".join(f"{x:.0f}" for x in measured) + " | "
              + ", ".join(f"{r[key]:.0f}" for key in ("mean", "sd", "min", "max"))
              + f" | {r['submerged']:.0f} | {ratios[-1][0]:.2f}, {ratios[-1][1]:.2f} | "
              f"{100 * r['without_contact']:.0f} % | {r['real_time']:.0f} |")
    mean, deviation = np.array(ratios).T
    print(f"\nmean within 20 %: {np.sum(abs(mean - 1) <= 0.2)} of {len(mean)}; standard deviation within 40 %: "
          f"{np.sum(abs(deviation - 1) <= 0.4)} of {len(mean)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tests", nargs="?", default=HERE / "uikku_tests.csv")
    parser.add_argument("--angles", choices=(*ANGLES, "both"), default="both")
    parser.add_argument("--set", action="append", default=[], dest="settings", metavar="KEY=VALUE")
    parser.add_argument("--speeds", type=int, default=1)
    parser.add_argument("--average", type=float, default=level_tests.AVERAGE, metavar="S")
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/uikku-bench")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    settings = []
    for setting in arguments.settings:
        key, _, value = setting.partition("=")
        try:
            settings.append((key, json.loads(value)))
        except json.JSONDecodeError:
            settings.append((key, value))
    tests = level_tests.read_tests(arguments.tests)
    chosen = list(ANGLES) if arguments.angles == "both" else [arguments.angles]
    shares = [1.0] if arguments.speeds == 1 else np.linspace(0.97, 1.03, arguments.speeds)
    scenes = {(angles, test.name, number): scene(test, ANGLES[angles], float(share), slant_of(number), settings)
              for angles in chosen for test in tests for number, share in enumerate(shares)}
    results = run_all(arguments, run, scenes)
    for angles in chosen:
        table(tests, results, angles, len(shares))


if __name__ == "__main__":
    sys.exit(main())
