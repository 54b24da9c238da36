#!/usr/bin/env python3
"""The tables of docs/theory/bow.md.

    studies/bow.py              runs every study and prints the tables; name some to make these alone
    studies/bow.py --write      puts them into the page
    studies/bow.py --check      compares them with the page (ctest -L validation)

Needs numpy, scipy and matplotlib (./setup.sh python) and a release build. The elements take an hour of one processor.
"""
import math
import sys

import numpy as np

import tables
from tables import REFERENCE, Table, mean_and_error
from benches import bow_edges, bow_speed, steep_stems

PAGE = "docs/theory/bow.md"
SPEED = "ships[0].propulsion.constant_speed_m_per_s"
BOW, LENGTH, START, WAY_IN = REFERENCE.bow, REFERENCE.length, -62, 32  # [m]
STRENGTH = 0.8e6  # [Pa]


def characteristic_length(h):
    return (5.4e9 * h**3 / (12 * (1 - 0.3**2) * 1000 * 9.81)) ** 0.25


def cases_of(runs, *, model="fsi-database", cracks="split", deflection="followed"):
    """{(h, v): its runs} with these settings of bending."""
    study = runs.study("bow.json")
    found = tables.groups(study, "ice.thickness_m", SPEED, "fracture.bending.model", "fracture.bending.radial_cracks",
                          "fracture.bending.deflection")
    return {key[:2]: [study.run(case) for case in cases] for key, cases in found.items()
            if key[2:] == (model, cracks, deflection)}


def surge(runs_of_case):
    """Mean, and its standard error [kN]."""
    def mean(run):
        forces = run.force_columns
        return -1e-3 * forces["surge_N"][forces["x_m"] > START + WAY_IN].mean()
    return mean_and_error(mean(run) for run in runs_of_case)


class Contacts:
    """The contacts of a run at its frames, once the bow is in the ice: where on the hull, and their forces [N]."""

    def __init__(self, run, speed):
        rows = run.contacts
        rows = rows[rows["t_s"] > WAY_IN / speed]
        self.behind = START + speed * rows["t_s"] + LENGTH / 2 - rows["x_m"]  # the stem [m]
        self.is_port = rows["y_m"] > 0
        self.is_stem = abs(rows["y_m"]) < 0.5
        self.surge, self.size = -rows["fx_N"], np.hypot(rows["fx_N"], rows["fy_N"])
        self.frames, self.frame = np.unique(rows["t_s"], return_inverse=True)
        self.count = (run.times > WAY_IN / speed).sum()


def median(events, value):
    return float(np.median([value(event) for event in events])) if events else math.nan


def parts(runs):
    rows = []
    for (h, v), of in cases_of(runs).items():
        l, found = characteristic_length(h), []
        for run in of:
            contacts = Contacts(run, v)
            is_flank = ~contacts.is_stem & (contacts.behind < BOW + 0.1)
            force = [contacts.surge[where].sum() / contacts.count
                     for where in (contacts.is_stem, is_flank, ~contacts.is_stem & ~is_flank)]
            bends = [event for event in tables.events_of(run) if event["kind"] == "bend"
                     and event["t_s"] > WAY_IN / v]
            stem = [event for event in bends if event["normal"][0] > 0.9]
            flank = [event for event in bends if event["normal"][0] <= 0.9]
            medians = []
            for value in (lambda e: e["cusp_radius_m"] / l, lambda e: e["penetration_m"] / h,
                          lambda e: e["criterion"]["bending_capacity_N"] / (STRENGTH * h**2)):
                medians += [median(flank, value), median(stem, value)]
            way = v * (run.end_time - WAY_IN / v)
            found.append([*force, len(bends) / way, len(stem) / way, np.mean([e["submerged_area_m2"] for e in bends]),
                          *medians])
        mean, error = surge(of)
        r = np.nanmean(found, axis=0)
        rows.append([f"{h:g}", f"{v:g}", ", ".join(f"{1e-3 * force:.1f}" for force in r[:3]),
                     f"{mean:.1f} ± {error:.1f}", f"{r[3]:.2f} ({r[4]:.2f})", f"{mean / r[3]:.1f}", f"{r[5]:.1f}",
                     *(f"{r[k]:.2f} ({r[k + 1]:.2f})" for k in (6, 8, 10))])
    return Table(["h [m]", "v [m/s]", "stem, flanks, sides [kN]", "sum", "bends a metre (stem)", "kJ a bend",
                  "cusp [m²]", "R/l (stem)", "ξ_b/h (stem)", "V_b/σ_f h² (stem)"], rows, within=0.1)


# Parts of the waterline by the distance behind the stem [m].
PLACES = (("stem, 0-1 m", -1, 1), ("flank, 1-6 m", 1, 6), ("flank, 6-12 m", 6, 12), ("flank, 12-18 m", 12, 18),
          ("flank, 18-22 m", 18, 22), ("shoulder, 22-24 m", 22, BOW + 0.5), ("sides", BOW + 0.5, LENGTH))


def loads_at(contacts, first, last):
    """Mean surge, and of one side's summed force the 99 % quantile and the largest over the frames with one [kN]."""
    is_there = (contacts.behind >= first) & (contacts.behind < last)
    sides = 2 * contacts.frame[is_there] + contacts.is_port[is_there]
    sums = np.bincount(sides, contacts.size[is_there], 2 * len(contacts.frames))
    loaded = sums[sums > 0]
    extremes = (np.quantile(loaded, 0.99), loaded.max()) if len(loaded) else (0, 0)
    return 1e-3 * np.array([contacts.surge[is_there].sum() / contacts.count, *extremes])


def places(runs):
    of_case, columns = cases_of(runs), []
    for h in (0.5, 1, 1.5):
        contacts = [Contacts(run, 1) for run in of_case[h, 1]]
        columns.append([np.mean([loads_at(one, first, last) for one in contacts], axis=0) for _, first, last in PLACES])
    rows = []
    for k, (name, first, last) in enumerate(PLACES):
        length = 2 * (last - max(0, first)) / (math.cos(REFERENCE.entrance) if first < 22 else 1)
        rows.append([name, *(f"{of[k][0]:.1f}, {of[k][0] / length:.2f}, {of[k][1]:.0f}, {of[k][2]:.0f}"
                             for of in columns)])
    rows.append(["sum", *(f"{sum(place[0] for place in of):.0f}" for of in columns)])
    return Table(["place on the waterline", "h 0.5 m: mean [kN], by metre [kN/m], 99 %, largest [kN]", "h 1 m",
                  "h 1.5 m"], rows, within=0.2)


def models(runs):
    rows = []
    for model in ("fsi-database", "nevel", "kashtelyan"):
        of_case = cases_of(runs, model=model)
        capacity = median([event for run in of_case[0.5, 1] for event in tables.events_of(run)
                           if event["kind"] == "bend" and event["normal"][0] <= 0.9],
                          lambda e: e["criterion"]["bending_capacity_N"] / (STRENGTH * 0.5**2))
        rows.append([model, ", ".join("{:.1f} ± {:.1f}".format(*surge(of_case[h, 1])) for h in (0.25, 0.5, 1, 1.5)),
                     f"{capacity:.2f}"])
    return Table(["model", "resistance at h 0.25, 0.5, 1, 1.5 m [kN]", "V_b/σ_f h² on the flanks, h 0.5"], rows,
                 within=0.05)


def switches(runs):
    rows = []
    for name, settings in (("default", {}), ("without radial cracks", {"cracks": "ignored"}),
                           ("without deflection", {"deflection": "ignored"})):
        of_case = cases_of(runs, **settings)
        rows.append([name, *("{:.1f} ± {:.1f}".format(*surge(of_case[0.5, v])) for v in (0.25, 1))])
    return Table(["bending", "resistance in 0.5 m at 0.25 m/s [kN]", "at 1 m/s"], rows)


TABLES = {"edges": lambda runs: bow_edges.edges(runs.study("bow-edges.json"), runs.folder),
          "law": lambda runs: bow_edges.law(runs.study("bow-edges.json"), runs.folder),
          "wedges": lambda _: bow_edges.wedges(), "switches": switches, "parts": parts, "places": places,
          "models": models, "stems": steep_stems.stems, "shoulders": steep_stems.shoulders,
          "speed": lambda runs: bow_speed.table(runs.study("bow-speed.json"))}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
