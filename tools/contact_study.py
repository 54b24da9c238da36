#!/usr/bin/env python3
"""How much the contact law's results depend on what should not matter; the tables of docs/validation.md.

  tools/contact_study.py step    [--figure FILE.svg]   the step: level ice at three speeds and four offsets
  tools/contact_study.py squeeze                       substeps, tolerance, sweeps: ice squeezed along the midbody
  tools/contact_study.py jams    [--seeds N] [--covers C ...]
                                                       confined pack ice at 80 and 90 %: convergence, by both laws

Options of all: --polynya PROGRAM, --work FOLDER (run folders; they are overwritten), --jobs N. Needs numpy; the figure
needs matplotlib.
"""
import argparse
import os

import numpy as np

from study import FEW_RECORDS, SHIP, rows_of, run_all, run_scene

def ship(x, y, speed):
    return SHIP | {"position_m": [x, y], "propulsion": {"constant_speed_m_per_s": speed}}


def level_ice(speed, offset, step, substeps=1):
    """120 m of half a metre of level ice, after 20 m in which the bow breaks its way in."""
    return {"name": "level-ice", "time": {"step_s": step, "until_s": 142 / speed},
            "contact": {"law": "crush", "substeps": substeps}, "fracture": {"splitting": {"model": "none"}},
            "ships": [ship(-62, offset, speed)],
            "floes": [{"rectangle": {"corner_m": [0, -100], "size_m": [400, 200]}}]}


def squeeze(substeps, tolerance, sweeps, start):
    """1.5 m of level ice, in which tips of ice press on both sides of the parallel midbody."""
    return {"name": "squeeze", "time": {"step_s": 0.005, "until_s": 1680}, "ice": {"thickness_m": 1.5},
            "contact": {"law": "crush", "substeps": substeps, "tolerance_m_per_s": tolerance, "iterations": sweeps,
                        "start": start},
            "fracture": {"splitting": {"model": "none"}},
            "ships": [ship(-62, 0, 0.25)],
            "floes": [{"rectangle": {"corner_m": [0, -2000], "size_m": [4000, 4000]}}]}


def confined(cover, seed, law, sweeps=100, tolerance=1e-4):
    """Pack ice of 15 m floes in a basin of 300 × 120 m with walls all around but where the ship enters."""
    wall = lambda x0, y0, x1, y1: {"waterline_m": [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]}
    return {"name": "confined", "seed": seed, "time": {"step_s": 0.01, "until_s": 100},
            "contact": {"law": law, "iterations": sweeps, "tolerance_m_per_s": tolerance},
            "fracture": {"splitting": {"model": "michel"}},  # both laws break floes by one rule
            "ships": [ship(-62, 0, 1)],
            "structures": [wall(0, 60, 310, 70), wall(0, -70, 310, -60), wall(300, -60, 310, 60)],
            "floes": [{"field": {"corner_m": [0, -60], "extent_m": [300, 120], "floe_size_m": 15,
                                 "concentration": cover, "gap_m": 0.01}}]}


def run(arguments, name, scene):
    """Runs a scene; the surge of the ship by record [N], its time [s] and the summary."""
    folder, summary = run_scene(arguments, name, scene | FEW_RECORDS)
    rows = [row for row in rows_of(folder, "forces.csv") if row["ship"] == "icebreaker"]
    return (np.array([float(row["t_s"]) for row in rows]), -np.array([float(row["surge_N"]) for row in rows]),
            max(-float(row["surge_max_N"]) for row in rows), summary)


def study_step(arguments):
    speeds, offsets = (0.5, 1, 2), (0, 0.3, 0.7, 1.1)
    steps = (0.00125, 0.0025, 0.005, 0.01, 0.02)
    results = run_all(arguments, run, {("step", v, y, dt): level_ice(v, y, dt)
                                  for v in speeds for y in offsets for dt in steps})
    means = {}
    print("| v [m/s] | " + " | ".join(f"Δt {dt:g} s" for dt in steps) + " |")
    print("|---|" + "---|" * len(steps))
    for v in speeds:
        for dt in steps:
            each = [surge[t > 22 / v].mean() for t, surge, *_ in (results["step", v, y, dt] for y in offsets)]
            means[v, dt] = np.mean(each), np.std(each) / np.sqrt(len(each))
        print(f"| {v:g} | " + " | ".join("{:.1f} ± {:.1f}".format(*np.array(means[v, dt]) / 1e3) for dt in steps)
              + " |")
    if arguments.figure:
        draw_steps(arguments.figure, speeds, steps, means)


def draw_steps(path, speeds, steps, means):
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "polynya"
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6))
    for v in speeds:
        mean, error = np.array([means[v, dt] for dt in steps]).T / 1e3
        axes.errorbar(np.array(steps) * 1e3, mean, error, marker="o", capsize=3, label=f"{v:g} m/s")
    axes.set(xlabel="time step [ms]", ylabel="mean surge [kN]", xscale="log",
             ylim=(0, 1.25 * max(mean for mean, _ in means.values()) / 1e3))
    axes.set_xticks(np.array(steps) * 1e3, [f"{1e3 * dt:g}" for dt in steps])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(title="ship's speed", ncols=len(speeds), loc="upper center")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def study_squeeze(arguments):
    cases = [(1, 1e-4, 100, "last-step"), (4, 1e-4, 100, "last-step"), (8, 1e-4, 100, "last-step"),
             (1, 1e-6, 100, "last-step"), (1, 1e-4, 400, "last-step"), (1, 1e-4, 100, "zero")]
    results = run_all(arguments, run, {("squeeze", *case): squeeze(*case) for case in cases})
    print("| substeps | tolerance [m/s] | sweeps | start | mean [kN] | largest 0.1 s mean [MN] | unconverged steps |\n"
          "|---|---|---|---|---|---|---|")
    for case in cases:
        t, surge, _, summary = results["squeeze", *case]
        print(f"| {case[0]} | {case[1]:g} | {case[2]} | {case[3]} | {surge.mean() / 1e3:.2f} | {surge.max() / 1e6:.3f} "
              f"| "
              f"{summary['counts']['unconverged_steps']} |")


def study_jams(arguments):
    cases = [(cover, law, sweeps) for cover in arguments.covers for law, sweeps in (("crush", 100), ("impulse", 300))]
    scenes = {("jam", *case, seed): confined(case[0], seed, case[1], case[2])
              for case in cases for seed in range(1, arguments.seeds + 1)}
    results = run_all(arguments, run, scenes)
    print("| cover | law | mean [kN] | median seed | largest seed | largest single step [MN] | converged steps, worst "
          "seed "
          "| energy created, worst seed [J] |\n|---|---|---|---|---|---|---|---|")
    for case in cases:
        of_case = [results["jam", *case, seed] for seed in range(1, arguments.seeds + 1)]
        means = np.array([surge[t > 30].mean() for t, surge, *_ in of_case]) / 1e3
        converged = min(1 - r[3]["counts"]["unconverged_steps"] / r[3]["steps"] for r in of_case)
        created = max(r[3]["counts"]["energy_created_J"] for r in of_case)
        print(f"| {case[0]} | {case[1]} | {means.mean():.0f} ± {means.std(ddof=1) / np.sqrt(len(means)):.0f} | "
              f"{np.median(means):.0f} | {means.max():.0f} | {max(r[2] for r in of_case) / 1e6:.2f} | "
              f"{100 * converged:.2f} % | {created:.2g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("step", "squeeze", "jams"))
    parser.add_argument("--polynya", default="build/release/app/polynya")
    parser.add_argument("--work", default="/tmp/contact-study")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--covers", type=float, nargs="+", default=[0.8, 0.9])
    parser.add_argument("--figure")
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    {"step": study_step, "squeeze": study_squeeze, "jams": study_jams}[arguments.study](arguments)


if __name__ == "__main__":
    main()
