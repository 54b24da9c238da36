"""Published formulas, and the curve of a ship's speed in level ice."""
import csv
import math

import pytest

from polynya import formulas
from polynya.performance import level_ice
from polynya.performance.__main__ import engine_of, hull_of, ship_of
from polynya.performance.options import thicknesses
from polynya.performance.curve import Curve

HULL = formulas.Hull(120, 24, 6, math.radians(30), math.radians(27))


def lindqvist(speed, thickness=0.5, **ice):
    return 1e-3 * sum(formulas.lindqvist(HULL, formulas.Ice(thickness, **ice), speed))


@pytest.mark.parametrize("speed, resistance", [(0, 391.0), (0.5, 474.2), (1, 557.4), (2, 723.7)])
def test_lindqvists_resistance_of_the_reference_ship(speed, resistance):
    assert lindqvist(speed) == pytest.approx(resistance, rel=1e-3)


@pytest.mark.parametrize(
    "thickness, at_rest, at_1", [(0.3, 202, 293), (0.8, 751, 1044), (1.0, 1039, 1425), (1.2, 1365, 1850)]
)
def test_lindqvists_resistance_by_thickness(thickness, at_rest, at_1):
    assert lindqvist(0, thickness) == pytest.approx(at_rest, rel=3e-3)
    assert lindqvist(1, thickness) == pytest.approx(at_1, rel=3e-3)


@pytest.mark.parametrize("friction, at_rest, at_1", [(0.05, 216, 316), (0.1, 273, 395)])
def test_lindqvists_resistance_by_friction(friction, at_rest, at_1):
    assert lindqvist(0, friction=friction) == pytest.approx(at_rest, rel=3e-3)
    assert lindqvist(1, friction=friction) == pytest.approx(at_1, rel=3e-3)


def test_the_other_formulas():
    ice = formulas.Ice(0.5)
    assert formulas.rise(HULL) == pytest.approx(5.0)
    assert formulas.slide(HULL) == pytest.approx(70.83, rel=1e-4)
    assert 1e-3 * formulas.riska(HULL, ice, 1, parallel=72.9) == pytest.approx(422, rel=1e-3)
    assert 1e-3 * formulas.riska(HULL, ice, 1, parallel=96.4) == pytest.approx(466, rel=2e-3)
    for speed, resistance in ((0.5, 255), (1, 344), (2, 473)):
        assert 1e-3 * formulas.spencer_jones(HULL, ice, speed) == pytest.approx(resistance, rel=2e-3)


def test_thrust_and_equilibrium():
    assert 1e-3 * formulas.bollard_pull(10e6, 4.3, 2) == pytest.approx(1203, rel=1e-3)
    assert formulas.net_thrust(1e6, 8, 0) == 1e6
    assert formulas.net_thrust(1e6, 8, 8) == pytest.approx(0, abs=1e-6)
    speed = formulas.equilibrium(1e6, 8, lambda v: 391.0e3 + 166.4e3 * v)
    assert speed == pytest.approx(2.591, abs=5e-4)
    assert formulas.equilibrium(1e6, 8, lambda v: 2e6) == 0


def write_run(folder, speeds, step=0.5):
    """A run that goes at these speeds, one a row."""
    x = 0.0
    with open(folder / "forces.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["t_s", "ship", "surge_N", "surge_from_submerged_ice_N", "x_m"])
        for i, speed in enumerate(speeds):
            x += step * speed
            writer.writerow([step * (i + 1), "ship", -1e5, -4e4, x])


SHIP = {
    "hull": {"length_m": 100, "beam_m": 20, "draught_m": 7, "stem_angle_deg": 25, "entrance_angle_deg": 30},
    "propulsion": {"engine": {"bollard_pull_kN": 1000, "open_water_speed_m_per_s": 8}},
}


def test_a_steady_run_is_measured_where_the_hull_is_full(tmp_path):
    entering = [5.0] * 88  # 220 m
    write_run(tmp_path, entering + [2.0 + 0.02 * math.sin(0.1 * i) for i in range(1000)])
    measured = level_ice.Measured(tmp_path, SHIP)
    assert measured.speed == pytest.approx(2, abs=0.02)
    assert measured.is_within(0.03) and not measured.is_stuck
    assert 1e-3 * measured.contact == pytest.approx(100)
    assert 1e-3 * measured.submerged == pytest.approx(40)


def test_a_run_that_slows_down_is_not_steady(tmp_path):
    write_run(tmp_path, [5.0] * 100 + [3 - 0.002 * i for i in range(1000)])
    assert not level_ice.Measured(tmp_path, SHIP).is_within(0.03)


def test_a_ship_that_stops_has_no_speed(tmp_path):
    write_run(tmp_path, [3.0] * 200 + [0.0] * 800)
    measured = level_ice.Measured(tmp_path, SHIP)
    assert measured.is_stuck and measured.speed == 0 and measured.is_within(0.03)


def test_what_a_ship_needs_is_asked_for():
    assert engine_of(SHIP) == {"bollard_pull": 1e6, "open_water_speed": 8}
    with pytest.raises(ValueError, match="propulsion.engine"):
        engine_of({"propulsion": {"thrust_N": 1e6}})
    with pytest.raises(ValueError, match="hull.draught_m"):
        hull_of({"hull": {"length_m": 100, "beam_m": 20}})
    assert thicknesses("0.8,0.4") == [0.4, 0.8]
    for wrong in ("", "a", "0,1", "-1"):
        with pytest.raises(Exception, match="allowed: a number"):
            thicknesses(wrong)


def test_the_curve_starts_near_the_formulas(tmp_path):
    ice = formulas.Ice(0, flexural_strength=500e3, friction=0.1)
    curve = Curve(SHIP, hull_of(SHIP), engine_of(SHIP), ice, str(tmp_path), "polynya", 0.03, 0.01)
    speeds = curve.formula_speeds(0.5)
    assert min(speeds.values()) > 1
    assert speeds["lindqvist"] < curve.first_speed(0.5) < 8
    assert curve.first_speed(4) == 0.5, "a ship that the formulas stop is tried all the same"
    scene = level_ice.scene(SHIP, curve.level(0.5), 2, 8, 0.01)
    assert scene["floes"][0]["fast_ice"] and scene["time"]["until_s"] == 450
    assert scene["ice"]["thickness_m"] == 0.5


def test_a_file_that_names_a_preset_starts_from_all_of_it(tmp_path):
    path = tmp_path / "deeper.json"
    path.write_text('{"ship": "polaris", // as scenes have it\n "hull": {"draught_m": 8.5}}')
    title, ship, reported = ship_of(str(path))
    _, polaris, _ = ship_of("polaris")
    assert title == "deeper" and reported
    assert ship["hull"] == polaris["hull"] | {"draught_m": 8.5}
    assert ship["propulsion"] == polaris["propulsion"]
