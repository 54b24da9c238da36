#!/usr/bin/env python3
"""A ship at full power into free square floes of 50 m to 3 km; the table and figure of docs/validation.md, "Crossover".

  tools/crossover.py [--figure FILE.svg] [--sides M…] [--thicknesses M…]

Splits (of the floe or what is left of it, and the strips among their pieces), floes broken as beams, bends, and the
mean speed while the stem is where the floe was. F_b is the force that opens the crack when the first cusp breaks, and
the greatest at any bend: L_s = (F_b/(0.187 h K))^2 is the side at which a square's F_max is just that. Options:
--polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. The figure needs matplotlib.
"""
import argparse
import json
import os

from study import HULL, rows_of, run_all, run_scene

SIDES = (50, 100, 200, 400, 800, 1500, 3000)
THICKNESSES = (0.5, 1.0, 1.5)
TOUGHNESS = 150e3  # the default [Pa sqrt(m)]
SPEED = 3  # at which the stem meets the floe [m/s]
LONGEST = 600  # [s]


def scene(side, h):
    ship = {"hull": HULL | {"draught_m": 6, "block_coefficient": 0.58}, "position_m": [-60.01, 0], "heading_deg": 0,
            "speed_m_per_s": SPEED, "steering": {"rudder": {}},
            "propulsion": {"engine": {"power_MW": 12, "propeller_diameter_m": 4, "propellers": 2,
                                      "open_water_speed_m_per_s": 8}},
            "pilot": {"hold_heading": {"heading_deg": 0, "lever": 1}}}
    return {"name": "crossover", "time": {"step_s": 0.01, "until_s": min(LONGEST, 20 + side / 1.5)},
            "ice": {"thickness_m": h, "fracture_toughness_Pa_sqrt_m": TOUGHNESS},
            "fracture": {"resurface": {"enabled": False}}, "ships": [ship],
            "floes": [{"rectangle": {"corner_m": [0, -side / 2], "size_m": [side, side]}}],
            "record": {"forces_interval_s": 0.1, "frames_interval_s": 60, "contacts": "none"}}


def areas_of(folder):
    with open(os.path.join(folder, "floes.ndjson"), encoding="utf-8") as file:
        return {floe["floe_id"]: floe["area_m2"] for floe in map(json.loads, file)}


def is_strip(split, areas):
    """Whether the narrower piece is longer along the crack than eight times its width."""
    length = split["criterion"]["crack_length_m"]
    pieces = [areas[child] for child in split["children"] if child in areas]
    return len(pieces) > 1 and length > 8 * min(pieces) / length


def way_at(rows, time):
    """Of the stem into the floe [m]."""
    return next(float(row["x_m"]) for row in rows if float(row["t_s"]) >= time) + 60


def measured(arguments, name, one):
    folder, summary = run_scene(arguments, name, one)
    side = one["floes"][0]["rectangle"]["size_m"][0]
    with open(os.path.join(folder, "events.ndjson"), encoding="utf-8") as file:
        events = [json.loads(line) for line in file]
    splits = [e for e in events if e["kind"] == "split"]
    bends = [e for e in events if e["kind"] == "bend"]
    beams = [e for e in splits if "section_stress_Pa" in e["criterion"]]
    cracks = [e for e in splits if e not in beams]
    areas = areas_of(folder)
    rows = rows_of(folder, "forces.csv")
    inside = [float(row["speed_m_per_s"]) for row in rows if 0 <= float(row["x_m"]) + 60 <= side]
    way = max(float(row["x_m"]) for row in rows) + 60
    opening = [e["criterion"].get("opening_force_N", 0) for e in bends]
    return {"splits": len(cracks), "beams": len(beams), "strips": sum(is_strip(e, areas) for e in cracks),
            "bends": len(bends), "speed": sum(inside) / len(inside), "way": min(way, side),
            "first": next((e["kind"] for e in events if e["kind"] in ("bend", "split")), "none"),
            "first_split": way_at(rows, cracks[0]["t_s"]) if cracks else None,
            "at_bend": opening[0] if opening else 0, "most": max(opening, default=0),
            "unresolved": summary["counts"]["unresolved_splits"]}


def crossover_side(h, force):
    return (force / (0.187 * h * TOUGHNESS)) ** 2


def print_tables(found):
    print("| h [m] | side [m] | first | first split after [m] | splits | strips | as beams | bends | way inside [m] | "
          "mean speed inside [m/s] | unresolved splits |\n|---|---|---|---|---|---|---|---|---|---|---|")
    for (h, side), row in found.items():
        after = "–" if row["first_split"] is None else f"{row['first_split']:.0f}"
        print(f"| {h:g} | {side} | {row['first']} | {after} | {row['splits']} | {row['strips']} | {row['beams']} | "
              f"{row['bends']} | {row['way']:.0f} | {row['speed']:.2f} | {row['unresolved']} |")
    print("\n| h [m] | F_b of the stem, at the first bend [kN] | its L_s [m] | of the bow, the greatest at a bend [kN] "
          "| "
          "its L_s [m] |\n|---|---|---|---|---|")
    for h in sorted({h for h, _ in found}):
        rows = [row for (of, _), row in found.items() if of == h]
        first = max((row["at_bend"] for row in rows), default=0)
        most = max((row["most"] for row in rows), default=0)
        print(f"| {h:g} | {first / 1e3:.0f} | {crossover_side(h, first):.0f} | {most / 1e3:.0f} | "
              f"{crossover_side(h, most):.0f} |")


def draw(path, found):
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams |= {"svg.hashsalt": "polynya", "svg.fonttype": "none"}
    import matplotlib.pyplot as plt
    figure, panels = plt.subplots(1, 3, figsize=(10, 3.6), layout="constrained")
    colours = ("#4c78a8", "#e45756", "#54a24b", "#b279a2")
    for colour, h in zip(colours, sorted({h for h, _ in found})):
        sides = [side for of, side in found if of == h]
        rows = [found[h, side] for side in sides]
        for panel, key in zip(panels, ("splits", "bends", "speed")):
            per = [row[key] for row in rows] if key == "speed" else [1e2 * row[key] / row["way"] for row in rows]
            panel.plot(sides, per, "o-", color=colour, ms=4, lw=1, label=f"h {h:g} m")
        panels[0].axvline(crossover_side(h, max(row["at_bend"] for row in rows)), color=colour, lw=0.8, ls="--")
    for panel, label in zip(panels, ("splits in 100 m of way", "bends in 100 m of way", "mean speed inside, m/s")):
        panel.set(xscale="log", xlabel="side of the floe, m", ylabel=label, ylim=(0, None))
        panel.set_xticks(SIDES, [str(side) for side in SIDES], rotation=45)
        panel.minorticks_off()
        panel.grid(alpha=0.3, lw=0.4)
    panels[0].legend(fontsize=7, title="dashed: L_s", title_fontsize=7)
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--figure")
    parser.add_argument("--sides", nargs="+", type=int, default=SIDES)
    parser.add_argument("--thicknesses", nargs="+", type=float, default=THICKNESSES)
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/crossover")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    scenes = {(h, side): scene(side, h) for h in arguments.thicknesses for side in arguments.sides}
    found = run_all(arguments, measured, scenes)
    print_tables(found)
    if arguments.figure:
        draw(arguments.figure, found)


if __name__ == "__main__":
    main()
