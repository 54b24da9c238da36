"""Voyages of the same ship some metres to the side, through the same ice, ours and Box2D 3.2's, as a table.

Usage: lateral.py BENCH [--quick] [--only CASE]      BENCH: polynya_bench_voyages

Ours by levels and by one step for all; Box2D's at that step, and at the longest with which its bodies come to the same
places. The last row of a case has the medians of the costs and ratios, and the means of the surge with standard errors.
"""

import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import tempfile

CASES = ("voyage", "field-10000")
PLACES = (-3, -2, -1, 0, 1, 2, 3)
ENGINES = {"levels": "Polynya", "one": "Polynya, one step for all", "peer": "Box2D 3.2",
           "longest": "Box2D 3.2, longest step"}


def measured(bench, case, metres, quick):
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "rows.csv"
        subprocess.run([bench, *quick, "--only", case, "--lateral", str(metres), "--peer-seconds", "10", "--csv",
                        str(table)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with table.open() as text:
            rows = {row["engine"]: {"step": float(row["step_s"]), "ms": float(row["ms_per_s"]),
                                    "surge": float(row["surge_kN"])} for row in csv.DictReader(text)}
        return {name: rows[engine] for name, engine in ENGINES.items()}


def with_error(values):
    return f"{statistics.fmean(values):.1f} ± {statistics.stdev(values) / math.sqrt(len(values)):.1f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only")
    given = parser.parse_args()
    quick = ["--quick"] if given.quick else []
    print("| case | to port, m | Polynya, ms a simulated s | surge, kN | one step for all | surge, kN "
          "| Box2D 3.2 at that step | at its longest | of, s | Box2D's longest over Polynya | both with one step |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for case in CASES:
        if given.only and given.only != case:
            continue
        found = []
        for metres in PLACES:
            row = measured(given.bench, case, metres, quick)
            found.append(row)
            print(f"| {case} | {metres} | {row['levels']['ms']:.3f} | {row['levels']['surge']:.1f} | "
                  f"{row['one']['ms']:.3f} | {row['one']['surge']:.1f} | {row['peer']['ms']:.3f} | "
                  f"{row['longest']['ms']:.3f} | {row['longest']['step']:g} | "
                  f"{row['longest']['ms'] / row['levels']['ms']:.2f} | {row['peer']['ms'] / row['one']['ms']:.2f} |",
                  flush=True)

        def median(value):
            return statistics.median(value(row) for row in found)

        print(f"| {case} | all | {median(lambda r: r['levels']['ms']):.3f} | "
              f"{with_error([row['levels']['surge'] for row in found])} | {median(lambda r: r['one']['ms']):.3f} | "
              f"{with_error([row['one']['surge'] for row in found])} | {median(lambda r: r['peer']['ms']):.3f} | "
              f"{median(lambda r: r['longest']['ms']):.3f} | | "
              f"**{median(lambda r: r['longest']['ms'] / r['levels']['ms']):.2f}** | "
              f"{median(lambda r: r['peer']['ms'] / r['one']['ms']):.2f} |", flush=True)


main()
