"""Resistance in pack ice, level ice and channels, and its fit in Colbourne's form."""
import csv
import json
import math
import random

import pytest

from program import ended, succeeded
from polynya import formulas, ice_class
from polynya.performance import colbourne, ice_scenes, rules
from polynya.performance.resistance import is_validated, points_of

BEAM, DENSITY = 20.0, 900.0
POINTS = points_of((1.0, 2.0, 4.0), (0.3, 0.6), (0.5, 0.8), (20.0,))


def test_a_fit_gives_back_what_points_were_made_of():
    truth = colbourne.Fit(4.4, 0, 0.8267, 0, 2.0, 0, 1, 0)
    fitted = colbourne.fit(POINTS, [truth.resistance(p, BEAM, DENSITY) for p in POINTS], BEAM, DENSITY)
    assert (fitted.k, fitted.b, fitted.n) == pytest.approx((4.4, 0.8267, 2.0), rel=1e-9)
    assert fitted.scatter == pytest.approx(1) and fitted.k_error < 1e-6 and fitted.points == len(POINTS)
    # Validation's own numbers of the slender ship: 0.5 m, 1 m/s, cover 0.7.
    reference = {"speed_m_per_s": 1, "thickness_m": 0.5, "cover": 0.7}
    assert 1e-3 * truth.resistance(reference, 24, 900) == pytest.approx(19, abs=0.6)


def test_errors_and_scatter_are_those_of_noise():
    dice, truth = random.Random(5), colbourne.Fit(10, 0, 1.2, 0, 2.5, 0, 1, 0)
    off = []
    for _ in range(200):
        noisy = [truth.resistance(p, BEAM, DENSITY) * math.exp(dice.gauss(0, 0.2)) for p in POINTS]
        fitted = colbourne.fit(POINTS, noisy, BEAM, DENSITY)
        off.append(((fitted.b - 1.2) / fitted.b_error, (fitted.n - 2.5) / fitted.n_error, math.log(fitted.scatter)))
    for i in (0, 1):  # Student's t of nine degrees of freedom has a deviation of 1.13
        assert math.sqrt(sum(row[i] ** 2 for row in off) / len(off)) == pytest.approx(1.13, abs=0.2)
    assert sum(row[2] for row in off) / len(off) == pytest.approx(0.2, abs=0.02)


def test_too_few_points_or_one_froude_number_decide_nothing():
    with pytest.raises(colbourne.NotEnough):
        colbourne.fit(POINTS[:4], [1e4] * 4, BEAM, DENSITY)
    same = [{**POINTS[0], "floe_size_m": i} for i in range(6)]
    with pytest.raises(colbourne.NotEnough):
        colbourne.fit(same, [1e4] * 6, BEAM, DENSITY)
    one_cover = points_of((1, 2, 3), (0.5, 1), (1.0,), (0,))
    assert colbourne.fit(one_cover, range(1, 7), BEAM, DENSITY).n is None


def test_what_was_compared_is_marked():
    inside = {"speed_m_per_s": 1, "thickness_m": 0.5, "cover": 0.7, "floe_size_m": 15}
    assert is_validated(ice_scenes.PACK, inside) and not is_validated(ice_scenes.PACK, {**inside, "thickness_m": 0.8})
    assert not is_validated(ice_scenes.CHANNEL, inside)
    assert is_validated(ice_scenes.LEVEL, inside) and not is_validated(ice_scenes.LEVEL, {**inside, "thickness_m": 0.6})


@pytest.mark.parametrize(("words", "counts"), [
    (("--pack",), "54 points, 108 runs"),
    (("--pack", "--cover", "0.5", "--fields", "3"), "18 points, 54 runs"),
    (("--level", "--speed", "1,2"), "6 points, 6 runs"),
])
def test_a_list_of_points_starts_no_run(tmp_path, words, counts):
    printed = succeeded("performance", "reference", *words, "--list", cwd=tmp_path).stdout.splitlines()
    assert printed[-1] == counts
    assert len(printed) == 2 + int(counts.split()[0])
    assert not list(tmp_path.iterdir())


SHIP = {"hull": {"length_m": 40, "beam_m": 10, "draught_m": 3, "stem_angle_deg": 30, "entrance_angle_deg": 30},
        "propulsion": {"engine": {"bollard_pull_kN": 200, "open_water_speed_m_per_s": 6}}}
ASKED = {
    "--pack": ["--cover", "0.5,0.7,0.8", "--floe-size", "15", "--thickness", "0.4", "--fields", "2"],
    "--level": ["--thickness", "0.3,0.5"],
    "--channel": ["--cover", "0.5,0.6,0.7", "--floe-size", "4", "--thickness", "0.4", "--fields", "1"],
}


@pytest.mark.parametrize("regime", ASKED)
def test_the_command_writes_a_table_and_a_fit(regime, tmp_path):
    name = regime[2:]
    (tmp_path / "ship.json").write_text(json.dumps(SHIP))
    speeds = ["--speed", "1,2,4"]
    words = ["performance", tmp_path / "ship.json", regime, *speeds, *ASKED[regime], "--out", tmp_path / "out"]
    printed = succeeded(*words).stdout
    fit = json.loads((tmp_path / "out" / f"{name}.json").read_text())
    with open(tmp_path / "out" / f"{name}.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == {"pack": 9, "level": 6, "channel": 9}[name]
    assert all(float(row["resistance_N"]) > 0 for row in rows) and "k = " in printed
    assert fit["form"] == colbourne.FORM and fit["ice"] == name and fit["beam_m"] == 10
    assert fit["k"] > 0 and fit["scatter_factor"] > 1 and fit["points"] == len(rows)
    assert (fit["n"] is None) == (name == "level")
    assert len(fit["not_supported"]) == 4 and fit["range"]["speed_m_per_s"] == [1, 4]
    first = rows[0]
    point = {key: float(first[key]) for key in ("speed_m_per_s", "thickness_m", "cover")}
    of_fit = 0.5 * fit["ice_density_kg_per_m3"] * 10 * point["thickness_m"] * point["speed_m_per_s"] ** 2 * fit["k"]
    of_fit *= colbourne.froude(point) ** -fit["b"] * point["cover"] ** (fit["n"] or 0)
    assert float(first["fit_N"]) == pytest.approx(of_fit, rel=1e-9)
    assert (tmp_path / "out" / "ice-class.csv").exists() == (name == "channel")
    assert ("by the rule" in printed) == (name == "channel")
    assert succeeded(*words).stdout.splitlines()[-3:] == printed.splitlines()[-3:], "finished runs are used again"


def test_the_rules_terms_are_those_of_a_calculation_by_hand():
    """A hull whose particulars make the terms simple: L 100, B 20, T 5 m, both angles 45 degrees."""
    hull = formulas.Hull(100, 20, 5, math.radians(45), math.radians(45))
    found = ice_class.channel_resistance(hull, 0.8)
    displaced = 0.26 + 4  # 0.26 + (0.8 · 20)^½
    flare = math.degrees(math.atan(math.sqrt(2)))
    friction = 0.15 * math.sqrt(0.5) + math.sqrt(2 / 3) * math.sqrt(0.5)
    assert found.bow == pytest.approx(845 * friction * (displaced + 0.8) ** 2
                                      * (20 + (0.047 * flare - 2.115) * displaced))
    assert found.midbody == pytest.approx(42 * 90 * displaced**2)  # the bow is 10 m long
    assert found.waterplane == pytest.approx(825 * 5 * 100 / 100)  # (L T / B²)³ = 1.95 counts as 5; A_wf = 100 m²
    assert found.total == pytest.approx(found.bow + found.midbody + found.waterplane) and found.frozen == 0
    frozen = ice_class.channel_resistance(hull, 0.8, is_frozen=True)
    assert frozen.total - found.total == pytest.approx(frozen.frozen)
    # The frozen layer is the level ice resistance of [Riska1997] in 0.1 m at 5 knots, by rounded coefficients.
    assert frozen.frozen == pytest.approx(formulas.riska(hull, formulas.Ice(0.1), 5 * formulas.KNOT), rel=0.02)
    assert ice_class.minimum_power(400e3, 4, 1) == pytest.approx(2.26 * 8000 / 4 * 1e3)
    assert ice_class.minimum_power(400e3, 4, 2, "controllable") == pytest.approx(1.44 * 8000 / 4 * 1e3)


def test_computed_resistance_stands_beside_its_class():
    of_all = {"thickness_m": 0.8, "floe_size_m": 2, "resistance_N": 4e5, "error_N": 1e3}
    points = [{**of_all, "speed_m_per_s": v, "cover": c} for v in (2.0, 2.572) for c in (0.7, 0.8)]
    ship = {**SHIP, "propulsion": {"engine": {"propellers": 2, "propeller_diameter_m": 4}}}
    found = rules.rows(ship, points)
    assert [row["class"] for row in found] == ["IA Super", "IA", "IB", "IB", "IC"]
    assert [row["computed_N"] for row in found] == ["", "", 4e5, 4e5, ""]
    assert found[2]["computed_power_fixed_pitch_W"] == pytest.approx(1.6 * 8000 / 4 * 1e3)
    assert rules.propellers_of(SHIP) == (1, 0.65 * 3)


def test_the_rules_alone_need_no_run(tmp_path):
    printed = succeeded("performance", "araon", "--channel", "--list", cwd=tmp_path).stdout
    assert "IA Super" in printed and "2 propellers of 4.3 m" in printed
    assert not list(tmp_path.iterdir())


def test_one_regime_at_a_time(tmp_path):
    done = ended("performance", "polaris", "--pack", "--level")
    assert done.returncode == 2 and "--level: not allowed with --pack" in done.stderr
