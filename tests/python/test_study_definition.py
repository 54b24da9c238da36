"""Studies: what is planned, what is drawn, and what is refused with its place."""
import json
import random
import re
import shutil
import signal

import pytest

from polynya.command import run as run_command
from polynya.study import draws
from polynya.study.__main__ import main as study_main
from polynya.study.definition import read_definition
from polynya.study.expand import count_cases, expand
from polynya.study.folder import list_of_numbers, numbers_of_list, open_study
from polynya.study.located_json import LocatedJson, StudyError
from program import mutated
from study_command import SCENE, folder, gathered, planned, study, write_study


def problems_of(path):
    with pytest.raises(StudyError) as caught:
        read_definition(path)
    return [str(problem) for problem in caught.value.problems]


def test_cases_are_every_combination_repeated_with_other_seeds(folder):
    path = write_study(folder, grid={"ice.thickness_m": [0.4, 0.6], "time.until_s": {"from": 5, "to": 7, "count": 3}},
                       paired={"name": ["a", "b"], "ice.friction": [0.1, 0.2]}, repetitions=2, seed=10)
    definition = read_definition(path)
    cases = [case for _, case in expand(definition)]
    assert len(cases) == count_cases(definition) == 2 * 3 * 2 * 2
    assert len({json.dumps(case) for case in cases}) == len(cases)
    assert {(case["name"], case["ice.friction"]) for case in cases} == {("a", 0.1), ("b", 0.2)}
    assert [case["seed"] for case in cases] == [10] * 12 + [11] * 12
    assert sorted({case["time.until_s"] for case in cases}) == [5, 6, 7]


def test_ranges_end_where_they_say(folder):
    ranges = {"a.x": {"from": 0.1, "to": 0.7, "step": 0.1}, "a.y": {"from": 3, "to": 1, "step": -0.5},
              "a.z": {"from": 1, "to": 100, "count": 3, "spacing": "log"}}
    grid = read_definition(write_study(folder, grid=ranges)).grid
    assert grid["a.x"] == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
    assert grid["a.y"] == [3, 2.5, 2, 1.5, 1]
    assert grid["a.z"] == pytest.approx([1, 10, 100])


def test_a_longer_study_begins_with_the_shorter_one(folder):
    spec = {"of": {"ice.thickness_m": {"normal": {"mean": 0.5, "sd": 0.1, "least": 0.2}}}}
    drawn = lambda n: write_study(folder, draw={"count": n, **spec}, grid={"ice.friction": [0.1, 0.2]})
    few, many = (list(expand(read_definition(drawn(n)))) for n in (3, 50))
    assert many[: len(few)] == few


@pytest.mark.parametrize("kind, numbers, mean, sd", [
    ("uniform", {"low": 2, "high": 4}, 3, 2 / 12**0.5),
    ("normal", {"mean": 5, "sd": 2}, 5, 2),
    ("log_normal", {"mean": 3, "sd": 1}, 3, 1),
    ("log_uniform", {"low": 1, "high": 2.718281828}, 1.71828, 0.4920)])
@pytest.mark.parametrize("method", ["independent", "latin_hypercube"])
def test_draws_have_the_distribution_that_was_asked_for(kind, numbers, mean, sd, method):
    values = draws.draw(1, "ice.thickness_m", kind, numbers, 4000, method)
    middle = sum(values) / len(values)
    spread = (sum((v - middle) ** 2 for v in values) / len(values)) ** 0.5
    assert middle == pytest.approx(mean, abs=4 * sd / 4000**0.5)
    assert spread == pytest.approx(sd, rel=0.1)
    for p in (0.01, 0.3, 0.9):
        assert draws.probability_below(kind, numbers, draws.value_at(kind, numbers, p)) == pytest.approx(p, abs=1e-9)


def test_latin_hypercube_has_one_draw_in_each_part_and_bounds_hold():
    values = draws.draw(3, "a", "uniform", {"low": 0, "high": 1}, 100, "latin_hypercube")
    assert sorted(int(100 * v) for v in values) == list(range(100))
    assert draws.draw(3, "b", "uniform", {"low": 0, "high": 1}, 100, "latin_hypercube") != values
    values = draws.draw(1, "a", "normal", {"mean": 0, "sd": 1, "least": -0.5, "most": 2}, 1000, "independent")
    assert -0.5 <= min(values) < -0.45 and 1.7 < max(values) <= 2


def test_everything_wrong_with_a_study_is_reported_with_its_place(folder):
    path = folder / "wrong.json"
    path.write_text('''{
  "scenes": "plate.json",  // a comment
  "grid": {"a": [], "b": {"from": 1, "to": 2}},
  "paired": {"c": [1], "d": [1, 2]},
  "draw": {"count": 0, "of": {"e": {"normal": {"mean": 1, "sd": -1}}, "a": {"uniform": {"low": 1, "high": 2}}}},
  "report": {"map": ["a"], "channels": -1, "means": 3}, "collect": {"quantiles": [1.5], "time_to": {"port": {"z_m": 1}}}
}''')
    found = problems_of(path)
    for words in (
        'wrong.json:2:3: scenes: found an unknown key', 'did you mean "scene"?',
        'wrong.json:3:17: grid.a: found an empty list',
        "wrong.json:3:26: grid.b: found count and step together or neither",
        "wrong.json:4:13: paired: found lists of 1 (c), 2 (d)", "wrong.json:5:21: draw.count: found 0",
        "draw.of.e.normal: found -1 for sd, allowed: a number > 0", 'draw.of.a: found what "grid" varies too',
        "collect.quantiles", "wrong.json:6:109: collect.time_to.port: found keys z_m, allowed: x_m",
        "report.map: found a list of 1, allowed: a list of two paths", "report.channels: found -1",
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
    "name": "mutated", "scene": "plate.json", "set": {"time.until_s": 6},
    "grid": {"ice.thickness_m": [0.4, 0.6], "ice.friction": {"from": 0.1, "to": 0.2, "step": 0.05}},
    "paired": {"name": ["a", "b"], "ice.density_kg_per_m3": [900, 910]},
    "draw": {"count": 2, "of": {"ice.flexural_strength_Pa": {"log_normal": {"mean": 5e5, "sd": 1e5, "most": 1e6}}}},
    "repetitions": 2,
    "collect": {"from_s": 1, "quantiles": [0.5], "time_to": {"lead": {"point_m": [1, 2], "within_m": 3}}},
    "keep": "summary", "report": {"against": "ice.friction", "map": ["ice.thickness_m", "ice.friction"], "channels": 2},
}


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


def test_numbers_beyond_what_can_be_computed_and_copies_are_refused(folder):
    wide = {"log_normal": {"mean": 5e5, "sd": 1e308}}
    for keys, message in (
        ({"draw": {"count": 2, "of": {"a": wide}}}, "sd 1e+308, allowed: a distribution whose draws"),
        ({"collect": {"time_to": {"lead": {"x_m": []}}}}, "time_to.lead.x_m: found a list, allowed: a number [m]"),
        ({"grid": {"a": {"from": 1e-308, "to": 1e308, "count": 3, "spacing": "log"}}},
         "grid.a: found ends that are too"),
        ({"grid": {"a": {"from": 0, "to": 1, "count": 10**8}}}, "grid.a.count: found 100000000, allowed: a whole"),
        ({"repetitions": 2, "grid": {"seed": [1, 2]}}, "repetitions would be copies"),
    ):
        assert message in problems_of(write_study(folder, **keys))[0]


def test_a_damaged_plan_is_named(folder):
    planned(folder)
    for name, text in (("plan.json", "[]"), ("plan.json", '{"format": 1}'), ("cases.ndjson", '{"scene": 3}\n')):
        plan = folder / "studies/s" / name
        kept = plan.read_text()
        plan.write_text(text)
        assert f"{name}:" in study("run", "studies/s", "--case", 0, code=5)
        plan.write_text(kept)


def test_lists_of_numbers_are_read_as_they_are_written():
    numbers = [0, 3, 4, 5, 9, 11, 12]
    assert list_of_numbers(numbers) == "0,3-5,9,11-12"
    assert numbers_of_list("0,3-5,9,11-12", 13, "case") == numbers
    with pytest.raises(StudyError, match="there is no case 99999999999"):
        numbers_of_list("2-99999999999", 13, "case")
    for words in ("a", "5-3", "1,,2", "²"):
        with pytest.raises(StudyError, match="no list of cases"):
            numbers_of_list(words, 13, "case")


def test_a_case_that_the_scene_does_not_allow_is_refused_before_anything_runs(folder):
    path, set_ = folder / "s.json", '"set": {"floes[0].rectangle.corner_m": [-20, 0]}}'
    grid = '"grid": {"ice.thickness_m": [0.5, -1], "ice.frction": [0.1]}'
    thickness = f"{path}:2:30: ice.thickness_m: found -1, allowed: a number ≥ 0.001, ≤ 20 [m] [case 1]"
    friction = f"{path}:2:56: ice.frction: found an unknown key"
    for text, messages in (
        ('{"scene": "plate.json",\n %s,\n %s' % (grid, set_),
         (thickness, friction, 'mean "friction"?', "[all 2 cases]")),
        ('{"scene": "plate.json", ' + set_, ("plate.json:5:12",)),
        ('{"scene": "gone.json"}', (f"{path}:1:11: scene: {folder}/gone.json: no such file\n",)),
        ('{"scene": "s.json",}', (f"{path}:1:19: a comma too many",)),
    ):
        path.write_text(text)
        words = study("plan", path, code=3)
        assert all(message in words for message in messages), words
        assert not (folder / "studies" / "s").exists()


def test_planning_again_changes_nothing_and_a_study_may_grow(folder):
    def times():
        return {p: p.stat().st_mtime_ns for p in (folder / "studies/s").iterdir()}

    planned(folder, repetitions=2, grid={"ice.thickness_m": [0.4, 0.5]})
    before = times()
    planned(folder, repetitions=2, grid={"ice.thickness_m": [0.4, 0.5]})
    assert before == times()
    study("run", "studies/s", "--cases", "0-3", "--quiet")
    case = folder / "studies/s/cases/000003/case.json"
    kept = case.read_bytes()
    planned(folder, repetitions=3, grid={"ice.thickness_m": [0.4, 0.5]})
    assert open_study("studies/s").count == 6 and case.read_bytes() == kept
    words = study("plan", write_study(folder, repetitions=3, grid={"ice.thickness_m": [0.4, 0.6]}), code=5)
    assert "its cases have run by an earlier plan with other cases" in words
    (folder / "plate.json").write_text(SCENE.replace("150", "140"))
    words = study("plan", write_study(folder, repetitions=3, grid={"ice.thickness_m": [0.4, 0.5]}), code=5)
    assert "with other inputs" in words
    planned(folder, "more", "--repetitions", 5, repetitions=2)
    assert open_study("studies/more").count == 5
    assert "copies" in study("plan", write_study(folder, "own", grid={"seed": [3, 4]}), "--repetitions", 5, code=2)
    assert "150" in (folder / "studies/s/scenes/0/plate.json").read_text()


def test_a_plan_that_is_refused_leaves_the_cases_that_were_begun(folder):
    begun = planned(folder) / "cases/000000/run"
    begun.mkdir(parents=True)
    study("plan", write_study(folder, set={"ice.thickness_m": -1}), "--trial-seconds", 0, code=3)
    assert begun.exists()
    study("plan", write_study(folder, set={"ice.thickness_m": 0.4}), "--trial-seconds", 0)
    assert not begun.exists()


def test_what_only_began_by_another_plan_is_removed(folder):
    planned(folder, collect={"loads": ["surge_from_moorng_N"]})
    assert 'forces.csv has no column "surge_from_moorng_N"' in study("run", "studies/s", code=4)
    planned(folder, set={"ice.thickness_m": 0.4})
    assert not (folder / "studies/s/cases").exists()
    gathered(folder / "studies/s")


def test_the_trial_estimates_and_is_the_first_case(folder):
    words = study("plan", write_study(folder, repetitions=3))
    assert "a case " in words and "all 3" in words and "MB of memory" in words
    assert (folder / "studies/s/cases/000000/case.json").exists()
    words = study("plan", write_study(folder, "long", set={"time.until_s": 200000}), "--trial-seconds", "2")
    assert "extrapolated from" in words


def test_floe_files_come_with_the_study(folder):
    (folder / "ice").mkdir()
    plate = {"type": "Polygon", "coordinates": [[[0, 0], [50, 0], [50, 150], [0, 150], [0, 0]]]}
    (folder / "ice" / "a.geojson").write_text(json.dumps(plate))
    rectangle = '{"rectangle": {"corner_m": [0, 0], "size_m": 150}}'
    (folder / "plate.json").write_text(SCENE.replace(rectangle, '{"file": "ice/a.geojson"}'))
    planned(folder)
    shutil.rmtree(folder / "ice")
    study("run", "studies/s", "--quiet")
    assert (folder / "studies/s/cases/000000/case.json").exists()
