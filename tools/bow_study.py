#!/usr/bin/env python3
"""What breaking level ice takes at the bow, part by part; the tables of docs/theory/bow.md.

  tools/bow_study.py parts      by speed and thickness
  tools/bow_study.py places     loads along the waterline, h .5, 1 and 1.5 m at 1 m/s
  tools/bow_study.py models     by bending model
  tools/bow_study.py switches   without the radial cracks, without the deflection, without both

Options of all: --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. Needs numpy.
Each row is the mean of four runs at 0.97 to 1.03 of its speed: breaking settles into patterns of cusps that repeat, and
these differ a little with the speed (not with where in a straight edge the ship enters).
"""
import argparse
import concurrent.futures
import json
import math
import os

import numpy as np

from study import BEAM, ENTRANCE, FLEXURAL, G, LENGTH, POISSON, RHO_W, SHIP, YOUNG, rows_of, run_scene
from study import lindqvist as lindqvist_by_part

BOW = BEAM / 2 / math.tan(ENTRANCE)
SHARES = (0.97, 0.99, 1.01, 1.03)
START, GAP, WAY_IN, WAY = -62, 2, 30, 120  # [m]: the ship, then water, ice before and while it is measured
FRAME = 0.025  # [m] of way


def scene(h, v, bending):
    """Level ice that does not split, and has too much mass to be pushed along."""
    return {"name": "level-ice", "time": {"step_s": 0.005 / max(1, v), "until_s": (GAP + WAY_IN + WAY) / v},
            "ice": {"thickness_m": h}, "fracture": {"bending": bending, "splitting": {"model": "none"}},
            "record": {"forces_interval_s": 0.1 / v, "frames_interval_s": FRAME / v},
            "ships": [SHIP | {"position_m": [START, 0], "propulsion": {"constant_speed_m_per_s": v}}],
            "floes": [{"rectangle": {"corner_m": [0, -4000], "size_m": [8000, 8000]}}]}


def by_place(folder, v, start):
    """Mean resistance [N], mean number of loaded contacts and share of the time with one, by place on the hull."""
    force, contacts, frames = {}, {}, {}
    for row in (row for row in rows_of(folder, "contacts.csv") if not row["ended_by"]):
        t, f = float(row["t_s"]), -float(row["fx_N"])
        if t <= start or f == 0:
            continue
        x = float(row["x_m"]) - (START + v * t)
        place = "stem" if abs(float(row["y_m"])) < 0.5 else "flank" if x > LENGTH / 2 - BOW - 0.1 else "side"
        force[place] = force.get(place, 0) + f
        contacts[place] = contacts.get(place, 0) + 1
        frames.setdefault(place, set()).add(t)
    count = WAY / FRAME
    return {p: (force.get(p, 0) / count, contacts.get(p, 0) / count, len(frames.get(p, ())) / count)
            for p in ("stem", "flank", "side")}


def run(arguments, name, one):
    path, _ = run_scene(arguments, name, one)
    v, scale = one["ships"][0]["propulsion"]["constant_speed_m_per_s"], FLEXURAL * one["ice"]["thickness_m"] ** 2
    start = (GAP + WAY_IN) / v
    surge = [-float(row["surge_N"]) for row in rows_of(path, "forces.csv") if float(row["t_s"]) > start]
    with open(os.path.join(path, "events.ndjson"), encoding="utf-8") as file:
        bends = [e for e in map(json.loads, file) if e["kind"] == "bend" and e["t_s"] > start]
    places = by_place(path, v, start)
    stem, flank = [e for e in bends if e["normal"][0] > 0.9], [e for e in bends if e["normal"][0] <= 0.9]
    median = lambda events, value: float(np.median([value(e) for e in events])) if events else float("nan")
    capacity = lambda e: e["criterion"]["bending_capacity_N"] / scale
    return {"mean": np.mean(surge), "force": [places[p][0] for p in places],
            "bends": len(bends) / WAY, "stem_bends": len(stem) / WAY,
            "radius": median(flank, lambda e: e["cusp_radius_m"]),
            "stem_radius": median(stem, lambda e: e["cusp_radius_m"]),
            "area": np.mean([e["submerged_area_m2"] for e in bends]),
            "penetration": median(flank, lambda e: e["penetration_m"]),
            "stem_penetration": median(stem, lambda e: e["penetration_m"]),
            "capacity": median(flank, capacity), "stem_capacity": median(stem, capacity),
            "angles": np.percentile([math.degrees(2 * e["submerged_area_m2"] / e["cusp_radius_m"] ** 2)
                                     for e in flank or bends],
                                    [10, 50, 90]),
            "on_flanks": places["flank"][1], "stem_time": places["stem"][2]}


# Parts of the waterline by the distance behind the stem [m].
PLACES = (("stem, 0-1 m", -1, 1), ("flank, 1-6 m", 1, 6), ("flank, 6-12 m", 6, 12), ("flank, 12-18 m", 12, 18),
          ("flank, 18-22 m", 18, 22), ("shoulder, 22-24 m", 22, BOW + 0.5), ("sides", BOW + 0.5, LENGTH))


def loads_by_place(arguments, name, one):
    """Of each of PLACES the mean surge [N], and of its contacts' summed force [N] the 99 % quantile over the times with
    one, and the largest."""
    folder, _ = run_scene(arguments, name, one)
    v = one["ships"][0]["propulsion"]["constant_speed_m_per_s"]
    # Rows of frames: where a contact ends between two, it has one more.
    rows = [row for row in rows_of(folder, "contacts.csv")
            if not row["ended_by"] and float(row["t_s"]) > (GAP + WAY_IN) / v]
    t, x, y, fx, fy = (np.array([float(row[key]) for row in rows]) for key in ("t_s", "x_m", "y_m", "fx_N", "fy_N"))
    behind, found = START + v * t + LENGTH / 2 - x, []
    frames, frame = np.unique(t, return_inverse=True)
    for _, first, last in PLACES:
        is_there = (behind >= first) & (behind < last)
        sums = np.bincount(2 * frame[is_there] + (y[is_there] > 0), np.hypot(fx, fy)[is_there], 2 * len(frames))
        loaded = sums[sums > 0]
        found.append((-fx[is_there].sum() * FRAME / WAY,
                      *((np.quantile(loaded, 0.99), loaded.max()) if len(loaded) else (0, 0))))
    return np.array(found)


def places(arguments):
    print("| place on the waterline | " + " | ".join(f"h {h:g} m: mean [kN], by metre [kN/m], 99 %, largest [kN]"
                                                     for h in (0.5, 1, 1.5)) + " |")
    print("|---|---|---|---|")
    columns = []
    for h in (0.5, 1, 1.5):
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            each = pool.map(lambda share, h=h: loads_by_place(arguments, f"places-{h:g}-{share}", scene(h, share, {})),
                            SHARES)
            columns.append(1e-3 * np.mean(list(each), axis=0))
    for k, (name, first, last) in enumerate(PLACES):
        length = 2 * (last - max(0, first)) / (math.cos(ENTRANCE) if first < 22 else 1)
        print(f"| {name} | " + " | ".join(f"{of[k][0]:.1f}, {of[k][0] / length:.2f}, {of[k][1]:.0f}, {of[k][2]:.0f}"
                                          for of in columns) + " |")
    print("| sum | " + " | ".join(f"{of[:, 0].sum():.0f}" for of in columns) + " |")


def run_all(arguments, cases):
    """Of each case (h, v, bending settings) the mean over its speeds, and the standard error of the mean surge."""
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        futures = [[pool.submit(run, arguments, f"{number}-{share}", scene(h, v * share, bending)) for share in SHARES]
                   for number, (h, v, bending) in enumerate(cases)]
    results = []
    for of_case in futures:
        each = [future.result() for future in of_case]
        results.append({key: np.nanmean([r[key] for r in each], axis=0) for key in each[0]})
        results[-1]["error"] = np.std([r["mean"] for r in each], ddof=1) / math.sqrt(len(each))
    return results


def characteristic_length(h):
    return (YOUNG * h ** 3 / (12 * (1 - POISSON ** 2) * RHO_W * G)) ** 0.25


def lindqvist(h, v):
    """R_c and R_b with the speed's factor [N]."""
    return lindqvist_by_part(h, v)[:2]


def name_of(bending):
    return ", ".join(bending.values()) or "default"


def print_rows(cases, results):
    print("| bending | h [m] | v [m/s] | resistance [kN] | stem, flanks, sides [kN] | Lindqvist R_c, R_b [kN] | bends "
          "a metre (stem) | kJ a bend "
          "| cusp [m²] | R/l (stem) | ξ_b/h (stem) | V_b/σ_f h² (stem) | 2A/R² [°] 10, 50, 90 % | contacts on the "
          "flanks | stem in contact |")
    print("|" + "---|" * 15)
    for (h, v, bending), r in zip(cases, results):
        l = characteristic_length(h)
        print(f"| {name_of(bending)} | {h:g} | {v:g} | {r['mean'] / 1e3:.1f} ± {r['error'] / 1e3:.1f} | "
              + ", ".join(f"{f / 1e3:.1f}" for f in r["force"]) + " | "
              + ", ".join(f"{f / 1e3:.0f}" for f in lindqvist(h, v))
              + f" | {r['bends']:.2f} ({r['stem_bends']:.2f}) | {r['mean'] / r['bends'] / 1e3:.1f} | {r['area']:.1f} | "
              f"{r['radius'] / l:.2f} ({r['stem_radius'] / l:.2f}) | {r['penetration'] / h:.2f} "
              f"({r['stem_penetration'] / h:.2f}) | "
              f"{r['capacity']:.2f} ({r['stem_capacity']:.2f}) | " + ", ".join(f"{a:.0f}" for a in r["angles"])
              + f" | {r['on_flanks']:.2f} | {100 * r['stem_time']:.0f} % |")


def exponents(cases, results):
    """Of the resistance against the thickness at 1 m/s, by least squares, and of Lindqvist's part."""
    points = [(h, r["mean"], sum(lindqvist(h, v))) for (h, v, _), r in zip(cases, results) if v == 1]
    h, ours, theirs = np.log(np.array(points)).T
    print(f"\nexponent of h at 1 m/s: {np.polyfit(h, ours, 1)[0]:.2f}, Lindqvist's R_c + R_b "
          f"{np.polyfit(h, theirs, 1)[0]:.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("parts", "places", "models", "switches"))
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/bow-study")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    if arguments.study == "places":
        return places(arguments)
    thicknesses = (0.25, 0.5, 1, 1.5)
    plan = [(0.5, v) for v in (0.25, 0.5, 1, 2, 3)] + [(h, 1) for h in thicknesses if h != 0.5]
    if arguments.study == "parts":
        cases = [(h, v, {}) for h, v in plan]
    elif arguments.study == "models":
        cases = [(h, 1, {"model": model}) for model in ("fsi-database", "nevel", "kashtelyan") for h in thicknesses]
    else:
        without = ({"radial_cracks": "ignored"}, {"deflection": "ignored"},
                   {"radial_cracks": "ignored", "deflection": "ignored"})
        cases = [(h, v, {"model": "fsi-database"} | keys) for keys in without for h, v in plan]
    results = run_all(arguments, cases)
    print_rows(cases, results)
    if arguments.study == "parts":
        exponents(cases, results)
    return None


if __name__ == "__main__":
    main()
