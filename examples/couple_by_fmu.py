#!/usr/bin/python3
"""A ship whose propulsion is computed elsewhere, coupled by a co-simulation unit, beside the same ship in one scene.

    python3 examples/couple_by_fmu.py        (--out FOLDER; --short: one field, the first seconds)

Shows a master of the Functional Mock-up Interface (FMI 2.0) in plain Python: ctypes loads the unit that `polynya fmu`
makes. Every 0.1 s the master reads the ship's speed, computes the thrust of its own propeller model, and sets it as a
force for the next step. The other ship has the same propeller as the engine of its scene. Both sail in open water and
through ten fields of floes. Draws couple-by-fmu.png: speeds in open water, and the way made in each field.
"""
import argparse
import ctypes
import json
import pathlib
import subprocess
import tempfile
import xml.etree.ElementTree as xml
import zipfile

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

import numpy
from matplotlib.figure import Figure

from polynya.program import program

COMMUNICATION = 0.1  # [s]
BOLLARD_PULL, OPEN_WATER_SPEED = 800e3, 7.0  # [N], [m/s]
LENGTH, BEAM, DRAUGHT, BLOCK = 80.0, 18.0, 6.0, 0.6
WETTED = 1.7 * LENGTH * DRAUGHT + BLOCK * LENGTH * BEAM  # [m²], as docs/theory/ship.md has it
# The engine's law has a hull resistance of two thirds of the bollard pull at the open-water speed. The coupled ship,
# which has no engine in its scene, gets the same resistance by its coefficient.
RESISTANCE = 2 / 3 * BOLLARD_PULL / OPEN_WATER_SPEED**2 / (0.5 * 1000 * WETTED)


def scene(propulsion, water, seed, has_ice):
    ice = [{"field": {"corner_m": [0, -100], "extent_m": [500, 200], "floe_size_m": 20, "size_spread": 0.3,
                      "concentration": 0.6}}]
    return {
        "name": "coupled-ship", "seed": seed, "time": {"step_s": 0.02, "until_s": 120},
        "ice": {"thickness_m": 0.6},
        "ships": [{"name": "ship", "hull": {"length_m": LENGTH, "beam_m": BEAM, "entrance_angle_deg": 30,
                                            "stem_angle_deg": 30, "draught_m": DRAUGHT, "block_coefficient": BLOCK},
                   "position_m": [-45, 0], "speed_m_per_s": 3, "propulsion": propulsion, "water": water}],
        "floes": ice if has_ice else [],
    }


def thrust(speed):
    """The master's propeller: it loses thrust in proportion to the ship's speed [N]."""
    return BOLLARD_PULL * (1 - speed / (3 * OPEN_WATER_SPEED))


LOGGER = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p,
                          ctypes.c_char_p)


class Callbacks(ctypes.Structure):
    _fields_ = [("logger", LOGGER), ("allocate", ctypes.c_void_p), ("free", ctypes.c_void_p),
                ("finished", ctypes.c_void_p), ("environment", ctypes.c_void_p)]


class Unit:
    """A co-simulation unit, unpacked and loaded, with one instance; a context that ends it."""

    def __init__(self, archive, name="ship"):
        self._folder = tempfile.TemporaryDirectory()
        with zipfile.ZipFile(archive) as members:
            members.extractall(self._folder.name)
        folder = pathlib.Path(self._folder.name)
        description = xml.parse(folder / "modelDescription.xml").getroot()
        self._references = {v.get("name"): int(v.get("valueReference")) for v in description.iter("ScalarVariable")}
        self._library = ctypes.CDLL(str(folder / "binaries/linux64/polynya.so"))
        self._library.fmi2Instantiate.restype = ctypes.c_void_p
        self._callbacks = Callbacks(LOGGER(lambda *told: print(told[3].decode(), (told[5] or b"").decode())))
        self._instance = ctypes.c_void_p(self._library.fmi2Instantiate(
            name.encode(), 1, description.get("guid").encode(), (folder / "resources").as_uri().encode(),
            ctypes.byref(self._callbacks), 0, 0))
        if not self._instance:
            raise RuntimeError("the unit makes no instance")
        self.time = 0.0

    def _call(self, function, *arguments):
        status = getattr(self._library, function)(self._instance, *arguments)
        if status > 1:  # neither OK nor a warning
            raise RuntimeError(f"{function} gives status {status}")

    def initialize(self, **integers):
        for name, value in integers.items():
            self._call("fmi2SetInteger", (ctypes.c_uint * 1)(self._references[name]), ctypes.c_size_t(1),
                       (ctypes.c_int * 1)(value))
        zero = ctypes.c_double(0)
        self._call("fmi2SetupExperiment", 0, zero, zero, 0, zero)
        self._call("fmi2EnterInitializationMode")
        self._call("fmi2ExitInitializationMode")

    def get(self, name):
        value = (ctypes.c_double * 1)()
        self._call("fmi2GetReal", (ctypes.c_uint * 1)(self._references[name]), ctypes.c_size_t(1), value)
        return value[0]

    def set(self, name, value):
        self._call("fmi2SetReal", (ctypes.c_uint * 1)(self._references[name]), ctypes.c_size_t(1),
                   (ctypes.c_double * 1)(value))

    def step(self, seconds):
        self._call("fmi2DoStep", ctypes.c_double(self.time), ctypes.c_double(seconds), 1)
        self.time += seconds

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self._library.fmi2FreeInstance(self._instance)
        self._folder.cleanup()


def sail_coupled(seed, has_ice, until, folder):
    """Speed [m/s] and place [m] each communication step, of the ship with the master's propeller."""
    water = {"model": "manoeuvring", "resistance_coefficient": RESISTANCE}
    written = folder / "coupled-ship.json"
    written.write_text(json.dumps(scene({"thrust_N": 0}, water, seed, has_ice)))
    subprocess.run([program(), "fmu", written, "--out", folder / "ship.fmu"], check=True, stdout=subprocess.DEVNULL)
    speeds, places = [], []
    with Unit(folder / "ship.fmu") as unit:
        unit.initialize()
        for _ in range(round(until / COMMUNICATION)):
            unit.set("ship.external.surge_N", thrust(unit.get("ship.surge_m_per_s")))
            unit.step(COMMUNICATION)
            speeds.append(unit.get("ship.surge_m_per_s"))
            places.append(unit.get("ship.x_m"))
    return numpy.array(speeds), numpy.array(places)


def sail_alone(seed, has_ice, until):
    """The same of the ship whose engine is in its scene."""
    engine = {"engine": {"bollard_pull_kN": BOLLARD_PULL / 1e3, "open_water_speed_m_per_s": OPEN_WATER_SPEED}}
    simulation = polynya.Simulation(scene(engine, {"model": "manoeuvring"}, seed, has_ice))
    speeds, places = [], []
    for i in range(round(until / COMMUNICATION)):
        simulation.run(until=(i + 1) * COMMUNICATION)
        ship = simulation.ships[0]
        speeds.append(numpy.cos(ship.heading) * ship.velocity[0] + numpy.sin(ship.heading) * ship.velocity[1])
        places.append(ship.position[0])
    return numpy.array(speeds), numpy.array(places)


def draw(open_water, ways, path):
    figure = Figure(figsize=(6.7, 3.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    times = COMMUNICATION * numpy.arange(1, len(open_water[0]) + 1)
    left.plot(times, open_water[0], color="#000000", linewidth=2, label="engine in the scene")
    left.plot(times, open_water[1], color="#d55e00", linewidth=1, label="coupled at 0.1 s")
    left.set(xlabel="time [s]", ylabel="speed [m/s]", title="open water")
    left.legend()
    right.plot(ways[:, 0], ways[:, 1], "o", color="#0072b2")
    ends = [ways.min(), ways.max()]
    right.plot(ends, ends, color="#000000", linewidth=0.8)
    right.set(xlabel="way, engine in the scene [m]", ylabel="way, coupled [m]", title="fields of floes")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="one field, the first seconds only")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    until, fields = (20, 2) if options.short else (80, 10)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        alone, coupled = sail_alone(1, False, until), sail_coupled(1, False, until, folder)
        apart = numpy.abs(coupled[0] / alone[0] - 1).max()
        print(f"open water: speeds differ by at most {100 * apart:.2f} %, ways by "
              f"{100 * abs((coupled[1][-1] + 45) / (alone[1][-1] + 45) - 1):.3f} %")
        ways = 45 + numpy.array([(sail_alone(seed, True, until)[1][-1], sail_coupled(seed, True, until, folder)[1][-1])
                                 for seed in range(1, fields + 1)])
    difference = ways[:, 1] - ways[:, 0]
    error = difference.std(ddof=1) / numpy.sqrt(fields)
    print(f"{fields} fields, {until} s: {ways[:, 0].mean():.2f} m with the engine in the scene, "
          f"{ways[:, 1].mean():.2f} m coupled; coupled less other {difference.mean():+.3f} m, standard error "
          f"{error:.3f} m")
    draw((alone[0], coupled[0]), ways, options.out / "couple-by-fmu.png")
    print(options.out / "couple-by-fmu.png")


if __name__ == "__main__":
    main()
