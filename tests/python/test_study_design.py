"""A study whose cases are the rows of a CSV file, and their measures as CSV."""
import csv
import os

import pytest

from polynya.study.definition import read_definition
from polynya.study.expand import count_cases, expand
from polynya.study.located_json import StudyError
from study_command import folder, planned, rows, study, write_study  # noqa: F401

DESIGN = "ice.thickness_m,ships[0].propulsion.constant_speed_m_per_s,seed\n0.4,1,3\n0.6,2e0,4\n0.5,1.5,5\n"


def problems_of(path, design=None):
    with pytest.raises(StudyError) as caught:
        read_definition(path, design)
    return [str(problem) for problem in caught.value.problems]


def test_a_row_is_a_case_in_their_order(folder):  # noqa: F811
    (folder / "design.csv").write_text(DESIGN)
    definition = read_definition(write_study(folder, design="design.csv"))
    cases = [case for _, case in expand(definition)]
    assert count_cases(definition) == 3
    assert cases[1] == {"ice.thickness_m": 0.6, "ships[0].propulsion.constant_speed_m_per_s": 2, "seed": 4}
    grid = read_definition(write_study(folder, design="design.csv", grid={"time.until_s": [3, 4]}))
    assert count_cases(grid) == 6
    (folder / "words.csv").write_text('name,fracture.going_under.enabled,"ships[0].position_m"\r\n'
                                      '"a b",true,"[-61, 75]"\r\n')
    (case,) = (case for _, case in expand(read_definition(write_study(folder, design="words.csv"))))
    assert case == {"name": "a b", "fracture.going_under.enabled": True, "ships[0].position_m": [-61, 75], "seed": 1}


@pytest.mark.parametrize("text, problem", [
    ("", "found no case"),
    ("ice.thickness_m\n", "found no case"),
    ("ice.thickness_m,a\n0.4\n", ":2:1: found 1 values, allowed: 2"),
    ("ice.thickness_m\n0.4\n\"\"\n", ":3:1: ice.thickness_m: found an empty value"),
    ("seed,seed\n1,2\n", ":1:1: seed: found a path twice"),
    ("ice.thickness_m\nInfinity\n", "allowed: finite numbers"),
    ('ice.thickness_m\n"0.4\n', "found no CSV"),
])
def test_what_is_wrong_has_its_line(folder, text, problem):  # noqa: F811
    (folder / "d.csv").write_text(text)
    found = problems_of(write_study(folder, design="d.csv"))
    assert len(found) == 1 and problem in found[0] and "d.csv" in found[0]


def test_a_design_and_the_rest_of_a_study_agree(folder):  # noqa: F811
    (folder / "design.csv").write_text(DESIGN)
    twice = problems_of(write_study(folder, design="design.csv", grid={"ice.thickness_m": [1]}))
    assert "varies too" in twice[0]
    assert "lists of one length" in problems_of(write_study(folder, design="design.csv", paired={"name": ["a"]}))[0]
    (folder / "wrong.csv").write_text("ice.thickness_m\n0.4\n-1\n")
    assert "found -1" in study("plan", write_study(folder, design="wrong.csv"), "--trial-seconds", 0, code=3)
    assert "nowhere.csv" in study("plan", write_study(folder, design="nowhere.csv"), code=5)


def test_a_study_that_was_planned_with_a_design_goes_on_after_its_file_was_written_again(folder):  # noqa: F811
    (folder / "design.csv").write_text(DESIGN)
    path = write_study(folder)
    study("plan", path, "--design", "design.csv", "--out", "studies/s", "--trial-seconds", 0)
    later = (folder / "studies/s/plan.json").stat().st_mtime + 10
    os.utime(path, (later, later))
    study("run", path, "--cases", 0, "--quiet")
    (folder / "design.csv").write_text(DESIGN.replace("0.4,1,3", "0.4,1,9"))
    assert "other cases" in study("run", path, "--cases", 0, code=5)


def test_a_design_is_evaluated_to_measures(folder):  # noqa: F811
    (folder / "design.csv").write_text(DESIGN)
    path = write_study(folder)
    study("evaluate", path, "design.csv", "measures.csv")
    measured = rows(folder / "measures.csv")
    assert [row["ice.thickness_m"] for row in measured] == ["0.4", "0.6", "0.5"]
    assert all(float(row["resistance_mean_N"]) > 0 and row["state"] == "finished" for row in measured)
    again = planned(folder, "t", grid={"ice.thickness_m": [0.6]}, seed=4,
                    set={"ships[0].propulsion.constant_speed_m_per_s": 2})
    study("run", again, "--quiet")
    study("gather", again)
    assert rows(again / "table.csv")[0]["resistance_mean_N"] == measured[1]["resistance_mean_N"]
    study("evaluate", path, "design.csv", "measures.csv", "--quiet")
    with open("measures.csv", newline="") as file:
        assert list(csv.DictReader(file)) == measured, "finished cases are not run again"
