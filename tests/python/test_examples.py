"""The scripts of examples/, in their short forms: each runs, prints and draws."""
import os
import pathlib
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
DRAWN = {
    "first_run.py": "first-run.png",
    "python_pilot.py": "python-pilot.png",
    "loads_over_seeds.py": "loads-over-seeds.png",
    "cut_floe_outlines.py": "cut-floe-outlines.png",
    "h_v_curve.py": "h-v-curve.png",
    "film.py": "film.png",
    "couple_by_fmu.py": "couple-by-fmu.png",
    "train_by_evolution.py": "train-by-evolution.png",
    "study_by_openturns.py": "study-by-openturns.png",
    "study_by_optuna.py": "study-by-optuna.png",
}
OPTIONAL = {"study_by_openturns.py": "openturns", "study_by_optuna.py": "optuna"}


@pytest.mark.parametrize("script", DRAWN)
def test_an_example_runs_and_draws(script, tmp_path):
    if script in OPTIONAL:
        pytest.importorskip(OPTIONAL[script])
    done = subprocess.run([sys.executable, EXAMPLES / script, "--short", "--out", tmp_path],
                          capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == str(tmp_path / DRAWN[script])
    assert (tmp_path / DRAWN[script]).read_bytes()[:4] == b"\x89PNG"


def test_each_example_begins_with_what_it_shows_and_its_command():
    assert {path.name for path in EXAMPLES.glob("*.py")} == DRAWN.keys() | {"find_polynya.py"}
    for path in (EXAMPLES / name for name in DRAWN):
        lines = path.read_text().splitlines()
        assert lines[0] == "#!/usr/bin/python3" and lines[1].startswith('"""') and lines[1].endswith(".")
        assert lines[3].strip().startswith(f"python3 examples/{path.name} ") and os.access(path, os.X_OK)
