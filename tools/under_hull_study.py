#!/usr/bin/env python3
"""Ice that goes under a hull, beside published resistance formulas; the tables of docs/validation.md.

  tools/under_hull_study.py level         level ice by part, .5-3 m/s and .25-1.5 m, beside Lindqvist's parts
  tools/under_hull_study.py pack          pack ice, concentrations .3-.9, six seeds, beside Colbourne and Zuev
  tools/under_hull_study.py shapes        square floes in rows and irregular ones, C .5-.9, beside Colbourne
  tools/under_hull_study.py special       a plug, a floe on a plate ahead of the stem, a follower in the channel
  tools/under_hull_study.py sensitivity   added mass, damping, deflection, step and contact circles halved and doubled

Options of all: --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. Needs numpy.
"""
import argparse
import json
import math
import os

import numpy as np

from study import BEAM, FEW_RECORDS, G, HULL, RHO_I, SHIP, lindqvist, rows_of, run_all, run_scene


def colbourne(cover, h, v, k, b, n):
    """Pack ice after Colbourne (2000), ½ k Fr^b ρ_i B h v² C^n [N]."""
    return 0.5 * k * (v / math.sqrt(G * h * cover))**b * RHO_I * BEAM * h * v**2 * cover**n


def zuev(cover, h, v):
    """Small broken ice after Zuev [N]."""
    fr = v / math.sqrt(G * h)
    return RHO_I * G * BEAM * h**2 * (0.13 * BEAM / h + 1.3 * fr + 0.5 * fr**2) * (2 - cover) * cover**2


def ship(x, y, speed, **other):
    return SHIP | {"hull": HULL | {"draught_m": 6}, "position_m": [x, y],
                   "propulsion": {"constant_speed_m_per_s": speed}} | other


def level_ice(h, v, y=0.0, **settings):
    """A plate so heavy that it stays; the ship goes in by its length and 60 m, then 150 m are measured."""
    return {"name": "level", "time": {"step_s": min(0.01, 0.01 / v), "until_s": (182 + 150) / v},
            "ice": {"thickness_m": h}, "fracture": {"splitting": {"model": "none"}}, "ships": [ship(-62, y, v)],
            "floes": [{"rectangle": {"corner_m": [0, -1500], "size_m": [3000, 3000]}}]} | settings


def pack(cover, seed, v=1.0, **settings):
    """Unbreakable floes of 15 m and half a metre, open all around."""
    fracture = {"breakable_size_factor": 100} | settings.pop("fracture", {})
    return {"name": "pack", "seed": seed, "time": {"step_s": 0.01, "until_s": 300 / v}, "fracture": fracture,
            "ships": [ship(-62, 0, v)],
            "floes": [{"field": {"corner_m": [0, -90], "extent_m": [400, 180], "floe_size_m": 15,
                                 "concentration": cover, "gap_m": 0.01}}]} | settings


def squares(cover, seed, v=1.0):
    """The same of square floes in rows; instead of another field, the ship goes in at another offset from them."""
    pitch = 15 / math.sqrt(cover)
    rows = round(180 / pitch)
    scene = pack(cover, 1, v)
    scene["ships"] = [ship(-62, (seed - 1) / 6 * pitch, v)]
    scene["floes"] = [{"lattice": {"origin_m": [0, -pitch * rows / 2], "columns": round(400 / pitch), "rows": rows,
                                   "pitch_m": pitch, "size_m": 15}}]
    return scene


def pinned():
    """A floe of 12 m and one metre on a plate ahead of the stem."""
    return {"name": "pinned", "time": {"step_s": 0.005, "until_s": 20}, "ice": {"thickness_m": 1},
            "fracture": {"breakable_size_factor": 100}, "ships": [ship(-60.5, 0, 1)],
            "floes": [{"rectangle": {"corner_m": [0, -6], "size_m": 12}},
                      {"rectangle": {"corner_m": [12.01, -1500], "size_m": [3000, 3000]}}]}


def follower():
    """Two ships in line, the second 60 m behind the first."""
    scene = level_ice(0.5, 1)
    scene["ships"].append(ship(-242, 0, 1, name="follower"))
    scene["time"]["until_s"] = 460
    return scene


def plug(path):
    with open(path, encoding="utf-8") as file:
        scene = json.load(file)
    scene["ships"][0]["hull"]["draught_m"] = 6
    return scene


def without_tilting(scene):
    fracture = scene.get("fracture", {}) | {"going_under": {"enabled": False}}
    return scene | {"fracture": fracture}


def run(arguments, name, scene):
    """Runs a scene: rows of forces by ship, and the summary."""
    folder, summary = run_scene(arguments, name, scene | FEW_RECORDS)
    columns = {}
    for row in rows_of(folder, "forces.csv"):
        of_ship = columns.setdefault(row["ship"], {"t": [], "contact": [], "under": []})
        of_ship["t"].append(float(row["t_s"]))
        of_ship["contact"].append(-float(row["surge_N"]))
        of_ship["under"].append(-float(row["surge_from_submerged_ice_N"]))
    assert summary["audit_closed"], name
    return {name: {key: np.array(column) for key, column in of.items()} for name, of in columns.items()}, summary


def mean_after(forces, time, until=math.inf):
    """Contact and submersion, mean [kN]."""
    chosen = (forces["t"] > time) & (forces["t"] <= until)
    return forces["contact"][chosen].mean() / 1e3, forces["under"][chosen].mean() / 1e3


def study_level(arguments):
    cases = [(0.5, v) for v in (0.5, 1, 2, 3)] + [(h, 1) for h in (0.25, 0.75, 1, 1.5)]
    offsets = (0, 0.7)
    results = run_all(arguments, run, {("level", h, v, y): level_ice(h, v, y) for h, v in cases for y in offsets})
    print("| h [m] | v [m/s] | crushing and bending | submersion | sum | Lindqvist: R_c + R_b | R_s | sum | × real "
          "time |")
    print("|---|---|---|---|---|---|---|---|---|")
    for h, v in cases:
        each = [mean_after(results["level", h, v, y][0]["icebreaker"], 182 / v) for y in offsets]
        contact, under = np.mean(each, axis=0)
        crushing, bending, submersion = (r / 1e3 for r in lindqvist(h, v))
        breaking = crushing + bending
        factor = np.median([results["level", h, v, y][1]["real_time_factor"] for y in offsets])
        print(f"| {h:g} | {v:g} | {contact:.0f} | {under:.0f} | {contact + under:.0f} | {breaking:.0f} | "
              f"{submersion:.0f} "
              f"| {breaking + submersion:.0f} | {factor:.0f} |")
    thin, thick = (np.mean([mean_after(results["level", h, 1, y][0]["icebreaker"], 182) for y in offsets], axis=0)[0]
                   for h in (0.25, 1.5))
    print(f"\nCrushing and bending grow with h^{math.log(thick / thin) / math.log(1.5 / 0.25):.2f} at 1 m/s.")


def study_pack(arguments):
    covers, seeds = (0.3, 0.5, 0.7, 0.8, 0.9), range(1, 7)
    scenes = {("pack", c, s): pack(c, s) for c in covers for s in seeds}
    scenes |= {("pack-up", c, s): without_tilting(pack(c, s)) for c in covers for s in seeds}
    results = run_all(arguments, run, scenes)
    print("| C | contact | submersion | sum | without tilting | floes under | Colbourne slender | blunt | Zuev | "
          "unconverged |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for c in covers:
        each = np.array([mean_after(results["pack", c, s][0]["icebreaker"], 60) for s in seeds])
        up = np.array([sum(mean_after(results["pack-up", c, s][0]["icebreaker"], 60)) for s in seeds])
        under = np.mean([results["pack", c, s][1]["counts"]["tilted_under"] for s in seeds])
        steps = sum(results["pack", c, s][1]["steps"] for s in seeds)
        missed = sum(results["pack", c, s][1]["counts"]["unconverged_steps"] for s in seeds)
        error = lambda values: np.std(values) / math.sqrt(len(values))
        total = each.sum(axis=1)
        print(f"| {c:g} | {each[:, 0].mean():.0f} | {each[:, 1].mean():.0f} | {total.mean():.0f} ± {error(total):.0f} "
              f"| {up.mean():.0f} ± {error(up):.0f} | {under:.0f} | {colbourne(c, 0.5, 1, 4.4, -0.8267, 2) / 1e3:.0f} "
              f"| {colbourne(c, 0.5, 1, 16.1, -1.7937, 3) / 1e3:.0f} | {zuev(c, 0.5, 1) / 1e3:.0f} | "
              f"{missed / steps:.2%} |")


def study_shapes(arguments):
    covers, seeds, kinds = (0.5, 0.6, 0.7, 0.8, 0.9), range(1, 5), {"squares": squares, "irregular": pack}
    results = run_all(arguments, run, {(kind, c, s): make(c, s)
                                       for kind, make in kinds.items() for c in covers for s in seeds})
    print("| C | square: mean [kN] | spread | largest .1 s | irregular: mean | spread | largest .1 s | Colbourne "
          "slender | blunt |")
    print("|---|---|---|---|---|---|---|---|---|")
    for c in covers:
        cells = []
        for kind in kinds:
            forces = [results[kind, c, s][0]["icebreaker"] for s in seeds]
            sums = np.array([sum(mean_after(f, 60)) for f in forces])
            largest = np.median([f["contact"][f["t"] > 60].max() / 1e3 for f in forces])
            cells.append(f"{sums.mean():.0f} | {sums.std(ddof=1):.0f} | {largest:.0f}")
        print(f"| {c:g} | {' | '.join(cells)} | {colbourne(c, 0.5, 1, 4.4, -0.8267, 2) / 1e3:.0f} "
              f"| {colbourne(c, 0.5, 1, 16.1, -1.7937, 3) / 1e3:.0f} |")


def study_special(arguments):
    scenes = {("plug",): plug(arguments.plug), ("pinned",): pinned(), ("follower",): follower()}
    scenes |= {(key[0], "up"): without_tilting(scene) for key, scene in scenes.items() if key[0] != "follower"}
    results = run_all(arguments, run, scenes)
    print("| scene | contact, mean [kN] | largest .1 s [kN] | submersion, mean [kN] | bends | tilted under |")
    print("|---|---|---|---|---|---|")
    for key, (forces, summary) in results.items():
        for name, of_ship in forces.items():
            contact, under = mean_after(of_ship, 182 if key == ("follower",) else 0,
                                        332 if name == "icebreaker" else math.inf)
            print(f"| {' '.join(key)}, {name} | {contact:.0f} | {of_ship['contact'].max() / 1e3:.0f} | {under:.0f} "
                  f"| {summary['counts']['bends']} | {summary['counts']['tilted_under']} |")


def study_sensitivity(arguments):
    def tilting(key, value):
        return {"fracture": {"going_under": {key: value}}}
    variants = {("default",): {}}
    for key, value in (("added_mass_factor", 1), ("damping", 0.3), ("edge_deflection_over_thickness", 0.9)):
        variants |= {(key, factor): tilting(key, factor * value) for factor in (0.5, 2)}
    variants |= {("step", factor): {"time": {"step_s": 0.01 * factor, "until_s": 300}} for factor in (0.5, 2)}
    variants |= {("circle_radius", factor): {"contact": {"circle_radius_m": factor}} for factor in (0.5, 2)}
    covers, seeds = (0.7, 0.9), range(1, 7)
    results = run_all(arguments, run, {(*variant, c, s): pack(c, s, **settings)
                                       for variant, settings in variants.items()
                                  for c in covers for s in seeds})
    print("| variant | " + " | ".join(f"C {c:g}: sum [kN], floes under" for c in covers) + " |")
    print("|---|" + "---|" * len(covers))
    for variant in variants:
        cells = []
        for c in covers:
            sums = np.array([sum(mean_after(results[(*variant, c, s)][0]["icebreaker"], 60)) for s in seeds])
            under = np.mean([results[(*variant, c, s)][1]["counts"]["tilted_under"] for s in seeds])
            cells.append(f"{sums.mean():.0f} ± {np.std(sums) / math.sqrt(len(sums)):.0f}, {under:.0f}")
        print(f"| {' × '.join(str(part) for part in variant)} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("level", "pack", "shapes", "special", "sensitivity"))
    parser.add_argument("--polynya", default="polynya")
    parser.add_argument("--work", default="/tmp/under-hull-study")
    parser.add_argument("--plug", default="../shared/trials/unbreakable_plug.json", help="of the study special")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    {"level": study_level, "pack": study_pack, "shapes": study_shapes, "special": study_special,
     "sensitivity": study_sensitivity}[arguments.study](arguments)


if __name__ == "__main__":
    main()
