"""Short names: by what differs, and of values, runs and cases alike."""
import json

from polynya.naming import names_of, names_of_folders
from polynya.readable import force

PILOTS = [{"manage": {"body": "rig", "pattern": "circular", "distance_m": 250, "width_m": 160}},
          {"manage": {"body": "rig", "pattern": "racetrack", "distance_m": 250, "width_m": 160, "depth_m": 120}},
          {"constant": {"lever": 0}}]


def names(values):
    return list(names_of([json.dumps(value) for value in values]).values())


def test_objects_are_named_by_the_fewest_members_that_tell_them_apart():
    assert names(PILOTS) == ["circular", "racetrack", "constant"]
    manage = PILOTS[0]["manage"]
    assert names([{"manage": {**manage, "width_m": width, "distance_m": distance}}
                  for width in (100, 160) for distance in (200, 300)]) == [
        "distance 200 m, width 100 m", "distance 300 m, width 100 m", "distance 200 m, width 160 m",
        "distance 300 m, width 160 m"]
    assert names([{"hull": {"stem_angle_deg": 20}}, {"hull": {"stem_angle_deg": 35.5}}]) == ["stem angle 20°",
                                                                                          "stem angle 35.5°"]
    assert names(PILOTS[:1]) == ["rig, circular"]  # one value alone is named by its words
    assert names([[1, 2], [1, 3]]) == ["[1, 2]", "[1, 3]"]
    assert names([{"a": {}}, {"a": None}, {}]) == ["a {}", "a null", "{}"]


def test_numbers_and_words_name_themselves():
    assert list(names_of([0.4, 0.5, 1e6]).values()) == ["0.4", "0.5", "1e+06"]
    assert list(names_of(["pack", "level"]).values()) == ["pack", "level"]


def test_long_names_are_cut_and_stay_different():
    found = names([{"name": "x" * 100 + end} for end in ("a", "b", "b" * 2)])
    assert len(set(found)) == 3 and max(map(len, found)) <= 44
    long = list(names_of(["y" * 60 + middle + "y" * 60 for middle in "ab"]).values())
    assert len(set(long)) == 2


def test_folders_are_named_by_what_differs():
    assert names_of_folders(["A/run", "B/run"]) == ["A", "B"]
    assert names_of_folders(["runs/a", "runs/b"]) == ["a", "b"]
    assert names_of_folders(["x/cases/000012/run", "x/cases/000137/run"]) == ["case 12", "case 137"]
    assert names_of_folders(["x/cases/000012/run"]) == ["case 12"]
    assert names_of_folders(["p/q", "s/q/r", "s/t/r"]) == ["p/q", "q/r", "t/r"]
    assert names_of_folders(["a", "a"]) == ["a (1)", "a (2)"]


def test_forces_have_three_digits_and_the_unit_of_the_rounded_value():
    values = [850, -12512, 999.9, 999_600, 3.28e6, 1.2345e9, 0]
    assert [force(value) for value in values] == ["850 N", "-12.5 kN", "1 kN", "1 MN", "3.28 MN", "1230 MN", "0 N"]
