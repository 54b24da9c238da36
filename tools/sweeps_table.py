"""Do more sweeps of the impulse solver change what a ship feels? Runs field-10000 over several seeds for each number
of sweeps and prints the means with their standard errors, as a table of docs/performance.md.

Usage: python3 tools/sweeps_table.py [BINARY]      default build/release/app/polynya; two to three minutes
"""

import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
binary = sys.argv[1] if len(sys.argv) > 1 else str(root / "build/release/app/polynya")
seeds = range(1, 11)
scene = (root / "scenes/field-10000.json").read_text()


def run_once(folder, sweeps, seed):
    file = folder / "scene.json"
    text, count = re.subn(r'"name": "field-10000",', f'\\g<0> "contact": {{"iterations": {sweeps}}},', scene)
    assert count == 1
    file.write_text(text)
    run = folder / "run"
    words = ["--until", "300", "--seed", str(seed), "--out", str(run), "--overwrite"]
    subprocess.run([binary, "run", str(file), *words], check=True, capture_output=True)
    with open(run / "forces.csv", newline="") as forces:
        surge = statistics.fmean(-float(row["surge_N"]) for row in csv.DictReader(forces))
    summary = json.loads((run / "summary.json").read_text())
    return surge / 1e3, summary["steps"], summary["counts"]


def mean_and_error(values):
    return f"{statistics.fmean(values):.1f} ± {statistics.stdev(values) / len(values) ** 0.5:.1f}"


print("| sweeps | mean surge force, kN | cusps | steps that used them all, % | largest left over: median run, worst "
      "run, m/s |")
print("|---|---|---|---|---|")
with tempfile.TemporaryDirectory() as name:
    for sweeps in (30, 120, 400):
        runs = [run_once(pathlib.Path(name), sweeps, seed) for seed in seeds]
        counts = [c for _, _, c in runs]
        unconverged = statistics.fmean(c["unconverged_steps"] / steps for _, steps, c in runs)
        print(
            f"| {sweeps} | {mean_and_error([surge for surge, _, _ in runs])} "
            f"| {mean_and_error([c['bends'] for c in counts])} | {100 * unconverged:.0f} "
            f"| {statistics.median(c['largest_left_over_m_per_s'] for c in counts):.2g}, "
            f"{max(c['largest_left_over_m_per_s'] for c in counts):.2g} |"
        )
