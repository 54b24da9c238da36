"""`polynya study` for the tests, and small studies."""
import json
import sys

import pytest

from program import ended, rows

SCENE = """// a ship and a plate
{"time": {"until_s": 8, "step_s": 0.01}, "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27},
  "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-61, 75],
  "propulsion": {"constant_speed_m_per_s": 1}}],
 "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 150}}]}"""
OF_PYTHON = [sys.executable, "-m", "polynya.study"]


def study(*words, code=0, by=ended):
    """What it prints, where it ends with that code."""
    ran = by("study", *words)
    assert ran.returncode == code, ran.stdout + ran.stderr
    return ran.stdout + ran.stderr


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plate.json").write_text(SCENE)
    return tmp_path


def write_study(folder, name="s", **keys):
    path = folder / f"{name}.json"
    path.write_text(json.dumps({"scene": "plate.json", **keys}))
    return path


def planned(folder, name="s", *words, **keys):
    """The folder of a study that is planned without a trial."""
    study("plan", write_study(folder, name, **keys), *words, "--trial-seconds", 0)
    return folder / "studies" / name


def gathered(study_folder):
    """The table of a study whose cases are run, those that are left."""
    study("run", study_folder, "--quiet")
    study("gather", study_folder)
    return rows(study_folder / "table.csv")


def files_of(case):
    """What a case's run wrote, but for the times by the clock, and the checksums, which are of these too."""
    found = {path.name: path.read_bytes() for path in (case / "run").iterdir() if path.name != "checksums.txt"}
    for name, content in (("summary.json", found["summary.json"]), ("case.json", (case / "case.json").read_bytes())):
        members = json.loads(content).items()
        found[name] = {k: v for k, v in members if k not in ("wall_time_s", "real_time_factor", "elapsed_s")}
    return found
