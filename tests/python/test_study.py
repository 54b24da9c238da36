"""Studies: what is planned, run, stopped, killed, gathered and sent, with the program that is built here."""
import contextlib
import csv
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

import pytest

from polynya.command import run as run_command
from polynya.study import draws
from polynya.study.__main__ import main as study_main
from polynya.study.definition import read_definition
from polynya.study.expand import count_cases, expand
from polynya.study.folder import list_of_numbers, numbers_of_list, open_study
from polynya.study.located_json import LocatedJson, StudyError
from study_command import study

SCENES = pathlib.Path(os.environ["POLYNYA_SCENES"]).resolve()
SHIP = '''{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9,
  "position_m": [-61, 75], "propulsion": {"constant_speed_m_per_s": 1}}'''
SCENE = (
    '''// a ship and a plate
{"time": {"until_s": 8, "step_s": 0.01}, "ships": [%s],
 "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 150}}]}'''
    % SHIP
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plate.json").write_text(SCENE)
    return tmp_path


def write_study(folder, name="s", **keys):
    path = folder / f"{name}.json"
    path.write_text(json.dumps({"scene": "plate.json", **keys}))
    return path


def problems_of(path):
    with pytest.raises(StudyError) as caught:
        read_definition(path)
    return [str(problem) for problem in caught.value.problems]


def table(folder):
    with open(folder / "table.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def files_of(case):
    """What a case's run wrote, but for the times by the clock."""
    found = {}
    for path in sorted((case / "run").iterdir()):
        content = path.read_bytes()
        if path.name == "summary.json":
            content = {k: v for k, v in json.loads(content).items() if k not in ("wall_time_s", "real_time_factor")}
        found[path.name] = content
    result = json.loads((case / "case.json").read_text())
    return found, {k: v for k, v in result.items() if k not in ("wall_time_s", "elapsed_s")}


# --- Definition and expansion ---


def test_cases_are_every_combination_repeated_with_other_seeds(folder):
    path = write_study(
        folder,
        grid={"ice.thickness_m": [0.4, 0.6], "time.until_s": {"from": 5, "to": 7, "count": 3}},
        paired={"name": ["a", "b"], "ice.friction": [0.1, 0.2]},
        repetitions=2,
        seed=10,
    )
    definition = read_definition(path)
    cases = [case for _, case in expand(definition)]
    assert len(cases) == count_cases(definition) == 2 * 3 * 2 * 2
    assert len({json.dumps(case) for case in cases}) == len(cases)
    assert {(case["name"], case["ice.friction"]) for case in cases} == {("a", 0.1), ("b", 0.2)}
    assert [case["seed"] for case in cases] == [10] * 12 + [11] * 12
    assert sorted({case["time.until_s"] for case in cases}) == [5, 6, 7]


def test_ranges_end_where_they_say(folder):
    path = write_study(
        folder,
        grid={
            "a.x": {"from": 0.1, "to": 0.7, "step": 0.1},
            "a.y": {"from": 3, "to": 1, "step": -0.5},
            "a.z": {"from": 1, "to": 100, "count": 3, "spacing": "log"},
        },
    )
    grid = read_definition(path).grid
    assert grid["a.x"] == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
    assert grid["a.y"] == [3, 2.5, 2, 1.5, 1]
    assert grid["a.z"] == pytest.approx([1, 10, 100])


def test_a_longer_study_begins_with_the_shorter_one(folder):
    spec = {"of": {"ice.thickness_m": {"normal": {"mean": 0.5, "sd": 0.1, "least": 0.2}}}}
    few, many = (
        list(expand(read_definition(write_study(folder, draw={"count": n, **spec}, grid={"ice.friction": [0.1, 0.2]}))))
        for n in (3, 50)
    )
    assert many[: len(few)] == few


@pytest.mark.parametrize(
    "kind, numbers, mean, sd",
    [
        ("uniform", {"low": 2, "high": 4}, 3, 2 / 12**0.5),
        ("normal", {"mean": 5, "sd": 2}, 5, 2),
        ("log_normal", {"mean": 3, "sd": 1}, 3, 1),
        ("log_uniform", {"low": 1, "high": 2.718281828}, 1.71828, 0.4920),
    ],
)
@pytest.mark.parametrize("method", ["independent", "latin_hypercube"])
def test_draws_have_the_distribution_that_was_asked_for(kind, numbers, mean, sd, method):
    values = draws.draw(1, "ice.thickness_m", kind, numbers, 4000, method)
    middle = sum(values) / len(values)
    spread = (sum((v - middle) ** 2 for v in values) / len(values)) ** 0.5
    assert middle == pytest.approx(mean, abs=4 * sd / 4000**0.5)
    assert spread == pytest.approx(sd, rel=0.1)
    assert (
        max(abs(draws.probability_below(kind, numbers, draws.value_at(kind, numbers, p)) - p) for p in (0.01, 0.3, 0.9))
        < 1e-9
    )


def test_latin_hypercube_has_one_draw_in_each_part():
    values = draws.draw(3, "a", "uniform", {"low": 0, "high": 1}, 100, "latin_hypercube")
    assert sorted(int(100 * v) for v in values) == list(range(100))
    assert draws.draw(3, "b", "uniform", {"low": 0, "high": 1}, 100, "latin_hypercube") != values


def test_bounds_of_a_distribution_hold():
    values = draws.draw(1, "a", "normal", {"mean": 0, "sd": 1, "least": -0.5, "most": 2}, 1000, "independent")
    assert -0.5 <= min(values) < -0.45 and 1.7 < max(values) <= 2


def test_everything_wrong_with_a_study_is_reported_with_its_place(folder):
    path = folder / "wrong.json"
    path.write_text(
        '''{
  "scenes": "plate.json",  // a comment
  "grid": {"a": [], "b": {"from": 1, "to": 2}},
  "paired": {"c": [1], "d": [1, 2]},
  "draw": {"count": 0, "of": {"e": {"normal": {"mean": 1, "sd": -1}}, "a": {"uniform": {"low": 1, "high": 2}}}},
  "report": {"map": ["a"], "channels": -1, "means": 3}, "collect": {"quantiles": [1.5], "time_to": {"port": {"z_m": 1}}}
}'''
    )
    found = problems_of(path)
    for words in (
        'wrong.json:2:3: scenes: found an unknown key',
        'did you mean "scene"?',
        'wrong.json:3:17: grid.a: found an empty list',
        "wrong.json:3:26: grid.b: found count and step together or neither",
        "wrong.json:4:13: paired: found lists of 1 (c), 2 (d)",
        "wrong.json:5:21: draw.count: found 0",
        "draw.of.e.normal: found -1 for sd, allowed: a number > 0",
        'draw.of.a: found what "grid" varies too',
        "collect.quantiles",
        "wrong.json:6:109: collect.time_to.port: found keys z_m, allowed: x_m",
        "report.map: found a list of 1, allowed: a list of two paths",
        "report.channels: found -1",
        "report.means: found 3, allowed: a list",
    ):
        assert any(words in problem for problem in found), (words, found)
    path.write_text('{"scene": "plate.json",\n "grid": {"a": [1, }}')
    assert problems_of(path)[0].startswith(f"{path}:2:18: a comma too many")


def test_json_is_read_by_the_program_with_the_place_of_every_key_and_value(tmp_path):
    path = tmp_path / "-a.json"
    text = '/* ü */ {"ä/~": [1, 2.0,\n  1e5, 0.1, 1e300], // "b": 2\n "b": {"c": "\\u00e9\\n"}}'
    path.write_text(text, encoding="utf-8")
    read = LocatedJson(path)
    assert read.value == {"ä/~": [1, 2, 100000, 0.1, 1e300], "b": {"c": "é\n"}}
    assert [type(number) for number in read.value["ä/~"]] == [int] * 3 + [float] * 2
    for steps, of_key, place in (
        ([], False, (1, 9)),
        (["ä/~"], True, (1, 10)),
        (["ä/~"], False, (1, 17)),
        (["ä/~", 1], False, (1, 21)),
        (["ä/~", 2], True, (2, 3)),
        (["b", "c"], False, (3, 13)),
        (["b", "d", "e"], True, (3, 7)),  # the nearest one that there is
    ):
        problem = read.problem(steps, "wrong", of_key)
        assert (problem.line, problem.column) == place, steps


WHOLE_STUDY = {
    "name": "mutated",
    "scene": "plate.json",
    "set": {"time.until_s": 6},
    "grid": {"ice.thickness_m": [0.4, 0.6], "ice.friction": {"from": 0.1, "to": 0.2, "step": 0.05}},
    "paired": {"name": ["a", "b"], "ice.density_kg_per_m3": [900, 910]},
    "draw": {"count": 2, "of": {"ice.flexural_strength_Pa": {"log_normal": {"mean": 5e5, "sd": 1e5, "most": 1e6}}}},
    "repetitions": 2,
    "collect": {"from_s": 1, "quantiles": [0.5], "time_to": {"lead": {"point_m": [1, 2], "within_m": 3}}},
    "keep": "summary",
    "report": {"against": "ice.friction", "map": ["ice.thickness_m", "ice.friction"], "channels": 2},
}
WRONG = ["null", "true", '"x"', '""', '"\\u0000"', "[]", "{}", "[null]", '{"a": [{}]}', "-1", "0", "1.5", "-1e308"]
WRONG += ["1e308", "1e-320", "1e999", "NaN", "-Infinity", "1" * 400, '"' + "y" * 5000 + '"', "[" * 90 + "]" * 90]


def mutated(dice, study):
    """The text of a study with one thing changed: a value, a key, or the text itself."""
    study = json.loads(json.dumps(study))
    kind = dice.choice(["value", "value", "value", "drop", "rename", "cut", "comma", "twice"])
    parents, parent = [study], study
    while isinstance(parent, (dict, list)) and parent:
        parents.append(parent)
        parent = parent[dice.choice(list(parent) if isinstance(parent, dict) else range(len(parent)))]
    parent = dice.choice(parents)
    key = dice.choice(list(parent) if isinstance(parent, dict) else range(len(parent)))
    if kind == "drop":
        del parent[key]
    elif kind == "rename" and isinstance(parent, dict):
        parent[key[:-1] + dice.choice("xyz_ü/~")] = parent.pop(key)
    elif kind == "value":
        parent[key] = "@"
    text = json.dumps(study, indent=dice.choice([None, 1])).replace('"@"', dice.choice(WRONG))
    if kind == "cut":
        return text[: dice.randrange(len(text))]
    if kind in ("comma", "twice"):
        at = dice.choice([match.end() for match in re.finditer("[{]" if kind == "twice" else "[][{},]", text)])
        return text[:at] + (", " if kind == "comma" else '"count": 1, "count": 2, ') + text[at:]
    return text


@pytest.mark.parametrize("part", range(3))
def test_a_mutated_study_is_planned_or_refused_with_places(folder, capsys, part):
    dice, codes = random.Random(part), []
    path = folder / "s.json"
    signal.signal(signal.SIGALRM, lambda *_: pytest.fail("hangs"))
    for _ in range(100):
        path.write_text(mutated(dice, WHOLE_STUDY))
        shutil.rmtree("studies", ignore_errors=True)
        signal.alarm(60)
        codes.append(run_command("study", lambda: study_main(["plan", str(path), "--trial-seconds", "0"])))
        signal.alarm(0)
        *problems, last = capsys.readouterr().err.splitlines()
        assert codes[-1] in (0, 3), (path.read_text(), problems, last)
        if codes[-1] == 3:
            assert re.fullmatch(r"polynya study: \d+ problems?; nothing was planned", last) and problems
            place = re.compile(re.escape(str(path)) + r":\d+:\d+: ")
            assert all(place.match(line) and len(line) < 1000 for line in problems), (path.read_text(), problems)
    assert codes.count(3) > 60


def test_numbers_beyond_what_can_be_computed_are_refused(folder):
    wide = {"log_normal": {"mean": 5e5, "sd": 1e308}}
    for keys, message in (
        ({"draw": {"count": 2, "of": {"a": wide}}}, "sd 1e+308, allowed: a distribution whose draws"),
        ({"collect": {"time_to": {"lead": {"x_m": []}}}}, "time_to.lead.x_m: found a list, allowed: a number [m]"),
        ({"grid": {"a": {"from": 1e-308, "to": 1e308, "count": 3, "spacing": "log"}}}, "grid.a: found ends that are too"),
        ({"grid": {"a": {"from": 0, "to": 1, "count": 10**8}}}, "grid.a.count: found 100000000, allowed: a whole"),
    ):
        assert message in problems_of(write_study(folder, **keys))[0]


def test_a_damaged_plan_is_named(folder):
    study("plan", write_study(folder), "--trial-seconds", 0)
    for name, text in (("plan.json", "[]"), ("plan.json", '{"format": 1}'), ("cases.ndjson", '{"scene": 3}\n')):
        plan = folder / "studies/s" / name
        kept = plan.read_text()
        plan.write_text(text)
        assert f"{name}: damaged" in study("run", "studies/s", "--case", 0, code=5)
        plan.write_text(kept)


def test_repetitions_of_a_fixed_seed_are_refused(folder):
    assert "repetitions would be copies" in problems_of(write_study(folder, repetitions=2, grid={"seed": [1, 2]}))[0]


def test_lists_of_numbers_are_read_as_they_are_written():
    numbers = [0, 3, 4, 5, 9, 11, 12]
    assert list_of_numbers(numbers) == "0,3-5,9,11-12"
    assert numbers_of_list("0,3-5,9,11-12", 13, "case") == numbers
    with pytest.raises(StudyError, match="there is no case 13"):
        numbers_of_list("2-13", 13, "case")
    with pytest.raises(StudyError, match="no list of case"):
        numbers_of_list("a", 13, "case")


# --- Planning ---


def test_a_case_that_the_scene_does_not_allow_is_refused_before_anything_runs(folder):
    path = folder / "s.json"
    path.write_text(
        '{"scene": "plate.json",\n "grid": {"ice.thickness_m": [0.5, -1], "ice.frction": [0.1]},\n "set": {"floes[0].rectangle.corner_m": [-20, 0]}}'
    )
    words = study("plan", path, code=3)
    assert f"{path}:2:30: ice.thickness_m: found -1, allowed: a number ≥ 0.001, ≤ 20 [m] [case 1]" in words
    assert (
        f'{path}:2:56: ice.frction: found an unknown key' in words
        and 'did you mean "friction"?' in words
        and "[all 2 cases]" in words
    )
    assert not (folder / "studies" / "s").exists()
    path.write_text('{"scene": "plate.json", "set": {"floes[0].rectangle.corner_m": [-20, 0]}}')
    assert "plate.json:4:12" in study("plan", path, code=3)
    path.write_text('{"scene": "gone.json"}')
    assert f"{path}:1:11: scene: {folder}/gone.json: no such file\n" in study("plan", path, code=3)
    path.write_text('{"scene": "s.json",}')
    assert study("plan", path, code=3).startswith(f"{path}:1:19: a comma too many")


def test_planning_again_changes_nothing_and_a_study_may_grow(folder):
    path = write_study(folder, repetitions=2, grid={"ice.thickness_m": [0.4, 0.5]})
    study("plan", path, "--trial-seconds", 0)
    before = {p: p.stat().st_mtime_ns for p in (folder / "studies/s").iterdir()}
    study("plan", path, "--trial-seconds", 0)
    after = {p: p.stat().st_mtime_ns for p in (folder / "studies/s").iterdir()}
    assert before == after
    study("run", "studies/s", "--cases", "0-3", "--quiet")
    kept = (folder / "studies/s/cases/000003/case.json").read_bytes()
    study("plan", write_study(folder, repetitions=3, grid={"ice.thickness_m": [0.4, 0.5]}), "--trial-seconds", 0)
    assert open_study("studies/s").count == 6
    assert (folder / "studies/s/cases/000003/case.json").read_bytes() == kept
    words = study("plan", write_study(folder, repetitions=3, grid={"ice.thickness_m": [0.4, 0.6]}), code=5)
    assert "its cases have run by an earlier plan with other cases" in words
    (folder / "plate.json").write_text(SCENE.replace("150", "140"))
    words = study("plan", write_study(folder, repetitions=3, grid={"ice.thickness_m": [0.4, 0.5]}), code=5)
    assert "with other inputs" in words
    study("plan", write_study(folder, "more", repetitions=2), "--repetitions", 5, "--trial-seconds", 0)
    assert open_study("studies/more").count == 5
    assert "copies" in study("plan", write_study(folder, "own", grid={"seed": [3, 4]}), "--repetitions", 5, code=2)
    assert "150" in (folder / "studies/s/scenes/0/plate.json").read_text()


def test_what_only_began_by_another_plan_is_removed(folder):
    study("plan", write_study(folder, collect={"loads": ["surge_from_moorng_N"]}), "--trial-seconds", 0)
    assert 'forces.csv has no column "surge_from_moorng_N"' in study("run", "studies/s", code=4)
    study("plan", write_study(folder, set={"ice.thickness_m": 0.4}), "--trial-seconds", 0)
    assert not (folder / "studies/s/cases").exists()
    study("run", "studies/s", "--quiet")
    study("gather", "studies/s")


def test_the_trial_estimates_and_is_the_first_case(folder):
    words = study("plan", write_study(folder, repetitions=3))
    assert "a case " in words and "all 3" in words and "MB of memory" in words
    assert (folder / "studies/s/cases/000000/case.json").exists()
    words = study("plan", write_study(folder, "long", set={"time.until_s": 20000}), "--trial-seconds", "2")
    assert "extrapolated from" in words


def test_floe_files_come_with_the_study(folder):
    (folder / "ice").mkdir()
    (folder / "ice" / "a.geojson").write_text(
        '{"type": "Polygon", "coordinates": [[[0, 0], [50, 0], [50, 150], [0, 150], [0, 0]]]}'
    )
    (folder / "plate.json").write_text(
        SCENE.replace('{"rectangle": {"corner_m": [0, 0], "size_m": 150}}', '{"file": "ice/a.geojson"}')
    )
    study("plan", write_study(folder), "--trial-seconds", 0)
    shutil.rmtree(folder / "ice")
    study("run", "studies/s", "--quiet")
    assert (folder / "studies/s/cases/000000/case.json").exists()


# --- Running ---


def test_any_number_of_jobs_gives_the_same_cases_and_a_finished_one_costs_nothing(folder):
    path = write_study(folder, grid={"ice.thickness_m": [0.4, 0.5, 0.6]}, repetitions=2)
    study("plan", path, "--out", "one", "--trial-seconds", 0)
    study("plan", path, "--out", "two", "--trial-seconds", 0)
    study("run", "one", "--jobs", 1, "--quiet")
    assert "case 4: finished" in study("run", "two", "--case", 4)
    study("run", "two", "--jobs", 2, "--quiet")
    for number in range(6):
        assert files_of(folder / f"one/cases/{number:06d}") == files_of(folder / f"two/cases/{number:06d}")
    study("gather", "one")
    study("gather", "two")
    assert (folder / "one/table.csv").read_bytes() == (folder / "two/table.csv").read_bytes()
    before = (folder / "two/cases/000004/case.json").stat().st_mtime_ns
    study("run", "two", "--case", 4)
    assert (folder / "two/cases/000004/case.json").stat().st_mtime_ns == before


LONG = {"time.until_s": 150, "time.step_s": 0.001, "record.frames_interval_s": 20}  # a second or more


def start_long_case(folder, name):
    """A case whose run has begun to write, and is held there by SIGSTOP."""
    study("plan", write_study(folder, name, set=LONG), "--trial-seconds", 0)
    running = subprocess.Popen(
        [sys.executable, "-m", "polynya.study", "run", f"studies/{name}", "--case", "0"],
        stderr=subprocess.PIPE,
        text=True,
    )
    forces = folder / f"studies/{name}/cases/000000/run/forces.csv"
    while running.poll() is None and not (forces.exists() and forces.stat().st_size > 4000):
        time.sleep(0.001)
    assert running.poll() is None
    child = child_of(running)
    os.kill(child, signal.SIGSTOP)
    return running, child


def let_go(held):
    """Lets a process that is held go on, as soon as a signal waits for it or it is gone."""
    deadline = time.monotonic() + 20
    with contextlib.suppress(FileNotFoundError, ProcessLookupError):
        while time.monotonic() < deadline:
            status = dict(line.split(":\t", 1) for line in open(f"/proc/{held}/status") if ":\t" in line)
            if status["State"].startswith("Z") or int(status["SigPnd"], 16) or int(status["ShdPnd"], 16):
                break
            time.sleep(0.001)
        os.kill(held, signal.SIGCONT)


def child_of(process):
    return int(pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()[0])


def test_what_is_stopped_or_killed_continues_and_comes_to_the_same_bytes(folder):
    study("plan", write_study(folder, "whole", set=LONG), "--trial-seconds", 0)
    study("run", "studies/whole", "--quiet")
    whole = files_of(folder / "studies/whole/cases/000000")
    for name, end, code in (
        ("stopped", lambda p: p.send_signal(signal.SIGTERM), 75),
        ("killed", lambda p: os.kill(child_of(p), signal.SIGKILL), 75),
        ("orphan", lambda p: p.kill(), -signal.SIGKILL),
    ):
        running, child = start_long_case(folder, name)
        end(running)
        let_go(child)
        words = running.communicate()[1]
        assert running.returncode == code, words
        if name == "orphan":  # the run itself stops when what started it is gone
            deadline = time.monotonic() + 20
            while "another process" in (words := study_ending(f"studies/{name}")) and time.monotonic() < deadline:
                time.sleep(0.05)
        assert (folder / f"studies/{name}/cases/000000/case.json").exists() == (name == "orphan")
        study("run", f"studies/{name}", "--case", 0)
        assert files_of(folder / f"studies/{name}/cases/000000") == whole


def test_workers_whose_parent_is_killed_stop_their_runs_also_in_the_background(folder):
    study("plan", write_study(folder, set=LONG | {"time.step_s": 0.0005}), "--trial-seconds", 0)
    # As a batch script starts it: a background job of a shell, which ignores SIGINT.
    command = f"{sys.executable} -m polynya.study run studies/s --jobs 1 2>/dev/null & echo $!; wait"
    shell = subprocess.Popen(["bash", "-c", command], stdout=subprocess.PIPE, text=True)
    parent = int(shell.stdout.readline())
    run = folder / "studies/s/cases/000000/run"
    while shell.poll() is None and not (run / "forces.csv").exists():
        time.sleep(0.01)
    os.kill(parent, signal.SIGKILL)
    shell.wait()
    deadline = time.monotonic() + 30
    while not list(run.glob("checkpoint-*")) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert list(run.glob("checkpoint-*")) and not (run.parent / "case.json").exists()
    assert not pids_of("studies/s"), "workers are left"


def pids_of(words):
    """Processes of this test's Python whose working folder is ours and whose command line has the words."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if (
                words in (process / "cmdline").read_bytes().decode().split("\0")
                and (process / "cwd").resolve() == pathlib.Path.cwd()
            ):
                found.append(process.name)
        except OSError:
            pass
    return found


def study_ending(given):
    return subprocess.run(
        [sys.executable, "-m", "polynya.study", "run", given, "--case", "0"],
        capture_output=True,
        text=True,
        check=False,
    ).stderr


def test_a_case_without_room_on_the_disk_is_unfinished_and_continues(folder):
    study("plan", write_study(folder, set={"time.until_s": 60}), "--trial-seconds", 0)
    command = [sys.executable, "-m", "polynya.study", "run", "studies/s", "--jobs", "1", "--quiet"]
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
    ran = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit, check=False)
    assert ran.returncode != 0 and "File too large" in ran.stderr, ran.stderr
    assert "unfinished" in study("gather", "studies/s", code=75)
    study("run", "studies/s", "--quiet")
    study("gather", "studies/s")


def test_a_case_that_runs_is_refused_to_another_process(folder):
    running, child = start_long_case(folder, "busy")
    assert "case 0: another process runs it" in study("run", "studies/busy", "--case", 0, code=5)
    running.send_signal(signal.SIGTERM)
    let_go(child)
    running.wait()


def test_a_case_writes_nothing_outside_its_folder(folder):
    study("plan", write_study(folder, repetitions=2), "--trial-seconds", 0)

    def tree():
        return {p: p.stat().st_mtime_ns for p in folder.rglob("*") if p.is_file() and "cases/000001" not in str(p)}

    before = tree()
    study("run", "studies/s", "--case", 1)
    assert tree() == before
    assert sorted(p.name for p in (folder / "studies/s/cases/000001").iterdir()) == ["case.json", "run"]


def test_jobs_stop_with_checkpoints_and_go_on(folder):
    study("plan", write_study(folder, set=LONG | {"time.step_s": 0.0005}, repetitions=3), "--trial-seconds", 0)
    running = subprocess.Popen(
        [sys.executable, "-m", "polynya.study", "run", "studies/s", "--jobs", "2"], stderr=subprocess.PIPE
    )
    case = folder / "studies/s/cases/000000/run/forces.csv"
    while running.poll() is None and not (case.exists() and case.stat().st_size > 4000):
        time.sleep(0.01)
    running.send_signal(signal.SIGTERM)
    assert running.wait() == 75
    assert list(case.parent.glob("checkpoint-*")) and not (case.parent.parent / "case.json").exists()
    study("run", "studies/s", "--quiet")
    assert len(list((folder / "studies/s/cases").glob("*/case.json"))) == 3


def test_a_terminal_has_a_live_table(folder):
    study("plan", write_study(folder, repetitions=3), "--trial-seconds", 0)
    ours, theirs = os.openpty()
    command = [sys.executable, "-m", "polynya.study", "run", "studies/s", "--jobs", "1"]
    with subprocess.Popen(command, stderr=theirs) as running:
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 65536):
                shown += part
        except OSError:  # the terminal's end
            pass
    os.close(ours)
    assert running.returncode == 0
    for words in (
        "running          1  case 0",
        "done             3 of 3  (100 %)",
        "failed           0",
        "left          0:00",
    ):
        assert words in shown.decode(), shown.decode()


def test_records_can_be_thinned_to_the_summary_and_brought_back(folder):
    study("plan", write_study(folder, "thin", keep="summary"), "--trial-seconds", 0)
    study("plan", write_study(folder, "thick"), "--trial-seconds", 0)
    study("run", "studies/thin", "--quiet")
    study("run", "studies/thick", "--quiet")
    case = folder / "studies/thin/cases/000000"
    assert [p.name for p in case.iterdir()] == ["case.json"]
    assert study("run", "studies/thin", "--quiet") is not None and [p.name for p in case.iterdir()] == ["case.json"]
    study("run", "studies/thin", "--case", 0, "--keep", "all")
    assert files_of(case) == files_of(folder / "studies/thick/cases/000000")


# --- Gathering, archives, clusters ---


def test_a_partial_gather_says_what_is_missing_and_how_to_repair_it(folder):
    study("plan", write_study(folder, grid={"ice.thickness_m": [0.4, 0.5, 0.6, 0.7]}), "--trial-seconds", 0)
    study("run", "studies/s", "--cases", "0,2", "--quiet")
    failed = folder / "studies/s/cases/000003"
    failed.mkdir()
    (failed / "case.json").write_text(
        json.dumps({"state": "failed", "case": 3, "message": "numbers stopped being numbers", "exit_code": 4})
    )
    words = study("gather", "studies/s", code=4)
    assert "PARTIAL" in words and "polynya study run studies/s --cases 1" in words
    assert "polynya study run studies/s --retry-failed --cases 3" in words and "case 3: numbers stopped" in words
    rows = table(folder / "studies/s")
    assert [row["state"] for row in rows] == ["finished", "missing", "finished", "failed"]
    assert [row["ice.thickness_m"] for row in rows] == ["0.4", "0.5", "0.6", "0.7"]
    assert rows[1]["resistance_mean_N"] == "" and float(rows[0]["resistance_mean_N"]) > 0
    assert "1 failed" in study("run", "studies/s", code=4)  # a failure is not tried again by itself
    study("run", "studies/s", "--retry-failed", "--cases", "3", "--quiet")
    study("gather", "studies/s")
    summary = json.loads((folder / "studies/s/gather.json").read_text())
    assert summary["is_complete"] and summary["finished"] == 4 and not summary["repair"]


def test_measures_are_those_of_the_run(folder):
    study(
        "plan",
        write_study(
            folder,
            set={"time.until_s": 30, "fracture.splitting.model": "none"},
            collect={
                "from_s": 5,
                "loads": ["thrust_N"],
                "time_to": {"port": {"x_m": -51}, "never": {"x_m": 900}, "far": {"distance_m": 20}},
            },
        ),
        "--trial-seconds",
        0,
    )
    study("run", "studies/s", "--quiet")
    study("gather", "studies/s")
    row, run = table(folder / "studies/s")[0], folder / "studies/s/cases/000000/run"
    with open(run / "forces.csv", newline="", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in r.items() if k != "ship"} for r in csv.DictReader(file)]
    kept = [-(r["surge_N"] + r["surge_from_submerged_ice_N"]) for r in rows if r["t_s"] > 5]
    summary = json.loads((run / "summary.json").read_text())
    assert float(row["resistance_mean_N"]) == pytest.approx(sum(kept) / len(kept))
    assert float(row["resistance_peak_N"]) == pytest.approx(max(kept))
    assert int(row["bends"]) == summary["counts"]["bends"] > 0 and row["outcome"] == "bent"
    assert float(row["mean_speed_m_per_s"]) == pytest.approx(1) and float(row["distance_m"]) == pytest.approx(
        25, abs=0.11
    )
    assert float(row["time_to_port_s"]) == pytest.approx(10, abs=0.11) and row["time_to_never_s"] == ""
    assert float(row["time_to_far_s"]) == pytest.approx(20, abs=0.11)
    # What holds the ship to its speed is what the ice takes from it.
    assert float(row["energy_per_km_J"]) == pytest.approx(1000 * float(row["resistance_mean_N"]), rel=1e-6)


def test_a_chunk_is_packed_into_one_file_and_read_from_it(folder):
    path = write_study(folder, repetitions=5, archive=True)
    study("plan", path, "--chunk", 2, "--trial-seconds", 0)
    study("plan", write_study(folder, "loose", repetitions=5), "--chunk", 2, "--trial-seconds", 0)
    study("run", "studies/s", "--chunk", 1, "--quiet")
    assert [p.name for p in (folder / "studies/s/cases").iterdir()] == ["000001.tar"]
    study("run", "studies/s", "--quiet")
    study("run", "studies/loose", "--quiet")
    assert sorted(p.name for p in (folder / "studies/s/cases").iterdir()) == ["000000.tar", "000001.tar", "000002.tar"]
    for name in ("s", "loose"):
        study("gather", f"studies/{name}")
    assert (folder / "studies/s/table.csv").read_bytes() == (folder / "studies/loose/table.csv").read_bytes()
    study("run", "studies/s", "--case", 3)
    study("run", "studies/s", "--quiet")
    assert sorted(p.name for p in (folder / "studies/s/cases").iterdir()) == ["000000.tar", "000001.tar", "000002.tar"]


def test_what_a_kill_leaves_of_a_packed_chunk_is_removed_and_its_archive_stays(folder):
    study("plan", write_study(folder, repetitions=4, archive=True), "--chunk", 2, "--trial-seconds", 0)
    study("run", "studies/s", "--chunk", 0, "--quiet")
    archive = folder / "studies/s/cases/000000.tar"
    packed = archive.read_bytes()
    left = folder / "studies/s/cases/000000/000001"
    left.mkdir(parents=True)
    (left / "case.json").write_text("{")
    study("run", "studies/s", "--chunk", 0, "--quiet")
    assert not left.exists() and archive.read_bytes() == packed
    study("run", "studies/s", "--quiet")
    study("gather", "studies/s")


def test_a_packed_case_can_run_again(folder):
    study("plan", write_study(folder, repetitions=4, archive=True, keep="summary"), "--chunk", 2, "--trial-seconds", 0)
    study("run", "studies/s", "--quiet")
    cases = folder / "studies/s/cases"
    study("run", "studies/s", "--case", 3, "--keep", "all")
    assert (cases / "000001/000003/run/frames.bin").exists() and not (cases / "000001.tar").exists()
    study("run", "studies/s", "--quiet")
    assert sorted(p.name for p in cases.iterdir()) == ["000000.tar", "000001.tar"]
    study("gather", "studies/s")


def test_slurms_script_has_the_chunks_that_are_left(folder):
    study("plan", write_study(folder, repetitions=8), "--chunk", 2, "--trial-seconds", 0)
    study("run", "studies/s", "--cases", "2-3", "--quiet")
    study("slurm", "studies/s", "--throttle", 7, "--time", "2:30:00", "--sbatch=--partition=long")
    script = (folder / "studies/s/slurm/array.sbatch").read_text()
    for line in (
        "#SBATCH --array=0,2-3%7\n",
        "#SBATCH --time=2:30:00\n",
        "#SBATCH --requeue\n",
        "#SBATCH --partition=long\n",
    ):
        assert line in script
    assert subprocess.run(["bash", "-n", folder / "studies/s/slurm/array.sbatch"], check=False).returncode == 0
    study("run", "studies/s", "--quiet")
    assert "every case has ended" in study("slurm", "studies/s")


def test_slurm_gets_the_memory_asked_for_twice_and_each_job_is_named_as_it_is_taken(folder, monkeypatch):
    (folder / "bin").mkdir()
    sbatch = folder / "bin" / "sbatch"
    sbatch.write_text(
        """#!/bin/sh
for script; do :; done  # the last word
grep -q mem-per-cpu=$LEAST "$script" || { echo "Memory specification can not be satisfied" >&2; exit 1; }
case $script in */array.sbatch) echo 71 ;; *) echo "$2" >"$0.words"; echo "72;cluster" ;; esac
"""
    )
    sbatch.chmod(0o755)
    monkeypatch.setenv("PATH", f"{sbatch.parent}:{os.environ['PATH']}")
    study("plan", write_study(folder), "--trial-seconds", 0)
    monkeypatch.setenv("LEAST", "0$")
    words = study("slurm", "studies/s", "--submit", "--memory", 0)
    assert "job 71\n" in words and "job 72, to gather" in words
    assert sbatch.with_suffix(".words").read_text() == "--dependency=afterany:71\n"
    monkeypatch.setenv("LEAST", "500M$")  # by default the gathering job asks for more
    words = study("slurm", "studies/s", "--submit", code=5)
    assert "job 71\n" in words and "can not be satisfied" in words
    assert "job 71 runs the cases; what gathers after it is still to submit: sbatch --dependency=afterany:71 " in words


@pytest.mark.skipif(not shutil.which("parallel"), reason="GNU parallel is not installed")
def test_the_line_for_gnu_parallel_runs_all_chunks(folder):
    study("plan", write_study(folder, repetitions=4), "--chunk", 2, "--trial-seconds", 0)
    line = study("parallel", "studies/s", "--jobs", 2)
    # The line names the program that users start, `polynya study`; here it is Python that is started.
    wrapper = folder / "bin"
    wrapper.write_text(f'#!/bin/sh\nshift\nexec {sys.executable} -m polynya.study "$@"\n')
    wrapper.chmod(0o755)
    ran = subprocess.run(
        ["bash", "-c", line.replace(os.environ["POLYNYA_PROGRAM"], str(wrapper))],
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    study("gather", "studies/s")


def test_a_report_without_numpy_names_what_to_install(folder, monkeypatch):
    study("plan", write_study(folder), "--trial-seconds", 0)
    (folder / "numpy.py").write_text("raise ModuleNotFoundError(name='numpy')")
    monkeypatch.setenv("PYTHONPATH", f"{folder}:{os.environ['PYTHONPATH']}")
    words = study("report", "studies/s", code=5)
    assert words.startswith("polynya study: ") and "has no numpy: " in words and "./setup.sh python" in words
    study("gather", "studies/s", code=75)  # does without


def test_a_folder_without_a_plan_and_a_study_not_planned_are_named(folder):
    assert "no study is planned there" in study("gather", folder, code=5)
    path = write_study(folder)
    assert f"polynya study plan {path}" in study("gather", path, code=5)
    assert "there is no case 7" in (
        study("plan", path, "--trial-seconds", 0) and study("run", path, "--case", 7, code=2)
    )
    (folder / "full").mkdir()
    (folder / "full" / "x").touch()
    assert "not empty" in study("plan", path, "--out", "full", code=5)
