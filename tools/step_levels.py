"""Mean loads and processor time by the default step with its levels and with one fine step for all, side by side.

Usage: python3 tools/step_levels.py [BINARY] [--places N] [--only CASE] [--step S]
       BINARY by default build/release/app/polynya; --places: lateral places of the ship, 4 by default; --step: a tick
       in place of the default one

Each case is run at each place twice: as a scene that gives no step, and by one step for all, a quarter of the shortest
step of that run. The mean is that of the surge by contact of all ships from the time that the bow is in the ice; its
standard error is that over the places, which are independent as far as the ice is (of level ice, which is the same at
all places, over thicknesses within 3 % and edges that slant by 2 to 6 degrees: in even ice a bow breaks mirror images,
and those of one edge stay alike for some 40 m). A row whose means differ by more
than twice the standard error of their difference, and by more than 5 %, is marked. The time is the processor's in user
mode, start-up and all.
"""

import argparse
import math
import pathlib
import statistics
import tempfile

from study import measured_run, rows_of, slant_of, slanted_ice

ROOT = pathlib.Path(__file__).resolve().parent.parent
HULL = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30, "draught_m": 6}


def ship(x, y, speed, name="icebreaker"):
    return {"name": name, "hull": HULL, "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [x, y],
            "propulsion": {"constant_speed_m_per_s": speed}}


def level_ice(thickness, followers=0):
    """Level ice is the same at all places: its thickness and the slant of its edge differ instead."""
    def case(place):
        ships = [ship(-62 - 170 * i, 0, 1.5, f"ship {i}") for i in range(followers + 1)]
        return {"time": {"until_s": 80 + 115 * followers},
                "ice": {"thickness_m": thickness * (0.97 + 0.06 * (0.75488 * place % 1))},
                "fracture": {"splitting": {"model": "none"}, "cusp_fate": "under_hull"}, "ships": ships,
                "floes": [slanted_ice(slant_of(place), 400)]}
    return case


def pack(concentration):
    def case(place):
        return {"time": {"until_s": 150}, "ships": [ship(-62, place, 2)], "floes": [
            {"field": {"corner_m": [0, -200], "extent_m": [400, 400], "floe_size_m": 15, "size_spread": 0.25,
                       "concentration": concentration}}]}
    return case


def walls(place):
    sides = [{"name": "south", "from_m": [-100, -80.1], "to_m": [400, -80.1], "pressure": {"line_load_N_per_m": 1e4}},
             {"name": "north", "from_m": [400, 80.1], "to_m": [-100, 80.1], "pressure": {"line_load_N_per_m": 1e4}}]
    return {"time": {"until_s": 60}, "ice": {"thickness_m": 0.6}, "ships": [ship(-62, place, 1.5)],
            "walls": sides, "floes": [{"field": {"corner_m": [0, -80], "extent_m": [300, 160], "floe_size_m": 18,
                                                 "concentration": 0.8}}]}


def plug(place):
    """The trials' unbreakable_plug.json, moved to the side."""
    hull = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 25}
    return {"seed": 7, "time": {"until_s": 120}, "ice": {"thickness_m": 1}, "ships": [
        {"hull": hull, "mass_kg": 1.5e7, "moment_of_inertia_kg_m2": 1.2e10, "position_m": [-65, 150 + place],
         "propulsion": {"constant_speed_m_per_s": 3}}],
        "floes": [{"field": {"corner_m": [0, 0], "extent_m": [600, 300], "floe_size_m": 25, "concentration": 0.8}}]}


CASES = {**{f"level ice {h} m": level_ice(h) for h in (0.25, 0.5, 1, 1.5)}, "follower, 0.5 m": level_ice(0.5, 1),
         **{f"pack {c}": pack(c) for c in (0.3, 0.6, 0.9)}, "pressing walls": walls, "plug": plug}


def measure(binary, folder, scene, time):
    """The mean surge [N], the processor's time [s], and the longest and the shortest step [s]."""
    scene = {"name": "step-levels", **scene, "time": {**scene["time"], **time}, "record": {"frames_interval_s": 10}}
    run, summary, cost = measured_run(binary, folder, scene, "--no-map")
    rows = rows_of(run, "forces.csv")
    steps = [level["step_s"] for level in summary["levels"]]
    surge = statistics.fmean(-float(row["surge_N"]) for row in rows if float(row["t_s"]) > 15)
    return surge, cost, min(steps), summary["step_s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", default=str(ROOT / "build/release/app/polynya"))
    parser.add_argument("--places", type=int, default=4)
    parser.add_argument("--only")
    parser.add_argument("--step", type=float)
    given = parser.parse_args()
    print("| case | tick, s | by levels, kN | fine step, s | one fine step for all, kN | differs, % | differs, s.e. "
          "| time by levels, s | fine, s |\n|---|---|---|---|---|---|---|---|---|")
    for name, case in CASES.items():
        if given.only and given.only not in name:
            continue
        found, beside = [], []
        for i in range(given.places):
            place = 3.1 * (i - (given.places - 1) / 2)
            with tempfile.TemporaryDirectory() as folder:
                found.append(measure(given.binary, folder, case(place), {"step_s": given.step} if given.step else {}))
            fine = found[0][2] / 4
            with tempfile.TemporaryDirectory() as folder:
                beside.append(measure(given.binary, folder, case(place), {"levels": 0, "step_s": fine}))
        means, errors, costs = [], [], []
        for rows in (found, beside):
            means.append(statistics.fmean(row[0] for row in rows))
            errors.append(statistics.stdev(row[0] for row in rows) / math.sqrt(given.places))
            costs.append(sum(row[1] for row in rows))
        differs = (means[0] - means[1]) / math.hypot(*errors)
        share = means[0] / means[1] - 1
        mark = "**" if abs(differs) > 2 and abs(share) > 0.05 else ""
        print(f"| {name} | {found[0][3]:g} | {means[0] / 1e3:.1f} ± {errors[0] / 1e3:.1f} | {fine:g} "
              f"| {means[1] / 1e3:.1f} ± {errors[1] / 1e3:.1f} | {100 * share:+.1f} | {mark}{differs:+.1f}{mark} "
              f"| {costs[0]:.1f} | {costs[1]:.1f} |", flush=True)


main()
