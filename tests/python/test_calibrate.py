"""The fit of two factors to tests of a ship, the table that it reads, and a calibration from beginning to end."""
import json
import pathlib

import numpy as np
import pytest

from program import succeeded
from polynya.calibrate import fit, level_tests
from polynya.errors import InputError
from polynya.results.run import is_calibrated

TOOLS = pathlib.Path(__file__).parents[2] / "tools"
HEADER = "test,thickness_m,flexural_strength_kPa,speed_m_per_s,resistance_mean_kN,resistance_sd_kN\n"


def behaviour(points):
    """Logarithms of mean and sd of three tests, as smooth functions of the factors."""
    a, b = points[:, 0], points[:, 1]
    return np.stack([np.stack([0.8 * a - k * b + 0.1 * a * b, 1.2 * a + 0.5 * b], -1) for k in (0.2, 0.3, 0.5)], 1)


def test_the_surface_is_exact_on_quadratics_and_the_fit_finds_the_factors_that_made_the_tests():
    points = np.vstack([fit.spread(9, np.zeros(2), np.log(2))[0], fit.spread(9, np.array([0.3, -0.2]), np.log(1.6))[0]])
    on_grid = fit.surface(points, behaviour(points), fit.GRID)
    near = (abs(fit.GRID) < np.log(2)).all(1)
    assert on_grid[near] == pytest.approx(behaviour(fit.GRID)[near], abs=0.03)
    true = np.log([1.4, 0.8])
    found = fit.fit(on_grid - behaviour(true[None]))
    assert found.factors == pytest.approx(np.exp(true), rel=0.05)
    assert (found.low < np.exp(true)).all() and (np.exp(true) < found.high).all() and not found.is_at_edge
    for others, ratio in fit.leave_one_out(on_grid - behaviour(true[None])):
        assert others.factors == pytest.approx(np.exp(true), rel=0.06) and ratio == pytest.approx([1, 1], abs=0.03)


def test_tests_that_contradict_each_other_widen_the_interval_and_the_error():
    points = fit.spread(20, np.zeros(2), np.log(2))[0]
    on_grid = fit.surface(points, behaviour(points), fit.GRID)
    agree, shifted = fit.fit(on_grid), on_grid + np.array([0.8, -0.6, 0.2])[:, None]
    differ = fit.fit(shifted)
    assert (np.log(differ.high / differ.low) > 1.2 * np.log(agree.high / agree.low)).any()
    assert max(abs(np.log(ratio[0])) for _, ratio in fit.leave_one_out(shifted)) > 0.3


@pytest.mark.parametrize("text, words", [
    ("", "no line of column names"), ("test,thickness_m\n", "no column speed_m_per_s"), (HEADER, "no test"),
    (HEADER + "a,0.5,500,-1,100,10\n", "2: speed_m_per_s: found -1, allowed: "),
    (HEADER + "# a comment\na,0.5,500,1,x,10\n", "3: resistance_mean_kN: found x"),
    (HEADER + "a,0.5,500,1,1,1\na,1,500,1,1,1\n", "two tests are called a")])
def test_wrong_tables_are_refused_with_their_places(tmp_path, text, words):
    path = tmp_path / "tests.csv"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        level_tests.read_tests(path)
    assert words in str(error.value)


def test_a_scene_carries_the_factors_and_is_valid(tmp_path):
    ship = json.loads((TOOLS / "uikku.json").read_text())
    for test in level_tests.read_tests(TOOLS / "uikku_tests.csv"):
        scene = level_tests.scene(test, ship, (1.5, 0.5), 0.05)
        assert is_calibrated(scene) and not is_calibrated(level_tests.scene(test, ship, (1, 1)))
        (tmp_path / "scene.json").write_text(json.dumps(scene))
        succeeded("validate", "scene.json", cwd=tmp_path)


def test_a_small_ship_from_her_tests_to_a_file_that_says_calibrated(tmp_path, monkeypatch):
    monkeypatch.setattr(level_tests, "MEASURED", 20)  # of the forty-two runs [m]
    ship = {"name": "tug", "hull": {"length_m": 12, "beam_m": 6, "draught_m": 2,
                                    "entrance_angle_deg": 40, "stem_angle_deg": 30},
            "mass_kg": 1e5, "moment_of_inertia_kg_m2": 1e6, "propulsion": {"constant_speed_m_per_s": 1}}
    (tmp_path / "tug.json").write_text(json.dumps(ship) + "// a ship as scenes have it\n")
    (tmp_path / "tests.csv").write_text(HEADER + "a,0.4,500,1,40,15\nb,0.5,500,1,55,20\nc,0.6,500,1,70,20\n")
    done = succeeded("calibrate", "tug.json", "tests.csv", "--points", 8, "--leave-out", "b", "--out", "out",
                     "--jobs", 2, cwd=tmp_path)
    assert "predicted" in done.stdout and "with 68 %" in done.stdout
    assert "error of a mean that was left out" in done.stdout
    record = json.loads((tmp_path / "out/calibration.json").read_text())
    assert [row["is_fitted"] for row in record["tests"]] == [True, False, True]
    assert all(low <= factor <= high for low, factor, high in zip(record["low_68"],
                                                                  record["factors"], record["high_68"]))
    assert (tmp_path / "out/calibration.png").stat().st_size > 10_000
    written = json.loads((tmp_path / "out/tug-calibrated.json").read_text())
    assert written["calibration"]["load_factor"] == pytest.approx(record["factors"][0], rel=0.01)
    (tmp_path / "scene.json").write_text(json.dumps({"name": "s", "time": {"until_s": 0.1},
                                                     "ships": [written], "floes": []}))
    run = succeeded("run", "scene.json", "--out", "run", cwd=tmp_path)
    assert "note: calibrated: bending loads times" in run.stderr
    succeeded("view", "run", cwd=tmp_path)
    assert "s, calibrated" in (tmp_path / "run/view.html").read_text()
