"""Level-ice tests of a ship: their table, the scene of each test, and what its run is compared by. Not a program."""
import csv
import dataclasses
import math
import typing

from polynya.errors import InputError
from polynya.performance.level_ice import ENDLESS

MEASURED = 100  # way over which the ice's force is measured, once the hull is full of ice [m]
GAP = 2  # width of the water before the ice [m]
AVERAGE = 0.1  # over which forces are averaged [s]
SLANT = 0.07  # of the ice's edge: along a straight one a bow breaks mirror images for a long way, as no ice does [rad]
# Columns of a table of tests, with the least and the largest value of each; the first are required.
REQUIRED = {
    "thickness_m": (1e-3, 20),
    "flexural_strength_kPa": (1e-3, 1e6),
    "speed_m_per_s": (1e-3, 20),
    "resistance_mean_kN": (1e-6, 1e9),
}
OPTIONAL = {
    "youngs_modulus_MPa": (1e-3, 1e6),
    "compressive_strength_kPa": (1e-3, 1e6),
    "friction": (0, 2),
    "resistance_sd_kN": (1e-6, 1e9),
}
IN_SI = {"flexural_strength_kPa": 1e3, "youngs_modulus_MPa": 1e6, "compressive_strength_kPa": 1e3}
ICE_KEYS = {
    "thickness_m": "thickness_m",
    "flexural_strength_kPa": "flexural_strength_Pa",
    "youngs_modulus_MPa": "youngs_modulus_Pa",
    "compressive_strength_kPa": "compressive_strength_Pa",
    "friction": "friction",
}


@dataclasses.dataclass(frozen=True)
class Test:
    """A row of the table: the scene's ice, the speed [m/s], and the measured resistance [kN]; `row` has its cells."""

    name: str
    ice: typing.Dict[str, float]
    speed: float
    mean: float
    row: typing.Dict[str, str]


def read_tests(path):
    """The tests of a table with a line of column names; lines that begin with # are comments. Raises InputError."""
    with open(path, encoding="utf-8-sig", newline="") as file:
        lines = [(number, line) for number, line in enumerate(file, 1) if line.strip() and not line.startswith("#")]
    if not lines:
        raise InputError(f"{path}: no line of column names")
    reader = csv.DictReader(line for _, line in lines)
    missing = [name for name in REQUIRED if name not in (reader.fieldnames or ())]
    if missing:
        raise InputError([f"{path}:{lines[0][0]}: no column {name}" for name in missing])
    tests, problems = [], []
    for (number, _), row in zip(lines[1:], reader):
        values = {}
        for name, (least, most) in (REQUIRED | OPTIONAL).items():
            if name in OPTIONAL and not row.get(name):
                continue
            try:
                values[name] = float(row[name])
            except (TypeError, ValueError):
                values[name] = math.nan
            if not least <= values[name] <= most:
                problems.append(f"{path}:{number}: {name}: found {row[name]}, allowed: a number ≥ {least:g}, ≤ "
                                f"{most:g}")
        ice = {key: values[name] * IN_SI.get(name, 1) for name, key in ICE_KEYS.items() if name in values}
        name = row.get("test") or str(len(tests) + 1)
        tests.append(
            Test(name, ice, values["speed_m_per_s"], values["resistance_mean_kN"], row)
        )
    names = [test.name for test in tests]
    problems += [f"{path}: two tests are called {name}" for name in sorted({n for n in names if names.count(n) > 1})]
    if not tests:
        problems.append(f"{path}: no test")
    if problems:
        raise InputError(problems)
    return tests


def ends_of(hull):
    """x of its stern and stem [m], and its beam [m]."""
    if "waterline_m" in hull:
        x, y = zip(*hull["waterline_m"])
        return min(x), max(x), max(y) - min(y)
    return -0.5 * hull["length_m"], 0.5 * hull["length_m"], hull["beam_m"]


def way_in(hull):
    """Distance that the ship sails until the ice reaches along all of its hull [m]."""
    stern, stem, beam = ends_of(hull)
    angle = hull.get("entrance_angle_deg")
    bow = 0.3 * (stem - stern) if angle is None else 0.5 * beam / math.tan(math.radians(angle))
    return bow + 1.05 * (stem - stern)


def scene(test, ship, friction=None, share=1.0, slant=SLANT):
    """The ship at constant speed, `share` of the test's, in fast ice that does not split and whose edge has that slant
    [rad]. Forces are measured once the ice reaches along all of the hull."""
    way, (stern, stem, beam) = way_in(ship["hull"]) + MEASURED, ends_of(ship["hull"])
    speed, kept = share * test.speed, ("name", "hull", "mass_kg", "moment_of_inertia_kg_m2")
    placed = {key: ship[key] for key in kept if key in ship} | {
        "position_m": [-stem - GAP, 0],
        "propulsion": {"constant_speed_m_per_s": speed},
    }
    ice = test.ice if friction is None or "friction" in test.ice else test.ice | {"friction": friction}
    side = 3.5 * beam
    end, skew = way + 50, slant * side
    return {
        "name": f"test-{test.name}",
        "time": {"step_s": min(0.02, 0.01 / speed), "until_s": (way + GAP) / speed},
        "ice": ice,
        "fracture": {key: dict(value) for key, value in ENDLESS.items()},
        "ships": [placed],
        "floes": [
            {
                "polygon": {"outer_m": [[-skew, -side], [end, -side], [end, side], [skew, side]]},
                "fast_ice": True,
            }
        ],
        "record": {"forces_interval_s": AVERAGE, "frames_interval_s": 60, "contacts": "none"},
    }


def measured(run):
    """Of the last MEASURED m: the force of contacts, and of the ice under the hull [kN]; means over AVERAGE."""
    start = run.scene["time"]["until_s"] - MEASURED / run.scene["ships"][0]["propulsion"]["constant_speed_m_per_s"]
    forces = run.force_columns
    is_measured = forces["t_s"] > start
    return [-1e-3 * forces[name][is_measured] for name in ("surge_N", "surge_from_submerged_ice_N")]
