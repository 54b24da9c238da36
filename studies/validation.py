#!/usr/bin/env python3
"""The tables of docs/validation.md.

    studies/validation.py              runs every study and prints the tables; name some to make these alone
    studies/validation.py --write      puts them into the page
    studies/validation.py --check      compares them with the page (ctest -L validation)

Needs numpy (./setup.sh python) and a release build. All of it takes some hours of one processor.
"""
import csv
import json
import math
import os
import subprocess
import sys

import numpy as np

import tables
from tables import REFERENCE, Table, formulas, mean_and_error
from benches import crack_plate, crack_trials, step_cliff, uikku

PAGE = "docs/validation.md"
SPEED = "ships[0].propulsion.constant_speed_m_per_s"
COVER = "floes[0].field.concentration"
SIDE = "floes[0].rectangle.size_m"
KEINONEN = 330, 510  # his band in 0.5 m at 1 m/s (recall) [kN]


# ---- level ice

def level_ice(runs):
    """{(h, v, strength, friction): mean of the contacts, mean of the ice under the hull, sum and its error [kN]}."""
    study = runs.study("level-ice.json")
    found = {}
    settings_of = tables.groups(study, "ice.thickness_m", SPEED, "ice.flexural_strength_Pa", "ice.friction")
    for key, cases in settings_of.items():
        of = lambda name: -1e-3 * study.table[name][cases]
        parts = of("surge_mean_N"), of("surge_from_submerged_ice_mean_N")
        found[key] = (parts[0].mean(), parts[1].mean(), *mean_and_error(parts[0] + parts[1]))
    return found


def presets_hull(ship):
    """Hull of a preset, and her mass with the water that goes with it ahead (5 %) [kg]."""
    done = subprocess.run([os.environ["POLYNYA_PROGRAM"], "ships", ship, "--json", "--for-performance"],
                          stdout=subprocess.PIPE, text=True, check=True)
    settings = json.loads(done.stdout)["ship"]
    hull = settings["hull"]
    angles = (math.radians(hull[key]) for key in ("stem_angle_deg", "entrance_angle_deg"))
    return formulas.Hull(hull["length_m"], hull["beam_m"], hull["draught_m"], *angles), 1.05 * settings["mass_kg"]


def mean_backing(columns):
    """How far the ship backs between two charges, mean of a run [m]. It is stuck where the lever begins to fall."""
    falls = np.diff(columns["lever"]) < 0
    stuck = np.flatnonzero(falls[1:] & ~falls[:-1]) + 1
    x = columns["x_m"]
    return np.mean([x[begin] - x[begin:end].min() for begin, end in zip(stuck, stuck[1:])])


def ramming(runs):
    """Means of the charges of a run; kinetic energy at the largest speed over Lindqvist's resistance at half of it."""
    study, rows = runs.study("ramming.json"), []
    of = lambda name, case: float(study.table[name][case])
    for case, (ship, h) in enumerate(zip(study.table["ships[0].ship"], study.table["ice.thickness_m"])):
        if not of("rams", case) >= 3:
            rows.append([ship, f"{float(h):g}", "none", "", "", "", "", ""])
            continue
        hull, mass = presets_hull(ship)
        speed = of("ram_speed_m_per_s", case)
        way = 0.5 * mass * speed**2 / sum(formulas.lindqvist(hull, formulas.Ice(float(h)), 0.5 * speed))
        rows.append([ship, f"{float(h):g}", f"{of('rams', case):.0f}",
                     f"{mean_backing(study.run(case).force_columns):.0f}", f"{of('ram_gain_m', case):.0f}",
                     f"{of('ram_time_s', case) / 60:.1f}", f"{speed:.1f}", f"{way:.0f}"])
    return Table(["ship", "h [m]", "charges after the first", "backs [m]", "gain of a charge [m]",
                  "minutes of a charge", "largest speed [m/s]", "½ m v²/R [m]"], rows, within=0.1)


def turning(runs):
    """Means over the 20 s before the rudder is laid, and from 200 s on."""
    study, rows = runs.study("turning-in-ice.json"), []
    for case, h in enumerate(study.table["ice.thickness_m"]):
        columns = study.run(case).force_columns
        before = (columns["t_s"] > 20) & (columns["t_s"] <= 40)
        hard_over = columns["t_s"] > 200
        mean = lambda name, of: columns[name][of].mean()
        moment = lambda cause: f"{1e-6 * mean(f'yaw_{cause}Nm', hard_over):z.1f}".replace("-", "−")
        turned = columns["heading_deg"][-1] - columns["heading_deg"][before][-1]
        rows.append([f"{float(h):g}", f"{mean('speed_m_per_s', before):.1f}", f"{mean('speed_m_per_s', hard_over):.1f}",
                     f"{turned:.1f}", moment("from_rudder_"), moment(""), moment("from_water_")])
    return Table(["h [m]", "speed amidships [m/s]", "speed hard over [m/s]", "turned by 240 s [°]",
                  "moment of the rudder [MN m]", "of the ice", "of the water"], rows, within=0.15)


def keinonen(h, v):
    """His band at 1 m/s, carried on from 0.5 m by h^1.25 (recall); of other speeds nothing is known here."""
    return "-".join(f"{r * (h / 0.5) ** 1.25:.0f}" for r in KEINONEN) if v == 1 else ""


def resistance(runs):
    found, rows = level_ice(runs), []
    for h, v in [(0.5, v) for v in (0.25, 0.5, 1, 2, 3)] + [(h, 1) for h in (0.25, 0.75, 1, 1.5)]:
        contact, submerged, total, error = found[h, v, 0.8e6, 0.2]
        ice = formulas.Ice(h)
        crushing, bending, submersion = (1e-3 * part for part in formulas.lindqvist(REFERENCE, ice, v))
        rows.append([f"{h:g}", f"{v:g}", f"{contact:.0f}", f"{submerged:.0f}", f"{total:.0f} ± {error:.0f}",
                     f"{crushing + bending:.0f}", f"{submersion:.0f}", f"{crushing + bending + submersion:.0f}",
                     f"{1e-3 * formulas.riska(REFERENCE, ice, v):.0f}",
                     f"{1e-3 * formulas.spencer_jones(REFERENCE, ice, v):.0f}", keinonen(h, v)])
    return Table(["h [m]", "v [m/s]", "crushing and bending", "submersion", "sum", "Lindqvist: R_c + R_b", "R_s", "sum",
                  "Riska", "Spencer, Jones", "Keinonen"], rows, within=0.03)


def smooth(runs):
    found, rows = level_ice(runs), []
    for h in (0.25, 0.5, 1, 1.5):
        contact, submerged, total, error = found[h, 1, 0.8e6, 0.05]
        ice = formulas.Ice(h, friction=0.05)
        rows.append([f"{h:g}", f"{contact:.0f}", f"{submerged:.0f}", f"{total:.0f} ± {error:.0f}",
                     f"{1e-3 * formulas.spencer_jones(REFERENCE, ice, 1):.0f}",
                     f"{1e-3 * sum(formulas.lindqvist(REFERENCE, ice, 1)):.0f}"])
    return Table(["h [m]", "crushing and bending", "submersion", "sum", "Spencer, Jones", "Lindqvist"], rows,
                 within=0.03)


def exponents(runs):
    """Slopes of the logarithms by least squares."""
    found, rows = level_ice(runs), []
    series = {"thickness h": [(h, (h, 1, 0.8e6, 0.2)) for h in (0.25, 0.5, 0.75, 1, 1.5)],
              "speed v": [(v, (0.5, v, 0.8e6, 0.2)) for v in (0.5, 1, 2, 3)],
              "strength σ_f": [(s, (0.5, 1, s, 0.2)) for s in (0.4e6, 0.8e6, 1.6e6)],
              "friction μ": [(m, (0.5, 1, 0.8e6, m)) for m in (0.05, 0.1, 0.2)]}
    for name, points in series.items():
        x = np.log([at for at, _ in points])
        slope = lambda values: f"{np.polyfit(x, np.log(values), 1)[0]:.2f}"
        his = [formulas.lindqvist(REFERENCE, formulas.Ice(h, flexural_strength=s, friction=m), v)
               for _, (h, v, s, m) in points]
        rows.append([name, slope([found[key][2] for _, key in points]), slope([found[key][0] for _, key in points]),
                     slope([sum(parts) for parts in his]), slope([parts[0] + parts[1] for parts in his])])
    return Table(["resistance grows with", "as", "crushing and bending as", "Lindqvist's as", "his R_c + R_b as"], rows,
                 within=0.05)


# ---- speeds

REPORTED = {"araon": ("1", "630e3"), "polaris": ("1.2,1.8", "500e3"), "nordica": ("0.8", "500e3"),
            "oden": ("1.8,1.9", "500e3"), "xuelong-2": ("1.5", "500e3")}


def performance(runs, ship, thicknesses, strength="500e3"):
    """Rows of performance.csv by thickness."""
    folder = runs.folder / f"performance-{ship}"
    runs.call("performance", ship, "--thickness", thicknesses, "--flexural-strength", strength, "--out", folder,
              "--jobs", runs.jobs, stdout=-3, stderr=-3)
    with open(folder / "performance.csv", encoding="utf-8") as file:
        return {float(row["thickness_m"]): {key: float(value) for key, value in row.items() if key.endswith("_s")}
                for row in csv.DictReader(file)}


def speeds(runs):
    rows = []
    for ship, (thicknesses, strength) in REPORTED.items():
        found = performance(runs, ship, thicknesses, strength)
        preset = json.loads(runs.call("ships", ship, "--json", stdout=-1).stdout)
        for point in preset["reported"]:
            row = found[point["thickness_m"]]
            rows.append([ship, f"{point['thickness_m']:g}", f"{point['speed_m_per_s']:.2f}",
                         f"{row['speed_m_per_s']:.2f} ± {row['error_m_per_s']:.2f}", f"{row['lindqvist_m_per_s']:.2f}",
                         f"{row['riska_m_per_s']:.2f}", f"{row['spencer_jones_m_per_s']:.2f}"])
    return Table(["ship", "h [m]", "reported [m/s]", "Polynya [m/s]", "Lindqvist", "Riska", "Spencer, Jones"], rows)


def speed_error(runs):
    """Speed over that by the fastest formula."""
    found = performance(runs, "reference", "0.25,0.4,0.5,0.6,0.7,0.8,1")
    fastest = lambda row: max(row[f"{name}_m_per_s"] for name in ("lindqvist", "riska", "spencer_jones"))
    shares = [f"{row['speed_m_per_s'] / fastest(row):.2f}" for row in found.values()]
    return Table(["ship", *(f"{h:g} m" for h in found)], [["reference", *shares]], within=0.03)


def thick_ice(runs):
    """Contacts, and the sum with the ice under the hull, by thickness; the slope of the contacts' logarithm over five
    neighbouring thicknesses, by least squares, with its error from those of the means."""
    study, rows, points = runs.study("thick-ice.json"), [], []
    for h, cases in tables.groups(study, "ice.thickness_m").items():
        contacts = -1e-3 * study.table["surge_mean_N"][cases]
        points.append((h, *mean_and_error(contacts), *mean_and_error(1e-3 * study.table["resistance_mean_N"][cases])))
    for i, (h, contact, error, total, error_of_total) in enumerate(points):
        slope = ""
        if 2 <= i < len(points) - 2:
            of_five = slope_and_error([point[:3] for point in points[i - 2:i + 3]])
            slope = "{:.2f} ± {:.2f}".format(*of_five).replace("-", "−")
        rows.append([f"{h:g}", f"{contact:.0f} ± {error:.0f}", slope, f"{total:.0f} ± {error_of_total:.0f}"])
    return Table(["h [m]", "crushing and bending [kN]", "slope over five thicknesses",
                  "sum with ice under the hull [kN]"], rows, within=0.1)


def slope_and_error(points):
    """The slope of ln y over ln x of (x, y, standard error of y) by least squares, and its standard error."""
    x, y, error = np.array(points, dtype=float).T
    away = np.log(x) - np.log(x).mean()
    weights = away / (away @ away)
    return weights @ np.log(y), np.sqrt(weights**2 @ (error / y)**2)


# ---- pack ice

def colbourne(cover, h, v, k, b, n):
    """Pack ice after Colbourne (2000), ½ k Fr^b ρ_i B h v² C^n [kN]."""
    froude = v / math.sqrt(formulas.G * h * cover)
    return 0.5e-3 * k * froude**b * 900 * REFERENCE.beam * h * v**2 * cover**n


def slender_and_blunt(cover):
    return [f"{colbourne(cover, 0.5, 1, 4.4, -0.8267, 2):.0f}", f"{colbourne(cover, 0.5, 1, 16.1, -1.7937, 3):.0f}"]


def zuev(cover, h, v):
    """Small broken ice after Zuev [kN]."""
    froude = v / math.sqrt(formulas.G * h)
    size = 0.13 * REFERENCE.beam / h + 1.3 * froude + 0.5 * froude**2
    return 1e-3 * 900 * formulas.G * REFERENCE.beam * h**2 * size * (2 - cover) * cover**2


def pack(runs):
    study, rows = runs.study("pack.json"), []
    kilo = lambda name, cases: -1e-3 * study.table[name][cases]
    by_setting = tables.groups(study, COVER, "fracture.going_under.enabled")
    for cover in (0.3, 0.5, 0.7, 0.8, 0.9):
        cases, without = by_setting[cover, "true"], by_setting[cover, "false"]
        total, error = mean_and_error(-kilo("resistance_mean_N", cases))
        up, error_up = mean_and_error(-kilo("resistance_mean_N", without))
        rows.append([f"{cover:g}", f"{kilo('surge_mean_N', cases).mean():.0f}",
                     f"{kilo('surge_from_submerged_ice_mean_N', cases).mean():.0f}", f"{total:.0f} ± {error:.0f}",
                     f"{up:.0f} ± {error_up:.0f}", f"{study.table['tilted_under'][cases].mean():.0f}",
                     *slender_and_blunt(cover), f"{zuev(cover, 0.5, 1):.0f}"])
    return Table(["C", "contact", "submersion", "sum", "without going under", "floes under", "Colbourne slender",
                  "blunt", "Zuev"], rows, within=0.1)


BREAKABLE = "fracture.breakable_size_factor"
THICKNESS, BEAM = "ice.thickness_m", "ships[0].hull.beam_m"
# Colbourne's k Fr^b C^n, with Fr = v/√(g h C): slender and blunt bows.
COLBOURNE = {"slender": (-0.8267, 2), "blunt": (-1.7937, 3)}


def pack_exponents(runs):
    """Slopes of the logarithm of the sum about V 1 m/s, h 0.5 m, C 0.7, B 24 m, beside Colbourne's."""
    study, rows = runs.study("pack-exponents.json"), []
    names = (SPEED, THICKNESS, COVER, BEAM)
    base = dict(zip(names, (1, 0.5, 0.7, 24)))
    found = tables.groups(study, BREAKABLE, *names)
    his = {SPEED: lambda b, n: 2 + b, THICKNESS: lambda b, n: 1 - b / 2, COVER: lambda b, n: n - b / 2,
           BEAM: lambda b, n: 1}
    of_series = [("V", SPEED, {}), ("V at C 0.5", SPEED, {COVER: 0.5}), ("h", THICKNESS, {}), ("C", COVER, {}),
                 ("B", BEAM, {})]
    for label, varied, other in of_series:
        row = [label, ""]
        for factor in (100, 1):
            points = []
            for key, cases in found.items():
                if key[0] == factor and all(value == (base | other)[name] for name, value in zip(names, key[1:])
                                            if name != varied):
                    points.append((key[1 + names.index(varied)],
                                   *mean_and_error(1e-3 * study.table["resistance_mean_N"][cases])))
            points.sort()
            row[1] = ", ".join(f"{at:g}" for at, _, _ in points)
            row.append(", ".join(f"{mean:.0f} ± {error:.0f}" for _, mean, error in points))
            row.append("{:.2f} ± {:.2f}".format(*slope_and_error(points)).replace("-", "−"))
        rows.append(row + [f"{his[varied](*COLBOURNE[bow]):.2f}" for bow in COLBOURNE])
    return Table(["varied", "values", "unbreakable: sum [kN]", "exponent", "breakable: sum [kN]", "exponent",
                  "Colbourne slender", "blunt"], rows, within=0.2)


def shapes(runs):
    study, squares, rows = runs.study("pack.json"), runs.study("squares.json"), []
    by_setting = tables.groups(study, COVER, "fracture.going_under.enabled")
    of_squares = tables.groups(squares, "floes[0].lattice.pitch_m")

    def cells(of, cases):
        sums = 1e-3 * of.table["resistance_mean_N"][cases]
        return [f"{sums.mean():.0f}", f"{sums.std(ddof=1):.0f}",
                f"{1e-3 * np.median(of.table['surge_peak_N'][cases]):.0f}"]
    for pitch, cases in of_squares.items():
        cover = round((15 / pitch) ** 2, 1)
        rows.append([f"{cover:g}", *cells(squares, cases), *cells(study, by_setting[cover, "true"][:4]),
                     *slender_and_blunt(cover)])
    return Table(["C", "square: mean [kN]", "spread", "largest 0.1 s", "irregular: mean", "spread", "largest 0.1 s",
                  "Colbourne slender", "blunt"], rows, within=0.1)


def settings(runs):
    """Each number halved and doubled."""
    study, rows = runs.study("going-under-settings.json"), []
    names = {"fracture.going_under.added_mass_factor": "added_mass_factor",
             "fracture.going_under.damping": "damping",
             "fracture.going_under.edge_deflection_over_thickness": "edge_deflection_over_thickness",
             "time.step_s": "step", "contact.circle_radius_m": "circle_radius"}
    variants = tables.groups(study, *names)
    default = next(iter(variants))
    for variant, cases in variants.items():
        what = [f"{names[name]} × {value / of_default:g}" for name, value, of_default in zip(names, variant, default)
                if value != of_default]
        cells = []
        for cover in (0.7, 0.9):
            of_cover = [case for case in cases if study.table[COVER][case] == cover]
            mean, error = mean_and_error(1e-3 * study.table["resistance_mean_N"][of_cover])
            cells.append(f"{mean:.0f} ± {error:.0f}, {study.table['tilted_under'][of_cover].mean():.0f}")
        rows.append(["".join(what) or "default", *cells])
    return Table(["variant", "C 0.7: sum [kN], floes under", "C 0.9: sum [kN], floes under"], rows, within=0.15)


# ---- peaks

def gauge(runs):
    """Peaks per hour above a force after the first ten seconds, and the mean of each run's largest."""
    study, rows = runs.study("peaks-gauge.json"), []
    for (step, radius, response), cases in tables.groups(study, "time.step_s", "contact.circle_radius_m",
                                                         "record.peak_response_s").items():
        forces = [peaks["force_N"][peaks["t_s"] > 10] for peaks in (study.run(case).peaks for case in cases)]
        hours = len(cases) * 50 / 3600
        count = lambda least: sum((of >= least).sum() for of in forces)
        largest, error = mean_and_error([1e-6 * of.max(initial=0) for of in forces])
        what = f"{step:g}" + (f", `contact.circle_radius_m` {radius:g}" if radius != 1 else "") + (
            "" if response == 0.02 else f", `record.peak_response_s` {response:g}" if response else ", no gauge: 0")
        rows.append([what, *(f"{count(least) / hours:.0f}" for least in (0.05e6, 0.1e6, 0.15e6)),
                     f"{count(0.25e6) / hours:.0f} ± {count(0.25e6) ** 0.5 / hours:.0f}",
                     f"{largest:.3f} ± {error:.3f}"])
    return Table(["`time.step_s`, and what differs", "0.05 MN", "0.1 MN", "0.15 MN", "0.25 MN", "largest [MN]"], rows,
                 within=0.1)


# ---- splitting

def splitting(runs):
    study, rows = runs.study("splitting-sides.json"), []
    for (h, toughness), cases in tables.groups(study, "ice.thickness_m", "ice.fracture_toughness_Pa_sqrt_m").items():
        first = {study.table[SIDE][case]: first_fracture(study.run(case)) for case in cases}
        first = {side: event for side, event in first.items() if event}
        split = max((side for side, event in first.items() if event["kind"] == "split"), default=None)
        bend = min(side for side, event in first.items() if event["kind"] == "bend" and (not split or side > split))
        force = first[bend]["criterion"]["opening_force_N"]
        over = [event["criterion"]["load_N"] / event["criterion"]["capacity_N"] for event in first.values()
                if event["kind"] == "split"]
        rows.append([f"{h:g}", f"{1e-3 * toughness:g}", f"{1e-3 * force:.1f}", f"{side_of(force, h, toughness):.1f}",
                     f"{f'{split:g}' if split else '–'}, {bend:g}",
                     f"{min(over):.3f}–{max(over):.3f}" if over else "–"])
    return Table(["h [m]", "K_IC [kPa√m]", "opening force at bending F_b [kN]", "L_s = (F_b / 0.187 h K)² [m]",
                  "largest floe that splits, smallest that bends first [m]", "splits at F / F_max"], rows, within=0.01)


def side_of(force, h, toughness):
    """L_s: the side at which a square's F_max is that force [m]."""
    return (force / (0.187 * h * toughness)) ** 2


def first_fracture(run):
    return next((event for event in tables.events_of(run) if event["kind"] in ("bend", "split")), None)


class Voyage:
    """A run of studies/crossover.json: what became of the floe."""

    def __init__(self, run, side):
        events = tables.events_of(run)
        self.areas = {floe["floe_id"]: floe["area_m2"] for floe in map(json.loads, open(run.folder / "floes.ndjson"))}
        splits = [event for event in events if event["kind"] == "split"]
        self.bends = [event for event in events if event["kind"] == "bend"]
        self.beams = [event for event in splits if "section_stress_Pa" in event["criterion"]]
        self.cracks = [event for event in splits if event not in self.beams]
        self.first = next((event["kind"] for event in events if event["kind"] in ("bend", "split")), "none")
        forces = run.force_columns
        stem = forces["x_m"] + 60
        self.way = min(stem.max(), side)
        self.speed = forces["speed_m_per_s"][(stem >= 0) & (stem <= side)].mean()
        self.first_split = stem[forces["t_s"] >= self.cracks[0]["t_s"]][0] if self.cracks else None
        self.opening = [event["criterion"].get("opening_force_N", 0) for event in self.bends] or [0]
        self.unresolved = run.summary["counts"]["unresolved_splits"]

    def is_strip(self, split):
        """Whether the narrower piece is longer along the crack than eight times its width."""
        length = split["criterion"]["crack_length_m"]
        pieces = [self.areas[child] for child in split["children"] if child in self.areas]
        return len(pieces) > 1 and length > 8 * min(pieces) / length


def voyages(runs):
    study = runs.study("crossover.json")
    return {key: Voyage(study.run(case), key[1])
            for key, (case,) in tables.groups(study, "ice.thickness_m", SIDE).items()}


def crossover(runs):
    rows = []
    for (h, side), of in sorted(voyages(runs).items()):
        after = "–" if of.first_split is None else f"{of.first_split:.0f}"
        rows.append([f"{h:g}", f"{side:g}", of.first, after, str(len(of.cracks)), str(sum(map(of.is_strip, of.cracks))),
                     str(len(of.beams)), str(len(of.bends)), f"{of.way:.0f}", f"{of.speed:.2f}", str(of.unresolved)])
    return Table(["h [m]", "side [m]", "first", "first split after [m]", "splits", "strips", "as beams", "bends",
                  "way inside [m]", "mean speed inside [m/s]", "unresolved splits"], rows, within=0.1)


def crossover_forces(runs):
    found, rows = voyages(runs), []
    for h in (0.5, 1, 1.5):
        first = max(of.opening[0] for (of_h, _), of in found.items() if of_h == h)
        most = max(max(of.opening) for (of_h, _), of in found.items() if of_h == h)
        rows.append([f"{h:g}", f"{1e-3 * first:.0f}", f"{side_of(first, h, 150e3):.0f}", f"{1e-3 * most:.0f}",
                     f"{side_of(most, h, 150e3):.0f}"])
    return Table(["h [m]", "F_b of the stem, at the first bend [kN]", "its L_s [m]",
                  "of the bow, the greatest at a bend [kN]", "its L_s [m]"], rows, within=0.05)


# ---- contact, step and radius

def three_measures(runs):
    study, rows = runs.study("three-measures.json"), []
    for case, scene in enumerate(("level-plate", "sawamura2017-fig4b")):
        of = lambda name: f"{1e-6 * study.table[name][case]:.3f} MN"
        of_paper = abs(study.run(case).force_columns["surge_j_over_tau_c_N"]).max()
        rows.append([f"`polynya run scenes/{scene}.json`", of("surge_peak_N"), of("surge_step_peak_N"),
                     f"{1e-6 * of_paper:.2f} MN"])
    return Table(["command", "mean over 0.1 s", "single step", "j/τ_c"], rows)


def step(runs):
    study, rows = runs.study("contact-step.json"), []
    steps = (0.00125, 0.0025, 0.005, 0.01, 0.02)
    for speed, cases in tables.groups(study, SPEED).items():
        means = []
        for tick in steps:
            of_tick = [case for case in cases if study.table["time.step_s"][case] == tick]
            of = -1e-3 * study.table["surge_mean_N"][of_tick]
            means.append("{:.1f} ± {:.1f}".format(*mean_and_error(of)))
        rows.append([f"{speed:g}", *means])
    return Table(["v [m/s]", *(f"{tick:g} s" for tick in steps)], rows)


def circles(runs):
    study = runs.study("plate-circles.json")
    means = -1e-3 * study.table["surge_mean_N"]
    return Table(["contact.circle_radius_m", *(f"{radius:g}" for radius in study.table["contact.circle_radius_m"])],
                 [["mean surge [kN]", *(f"{mean:.1f}" for mean in means)]], within=0.04)


def scatter(runs):
    study, rows = runs.study("plate-scatter.json"), []
    for spread, cases in tables.groups(study, "fracture.bending.strength_spread").items():
        means, peaks = -1e-3 * study.table["surge_mean_N"][cases], 1e-3 * study.table["surge_peak_N"][cases]
        rows.append([f"{spread:g}", "{:.1f} ± {:.1f}".format(*mean_and_error(means)),
                     "{:.0f} ± {:.0f}".format(*mean_and_error(peaks))])
    return Table(["strength_spread", "mean surge [kN]", "largest mean over 0.1 s [kN]"], rows, within=0.04)


TABLES = {"resistance": resistance, "smooth": smooth, "exponents": exponents, "speeds": speeds,
          "speed-error": speed_error, "uikku": lambda runs: uikku.table(runs, "stated"),
          "uikku-other-angles": lambda runs: uikku.table(runs, "inverted"),
          "uikku-dependences": lambda runs: uikku.dependences(runs), "water-once": lambda runs: uikku.water(runs),
          "polaris": lambda runs: uikku.polaris(runs), "thick-ice": thick_ice, "pack": pack,
          "pack-exponents": pack_exponents, "shapes": shapes,
          "settings": settings, "gauge": gauge, "splitting": splitting, "crossover-forces": crossover_forces,
          "crossover": crossover, "ramming": ramming, "turning": turning,
          "three-measures": three_measures, "step": step, "circles": circles, "scatter": scatter,
          "crack-trials": crack_trials.table, "step-cliff": lambda runs: step_cliff.table(runs, places=3),
          "crack-arms": lambda _: crack_plate.arms(), "crack-paths": lambda _: crack_plate.paths()}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
