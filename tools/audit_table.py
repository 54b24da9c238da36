"""Runs every scene and prints how far energy and momentum are from their accounts, as a table of docs/reliability.md.

Usage: python3 tools/audit_table.py [BINARY]      default build/release/app/polynya
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
binary = sys.argv[1] if len(sys.argv) > 1 else str(root / "build/release/app/polynya")
print("| scene | simulated, s | energy turned over, MJ | imbalance / turnover | momentum imbalance / turnover |")
print("|---|---|---|---|---|")
with tempfile.TemporaryDirectory() as folder:
    for scene in sorted((root / "scenes").glob("*.json")):
        run = pathlib.Path(folder) / scene.stem
        subprocess.run([binary, "run", str(scene), "--out", str(run)], check=True, capture_output=True)
        summary = json.loads((run / "summary.json").read_text())
        energy, momentum = summary["energy"], summary["momentum"]
        off = abs(energy["imbalance_J"]) / max(energy["turnover_J"], 1e-300)
        momentum_off = math.hypot(*momentum["imbalance_Ns"]) / max(momentum["turnover_Ns"], 1e-300)
        print(f"| {scene.stem} | {summary['sim_time_s']:g} | {energy['turnover_J'] / 1e6:.3g} | {off:.1e} | "
              f"{momentum_off:.1e} |")
