"""What the studies of ships in ice share: the reference ship, runs of scenes, and published formulas. Not a program."""
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "python"))
from polynya import formulas  # noqa: E402

HULL = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30}
SHIP = {"name": "icebreaker", "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "hull": HULL}
LENGTH, BEAM, DRAUGHT, STEM, ENTRANCE = 120, 24, 6, math.radians(30), math.radians(27)
REFERENCE = formulas.Hull(LENGTH, BEAM, DRAUGHT, STEM, ENTRANCE)
ICE = formulas.Ice(thickness=0.5)
G, RHO_I, RHO_W = formulas.G, ICE.density, ICE.water_density
YOUNG, POISSON, FLEXURAL = ICE.young, ICE.poisson, ICE.flexural_strength

FEW_RECORDS = {"record": {"forces_interval_s": 0.1, "frames_interval_s": 60, "contacts": "none"}}


def slant_of(number):
    """Of the edge of one of many plates, 2 to 6 degrees, spread evenly over any first ones [rad]."""
    return 0.03 + 0.07 * (0.61803 * number % 1)


def slanted_ice(slant, end):
    """A plate of fast ice, 200 m wide, from x = 0 to `end` [m]; its edge has that slant."""
    return {"polygon": {"outer_m": [[-100 * slant, -100], [end, -100], [end, 100], [100 * slant, 100]]},
            "fast_ice": True}


def lindqvist(h, v):
    """Of the reference ship."""
    return formulas.lindqvist(REFERENCE, formulas.Ice(h), v)


def run_scene(arguments, name, scene):
    """Runs a scene with arguments.polynya; its run folder, in arguments.work, and its summary."""
    folder = os.path.join(arguments.work, name)
    with open(folder + ".json", "w", encoding="utf-8") as file:
        json.dump(scene, file)
    subprocess.run([arguments.polynya, "run", folder + ".json", "--out", folder, "--overwrite", "--progress", "none"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return folder, json.load(file)


def measured_run(program, folder, scene, *options):
    """Runs a scene without pictures into folder/run: that folder, its summary, and its time of the processor [s]."""
    file, run = pathlib.Path(folder) / "scene.json", pathlib.Path(folder) / "run"
    file.write_text(json.dumps(scene), encoding="utf-8")
    before = os.times()
    subprocess.run([program, "run", file, "--out", run, "--overwrite", "--progress", "none", *options], check=True,
                   capture_output=True)
    after = os.times()
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return run, json.loads((run / "summary.json").read_text(encoding="utf-8")), used


def rows_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run_all(arguments, run, scenes):
    """The results of run(arguments, name, scene) of all scenes, by their keys."""
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        futures = {key: pool.submit(run, arguments, "-".join(str(part) for part in key), scene)
                   for key, scene in scenes.items()}
        return {key: future.result() for key, future in futures.items()}
