#!/usr/bin/env python3
"""The table of docs/performance.md that is no time; bench/performance.sh has the others.

    studies/performance.py              runs the study and prints the table
    studies/performance.py --write      puts it into the page
    studies/performance.py --check      compares it with the page (ctest -L validation)

Needs numpy (./setup.sh python) and a release build.
"""
import statistics
import sys

import tables
from tables import Table, mean_and_error

PAGE = "docs/performance.md"


def sweeps(runs):
    study, rows = runs.study("sweeps.json"), []
    for iterations, cases in tables.groups(study, "contact.iterations").items():
        summaries = [study.run(case).summary for case in cases]
        unsolved = statistics.fmean(of["counts"]["unconverged_steps"] / of["time_steps"] for of in summaries)
        left = [of["counts"]["largest_left_over_m_per_s"] for of in summaries]
        surge, bends = -1e-3 * study.table["surge_mean_N"][cases], study.table["bends"][cases]
        rows.append([f"{iterations:g}", *("{:.1f} ± {:.1f}".format(*mean_and_error(of)) for of in (surge, bends)),
                     f"{100 * unsolved:.0f}", f"{statistics.median(left):.2g}, {max(left):.2g}"])
    return Table(["sweeps", "mean surge force [kN]", "cusps", "steps that used them all [%]",
                  "largest left over: median run, worst run [m/s]"], rows, within=0.2)


TABLES = {"sweeps": sweeps}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
