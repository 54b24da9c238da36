"""Damaged folders of runs and studies: every command in Python says which file is damaged, and none waits for ever or
ends with a defect of its own."""
import json
import os
import shutil

import pytest

import damage
from program import BREAKER, ended, started, succeeded

COUNT = int(os.environ.get("POLYNYA_DAMAGED_FOLDERS", "40"))
LONGEST = 120  # a command that takes longer waits for something [s]
CODES = {0, 4, 5, 75}  # done, or a case has failed, damaged, or a case is to be continued
MOORED = {"name": "moored", "hull": {"length_m": 40, "beam_m": 12, "entrance_angle_deg": 40, "draught_m": 5,
                                     "block_coefficient": 0.65},
          "propulsion": {"thrust_N": 0}, "water": {"model": "manoeuvring"}, "panels": {"length_m": 2},
          "mooring": {"surge_stiffness_N_per_m": 2e5, "sway_stiffness_N_per_m": 2e5, "yaw_stiffness_Nm_per_rad": 1e9}}
SCENE = {
    "name": "whole",
    "time": {"step_s": 0.02, "until_s": 12},
    "record": {"forces_interval_s": 0.2, "frames_interval_s": 1, "contacts": "all"},
    "water": {"drift_m_per_s": [-0.5, 0]},
    "ice": {"thickness_m": 0.5},
    "ships": [MOORED, {**BREAKER, "position_m": [70, 40], "heading_deg": -90}],
    "floes": [{"rectangle": {"corner_m": [22, -30], "size_m": [40, 60]}},
              {"rectangle": {"corner_m": [64, -60], "size_m": [12, 12]}},
              {"rectangle": {"corner_m": [78, -20], "size_m": [15, 15]}}],
}
GATES = ["--upstream", "70", "--near", "25", "--width", "80", "--body", "moored"]
STUDY = {"name": "whole", "scene": "scene.json", "grid": {"ice.thickness_m": [0.4, 0.8]},
         "set": {"time.until_s": 3}, "keep": "all", "collect": {"ship": "moored", "loads": ["surge_N"]}}
OF_RUNS = [["loads", "it", "--out", "out"], ["management", "it", "--json", *GATES], ["figures", "it", "--out", "out"],
           ["movie", "it", "--out", "one.png", "--size", "320x320"]]
OF_STUDIES = [["loads", "it", "--out", "out"], ["study", "gather", "it"], ["study", "report", "it"],
              ["study", "run", "it", "--jobs", "1", "--quiet"]]


def some(commands, number):
    """All of them in the long trial; else one, each in turn: what reads a file is the same for all."""
    return commands if COUNT > 100 else [commands[number % len(commands)]]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A folder with a run, its channel in it, and a study."""
    home = tmp_path_factory.mktemp("whole")
    (home / "scene.json").write_text(json.dumps(SCENE))
    (home / "study.json").write_text(json.dumps(STUDY))
    succeeded("run", "scene.json", "--out", "run", "--no-map", cwd=home)
    succeeded("channel", "run", "--ship", "breaker", cwd=home)
    succeeded("study", "plan", "study.json", "--trial-seconds", "0", "--out", "study", cwd=home)
    succeeded("study", "run", "study", "--jobs", "1", "--quiet", cwd=home)
    succeeded("study", "gather", "study", cwd=home)
    return home


def check(words, folder, path, what):
    """One command over a damaged folder: it ends, with an exit code of its own, and names the file where it fails."""
    done = ended(*words, cwd=folder, timeout=LONGEST)
    told = f"{what} in {path.name}: polynya {' '.join(words)}: {done.returncode}\n{done.stderr}"
    assert done.returncode in CODES, told
    assert "Traceback" not in done.stderr, told
    if done.returncode == 5:
        assert str(path.parent.name) in done.stderr or path.name in done.stderr, told
    return done, told


@pytest.mark.parametrize("seed", range(COUNT))
def test_a_damaged_run_folder_is_refused_by_the_name_of_its_file(whole, tmp_path, seed):
    path, kind = damage.damaged(whole / "run", tmp_path / "it", seed)
    read = started("inspect", "it", cwd=tmp_path, timeout=LONGEST)
    for words in some(OF_RUNS, seed):
        done, told = check(words, tmp_path, path, kind)
        if read.returncode == 5:  # as strict as the program
            assert done.returncode == 5, told + read.stderr
            assert read.stderr.strip().removeprefix("polynya: ") in done.stderr, told + read.stderr


@pytest.mark.parametrize("seed", range(COUNT))
def test_a_damaged_study_is_refused_by_the_name_of_its_file(whole, tmp_path, seed):
    path, kind = damage.damaged(whole / "study", tmp_path / "it", seed)
    for words in some(OF_STUDIES, seed):
        check(words, tmp_path, path, kind)


FILES = ["forces.csv", "contacts.csv", "panels.csv", "crushed.csv", "states.csv", "events.ndjson", "floes.ndjson",
         "scene.json", "summary.json", "frames.bin"]


@pytest.mark.parametrize("file", FILES[:-1])
def test_a_byte_that_is_no_text_is_named_with_its_line(whole, tmp_path, file):
    shutil.copytree(whole / "run", tmp_path / "it")
    lines = (tmp_path / "it" / file).read_bytes().split(b"\n")
    lines[1] = lines[1][:20] + b"\x8f" + lines[1][21:]
    (tmp_path / "it" / file).write_bytes(b"\n".join(lines))
    for words in some(OF_RUNS, FILES.index(file)):
        done = ended(*words, cwd=tmp_path, timeout=LONGEST)
        assert done.returncode == 5 and f"it/{file}:2:" in done.stderr, done.stderr


@pytest.mark.parametrize("file", FILES)
def test_a_pipe_in_place_of_a_file_is_refused(whole, tmp_path, file):
    shutil.copytree(whole / "run", tmp_path / "it")
    damage.pipe(tmp_path / "it" / file)
    for words in [["inspect", "it"], *some(OF_RUNS, FILES.index(file))]:
        done = ended(*words, cwd=tmp_path, timeout=LONGEST)
        assert done.returncode == 5 and file in done.stderr, done.stderr


def test_numbers_that_are_none_are_refused(whole, tmp_path):
    for number in ("1e999", "NaN", "nan", "inf", "-Infinity", "1_000", "0x10"):
        shutil.copytree(whole / "run", tmp_path / "it")
        path = tmp_path / "it/forces.csv"
        header, first, *rest = path.read_text().split("\n")
        cells = first.split(",")
        path.write_text("\n".join([header, ",".join([*cells[:3], number, *cells[4:]]), *rest]))
        for words in [["inspect", "it"], *some(OF_RUNS[:2], len(number))]:
            done = ended(*words, cwd=tmp_path, timeout=LONGEST)
            assert done.returncode == 5 and f'it/forces.csv:2: "{number}" is not a number' in done.stderr, done.stderr
        shutil.rmtree(tmp_path / "it")
