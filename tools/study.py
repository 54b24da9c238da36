"""What the studies of ships in ice share: the reference ship, runs of scenes, and Lindqvist's formula. Not a program."""
import concurrent.futures
import csv
import json
import math
import os
import subprocess

HULL = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30}
SHIP = {"name": "icebreaker", "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "hull": HULL}
LENGTH, BEAM, DRAUGHT, STEM, ENTRANCE = 120, 24, 6, math.radians(30), math.radians(27)
G, RHO_I, RHO_W, YOUNG, POISSON, FLEXURAL, FRICTION = 9.81, 900, 1000, 5.4e9, 0.3, 0.8e6, 0.2

FEW_RECORDS = {"record": {"forces_interval_s": 0.1, "frames_interval_s": 60, "contacts": "none"}}


def lindqvist(h, v):
    """R_c, R_b and R_s with their factors of speed [N]; [Lindqvist1989] (recall)."""
    psi = math.atan(math.tan(STEM) / math.sin(ENTRANCE))
    crushing = 0.5 * FLEXURAL * h**2 * (math.tan(STEM) + FRICTION * math.cos(STEM) / math.cos(psi)) / (
        1 - FRICTION * math.sin(STEM) / math.cos(psi))
    bending = (27 / 64) * FLEXURAL * BEAM * h**1.5 / math.sqrt(YOUNG / (12 * (1 - POISSON**2) * RHO_W * G)) * (
        math.tan(psi) + FRICTION * math.cos(STEM) / (math.sin(ENTRANCE) * math.cos(psi))) * (1 + 1 / math.cos(psi))
    rise = DRAUGHT * (BEAM + DRAUGHT) / (BEAM + 2 * DRAUGHT)
    slide = (0.7 * LENGTH - DRAUGHT / math.tan(STEM) - BEAM / (4 * math.tan(ENTRANCE))
             + DRAUGHT * math.cos(STEM) * math.cos(psi) * math.sqrt(1 / math.sin(STEM)**2 + 1 / math.tan(ENTRANCE)**2))
    submersion = (RHO_W - RHO_I) * G * h * BEAM * (rise + FRICTION * slide)
    factor = 1 + 1.4 * v / math.sqrt(G * h)
    return crushing * factor, bending * factor, submersion * (1 + 9.4 * v / math.sqrt(G * LENGTH))


def run_scene(arguments, name, scene):
    """Runs a scene with arguments.polynya; its run folder, in arguments.work, and its summary."""
    folder = os.path.join(arguments.work, name)
    with open(folder + ".json", "w", encoding="utf-8") as file:
        json.dump(scene, file)
    subprocess.run([arguments.polynya, "run", folder + ".json", "--out", folder, "--overwrite", "--progress", "none"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return folder, json.load(file)


def rows_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run_all(arguments, run, scenes):
    """The results of run(arguments, name, scene) of all scenes, by their keys."""
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        futures = {key: pool.submit(run, arguments, "-".join(str(part) for part in key), scene)
                   for key, scene in scenes.items()}
        return {key: future.result() for key, future in futures.items()}
