#!/usr/bin/python3
"""Optuna searches the lever with which a ship goes through pack ice at the least cost of energy and time.

    python3 examples/study_by_optuna.py      (--out FOLDER; --short: few trials; needs python3-optuna)

Shows an optimiser that drives studies: in each round Optuna is asked for four trials, which become the rows of a CSV
file; `polynya study evaluate` runs them in three fields of floes each and writes their measures as CSV, and Optuna is
told the costs. Draws study-by-optuna.png.
"""
import argparse
import csv
import json
import pathlib
import subprocess

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib", "optuna")

import optuna
from matplotlib.figure import Figure

from polynya.program import program

SCENE = {
    "time": {"step_s": 0.02, "until_s": 90}, "record": {"forces_interval_s": 0.5}, "ice": {"thickness_m": 0.6},
    "ships": [{"name": "ship", "hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30, "draught_m": 5,
                                        "block_coefficient": 0.6},
               "position_m": [-31, 0], "speed_m_per_s": 3,
               "propulsion": {"engine": {"power_MW": 6, "propeller_diameter_m": 3.2, "open_water_speed_m_per_s": 7}},
               "pilot": {"constant": {"lever": 0.5}}}],
    "floes": [{"field": {"corner_m": [0, -60], "extent_m": [500, 120], "floe_size_m": 20, "size_spread": 0.3,
                         "concentration": 0.6}}],
}
LEVER = "ships[0].pilot.constant.lever"
AT_A_TIME, HOUR_J = 4, 9e9  # trials a round; energy that an hour of the voyage is worth [J]


def cost(row):
    """Energy of the engine and of the time, by the way made good [MJ/km]."""
    speed = float(row["mean_speed_m_per_s"])
    return 1e-6 * (float(row["delivered_per_km_J"]) + HOUR_J * 1000 / max(speed, 0.05) / 3600)


def evaluate(levers, fields, folder):
    """The mean cost of each lever over the fields."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "pack.json").write_text(json.dumps(SCENE))
    (folder / "study.json").write_text(json.dumps({"scene": "pack.json", "keep": "summary"}))
    with open(folder / "design.csv", "w", newline="") as file:
        csv.writer(file).writerows([[LEVER, "seed"], *([f"{lever:.6g}", seed] for lever in levers
                                                       for seed in range(1, fields + 1))])
    subprocess.run([program(), "study", "evaluate", folder / "study.json", folder / "design.csv",
                    folder / "measures.csv", "--folder", folder / "cases", "--quiet"], check=True)
    with open(folder / "measures.csv", newline="") as file:
        costs = [cost(row) for row in csv.DictReader(file)]
    return [sum(costs[i:i + fields]) / fields for i in range(0, len(costs), fields)]


def draw(study, path):
    figure = Figure(figsize=(6.7, 3.0), layout="constrained")
    axes = figure.subplots()
    trials = study.trials
    points = axes.scatter([t.params["lever"] for t in trials], [t.value for t in trials], c=[t.number for t in trials])
    figure.colorbar(points, label="trial")
    axes.set(xlabel="lever", ylabel="cost [MJ/km]")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="one round, one field")
    options = parser.parse_args()
    rounds, fields = (1, 1) if options.short else (4, 3)
    folder = options.out / ("optuna-short" if options.short else "optuna")
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1))
    for number in range(rounds):
        trials = [study.ask() for _ in range(AT_A_TIME)]
        levers = [trial.suggest_float("lever", 0.05, 1.0) for trial in trials]
        for trial, value in zip(trials, evaluate(levers, fields, folder / f"round-{number}")):
            study.tell(trial, value)
        print(f"round {number + 1}: lever {study.best_params['lever']:.3f}, {study.best_value:.0f} MJ/km")
    draw(study, options.out / "study-by-optuna.png")
    print(options.out / "study-by-optuna.png")


if __name__ == "__main__":
    main()
