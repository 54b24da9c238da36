#!/usr/bin/env python3
"""The tanker Uikku in level ice beside ten measured tests, and two trials of Polaris; the tables of docs/validation.md,
"A ship that was measured".

  studies/benches/uikku.py [TABLE]... [--places N] [--average S] [--set KEY=VALUE]...

TABLE is one of tests, other-angles, water, dependences, polaris; all without one. Each test is run at N places (8 if
not given): constant speed in fast ice that does not split and whose strength scatters by 0.2 from cusp to cusp. A
place has a seed of the strength, a slant of the ice's edge from 2 to 6 degrees (along a straight edge a bow breaks
mirror images) and a speed within 3 % of the test's. 100 m are measured after the ice reaches along all of the hull. ±
is the standard error of the mean over places. uikku_tests.csv has the tests: model scale 1:31.56, values in full
scale. The angles of the bow are doubtful, so both sets that are named for it are run. --average: running means of
forces over so many seconds, 0.1 if not given; --set: a key of the scene. Needs numpy.
"""
import argparse
import copy
import json
import math
import pathlib
import sys
import zlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
from tables import Runs, Table, formulas, mean_and_error, slant_of  # noqa: E402  (first: it finds the package)
import level_tests  # noqa: E402

# Stem from the horizontal and entrance from the centre line [°], friction of ice on the hull. "inverted": what the
# authors of the tests must have put into Lindqvist's formula to find the numbers that they state.
ANGLES = {"stated": {"stem": 30, "entrance": 21, "friction": 0.05},
          "inverted": {"stem": 28.5, "entrance": 25, "friction": 0.03}}
# Deviation of the flexural strength of beams at one place over their mean (recall).
STRENGTH_SPREAD = 0.2
PLACES = 8
SPEED_RANGE = 0.03  # allowed difference between the speed of a place and that of the test, as a share of it [-]
FORMULAS = {"Lindqvist": "lindqvist_kN", "Riska": "riska_kN", "Keinonen": "keinonen_kN", "Jeong": "jeong_kN"}
# Polaris, Bay of Bothnia, March 2017: thickness [m] and speed [m/s] at full power. The strength of the ice is not
# stated: 0.5 MPa, and friction 0.1, are assumed as for the design points of docs/validation.md.
POLARIS_TRIALS = ((0.72, 6.533), (0.81, 6.173))
POLARIS_ICE = {"flexural_strength_Pa": 0.5e6, "friction": 0.1}
NO_FACTOR = ("ships[0].hull.submersion_speed_factor", "none")


def set_key(whole, key, value):
    """Sets a key of a scene, as a.b[0].c names it."""
    *path, last = key.replace("[", ".").replace("]", "").split(".")
    for part in path:
        whole = whole[int(part)] if part.isdigit() else whole.setdefault(part, {})
    whole[last] = value


def share_of(place):
    """Of a test's speed at one of many places, spread evenly over any first ones [-]."""
    return 1 + SPEED_RANGE * (2 * (0.75488 * (place + 0.5) % 1) - 1)


def at_places(scene_at, places, settings):
    """[the scene of each place]; scene_at(share, slant) has the test at that share of its speed. More places have the
    same first ones."""
    scenes = []
    for place in range(places):
        whole = copy.deepcopy(scene_at(share=share_of(place), slant=slant_of(place))) | {"seed": place + 1}
        whole["fracture"]["bending"] = {"strength_spread": STRENGTH_SPREAD}
        for key, value in settings:
            set_key(whole, key, value)
        scenes.append(whole)
    return scenes


def scenes_of(test, particulars, places, settings):
    """The scenes of a test of Uikku with these angles and this friction."""
    ship = json.loads((HERE / "uikku.json").read_text(encoding="utf-8"))
    ship["hull"] |= {"entrance_angle_deg": particulars["entrance"], "stem_angle_deg": particulars["stem"]}
    scene_at = lambda share, slant: level_tests.scene(test, ship, particulars["friction"], share, slant=slant)
    return at_places(scene_at, places, settings)


def measured(run, average):
    """Of the measured way: the resistance [kN], its part under the hull, the share of the time without contact."""
    contact, submerged = level_tests.measured(run)
    count = round(average / level_tests.AVERAGE)
    total = np.convolve(contact + submerged, np.full(count, 1 / count), "valid")
    return {"mean": total.mean(), "sd": total.std(ddof=1), "min": total.min(), "max": total.max(),
            "submerged": submerged.mean(), "without_contact": np.mean(contact < 1e-3 * contact.max())}


def found_at(runs, label, scenes, average=level_tests.AVERAGE):
    """{name: means over its places of what `measured` has, and the standard error of the mean}."""
    found = runs.scenes("uikku", {(label, name, str(place)): each[place]
                                  for place in range(max(map(len, scenes.values()))) for name, each in scenes.items()})
    results = {}
    for name, each in scenes.items():
        values = [measured(found[label, name, str(place)], average) for place in range(len(each))]
        results[name] = {key: float(np.mean([of[key] for of in values])) for key in values[0]}
        results[name]["error"] = mean_and_error([of["mean"] for of in values])[1] if len(values) > 1 else math.nan
    return results


def with_error(of):
    """A mean and its standard error as a cell; of one place the mean alone [kN]."""
    return f"{of['mean']:.0f}" + ("" if math.isnan(of["error"]) else f" ± {of['error']:.0f}")


def of_tests(runs, angles, average=level_tests.AVERAGE, settings=(), places=PLACES):
    """(the tests, {test's name: what was found}) by one set of angles."""
    tests = level_tests.read_tests(HERE / "uikku_tests.csv")
    label = f"{angles}-{zlib.crc32(repr(tuple(settings)).encode()):08x}" if settings else angles
    scenes = {test.name: scenes_of(test, ANGLES[angles], places, settings) for test in tests}
    return tests, found_at(runs, label, scenes, average)


def table(runs, angles, average=level_tests.AVERAGE, settings=(), places=PLACES):
    """The tests by one set of angles."""
    tests, results = of_tests(runs, angles, average, settings, places)
    rows = []
    for test in tests:
        ours = results[test.name]
        hers = {key: float(test.row[f"resistance_{key}_kN"] or "nan") for key in ("mean", "sd", "min", "max")}
        has_sd = not math.isnan(hers["sd"])
        listed = lambda of: ", ".join(f"{of[key]:.0f}" for key in ("sd", "min", "max"))
        rows.append([test.name, f"{test.ice['thickness_m']:g}", f"{test.speed:g}",
                     f"{hers['mean']:.0f}, {listed(hers)}" if has_sd else f"{hers['mean']:.0f}",
                     with_error(ours), listed(ours), f"{ours['submerged']:.0f}",
                     f"{ours['mean'] / hers['mean']:.2f}", f"{ours['sd'] / hers['sd']:.2f}" if has_sd else "",
                     f"{100 * ours['without_contact']:.0f} %"])
    return Table(["test", "h [m]", "v [m/s]", "measured: mean, sd, least, largest [kN]", "Polynya: mean [kN]",
                  "sd, least, largest [kN]", "of it submersion", "mean over measured", "sd over measured",
                  "without contact"], rows, within=0.1)


def dependence(tests, forces):
    """Exponents of h, σ_f and v of sheets I to III by least squares of the logarithms, their standard errors, and the
    root mean square of what is left [-]."""
    of_sheets = [test for test in tests if test.name[0] in "123"]
    logarithms = np.log([[test.ice["thickness_m"], test.ice["flexural_strength_Pa"], test.speed] for test in of_sheets])
    matrix = np.column_stack([np.ones(len(of_sheets)), logarithms])
    values = np.log([forces[test.name] for test in of_sheets])
    solution = np.linalg.lstsq(matrix, values, rcond=None)[0]
    left = values - matrix @ solution
    variance = left @ left / (len(values) - len(solution))
    errors = np.sqrt(np.diag(variance * np.linalg.inv(matrix.T @ matrix)))
    return solution[1:], errors[1:], math.sqrt(np.mean(left**2))


DEPENDENCES = ("exponent of h", "of σ_f", "of v", "rms of what is left", "mean absolute error, sheets I to III",
               "all ten")


def dependence_cells(tests, forces):
    """Exponents of sheets I to III and the mean absolute errors of {test's name: force [kN]}."""
    solution, errors, left = dependence(tests, forces)
    off = [abs(forces[test.name] / test.mean - 1) for test in tests]
    of_sheets = off[:sum(test.name[0] in "123" for test in tests)]
    return [*(f"{value:.2f} ± {error:.2f}".replace("-", "−") for value, error in zip(solution, errors)),
            f"{100 * left:.0f} %", f"{100 * np.mean(of_sheets):.0f} %", f"{100 * np.mean(off):.0f} %"]


def dependences(runs, settings=(), places=PLACES):
    """How the resistance grows, and how far the means are off, beside formulas as the tests' authors found them."""
    tests, results = of_tests(runs, "stated", settings=settings, places=places)
    columns = {"measured": {test.name: test.mean for test in tests},
               "Polynya": {name: of["mean"] for name, of in results.items()}}
    columns |= {name: {test.name: float(test.row[key]) for test in tests} for name, key in FORMULAS.items()}
    rows = [[name, *dependence_cells(tests, forces)] for name, forces in columns.items()]
    rows[0][-2:] = "", ""
    return Table(["sheets I to III", *DEPENDENCES], rows, within=0.1)


def growth_over_bow(test):
    """What Lindqvist's factor of speed adds over the bow, which cusps with decks that flood leave out [kN]."""
    hull = json.loads((HERE / "uikku.json").read_text(encoding="utf-8"))["hull"]
    form = formulas.Hull(hull["length_m"], hull["beam_m"], hull["draught_m"], *(
        math.radians(ANGLES["stated"][key]) for key in ("stem", "entrance")))
    ice = formulas.Ice(test.ice["thickness_m"], friction=ANGLES["stated"]["friction"])
    of_bow = formulas.lift(form, ice) * (formulas.rise(form) + ice.friction * form.draught / math.tan(form.stem))
    return 1e-3 * of_bow * formulas.submersion_growth(form, test.speed)


WATER = {"once: decks, and the factor behind the bow (default)": (),
         "once: decks alone": (NO_FACTOR,),
         "once: the factor alone": (("fracture.bending.decks", "wet"),)}


def water(runs, settings=(), places=PLACES):
    """The choices by which missing water is counted once, and twice as in earlier versions: the default's means with
    the factor's growth over the bow, since contacts at constant speed are the same."""
    rows, twice = [], None
    for name, more in WATER.items():
        tests, results = of_tests(runs, "stated", settings=(*settings, *more), places=places)
        forces = {key: of["mean"] for key, of in results.items()}
        twice = twice or {test.name: forces[test.name] + growth_over_bow(test) for test in tests}
        rows.append([name, *dependence_cells(tests, forces)])
    rows.insert(0, ["twice: decks and all of the factor", *dependence_cells(tests, twice)])
    return Table(["water", *DEPENDENCES], rows, within=0.1)


def polaris(runs, settings=(), places=PLACES):
    """Resistance at the speeds of two trials, with and without Lindqvist's factor of speed, over the net thrust."""
    preset = json.loads(runs.call("ships", "polaris", "--json", stdout=-1).stdout)["ship"]
    engine = preset["propulsion"]["engine"]
    ship = {"name": "polaris", "hull": preset["hull"]}
    rows = []
    for h, v in POLARIS_TRIALS:
        test = level_tests.Test(f"polaris-{h:g}", {"thickness_m": h} | POLARIS_ICE, v, math.nan, {})
        scene_at = lambda share, slant: level_tests.scene(test, ship, None, share, slant=slant)
        thrust = 1e-3 * formulas.net_thrust(1e3 * engine["bollard_pull_kN"], engine["open_water_speed_m_per_s"], v)
        both = [found_at(runs, label, {test.name: at_places(scene_at, places, (*settings, *more))})[test.name]
                for label, more in (("with", ()), ("without", (NO_FACTOR,)))]
        rows.append([f"{h:g}", f"{v:.2f}", f"{thrust:.0f}", *map(with_error, both),
                     ", ".join(f"{of['mean'] / thrust:.2f}" for of in both),
                     f"{100 * (both[0]['mean'] - both[1]['mean']) / both[0]['mean']:.0f} %"])
    return Table(["h [m]", "v [m/s]", "net thrust [kN]", "resistance with the factor [kN]", "without [kN]",
                  "over net thrust: with, without", "share of the factor"], rows, within=0.1)


def main():
    made = {"tests": lambda runs, of: table(runs, "stated", of.average, of.settings, of.places),
            "other-angles": lambda runs, of: table(runs, "inverted", of.average, of.settings, of.places),
            "water": lambda runs, of: water(runs, of.settings, of.places),
            "dependences": lambda runs, of: dependences(runs, of.settings, of.places),
            "polaris": lambda runs, of: polaris(runs, of.settings, of.places)}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="*", metavar="TABLE", help=f"of {', '.join(made)}; all if none is named")
    parser.add_argument("--set", action="append", default=[], dest="settings", metavar="KEY=VALUE")
    parser.add_argument("--places", type=int, default=PLACES, metavar="N")
    parser.add_argument("--average", type=float, default=level_tests.AVERAGE, metavar="S")
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="build/studies")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    unknown = set(arguments.tables) - set(made)
    if unknown:
        parser.error(f"no table {', '.join(sorted(unknown))}")
    arguments.settings = [(key, json.loads(value))
                          for key, _, value in (of.partition("=") for of in arguments.settings)]
    runs = Runs(arguments.polynya, arguments.work, arguments.jobs)
    for name in arguments.tables or made:
        print(f"{name}\n\n{made[name](runs, arguments)}", flush=True)


if __name__ == "__main__":
    main()
