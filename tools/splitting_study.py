#!/usr/bin/env python3
"""Which comes first at a ship's stem, bending or splitting; the table and figure of docs/validation.md, "Splitting".

  tools/splitting_study.py crossover [--figure FILE.svg]   square floes of rising side, K_IC 115 and 250 kPa√m

Options: --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. The figure needs matplotlib.
"""
import argparse
import json
import os

from study import FEW_RECORDS, SHIP, run_all, run_scene

THICKNESSES = (0.3, 0.5, 0.8)
TOUGHNESSES = (115e3, 250e3)
# From the least floe that breaks (κ l = 6.1, 8.9, 12.7 m) to a few times L_s.
RATIO, MOST = 1.12, 400


def square(side, h, toughness):
    """The reference ship sails at 1 m/s with its stem at the middle of a floe's side. The floe is free."""
    return {"name": "square", "time": {"step_s": 0.002, "until_s": 6},
            "ice": {"thickness_m": h, "fracture_toughness_Pa_sqrt_m": toughness},
            "ships": [SHIP | {"position_m": [-60.01, 0], "speed_m_per_s": 1,
                              "propulsion": {"constant_speed_m_per_s": 1}}],
            "floes": [{"rectangle": {"corner_m": [0, -side / 2], "size_m": [side, side]}}]} | FEW_RECORDS


def first_fracture(arguments, name, scene):
    folder, _ = run_scene(arguments, name, scene)
    with open(os.path.join(folder, "events.ndjson"), encoding="utf-8") as file:
        return next((e for e in map(json.loads, file) if e["kind"] in ("bend", "split")), None)


def crossover_of(events):
    """The sides between which bending takes over, and the opening force at the first bend beyond [m, N]."""
    sides = sorted(side for side, e in events.items() if e)
    split = max((s for s in sides if events[s]["kind"] == "split"), default=None)
    bend = min((s for s in sides if events[s]["kind"] == "bend" and (split is None or s > split)), default=None)
    return split, bend, events[bend]["criterion"]["opening_force_N"] if bend else None


def study_crossover(arguments):
    sides = [6.2]
    while sides[-1] * RATIO < MOST:
        sides.append(sides[-1] * RATIO)
    scenes = {(h, int(k / 1e3), round(side, 2)): square(round(side, 2), h, k)
              for h in THICKNESSES for k in TOUGHNESSES for side in sides if side > 0.01 + 8.909 * (h / 0.5) ** 0.75}
    found = run_all(arguments, first_fracture, scenes)
    curves = {}
    for (h, k, side), event in found.items():
        curves.setdefault((h, k), {})[side] = event
    print("| h, m | K_IC, kPa√m | opening force at bending F_b, kN | L_s = (F_b / 0.187 h K)², m | largest floe that "
          "splits, "
          "smallest that bends first, m | splits at F / F_max |\n|---|---|---|---|---|---|")
    for (h, k), events in curves.items():
        split, bend, force = crossover_of(events)
        over = [e["criterion"]["load_N"] / e["criterion"]["capacity_N"] for e in events.values()
                if e and e["kind"] == "split"]
        expected = (force / (0.187 * h * k * 1e3)) ** 2 if force else float("nan")
        print(f"| {h} | {k} | {force / 1e3:.1f} | {expected:.1f} | {split or '–'}, {bend or '–'} | "
              + (f"{min(over):.3f}–{max(over):.3f} |" if over else "– |"))
    if arguments.figure:
        draw(arguments.figure, curves)


def draw(path, curves):
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams |= {"svg.hashsalt": "polynya", "svg.fonttype": "none"}
    import matplotlib.pyplot as plt
    figure, panels = plt.subplots(1, len(TOUGHNESSES), figsize=(9, 3.8), sharey=True, layout="constrained")
    colours = dict(zip(THICKNESSES, ("#4c78a8", "#e45756", "#54a24b")))
    for panel, k in zip(panels, TOUGHNESSES):
        for h in THICKNESSES:
            events = {s: e for s, e in sorted(curves[h, int(k / 1e3)].items()) if e}
            panel.plot(list(events), [0.187 * h * k * s**0.5 / 1e3 for s in events], "-", color=colours[h], lw=1,
                       label="F$_{max}$ = 0.187 h K √side" if h == THICKNESSES[0] else None)
            for kind, marker, filled in (("split", "o", True), ("bend", "s", False)):
                points = [(s, e["criterion"]["opening_force_N"] / 1e3) for s, e in events.items() if e["kind"] == kind]
                panel.plot(*zip(*points) if points else ((), ()), marker, ms=4, color=colours[h],
                           mfc=colours[h] if filled else "none", label=f"h {h} m, {kind} first")
        panel.set(xscale="log", yscale="log", xlabel="side of the floe, m", title=f"K$_{{IC}}$ {k / 1e3:g} kPa√m")
        panel.set_xticks([10, 20, 50, 100, 200, 400], ["10", "20", "50", "100", "200", "400"])
        panel.set_yticks([20, 50, 100, 200, 500], ["20", "50", "100", "200", "500"])
        panel.grid(alpha=0.3, which="both", lw=0.4)
    panels[0].set_ylabel("force that opens the crack at the first fracture, kN")
    panels[0].legend(fontsize=7)
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=["crossover"])
    parser.add_argument("--figure")
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/splitting-study")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    study_crossover(arguments)


if __name__ == "__main__":
    main()
