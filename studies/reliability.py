#!/usr/bin/env python3
"""The table of docs/reliability.md, "Every joule".

    studies/reliability.py              runs every shipped scene and prints the table
    studies/reliability.py --write      puts it into the page
    studies/reliability.py --check      compares it with the page (ctest -L validation)

Imbalances are rounding: the check allows a hundredth of what a run warns of.
"""
import math
import sys

import tables
from tables import Table

PAGE = "docs/reliability.md"
SHOWN = 5
ALLOWED = 1e-8  # allowed share of the turnover; a run warns above 1e-6


def accounts(runs):
    study, rows = runs.study("shipped-scenes.json"), []
    for case, name in enumerate(study.table["scene"]):
        summary = study.run(case).summary
        energy, momentum = summary["energy"], summary["momentum"]
        off = (abs(energy["imbalance_J"]) / max(energy["turnover_J"], 1e-300),
               math.hypot(*momentum["imbalance_Ns"]) / max(momentum["turnover_Ns"], 1e-300))
        if max(off) > ALLOWED:
            raise SystemExit(f"{name}: energy is off by {off[0]:.1e} of its turnover, momentum by {off[1]:.1e}")
        rows.append([name, f"{summary['sim_time_s']:g}", f"{energy['turnover_J'] / 1e6:.3g}",
                     *("< 1e-8" for _ in off)])
    return Table(["scene", "simulated [s]", "energy turned over [MJ]", "imbalance / turnover",
                  "momentum imbalance / turnover"], rows[:SHOWN], within=0.05)


TABLES = {"accounts": accounts}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
