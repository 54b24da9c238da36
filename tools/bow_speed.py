#!/usr/bin/env python3
"""What could grow with speed at the bow: the size of each candidate from the cusps of runs; the table of
docs/theory/bow.md, "What grows with speed".

  tools/bow_speed.py   the reference ship at 1-6 m/s in .5 and 1 m; --polynya PROGRAM, --work FOLDER, --jobs N

A cusp of area A and depth R turns about its far edge, the near one is pressed down at w = v tan(stem). By the way:
  ice       its kinetic energy, ρ_i h A w²/6
  water     that of the water below, half of a plate's that turns about its edge in water without bounds,
            (9π/512) ρ_w R A w² (1 + (R/b)²)^-½, b = A/R
  drag      of its turning by ψ, C_D ρ_w w² R A ψ/8, C_D 1.1: an upper bound, the water's own energy is in it
  dry deck  no water above it until it lies along the hull: ρ_w g A R² (1 − cos ψ)/6 an area R², a bound
  slots     the same, where water falls over its two sides once the deck is below the neighbours' bottom (.9 h)
The hull works against friction too: all times η/η₀, the thrust with friction over that without. Needs numpy.
"""
import argparse
import json
import math
import os

import numpy as np

from bow_study import GAP, WAY, WAY_IN, scene
from study import ENTRANCE, G, RHO_I, RHO_W, STEM, rows_of, run_all, run_scene

FRICTION, DRAG, WEIR = 0.2, 1.1, 0.6
SPEEDS, THICKNESSES = (1, 2, 3, 4, 6), (0.5, 1)
NORMAL = math.sin(ENTRANCE)
TILT = math.atan(math.tan(STEM) / NORMAL)  # of the flank from the horizontal, ψ
MORE = (math.sin(TILT) + FRICTION * math.cos(TILT)) / (math.cos(TILT) - FRICTION * math.sin(TILT)) / math.tan(TILT)


def dry_share(h, depth, width, speed):
    """The part of the dry deck's work that is left where water falls over a cusp's sides."""
    steps = 400
    angle = np.linspace(0, TILT, steps + 1)[1:]
    time, volume, dry, wet = depth / speed * TILT / steps, 0.0, 0.0, 0.0
    for psi in angle:
        edge = depth * math.sin(psi)
        room = 0.5 * width * depth * edge
        if edge > 0.9 * h:
            head = edge - 0.9 * h  # of the deepest end; the sides are open where the deck is below the neighbours
            volume += time * 2 * WEIR * 2 / 3 * math.sqrt(2 * G) * head**1.5 * depth * (head / edge) / 2.5
        volume = min(volume, room)
        dry += edge
        wet += edge * (1 - volume / room)
    return wet / dry


def run(arguments, name, one):
    """Of the measured way: the contacts' mean surge, and each candidate [N]."""
    folder, _ = run_scene(arguments, name, one)
    h, v = one["ice"]["thickness_m"], one["ships"][0]["propulsion"]["constant_speed_m_per_s"]
    start = (GAP + WAY_IN) / v
    surge = np.mean([-float(row["surge_N"]) for row in rows_of(folder, "forces.csv") if float(row["t_s"]) > start])
    with open(os.path.join(folder, "events.ndjson"), encoding="utf-8") as file:
        bends = [e for e in map(json.loads, file) if e["kind"] == "bend" and e["t_s"] > start]
    w, sums = v * math.tan(STEM), np.zeros(5)
    for e in bends:
        area, depth = e["submerged_area_m2"], e["cusp_radius_m"]
        width = max(area / depth, 0.1 * depth)
        deck = RHO_W * G * area * depth**2 * (1 - math.cos(TILT)) / 6
        sums += (RHO_I * h * area * w**2 / 6,
                 9 * math.pi / 512 * RHO_W * depth * area * w**2 / math.hypot(1, depth / width),
                 DRAG * RHO_W * w**2 * depth * area * TILT / 8, deck, deck * dry_share(h, depth, width, w))
    return np.array([surge, *(MORE * sums / WAY)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/bow-speed")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    scenes = {}
    for h in THICKNESSES:
        for v in SPEEDS:
            scenes[f"{h:g}", f"{v:g}"] = scene(h, v, {}) | {"record": {"forces_interval_s": 0.1 / v,
                                                                       "frames_interval_s": 60, "contacts": "none"}}
    results = run_all(arguments, run, scenes)
    print("| h [m] | v [m/s] | crushing and bending of the run | ice | water | drag | dry deck | slots |\n|"
          + "---|" * 8)
    for (h, v), found in results.items():
        print(f"| {h} | {v} | " + " | ".join(f"{1e-3 * value:.1f}" if value < 1e4
                                             else f"{1e-3 * value:.0f}" for value in found) + " |")


if __name__ == "__main__":
    main()
