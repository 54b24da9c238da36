#!/usr/bin/env python3
"""What bounds and moves ice from outside, beside closed forms; tables of docs/validation.md.

  tools/boundary_study.py cylinder    a floe of 40 m on a cylinder of 10 m: largest force and depth
  tools/boundary_study.py drift       speed of floes in the wind, by size and speed of the wind
  tools/boundary_study.py press       a plate on a cylinder in a wind and in a current
  tools/boundary_study.py pressure    ice along flanks and sides of the ship, pressed by walls with a line load

Options of all: --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. Needs numpy.
"""
import argparse
import json
import math
import os

import numpy as np

from study import BEAM, ENTRANCE, HULL, LENGTH, SHIP, rows_of, run_all, run_scene

AIR, C_A, C_W, RHO_I, RHO_W, THICKNESS, FRICTION = 1.3, 0.002, 0.004, 900, 1000, 0.5, 0.2
UNBREAKABLE = {"fracture": {"breakable_size_factor": 1000, "splitting": {"model": "none"}}}


def column(folder, ship, name):
    return np.array([float(row[name]) for row in rows_of(folder, "forces.csv") if row["ship"] == ship])


def run(arguments, name, scene):
    folder, summary = run_scene(arguments, name, scene)
    assert summary["audit_closed"], name
    return folder, summary


def on_cylinder(corners, step):
    """A floe of 40 x 40 m at .5 m/s onto a cylinder of 10 m, of so many corners; 0: as radius_m gives it."""
    ring = [[10 * math.cos(2 * math.pi * i / corners), 10 * math.sin(2 * math.pi * i / corners)]
            for i in range(corners)]
    outline = {"waterline_m": ring} if corners else {"radius_m": 10}
    return UNBREAKABLE | {
        "name": "cylinder", "time": {"step_s": step, "until_s": 0.5}, "water": {"drag_coefficient": 0},
        "record": {"forces_interval_s": step, "frames_interval_s": 0.5}, "structures": [outline | {"name": "cylinder"}],
        "floes": [{"rectangle": {"corner_m": [10.001, -20], "size_m": 40}, "velocity_m_per_s": [-0.5, 0]}]}


def depth_of(folder):
    """How far the floe has come into the cylinder [m], by the floes at the end."""
    with open(os.path.join(folder, "final.geojson"), encoding="utf-8") as file:
        rings = [feature["geometry"]["coordinates"][0] for feature in json.load(file)["features"]]
    return 10 - min(x for ring in rings for x, _ in ring)


def study_cylinder(arguments):
    energy, pressure = 0.5 * RHO_I * THICKNESS * 1600 * 0.25, 2.8e6
    depth = (3 * energy / (4 * pressure * THICKNESS * math.sqrt(20)))**(2 / 3)
    force = 2 * pressure * THICKNESS * math.sqrt(20 * depth)
    results = run_all(arguments, run, {("cylinder", n, dt): on_cylinder(n, dt) for n in (0, 2048)
                                       for dt in (0.001, 0.005, 0.01)})
    print("| cylinder | step [s] | largest force [MN] | closed form | depth [m] | closed form |\n|---|---|---|---|---|"
          "---|")
    for (_, corners, step), (folder, _) in results.items():
        print(f"| {corners or 'radius_m 10'}{' corners' if corners else ''} | {step:g} | "
              f"{-column(folder, 'cylinder', 'surge_N').min() / 1e6:.3f} "
              f"| {force / 1e6:.3f} | {depth_of(folder):.4f} | {depth:.4f} |")


def drifting(size, wind):
    """A square floe in a wind, until it has its speed."""
    mass_per_area = RHO_I * THICKNESS
    tau = mass_per_area / math.sqrt(0.5 * AIR * C_A * wind**2 * 0.5 * C_W * RHO_W)
    return {"name": "drift", "time": {"step_s": 0.2, "until_s": 10 * tau}, "wind": {"velocity_m_per_s": [wind, 0]},
            "record": {"forces_interval_s": 1000, "frames_interval_s": 5 * tau},
            "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": size}}]}


def study_drift(arguments):
    cases = [(size, wind) for size in (5, 15, 50, 500) for wind in (5, 10, 20)]
    results = run_all(arguments, run, {("drift", *case): drifting(*case) for case in cases})
    print("| floe [m] | wind [m/s] | speed [m/s] | closed form | % of the wind | without form drag |\n|---|---|---|---|"
          "---|---|")
    for size, wind in cases:
        _, summary = results["drift", size, wind]
        speed = math.sqrt(2 * summary["energy"]["kinetic_J"] / (RHO_I * THICKNESS * size**2))
        push = AIR * C_A * wind**2
        closed = math.sqrt(push / (RHO_W * (C_W + 0.5 * THICKNESS / size)))
        print(f"| {size} | {wind} | {speed:.4f} | {closed:.4f} | {100 * speed / wind:.2f} | "
              f"{math.sqrt(push / (RHO_W * C_W)):.4f} |")


def pressing_plate(wind, drift):
    """A plate of 600 x 400 m that comes onto a cylinder of 10 m at .3 m/s."""
    scene = UNBREAKABLE | {
        "name": "press", "time": {"step_s": 0.02, "until_s": 240}, "water": {"drift_m_per_s": [-drift, 0]},
        "record": {"forces_interval_s": 1, "frames_interval_s": 120},
        "structures": [{"name": "cylinder", "radius_m": 10}],
        "floes": [{"rectangle": {"corner_m": [10.01, -200], "size_m": [600, 400]},
                   "velocity_m_per_s": [drift - 0.3, 0]}]}
    if wind:
        scene["wind"] = {"velocity_m_per_s": [-wind, 0]}
    elif drift:
        scene["water"]["skin_drag_coefficient"] = C_W
    return scene


def study_press(arguments):
    cases = [(0, 0), (10, 0), (20, 0), (0, 0.3), (0, 0.5)]
    results = run_all(arguments, run, {("press", *case): pressing_plate(*case) for case in cases})
    print("| wind [m/s] | current [m/s] | mean force, 120-240 s [kN] | wind and water on the plate [kN] |\n|---|---|"
          "---|---|")
    for wind, drift in cases:
        force = -column(results["press", wind, drift][0], "cylinder", "surge_N")[120:].mean()
        skin = C_W if wind or drift else 0
        outer = 0.5 * AIR * C_A * wind**2 * 240e3 + 0.5 * RHO_W * drift**2 * (skin * 240e3 + 0.5 * THICKNESS * 400)
        print(f"| {wind} | {drift:g} | {force / 1e3:.2f} | {outer / 1e3:.2f} |")


BOW = 0.5 * BEAM / math.tan(ENTRANCE)


def along_hull(load, side, speed=0.005):
    """Blocks of ice along both bow flanks and so much of both sides, a wall behind each; the walls press."""
    aft = LENGTH / 2 - BOW - side
    hull = [(LENGTH / 2, 0), (LENGTH / 2 - BOW, BEAM / 2), (aft, BEAM / 2), (aft, -BEAM / 2),
            (LENGTH / 2 - BOW, -BEAM / 2)]
    walls, floes = [], []
    for i, k in ((0, 1), (1, 2), (3, 4), (4, 0)):
        along = np.subtract(hull[k], hull[i]) / math.dist(hull[i], hull[k])
        out = np.array([along[1], -along[0]])
        beside = lambda p, off: list(np.array(p) + off * out)
        floes.append({"polygon": {"outer_m": [beside(hull[i], 0.001), beside(hull[i], 10),
                                              beside(hull[k], 10), beside(hull[k], 0.001)]}})
        walls.append({"from_m": beside(hull[i], 10.001), "to_m": beside(hull[k], 10.001), "depth_m": 5,
                      "pressure": {"line_load_N_per_m": load}})
    return UNBREAKABLE | {
        "name": "along-hull", "time": {"step_s": 0.01, "until_s": 60}, "contact": {"tolerance_m_per_s": 1e-5},
        "record": {"forces_interval_s": 0.1, "frames_interval_s": 30}, "walls": walls, "floes": floes,
        "ships": [SHIP | {"hull": HULL | {"stem_angle_deg": 90}, "propulsion": {"constant_speed_m_per_s": speed}}]}


def study_pressure(arguments):
    closed = lambda q, side: q * (BEAM + 2 * FRICTION * (BOW + side)) / 1e6
    whole = LENGTH - BOW
    print("| q [kN/m] | length of a side [m] | R [MN] | q (B + 2 μ (L_bow + L_par)) |\n|---|---|---|---|")
    cases = [(50e3, 72.9), (50e3, whole), (25e3, whole), (100e3, whole)]
    results = run_all(arguments, run, {("along", int(q), f"{side:.0f}"): along_hull(q, side) for q, side in cases})
    for q, side in cases:
        rows = column(results["along", int(q), f"{side:.0f}"][0], "icebreaker", "surge_N")
        print(f"| {q / 1e3:g} | {side:.2f} | {-rows[300:].mean() / 1e6:.3f} | {closed(q, side):.3f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("cylinder", "drift", "press", "pressure"))
    parser.add_argument("--polynya", default="polynya")
    parser.add_argument("--work", default="/tmp/boundary-study")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    globals()["study_" + arguments.study](arguments)


if __name__ == "__main__":
    main()
