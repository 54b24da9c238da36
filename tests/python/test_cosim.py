"""A ship with its own propulsion model, coupled by a co-simulation unit, does what the same ship does in one scene."""
import importlib.util
import pathlib
import sys

import numpy

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def example():
    sys.path.insert(0, str(EXAMPLES))
    spec = importlib.util.spec_from_file_location("couple_by_fmu", EXAMPLES / "couple_by_fmu.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


COUPLE = example()


def test_open_water_is_the_same_within_one_percent(tmp_path):
    alone, coupled = COUPLE.sail_alone(1, False, 80), COUPLE.sail_coupled(1, False, 80, tmp_path)
    assert alone[0][-1] > alone[0][0] + 1, "the ship gains speed"
    assert numpy.abs(coupled[0] / alone[0] - 1).max() < 0.01
    assert abs(coupled[1][-1] - alone[1][-1]) < 0.01 * (alone[1][-1] + 45)


def test_ways_through_ten_fields_are_the_same_within_two_standard_errors(tmp_path):
    ways = numpy.array([(COUPLE.sail_alone(seed, True, 80)[1][-1], COUPLE.sail_coupled(seed, True, 80, tmp_path)[1][-1])
                        for seed in range(1, 11)])
    difference = ways[:, 1] - ways[:, 0]
    error = difference.std(ddof=1) / numpy.sqrt(len(difference))
    assert ways[:, 0].std() > 1, "the fields differ"
    assert abs(difference.mean()) <= 2 * error
    assert error < 0.01 * (ways[:, 0].mean() + 45), "and two standard errors are little"


def test_a_wrong_propeller_is_seen(tmp_path, monkeypatch):
    monkeypatch.setattr(COUPLE, "thrust", lambda speed: 0.9 * COUPLE.BOLLARD_PULL)
    alone, coupled = COUPLE.sail_alone(1, False, 40), COUPLE.sail_coupled(1, False, 40, tmp_path)
    assert numpy.abs(coupled[0] / alone[0] - 1).max() > 0.01
