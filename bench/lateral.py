"""Voyages of the same ship some metres to the side, through the same ice, ours and Box2D 3.2's, as a table.

Usage: lateral.py BENCH [--quick] [--only CASE]      BENCH: polynya_bench_voyages

Each engine takes longer steps as far as its own answer holds. Polynya takes the cheapest of its longer ticks, up to the
longest one with which the mean surge over the places stays within its standard deviation from the mean by the tick of a
scene that gives none. Box2D takes the longest step with which its bodies reach the same places. The table also has
Polynya by the tick of a scene that gives none, and both engines by the fine step (bench/voyage_run.hpp). The last row
of a case has the medians of the costs and ratios, and the means of the surge with standard errors.
"""

import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

CASES = ("voyage", "field-10000")
PLACES = (-3, -2, -1, 0, 1, 2, 3)
LONGER = ("tick x 2", "tick x 4", "tick x 8")
ENGINES = {"tick": "Polynya", **{longer: f"Polynya, {longer}" for longer in LONGER},
           "fine": "Polynya, fine step", "peer": "Box2D 3.2", "peer_longest": "Box2D 3.2, longest step"}


def measured(bench, case, metres, quick):
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "rows.csv"
        subprocess.run([bench, *quick, "--only", case, "--lateral", str(metres), "--peer-seconds", "10", "--csv",
                        str(table)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with table.open() as text:
            rows = {row["engine"]: {"step": float(row["step_s"]), "ms": float(row["ms_per_s"]),
                                    "surge": float(row["surge_kN"])} for row in csv.DictReader(text)}
        return {name: rows[engine] for name, engine in ENGINES.items()}


def mean_and_error(values):
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))


def best_of(found):
    """Returns the name of the cheapest tick among those with which, and with all shorter ones, the mean surge holds."""
    surges = {name: [row[name]["surge"] for row in found] for name in ("tick", *LONGER)}
    holding = ["tick"]
    for longer in LONGER:
        if abs(statistics.fmean(surges[longer]) - statistics.fmean(surges["tick"])) > statistics.stdev(surges["tick"]):
            break
        holding.append(longer)
    for name, of in surges.items():
        ms = statistics.median(row[name]["ms"] for row in found)
        print(f"{name}: {ms:.3f} ms, {statistics.fmean(of):.3f} kN, deviation {statistics.stdev(of):.3f}",
              file=sys.stderr)
    return min(holding, key=lambda name: statistics.median(row[name]["ms"] for row in found))


def print_case(case, found):
    best = best_of(found)
    ours = (best, "tick", "fine")
    ratios = [(row["peer_longest"]["ms"] / row[best]["ms"], row["peer"]["ms"] / row["fine"]["ms"]) for row in found]
    for place, row, (of_best, of_fine) in zip(PLACES, found, ratios):
        costs = " | ".join(f"{row[name]['ms']:.3f} | {row[name]['surge']:.1f}" for name in ours)
        print(f"| {case} | {place} | {costs} | {row['peer']['ms']:.3f} | {row['peer_longest']['ms']:.3f} | "
              f"{row['peer_longest']['step']:g} | {of_best:.2f} | {of_fine:.2f} |", flush=True)

    medians = {name: statistics.median(row[name]["ms"] for row in found) for name in ENGINES}
    surges = {name: mean_and_error([row[name]["surge"] for row in found]) for name in ours}
    costs = " | ".join("{:.3f} | {:.2f} ± {:.2f}".format(medians[name], *surges[name]) for name in ours)
    of_best, of_fine = (statistics.median(column) for column in zip(*ratios))
    print(f"| {case} | all; tick {found[0][best]['step']:g} s, {found[0]['tick']['step']:g} s | {costs} | "
          f"{medians['peer']:.3f} | {medians['peer_longest']:.3f} |  | **{of_best:.2f}** | {of_fine:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only")
    given = parser.parse_args()
    quick = ["--quick"] if given.quick else []
    print("| case | to port, m | Polynya by a longer tick, ms a simulated s | surge, kN | by the tick | surge, kN "
          "| by the fine step | surge, kN | Box2D 3.2 at that step | at its longest | of, s "
          "| Box2D's longest over Polynya's | both by the fine step |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for case in CASES:
        if not given.only or given.only == case:
            print_case(case, [measured(given.bench, case, metres, quick) for metres in PLACES])


main()
