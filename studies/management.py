#!/usr/bin/env python3
"""The table of docs/management.md, "A study that ships".

    studies/management.py              runs scenes/studies/ice-management.json and prints the table
    studies/management.py --write      puts it into the page
    studies/management.py --check      compares it with the page (ctest -L validation)

The study takes half an hour of two processors. It is the study of `polynya management`, which ranks the patterns.
"""
import csv
import subprocess
import sys

import tables
from tables import Table

PAGE = "docs/management.md"
STUDY = "../scenes/studies/ice-management.json"
MEASURES = {"management_ice_load_mean_N": 1e-3, "management_ice_load_q99_N": 1e-3, "management_largest_at_body_m": 1}


def number(text, scale):
    return f"{scale * float(text):.3g}"


def with_interval(row, scale):
    """The mean and half of its 95 % interval, and what is left of the unmanaged mean with its interval."""
    text = f"{number(row['mean'], scale)} ± {number(row['half_of_95_percent'], scale)}"
    if not row["of_unmanaged"]:
        return text
    limits = [row["of_unmanaged_low"], row["of_unmanaged_high"]]
    between = f" ({number(limits[0], 100)} to {number(limits[1], 100)})" if all(limits) else ""
    return f"{text}; {number(row['of_unmanaged'], 100)} %{between}"


def ranking(runs):
    study = runs.study(STUDY)
    runs.call("management", study.folder, stdout=subprocess.DEVNULL)
    with open(study.folder / "management-ranking.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    found = {measure: {row["pattern"]: row for row in rows if row["measure"] == measure} for measure in MEASURES}
    if any(not of for of in found.values()):
        raise SystemExit(f"polynya management ranks by {sorted({row['measure'] for row in rows})}")
    first = next(iter(found.values()))
    return Table(["pattern", "mean load of the ice [kN]", "load exceeded 1 % of the time [kN]",
                  "largest floe that arrives [m]", "ice lost by rule", "fields"],
                 [[name, *(with_interval(found[measure][name], scale) for measure, scale in MEASURES.items()),
                   f"{number(row['ice_lost_share'], 100)} %", row["fields"]] for name, row in first.items()],
                 within=0.2)


TABLES = {"ranking": ranking}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
