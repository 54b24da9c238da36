#!/usr/bin/env python3
"""The table of docs/management.md, "A study that ships".

    studies/management.py              runs scenes/studies/ice-management.json and prints the table
    studies/management.py --write      puts it into the page
    studies/management.py --check      compares it with the page (ctest -L validation)

The study takes half an hour to an hour of two processors. `polynya management` ranks its patterns.
"""
import json
import sys

import tables
from tables import Table

PAGE = "docs/management.md"
STUDY = "../scenes/studies/ice-management.json"
LOADS = ("management_ice_load_mean_N", "management_ice_load_q99_N")  # each with its ratio to the unmanaged load
UNMANAGED = "not managed"
LARGEST, LOST = "management_largest_at_body_m", "management_ice_lost_share"


def with_half(mean, scale, digits):
    """A mean and half of its 95 % interval."""
    return f"{scale * mean['value']:.{digits}f} ± {scale * mean['half']:.{digits}f}"


def ratio(left):
    """What is left of the unmanaged load, with its interval [%]; empty for the unmanaged load itself."""
    if left is None:
        return ""
    value, low, high = (None if number is None else f"{100 * number:.0f}" for number in left)
    return f"{value} %" if low is None else f"{value} % ({low} to {high})"


def ranking(runs):
    study = runs.study(STUDY)
    found = json.loads(runs.call("management", study.folder, "--json", capture_output=True).stdout)
    condition, = found["conditions"]
    places = {measure: {place["name"]: place for place in ranked} for measure, ranked in condition["ranking"].items()}
    means = condition["means"]
    rows = []
    for name in places[LOADS[0]]:
        row = [name]
        for measure, digits in zip(LOADS, (1, 0)):
            place = places[measure][name]
            row += [with_half(place["mean"], 1e-3, digits), ratio(place["left"])]
        contacts = condition["contacts"].get(name) if name != UNMANAGED else None  # there the icebreaker lies far away
        row += [with_half(means[LARGEST][name], 1, 0), f"{100 * means[LOST][name]['value']:.2f} %",
                f"{contacts['closest']:.0f}" if contacts else ""]
        rows.append(row)
    return Table(["pattern", "mean load [kN]", "of unmanaged", "load exceeded 1 % of the time [kN]", "of unmanaged",
                  "largest floe that arrives [m]", "ice lost by rule", "closest distance of ship and icebreaker [m]"],
                 rows, within=0.2)


TABLES = {"ranking": ranking}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
