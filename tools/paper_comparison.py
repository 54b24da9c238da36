#!/usr/bin/env python3
"""Runs the five scenes of the paper by both readings of Eq. (6) and writes the measured tables into
docs/paper-comparison.md.

    ./quickstart                      (or build the release preset)
    python3 tools/paper_comparison.py             everything, 70 runs
    python3 tools/paper_comparison.py --channel   only the widths of the channels
    python3 tools/paper_comparison.py --scenes    only the five shipped scenes: prints when each splits, writes nothing

Everything between the page's pairs of markers is replaced; the text around them is written by hand.
"""
import argparse
import concurrent.futures
import csv
import json
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
POLYNYA = ROOT / "build/release/app/polynya"
PAGE = ROOT / "docs/paper-comparison.md"
SCENES = ["fig4a", "fig4b", "fig4c", "fig6a", "fig6b"]
READINGS = ["plan", "edge"]
COURSES_M = [-3, -2, -1, 0, 1, 2, 3]
SMALL_FLOES_END_M = {"fig4a": 206, "fig4b": 206, "fig4c": 206, "fig6a": 202.5, "fig6b": 216}
# The paper's times of first breaking and of splits [s].
PAPER_TIMES_S = {"fig6a": (231, (231, 366)), "fig6b": (293, (367, 454))}
MASS_KG, THRUST_N, START_SPEED, ALIKE = 1e7, 2e4, 1.0, 0.1  # ALIKE: numbers within this share of the paper's agree


def run(arguments, scene: pathlib.Path, folder: pathlib.Path) -> dict:
    subprocess.run([arguments.polynya, "run", scene, "--out", folder, "--overwrite", "--progress", "none"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(folder / "forces.csv") as file:
        rows = [{k: (float(v) if k != "ship" else v) for k, v in row.items()} for row in csv.DictReader(file)]
    measured, stations = channel(arguments, folder)
    result = {
        "channel": measured,
        "stations": stations,
        "summary": json.loads((folder / "summary.json").read_text()),
        "scene": json.loads((folder / "scene.json").read_text()),
        "events": [json.loads(line) for line in (folder / "events.ndjson").read_text().splitlines()],
        "forces": rows,
    }
    shutil.rmtree(folder)
    return result


def variant(name: str, reading: str, aside_m: float, folder: pathlib.Path) -> pathlib.Path:
    """The paper's scene by a reading, with the ship on a course beside its own."""
    text = (ROOT / f"scenes/sawamura2017-{name}.json").read_text()
    text, count = re.subn(r'"drag_area": "[a-z]+"', f'"drag_area": "{reading}"', text)
    course = re.search(r'"position_m": \[-60, ([0-9.]+)\]', text)
    assert count == 1 and course
    text = text.replace(course[0], f'"position_m": [-60, {float(course[1]) + aside_m:g}]')
    path = folder / f"{name}-{reading}-{aside_m}.json"
    path.write_text(text)
    return path


def run_all(arguments, keys: list, folder: pathlib.Path) -> dict:
    """The results of (scene, reading, metres aside)."""
    def one(key):
        return run(arguments, variant(*key, folder), folder / "-".join(str(part) for part in key))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        return dict(zip(keys, pool.map(one, keys)))


def channel(arguments, folder: pathlib.Path) -> tuple:
    """What `polynya channel` measures: its object, and its stations with ice on both sides."""
    printed = subprocess.run([arguments.polynya, "channel", folder, "--format", "json"], check=True,
                             capture_output=True).stdout
    with open(folder / "channel.csv") as file:
        stations = [{k: float("nan" if v == "null" else v) for k, v in row.items()} for row in csv.DictReader(file)]
    return json.loads(printed), [s for s in stations if s["has_port_ice"] and s["has_starboard_ice"]]


def widths_in(result: dict, low_m: float, high_m: float) -> list:
    """Widths of the stations whose ice, carried back with the drift, was between two x at the start [m]."""
    drift = result["scene"]["water"]["drift_m_per_s"]
    end_s = result["forces"][-1]["t_s"]
    return [s["width_m"] for s in result["stations"] if low_m < s["x_m"] - drift[0] * end_s < high_m]


def of_widths(widths: list) -> str:
    return f"{statistics.mean(widths):.1f} ({min(widths):.1f}–{max(widths):.1f})" if widths else "–"


def speed_at(result: dict, time_s: float) -> float:
    return min(result["forces"], key=lambda row: abs(row["t_s"] - time_s))["speed_m_per_s"]


def force_at(result: dict, time_s: float) -> float:
    """The ice's true force on the ship, the mean of the recorded interval [N]."""
    row = next((r for r in result["forces"] if r["t_s"] >= time_s - 1e-9), result["forces"][-1])
    return (row["surge_N"]**2 + row["sway_N"]**2)**0.5


def fractures(result: dict, kind: str = "") -> list:
    return [e for e in result["events"] if e["kind"] in ("bend", "split") and kind in ("", e["kind"])]


def first_break(result: dict) -> float:
    return fractures(result)[0]["t_s"] if fractures(result) else float("inf")


def loads(result: dict, is_removing: bool, suffix: str) -> list:
    """The size of (surge, sway) in all rows, by the name of the columns: "_N" the mean over 0.1 s, "_max_N" a single
    step."""
    first = first_break(result)
    # The ship presses on a plate for a moment before it breaks: removal ends 5 s before the first fracture.
    rows = [r for r in result["forces"] if (0 < r["t_s"] < first - 5 if is_removing else r["t_s"] >= first)]
    return [max(abs(row["surge" + suffix]), abs(row["sway" + suffix])) for row in rows] or [0]


MEASURES = [("largest mean over 0.1 s", "_N", max), ("90th percentile of it", "_N",
                                                     lambda v: statistics.quantiles(v, n=10)[-1]),
            ("mean of it", "_N", statistics.mean), ("largest j/τ_c", "_j_over_tau_c_N", max)]


def measured(result: dict, is_removing: bool) -> dict:
    return {name: of(loads(result, is_removing, suffix)) for name, suffix, of in MEASURES}


def table(head: list, rows: list) -> str:
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def main_table(results: dict) -> str:
    rows = []
    for (name, reading, _), result in results.items():
        splits = [e["t_s"] for e in fractures(result, "split")]
        widths = widths_in(result, 30, SMALL_FLOES_END_M[name] - 30)
        forces = [f"{max(loads(result, is_removing, suffix)) / unit:.{digits}f}" for suffix, unit, digits in
                  (("_N", 1e3, 0), ("_max_N", 1e3, 0), ("_j_over_tau_c_N", 1e6, 2)) for is_removing in (True, False)]
        first, last = first_break(result), result["forces"][-1]
        rows.append([name, reading, f"{first:.0f}", len(fractures(result, "bend")), len(splits),
                     ", ".join(f"{t:.0f}" for t in splits), *forces,
                     f"{statistics.mean(widths):.1f}" if widths else "closed", f"{speed_at(result, first):.2f}",
                     f"{last['heading_deg']:.0f}", f"{last['x_m']:.0f}"])
    return table(["scene", "A", "breaking starts, s", "bends", "splits", "splits at, s",
                  "ice force removing, mean over 0.1 s, kN", "breaking", "removing, single step, kN", "breaking",
                  "j/τ_c removing, MN", "breaking", "channel in the small floes, m", "speed at the plates, m/s",
                  "heading at 550 s, °", "ship at x, m"], rows)


def removal_table(results: dict) -> str:
    """The mean force that lets the ship arrive at the paper's time: d = v t + ½ (T − R) t² / m, to the ice that drifts
    towards it. Beside what the scene delivers until its own first fracture."""
    rows = []
    for name, (time, _) in PAPER_TIMES_S.items():
        way = SMALL_FLOES_END_M[name] - 0.05 * time
        needed = THRUST_N - 2 * MASS_KG * (way - START_SPEED * time) / time**2
        for reading in READINGS:
            result = results[name, reading, 0]
            first = first_break(result)
            surge = [-r["surge_N"] for r in result["forces"] if r["t_s"] < first]
            rows.append([name, f"{time}", f"{needed / 1e3:.1f}", reading, f"{first:.0f}",
                         f"{statistics.mean(surge) / 1e3:.1f}"])
    return table(["scene", "breaking starts in the paper, s", "mean removal force that takes, kN", "A",
                  "breaking starts here, s", "mean removal force here, kN"], rows)


def small_width(result: dict, name: str) -> float:
    widths = widths_in(result, 0, SMALL_FLOES_END_M[name])
    return statistics.mean(widths) if widths else 0


def channel_table(results: dict) -> str:
    rows = []
    for name, side in (("fig6a", 10), ("fig4b", 15), ("fig4c", 15), ("fig6b", 20)):
        for reading in READINGS:
            result = results[name, reading, 0]
            end = SMALL_FLOES_END_M[name]
            small, plates = widths_in(result, 0, end), widths_in(result, end, end + 221)
            c = result["channel"]
            before = c["swept_ice_at_start_m2"] / c["swept_area_m2"]
            left = c["swept_ice_m2"] / c["swept_area_m2"]
            rows.append([name, side, reading, of_widths(small), f"{statistics.mean(small) / c['beam_m']:.2f}"
                         if small else "–",
                         of_widths(plates), f"{100 * before:.0f} → {100 * left:.1f}", f"{c['largest_floe_m']:.0f}"])
    return table(["scene", "small floes, m", "A", "width in the small floes, m: mean (least–most)", "mean / beam",
                  "width between the plates, m", "ice in the swept band, %", "largest floe reaching into it, m"], rows)


def split_table(results: dict) -> str:
    """Both sides of Eq. (4) and of the true forces at the splits, and at the bend that came nearest to one."""
    ratio = lambda e: e["criterion"]["collision_force_N"] / max(1, e["criterion"]["splitting_force_N"])
    rows = []
    for (name, reading, _), result in results.items():
        shown = fractures(result, "split")
        others = [e for e in fractures(result, "bend") if e["criterion"]["splitting_force_N"] > 0]
        for e in shown + ([max(others, key=ratio)] if others else []):
            c = e["criterion"]
            why = "" if e["kind"] == "split" else "j/τ_c < F_s" if ratio(e) <= 1 else "would pare"
            rows.append([name, reading, f"{e['t_s']:.1f}", e["kind"], f"{c['collision_force_N'] / 1e6:.2f}",
                         f"{c['splitting_force_N'] / 1e6:.2f}", f"{c['crack_length_m']:.1f}",
                         f"{c['crack_width_m']:.1f}",
                         f"{force_at(result, e['t_s']) / 1e3:.0f}", f"{c['contact_force_N'] / 1e3:.2g}",
                         f"{c.get('opening_force_N', 0) / 1e3:.2g}", f"{c.get('opening_capacity_N', 0) / 1e3:.0f}",
                         why])
    return table(["scene", "A", "t, s", "what broke", "j/τ_c, MN", "F_s = n L h σ_t, MN", "L, m", "W, m",
                  "ice force, mean of that 0.1 s, kN", "true force of the contact, kN", "of it opening the crack, kN",
                  "F_max, kN", "why no split"],
                 rows)


def course_table(results: dict) -> str:
    rows = []
    for name in SCENES:
        for reading in READINGS:
            counts = [len(fractures(results[name, reading, aside], "split")) for aside in COURSES_M]
            rows.append([name, reading, *counts, f"{counts.count(2)} of {len(counts)}"])
    return table(["scene", "A"] + [f"{aside:+d} m" if aside else "as shipped" for aside in COURSES_M]
                 + ["two splits on"], rows)


def in_order(values: list) -> bool:
    return all(a < b for a, b in zip(values, values[1:]))


def verdict(holds: list) -> str:
    """By all measures, by none, or by some."""
    return "agrees" if all(holds) else "not settled" if any(holds) else "differs"


def forces_finding(results: dict, reading: str, holds, show) -> tuple:
    """A finding on forces by each measure: (verdict, text)."""
    decided = [(measure, holds(measure), show(measure)) for measure, _, _ in MEASURES]
    return verdict([h for _, h, _ in decided]), "; ".join(f"{m}: {'yes' if h else 'no'} ({t})" for m, h, t in decided)


def findings(results: dict, reading: str) -> list:
    """(verdict, measure) of the ten findings by a reading."""
    of = {name: results[name, reading, 0] for name in SCENES}
    removing = {name: measured(of[name], True) for name in SCENES}
    breaking = {name: measured(of[name], False) for name in SCENES}
    kN = lambda values: "/".join(f"{v / 1e3:.0f}" for v in values)
    alike = lambda a, b: abs(a / b - 1) <= ALIKE
    found = [forces_finding(
        of, reading, lambda m: all(removing[n][m] < breaking[n][m] for n in SCENES),
        lambda m: f"at most {100 * max(removing[n][m] / breaking[n][m] for n in SCENES):.0f} % of it")]
    found.append(forces_finding(of, reading, lambda m: in_order([removing[n][m] for n in ("fig6a", "fig4c", "fig6b")]),
                                lambda m: kN(removing[n][m] for n in ("fig6a", "fig4c", "fig6b")) + " kN"))
    found.append(forces_finding(of, reading, lambda m: alike(breaking["fig6a"][m], breaking["fig6b"][m]),
                                lambda m: kN(breaking[n][m] for n in ("fig6a", "fig6b")) + " kN"))
    found.append(forces_finding(of, reading, lambda m: min(breaking["fig4b"][m],
                                                           breaking["fig4c"][m]) > breaking["fig4a"][m],
                                lambda m: kN(breaking[n][m] for n in ("fig4a", "fig4b", "fig4c")) + " kN"))
    counts = [len(fractures(of[n], "split")) for n in SCENES]
    courses = [len(fractures(results[n, reading, aside], "split")) == 2 for n in SCENES for aside in COURSES_M]
    found.append((verdict([c == 2 for c in counts]), f"{'/'.join(map(str, counts))} splits; two on {sum(courses)} of "
                  f"{len(courses)} courses ± 3 m"))
    headings = [of[n]["forces"][-1]["heading_deg"] for n in ("fig4b", "fig4c")]
    found.append((verdict([headings[1] < headings[0] - 5]),
                  f"heading at 550 s {headings[1]:.0f}°, without drift {headings[0]:.0f}°"))
    widths = [small_width(of[n], n) for n in ("fig6a", "fig4c", "fig6b")]
    found.append((verdict([in_order(widths)]), "/".join(f"{w:.0f}" for w in widths) + " m"))
    starts = {n: first_break(of[n]) for n in PAPER_TIMES_S}
    found.append((verdict([alike(starts[n], PAPER_TIMES_S[n][0]) for n in starts]),
                  " and ".join(f"{t:.0f} s" for t in starts.values())))
    times = {n: [e["t_s"] for e in fractures(of[n], "split")] for n in PAPER_TIMES_S}
    near = [len(times[n]) > i and alike(times[n][i], t) for n in times for i, t in enumerate(PAPER_TIMES_S[n][1])]
    found.append((verdict(near), "; ".join(", ".join(f"{t:.0f}" for t in times[n]) or "none" for n in times) + " s"))
    bends = [len(fractures(of[n], "bend")) for n in SCENES]
    found.append((verdict([b > 0 for b in bends]), "/".join(map(str, bends)) + " cusps"))
    return found


FINDINGS = ["removal forces are smaller than breaking forces", "removal peaks grow with floe size (6a, 4c, 6b)",
            "the peaks at the plates are about equal in 6a and 6b",
            "larger forces under constant thrust (4b, 4c) than at constant speed (4a)", "two splits in every run",
            "the course is turned by the drift in 4c", "a wider channel with larger floes (6a, 4c, 6b)",
            "breaking starts at 231 s (6a), 293 s (6b)", "splits at 231 and 366 s (6a), 367 and 454 s (6b)",
            "bending in every run"]


def scorecard(results: dict) -> str:
    columns = [findings(results, reading) for reading in READINGS]
    rows = [[i + 1, FINDINGS[i], *(f"**{v}**: {text}" for v, text in cells)] for i, cells in enumerate(zip(*columns))]
    totals = [", ".join(f"{sum(v == kind for v, _ in column)} {words}" for kind, words in
                        (("agrees", "agree"), ("differs", "differ"), ("not settled", "not settled")))
                        for column in columns]
    return table(["", "finding of the paper", *(f"A = {reading}" for reading in READINGS)],
                 rows + [["", "**in all**", *totals]])


def write_between(name: str, text: str) -> None:
    page = PAGE.read_text()
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    head, rest = page.split(begin)
    PAGE.write_text(head + begin + "\n\n" + text + "\n\n" + end + rest.split(end)[1])
    print(text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--polynya", type=pathlib.Path, default=POLYNYA)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--channel", action="store_true", help="only the table of channels")
    parser.add_argument("--scenes", action="store_true", help="only the shipped scenes; prints when they split")
    arguments = parser.parse_args()
    if not arguments.polynya.exists():
        print(f"{arguments.polynya} is not there: ./quickstart builds it", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        if arguments.scenes:
            for (name, _, _), result in run_all(arguments, [(name, "plan", 0) for name in SCENES], folder).items():
                splits = fractures(result, "split")
                print(f"{name}: {len(splits)} splits, at " + ", ".join(f"{e['t_s']:.1f} s" for e in splits))
            return 0
        shipped = run_all(arguments, [(name, reading, 0) for name in SCENES for reading in READINGS], folder)
        write_between("channel", channel_table(shipped))
        if arguments.channel:
            return 0
        asides = [(name, reading, aside) for name in SCENES for reading in READINGS for aside in COURSES_M if aside]
        results = shipped | run_all(arguments, asides, folder)
        write_between("scorecard", scorecard(results))
        write_between("measured", "\n\n".join([
            "### The five scenes", main_table(shipped), "### The force that removing floes takes",
            removal_table(shipped),
            "### Both sides of the splitting criterion", split_table(shipped),
            "### Splits on courses beside the shipped one",
            course_table(results)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
