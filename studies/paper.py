#!/usr/bin/env python3
"""The tables of docs/paper-comparison.md: the five scenes of the paper by both readings of Eq. (6).

    studies/paper.py              runs the study (410 runs, half an hour) and prints the tables
    studies/paper.py --write      puts them into the page
    studies/paper.py --check      compares them with the page (ctest -L validation)

Needs numpy (./setup.sh python) and a release build.
"""
import math
import statistics
import sys

import tables
from tables import Table

PAGE = "docs/paper-comparison.md"
SCENES = ["fig4a", "fig4b", "fig4c", "fig6a", "fig6b"]
READINGS = ["plan", "edge"]
SHIPPED_Y = {"fig4a": 150, "fig4b": 150, "fig4c": 146, "fig6a": 146, "fig6b": 146}  # of the ship in the scenes [m]
COURSES_M = [-3, -2, -1, 0, 1, 2, 3]
SMALL_FLOES_END_M = {"fig4a": 206, "fig4b": 206, "fig4c": 206, "fig6a": 202.5, "fig6b": 216}
# The paper's times of first breaking and of splits [s].
PAPER_TIMES_S = {"fig6a": (231, (231, 366)), "fig6b": (293, (367, 454))}
MASS_KG, THRUST_N, START_SPEED, ALIKE = 1e7, 2e4, 1.0, 0.1  # ALIKE: numbers within this share of the paper's agree


class Voyage:
    """A run on the shipped course: its forces, its fractures and the channel behind it."""

    def __init__(self, run):
        self.run = run
        self.forces = run.force_columns
        self.events = [event for event in tables.events_of(run) if event["kind"] in ("bend", "split")]
        measured = run.measure_channel()
        self.channel = measured.sums
        stations = measured.stations
        self.stations = stations[(stations["has_port_ice"] == 1) & (stations["has_starboard_ice"] == 1)]

    def fractures(self, kind):
        return [event for event in self.events if event["kind"] == kind]

    @property
    def first_break(self):
        return self.events[0]["t_s"] if self.events else math.inf

    @property
    def split_times(self):
        return [event["t_s"] for event in self.fractures("split")]

    def widths_in(self, low, high):
        """Widths of the stations whose ice, carried back with the drift, was between two x at the start [m]."""
        moved = self.run.scene["water"]["drift_m_per_s"][0] * self.forces["t_s"][-1]
        x = self.stations["x_m"] - moved
        return list(self.stations["width_m"][(low < x) & (x < high)])

    def speed_at(self, time):
        return self.forces["speed_m_per_s"][abs(self.forces["t_s"] - time).argmin()]

    def force_at(self, time):
        """The ice's true force on the ship, the mean of the recorded interval [N]."""
        row = min((self.forces["t_s"] < time - 1e-9).sum(), len(self.forces["t_s"]) - 1)
        return math.hypot(self.forces["surge_N"][row], self.forces["sway_N"][row])

    def loads(self, is_removing, suffix):
        """The size of (surge, sway) in all rows, by the end of the columns' names: "_N" the mean over 0.1 s, "_max_N" a
        single step."""
        time = self.forces["t_s"]
        # The ship presses on a plate for a moment before it breaks: removal ends 5 s before the first fracture.
        kept = (time > 0) & (time < self.first_break - 5) if is_removing else time >= self.first_break
        surge, sway = (abs(self.forces[name + suffix][kept]) for name in ("surge", "sway"))
        return [max(pair) for pair in zip(surge, sway)] or [0]


def courses(runs):
    """The study, and {(scene, reading): {y of the ship: number of its case}}."""
    study, found = runs.study("paper.json"), {}
    for case, (scene, reading, y) in enumerate(zip(*(study.table[name] for name in
                                                     ("scene", "water.drag_area", "ships[0].position_m[1]")))):
        found.setdefault((scene.removeprefix("sawamura2017-"), reading), {})[y] = case
    return study, found


SHIPPED = {}


def shipped(runs):
    """{(scene, reading): its voyage on the shipped course}."""
    if not SHIPPED:
        study, cases = courses(runs)
        SHIPPED.update({key: Voyage(study.run(cases[key][SHIPPED_Y[key[0]]])) for key in cases})
    return SHIPPED


def of_widths(widths):
    return f"{statistics.mean(widths):.1f} ({min(widths):.1f}–{max(widths):.1f})" if widths else "–"


MEASURES = [("largest mean over 0.1 s", "_N", max), ("90th percentile of it", "_N",
                                                     lambda v: statistics.quantiles(v, n=10)[-1]),
            ("mean of it", "_N", statistics.mean), ("largest j/τ_c", "_j_over_tau_c_N", max)]


def measured(voyage, is_removing):
    return {name: of(voyage.loads(is_removing, suffix)) for name, suffix, of in MEASURES}


def five_scenes(runs):
    rows = []
    for (name, reading), of in shipped(runs).items():
        widths = of.widths_in(30, SMALL_FLOES_END_M[name] - 30)
        forces = [f"{max(of.loads(is_removing, suffix)) / unit:.{digits}f}" for suffix, unit, digits in
                  (("_N", 1e3, 0), ("_max_N", 1e3, 0), ("_j_over_tau_c_N", 1e6, 2)) for is_removing in (True, False)]
        rows.append([name, reading, f"{of.first_break:.0f}", str(len(of.fractures("bend"))), str(len(of.split_times)),
                     ", ".join(f"{t:.0f}" for t in of.split_times), *forces,
                     f"{statistics.mean(widths):.1f}" if widths else "closed", f"{of.speed_at(of.first_break):.2f}",
                     f"{of.forces['heading_deg'][-1]:.0f}", f"{of.forces['x_m'][-1]:.0f}"])
    return Table(["scene", "A", "breaking starts [s]", "bends", "splits", "splits at [s]",
                  "ice force removing, mean over 0.1 s [kN]", "breaking", "removing, single step [kN]", "breaking",
                  "j/τ_c removing [MN]", "breaking", "channel in the small floes [m]", "speed at the plates [m/s]",
                  "heading at 550 s [°]", "ship at x [m]"], rows)


def removal(runs):
    """The mean force that lets the ship arrive at the paper's time: d = v t + ½ (T − R) t² / m, to the ice that drifts
    towards it. Beside what the scene delivers until its own first fracture."""
    rows = []
    for name, (time, _) in PAPER_TIMES_S.items():
        way = SMALL_FLOES_END_M[name] - 0.05 * time
        needed = THRUST_N - 2 * MASS_KG * (way - START_SPEED * time) / time**2
        for reading in READINGS:
            of = shipped(runs)[name, reading]
            surge = -of.forces["surge_N"][of.forces["t_s"] < of.first_break]
            rows.append([name, f"{time}", f"{needed / 1e3:.1f}", reading, f"{of.first_break:.0f}",
                         f"{surge.mean() / 1e3:.1f}"])
    return Table(["scene", "breaking starts in the paper [s]", "mean removal force that takes [kN]", "A",
                  "breaking starts here [s]", "mean removal force here [kN]"], rows)


def small_width(voyage, name):
    widths = voyage.widths_in(0, SMALL_FLOES_END_M[name])
    return statistics.mean(widths) if widths else 0


def channel(runs):
    rows = []
    for name, side in (("fig6a", 10), ("fig4b", 15), ("fig4c", 15), ("fig6b", 20)):
        for reading in READINGS:
            of, end = shipped(runs)[name, reading], SMALL_FLOES_END_M[name]
            small, plates, c = of.widths_in(0, end), of.widths_in(end, end + 221), of.channel
            before = c["swept_ice_at_start_m2"] / c["swept_area_m2"]
            left = c["swept_ice_m2"] / c["swept_area_m2"]
            rows.append([name, str(side), reading, of_widths(small),
                         f"{statistics.mean(small) / c['beam_m']:.2f}" if small else "–", of_widths(plates),
                         f"{100 * before:.0f} → {100 * left:.1f}", f"{c['largest_floe_m']:.0f}"])
    return Table(["scene", "small floes [m]", "A", "width in the small floes [m]: mean (least–most)", "mean / beam",
                  "width between the plates [m]", "ice in the swept band [%]", "largest floe reaching into it [m]"],
                 rows)


def criterion(runs):
    """Both sides of Eq. (4) and of the true forces at the splits, and at the bend that came nearest to one."""
    ratio = lambda e: e["criterion"]["collision_force_N"] / max(1, e["criterion"]["splitting_force_N"])
    rows = []
    for (name, reading), of in shipped(runs).items():
        others = [e for e in of.fractures("bend") if e["criterion"]["splitting_force_N"] > 0]
        for e in of.fractures("split") + ([max(others, key=ratio)] if others else []):
            c = e["criterion"]
            why = "" if e["kind"] == "split" else "j/τ_c < F_s" if ratio(e) <= 1 else "would leave a sliver"
            rows.append([name, reading, f"{e['t_s']:.1f}", e["kind"], f"{c['collision_force_N'] / 1e6:.2f}",
                         f"{c['splitting_force_N'] / 1e6:.2f}", f"{c['crack_length_m']:.1f}",
                         f"{c['crack_width_m']:.1f}", f"{of.force_at(e['t_s']) / 1e3:.0f}",
                         f"{c['contact_force_N'] / 1e3:.2g}", f"{c.get('opening_force_N', 0) / 1e3:.2g}",
                         f"{c.get('opening_capacity_N', 0) / 1e3:.0f}", why])
    return Table(["scene", "A", "t [s]", "what broke", "j/τ_c [MN]", "F_s = n L h σ_t [MN]", "L [m]", "W [m]",
                  "ice force, mean of that 0.1 s [kN]", "true force of the contact [kN]",
                  "of it opening the crack [kN]", "F_max [kN]", "why no split"], rows)


def splits_aside(runs):
    """{(scene, reading): the splits on the shipped course and on those within 3 m of it}."""
    study, cases = courses(runs)
    return {key: [int(study.table["splits"][of[SHIPPED_Y[key[0]] + aside]]) for aside in COURSES_M]
            for key, of in cases.items()}


def near_courses(runs):
    rows = [[name, reading, *map(str, counts), f"{counts.count(2)} of {len(counts)}"]
            for (name, reading), counts in splits_aside(runs).items()]
    return Table(["scene", "A", *(f"{aside:+d} m" if aside else "as shipped" for aside in COURSES_M), "two splits on"],
                 rows)


def spread(values, factor=1.0, digits=0):
    """Median (least–most)."""
    values = [value for value in values if not math.isnan(value)]
    if not values:
        return "–"
    low, middle, high = (f"{factor * v:.{digits}f}" for v in (min(values), statistics.median(values), max(values)))
    return f"{middle} ({low}–{high})"


def all_courses(runs):
    study, cases = courses(runs)
    rows = []
    for name in SCENES:
        of = list(cases[name, "plan"].values())
        splits = [int(study.table["splits"][case]) for case in of]
        numbers = lambda column: [float(study.table[column][case]) for case in of]
        stuck = sum(study.table["outcome"][case] == "stuck" for case in of)
        rows.append([name, str(len(of)), str(stuck), *(str(splits.count(n)) for n in (0, 1, 2)),
                     str(sum(n > 2 for n in splits)), spread(numbers("bends")),
                     spread(numbers("resistance_peak_N"), 1e-6, 2), spread(numbers("time_to_plates_s")),
                     spread(numbers("final_x_m"))])
    return Table(["scene", "courses", "stuck", "no split", "1 split", "2 splits", "more", "bends",
                  "peak resistance [MN]", "stem at x = 206 m [s]", "ship at x [m] (550 s)"], rows)


def in_order(values):
    return all(a < b for a, b in zip(values, values[1:]))


def verdict(holds):
    """By all measures, by none, or by some."""
    return "agrees" if all(holds) else "not settled" if any(holds) else "differs"


def alike(a, b):
    return abs(a / b - 1) <= ALIKE


def by_measures(holds, show):
    """A finding on forces by each measure: (verdict, text)."""
    decided = [(measure, holds(measure), show(measure)) for measure, _, _ in MEASURES]
    return verdict([h for _, h, _ in decided]), "; ".join(f"{m}: {'yes' if h else 'no'} ({t})" for m, h, t in decided)


def findings_on_forces(of):
    removing = {name: measured(of[name], True) for name in SCENES}
    breaking = {name: measured(of[name], False) for name in SCENES}
    kilo = lambda values: "/".join(f"{v / 1e3:.0f}" for v in values) + " kN"
    by_size = ("fig6a", "fig4c", "fig6b")
    yield by_measures(lambda m: all(removing[n][m] < breaking[n][m] for n in SCENES),
                      lambda m: f"at most {100 * max(removing[n][m] / breaking[n][m] for n in SCENES):.0f} % of it")
    yield by_measures(lambda m: in_order([removing[n][m] for n in by_size]),
                      lambda m: kilo(removing[n][m] for n in by_size))
    yield by_measures(lambda m: alike(breaking["fig6a"][m], breaking["fig6b"][m]),
                      lambda m: kilo(breaking[n][m] for n in ("fig6a", "fig6b")))
    yield by_measures(lambda m: min(breaking["fig4b"][m], breaking["fig4c"][m]) > breaking["fig4a"][m],
                      lambda m: kilo(breaking[n][m] for n in ("fig4a", "fig4b", "fig4c")))


def findings(runs, reading):
    """(verdict, measure) of the ten findings by a reading."""
    of = {name: shipped(runs)[name, reading] for name in SCENES}
    yield from findings_on_forces(of)
    counts = [len(of[n].split_times) for n in SCENES]
    near = [count == 2 for n in SCENES for count in splits_aside(runs)[n, reading]]
    yield (verdict([c == 2 for c in counts]),
           f"{'/'.join(map(str, counts))} splits; two on {sum(near)} of {len(near)} courses ± 3 m")
    headings = [of[n].forces["heading_deg"][-1] for n in ("fig4b", "fig4c")]
    yield (verdict([headings[1] < headings[0] - 5]),
           f"heading at 550 s {headings[1]:.0f}°, without drift {headings[0]:.0f}°")
    widths = [small_width(of[n], n) for n in ("fig6a", "fig4c", "fig6b")]
    yield verdict([in_order(widths)]), "/".join(f"{w:.0f}" for w in widths) + " m"
    starts = {n: of[n].first_break for n in PAPER_TIMES_S}
    yield (verdict([alike(starts[n], PAPER_TIMES_S[n][0]) for n in starts]),
           " and ".join(f"{t:.0f} s" for t in starts.values()))
    times = {n: of[n].split_times for n in PAPER_TIMES_S}
    yield (verdict([len(times[n]) > i and alike(times[n][i], t)
                    for n in times for i, t in enumerate(PAPER_TIMES_S[n][1])]),
           "; ".join(", ".join(f"{t:.0f}" for t in times[n]) or "none" for n in times) + " s")
    bends = [len(of[n].fractures("bend")) for n in SCENES]
    yield verdict([b > 0 for b in bends]), "/".join(map(str, bends)) + " cusps"


FINDINGS = ["removal forces are smaller than breaking forces", "removal peaks grow with floe size (6a, 4c, 6b)",
            "the peaks at the plates are about equal in 6a and 6b",
            "larger forces under constant thrust (4b, 4c) than at constant speed (4a)", "two splits in every run",
            "the course is turned by the drift in 4c", "a wider channel with larger floes (6a, 4c, 6b)",
            "breaking starts at 231 s (6a), 293 s (6b)", "splits at 231 and 366 s (6a), 367 and 454 s (6b)",
            "bending in every run"]


def scorecard(runs):
    columns = [list(findings(runs, reading)) for reading in READINGS]
    rows = [[str(i + 1), FINDINGS[i], *(f"**{v}**: {text}" for v, text in cells)]
            for i, cells in enumerate(zip(*columns))]
    totals = [", ".join(f"{sum(v == kind for v, _ in column)} {words}" for kind, words in
                        (("agrees", "agree"), ("differs", "differ"), ("not settled", "not settled")))
              for column in columns]
    return Table(["", "finding of the paper", *(f"A = {reading}" for reading in READINGS)],
                 [*rows, ["", "**in all**", *totals]])


TABLES = {"scorecard": scorecard, "channel": channel, "five-scenes": five_scenes, "removal": removal,
          "criterion": criterion, "near-courses": near_courses, "courses": all_courses}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
