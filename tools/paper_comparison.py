#!/usr/bin/env python3
"""Runs the five scenes of the paper and writes the measured tables into docs/paper-comparison.md.

    ./quickstart                      (or build the release preset)
    python3 tools/paper_comparison.py             everything
    python3 tools/paper_comparison.py --channel   only the widths of the channels

Everything between the page's pairs of markers is replaced; the text around them is written by hand.
"""
import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
POLYNYA = ROOT / "build/release/app/polynya"
PAGE = ROOT / "docs/paper-comparison.md"
SCENES = ["fig4a", "fig4b", "fig4c", "fig6a", "fig6b"]
SMALL_FLOES_END_M = {"fig4a": 206, "fig4b": 206, "fig4c": 206, "fig6a": 202.5, "fig6b": 216}


def run(scene: pathlib.Path, folder: pathlib.Path) -> dict:
    subprocess.run([POLYNYA, "run", scene, "--out", folder, "--overwrite", "--progress", "none"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(folder / "forces.csv") as file:
        rows = [{k: (float(v) if k != "ship" else v) for k, v in row.items()} for row in csv.DictReader(file)]
    measured, stations = channel(folder)
    return {
        "channel": measured,
        "stations": stations,
        "summary": json.loads((folder / "summary.json").read_text()),
        "scene": json.loads((folder / "scene.json").read_text()),
        "events": [json.loads(line) for line in (folder / "events.ndjson").read_text().splitlines()],
        "forces": rows,
    }


def variant(name: str, lateral_m: float, folder: pathlib.Path) -> pathlib.Path:
    """The paper's scene with the ship on another course."""
    text = (ROOT / f"scenes/sawamura2017-{name}.json").read_text()
    text, count = re.subn(r'"position_m": \[-60, [0-9.]+\]', f'"position_m": [-60, {lateral_m}]', text)
    assert count == 1
    path = folder / f"{name}-{lateral_m}.json"
    path.write_text(text)
    return path


def channel(folder: pathlib.Path) -> tuple:
    """What `polynya channel` measures: its object, and its stations with ice on both sides."""
    told = subprocess.run([POLYNYA, "channel", folder, "--format", "json"], check=True, capture_output=True).stdout
    with open(folder / "channel.csv") as file:
        stations = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    return json.loads(told), [s for s in stations if s["has_port_ice"] and s["has_starboard_ice"]]


def widths_in(result: dict, low_m: float, high_m: float) -> list:
    """Widths of the stations whose ice, carried back with the drift, was between two x at the start [m]."""
    drift = result["scene"]["water"]["drift_m_per_s"]
    end_s = result["forces"][-1]["t_s"]
    return [s["width_m"] for s in result["stations"] if low_m < s["x_m"] - drift[0] * end_s < high_m]


def of_widths(widths: list) -> str:
    return f"{statistics.mean(widths):.1f} ({min(widths):.1f}–{max(widths):.1f})" if widths else "–"


def speed_at(result: dict, time_s: float) -> float:
    return min(result["forces"], key=lambda row: abs(row["t_s"] - time_s))["speed_m_per_s"]


def peak(rows: list, suffix: str) -> float:
    """The largest surge or sway of a kind by magnitude: "_N" the mean over 0.1 s, "_max_N" a single step."""
    return max(max(abs(row["surge" + suffix]), abs(row["sway" + suffix])) for row in rows)


def table(head: list, rows: list) -> str:
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def main_table(results: dict) -> str:
    rows = []
    for name, result in results.items():
        fractures = [e for e in result["events"] if e["kind"] in ("bend", "split")]
        first = fractures[0]["t_s"] if fractures else float("nan")
        # The ship presses on a plate for a moment before it breaks: removal ends 5 s before the first fracture.
        removal = [r for r in result["forces"] if 0 < r["t_s"] < first - 5]
        breaking = [r for r in result["forces"] if r["t_s"] >= first]
        loads = [f"{peak(rows, suffix) / unit:.{digits}f}" for suffix, unit, digits in
                 (("_N", 1e3, 0), ("_max_N", 1e3, 0), ("_j_over_tau_c_N", 1e6, 2)) for rows in (removal, breaking)]
        splits = [e["t_s"] for e in fractures if e["kind"] == "split"]
        widths = widths_in(result, 30, SMALL_FLOES_END_M[name] - 30)
        last = result["forces"][-1]
        rows.append([
            name, f"{first:.0f}", sum(e["kind"] == "bend" for e in fractures), len(splits),
            ", ".join(f"{t:.0f}" for t in splits), *loads,
            f"{statistics.mean(widths):.1f}" if widths else "closed", f"{speed_at(result, first):.2f}",
            f"{last['heading_deg']:.0f}", f"{last['x_m']:.0f}"])
    return table(["scene", "breaking starts, s", "bends", "splits", "splits at, s",
                  "ice force removing, mean over 0.1 s, kN", "breaking", "removing, single step, kN", "breaking",
                  "j/τ_c removing, MN", "breaking", "channel in the small floes, m", "speed at the plates, m/s",
                  "heading at 550 s, °", "ship at x, m"], rows)


def channel_table(results: dict) -> str:
    rows = []
    for name, side in (("fig6a", 10), ("fig4b", 15), ("fig4c", 15), ("fig6b", 20)):
        result = results[name]
        end = SMALL_FLOES_END_M[name]
        small, plates = widths_in(result, 0, end), widths_in(result, end, end + 221)
        c = result["channel"]
        before = c["swept_ice_at_start_m2"] / c["swept_area_m2"]
        left = c["swept_ice_m2"] / c["swept_area_m2"]
        rows.append([name, side, of_widths(small), f"{statistics.mean(small) / c['beam_m']:.2f}" if small else "–",
                     of_widths(plates), f"{100 * before:.0f} → {100 * left:.1f}", f"{c['largest_floe_m']:.0f}"])
    return table(["scene", "small floes, m", "width in the small floes, m: mean (least–most)", "mean / beam",
                  "width between the plates, m", "ice in the swept band, %", "largest floe reaching into it, m"], rows)


def split_table(results: dict) -> str:
    """Both sides of Eq. (4) at the splits, and at the fracture that came nearest to one among the others."""
    rows = []
    for name, result in results.items():
        plates = [e for e in result["events"] if e["kind"] in ("bend", "split")]
        ratio = lambda e: e["criterion"]["collision_force_N"] / e["criterion"]["splitting_force_N"]
        can_crack = lambda e: e["criterion"]["crack_length_m"] >= e["criterion"]["breakable_size_m"]
        shown = [e for e in plates if e["kind"] == "split"]
        # Beside the splits: of the bends with a crack long enough to count, what came nearest to one, in the whole run
        # and after its last split.
        others = [e for e in plates if e["kind"] == "bend" and can_crack(e)]
        after = [e for e in others if not shown or e["t_s"] > shown[-1]["t_s"]]
        for candidates in (others, after):
            if candidates and max(candidates, key=ratio) not in shown:
                shown.append(max(candidates, key=ratio))
        for e in shown:
            c = e["criterion"]
            why = "" if e["kind"] == "split" else "j/τ_c < F_s"
            rows.append([name, f"{e['t_s']:.1f}", e["kind"], f"{c['collision_force_N'] / 1e6:.2f}",
                         f"{c['splitting_force_N'] / 1e6:.2f}", f"{c['crack_length_m']:.1f}", why])
    return table(["scene", "t, s", "what broke", "j/τ_c, MN", "F_s = n L h σ_t, MN", "L, m", "why no split"], rows)


def course_table(folder: pathlib.Path) -> str:
    rows = []
    for name, courses in (("fig4b", [140, 145, 148, 149, 150, 151, 152, 155, 160]),
                          ("fig4c", [140, 144, 145, 146, 147, 148, 150]), ("fig6a", [144, 145, 146, 147, 148, 150])):
        for lateral in courses:
            result = run(variant(name, lateral, folder), folder / "run")
            counts, last = result["summary"]["counts"], result["forces"][-1]
            rows.append([name, lateral, counts["bends"], counts["splits"], f"{last['x_m']:.0f}",
                         f"{last['heading_deg']:.0f}"])
    return table(["scene", "ship starts at y, m", "bends", "splits", "ship at x, m (550 s)", "heading, °"], rows)


def write_between(name: str, text: str) -> None:
    page = PAGE.read_text()
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    head, rest = page.split(begin)
    PAGE.write_text(head + begin + "\n\n" + text + "\n\n" + end + rest.split(end)[1])
    print(text)


def main() -> int:
    if not POLYNYA.exists():
        print(f"{POLYNYA} is not there: ./quickstart builds it", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        results = {name: run(ROOT / f"scenes/sawamura2017-{name}.json", folder / name) for name in SCENES}
        write_between("channel", channel_table(results))
        if "--channel" in sys.argv[1:]:
            return 0
        write_between("measured", "\n\n".join([
            "### The five scenes", main_table(results), "### Both sides of the splitting criterion",
            split_table(results), "### What the course does", course_table(folder)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
