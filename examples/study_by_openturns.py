#!/usr/bin/python3
"""OpenTURNS draws the cases of a study and states which particular of ice and ship decides the resistance.

    python3 examples/study_by_openturns.py   (--out FOLDER; --short: few cases; needs python3-openturns)

Shows a study whose cases are another program's: OpenTURNS optimises a Latin hypercube of four particulars, writes it as
a CSV file with a row a case, and `polynya study evaluate` writes the measures of each case as CSV. From both follow the
standardised coefficients of a linear model. Draws study-by-openturns.png.
"""
import argparse
import csv
import json
import pathlib
import subprocess

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib", "openturns")

import openturns
from matplotlib.figure import Figure

from polynya.program import program

SCENE = {
    "time": {"step_s": 0.02, "until_s": 60}, "record": {"forces_interval_s": 0.5},
    "ships": [{"name": "ship", "hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30, "draught_m": 5,
                                        "block_coefficient": 0.6},
               "position_m": [-31, 0], "propulsion": {"constant_speed_m_per_s": 2}}],
    "floes": [{"field": {"corner_m": [0, -60], "extent_m": [140, 120], "floe_size_m": 20, "size_spread": 0.3,
                         "concentration": 0.7}}],
}
PARTICULARS = {
    "ice.thickness_m": (0.3, 0.9),
    "floes[0].field.concentration": (0.5, 0.8),
    "ships[0].propulsion.constant_speed_m_per_s": (1.0, 3.0),
    "ice.friction": (0.05, 0.2),
}
MEASURE = "resistance_mean_N"


def design(count):
    """An optimised Latin hypercube of the particulars."""
    openturns.RandomGenerator.SetSeed(1)
    joint = openturns.ComposedDistribution([openturns.Uniform(*ends) for ends in PARTICULARS.values()])
    hypercube = openturns.LHSExperiment(joint, count)
    hypercube.setAlwaysShuffle(True)
    return openturns.MonteCarloLHS(hypercube, 200).generate()


def evaluate(inputs, folder):
    """The measure of each case."""
    (folder / "pack.json").write_text(json.dumps(SCENE))
    (folder / "study.json").write_text(json.dumps({"scene": "pack.json", "collect": {"from_s": 15}, "keep": "summary"}))
    with open(folder / "design.csv", "w", newline="") as file:
        csv.writer(file).writerows([PARTICULARS, *([f"{value:.6g}" for value in row] for row in inputs)])
    subprocess.run([program(), "study", "evaluate", folder / "study.json", folder / "design.csv",
                    folder / "measures.csv", "--folder", folder / "cases", "--quiet"], check=True)
    with open(folder / "measures.csv", newline="") as file:
        return openturns.Sample([[float(row[MEASURE])] for row in csv.DictReader(file)])


def draw(coefficients, path):
    figure = Figure(figsize=(6.7, 2.4), layout="constrained")
    axes = figure.subplots()
    axes.barh(range(len(PARTICULARS)), coefficients, color="#0072b2")
    axes.set_yticks(range(len(PARTICULARS)), PARTICULARS)
    axes.set(xlabel="standardised regression coefficient of the mean resistance")
    axes.axvline(0, color="#000000", linewidth=0.8)
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="few cases")
    options = parser.parse_args()
    folder = options.out / ("openturns-short" if options.short else "openturns")
    folder.mkdir(parents=True, exist_ok=True)
    inputs = design(8 if options.short else 40)
    resistances = evaluate(inputs, folder)
    coefficients = openturns.CorrelationAnalysis(inputs, resistances).computeSRC()
    fit = openturns.LinearModelAlgorithm(inputs, resistances).getResult()
    for path, coefficient in zip(PARTICULARS, coefficients):
        print(f"{path:45s} {coefficient:+.2f}")
    print(f"{inputs.getSize()} cases, R² of the linear model {fit.getRSquared():.2f}")
    draw(list(coefficients), options.out / "study-by-openturns.png")
    print(options.out / "study-by-openturns.png")


if __name__ == "__main__":
    main()
