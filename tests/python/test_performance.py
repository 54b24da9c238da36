"""Published formulas, and the curve of a ship's speed in level ice."""
import csv
import json
import math
import random
import re

import pytest

from program import SCENES, ended, mutated, succeeded
from polynya import formulas
from polynya.performance import level_ice, sensitivity
from polynya.performance.__main__ import hull_of, print_table, ship_of
from polynya.performance.curve import VALIDATED_THICKNESS, Curve, beyond_band
from polynya.performance.options import USES, command_line, problem_of, read_options
from polynya.program import program
from polynya.runs_kept import RunFailed, kept_run

HULL = formulas.Hull(120, 24, 6, math.radians(30), math.radians(27))


@pytest.mark.parametrize("resistance, speed, thickness, friction, tolerance", [
    (391, 0, 0.5, None, 1e-3), (474.2, 0.5, 0.5, None, 1e-3), (557.4, 1, 0.5, None, 1e-3), (723.7, 2, 0.5, None, 1e-3),
    (202, 0, 0.3, None, 3e-3), (751, 0, 0.8, None, 3e-3), (1039, 0, 1.0, None, 3e-3), (1365, 0, 1.2, None, 3e-3),
    (293, 1, 0.3, None, 3e-3), (1044, 1, 0.8, None, 3e-3), (1425, 1, 1.0, None, 3e-3), (1850, 1, 1.2, None, 3e-3),
    (216, 0, 0.5, 0.05, 3e-3), (316, 1, 0.5, 0.05, 3e-3), (273, 0, 0.5, 0.1, 3e-3), (395, 1, 0.5, 0.1, 3e-3)])
def test_lindqvists_resistance_of_the_reference_ship(resistance, speed, thickness, friction, tolerance):
    ice = formulas.Ice(thickness, **({} if friction is None else {"friction": friction}))
    assert 1e-3 * sum(formulas.lindqvist(HULL, ice, speed)) == pytest.approx(resistance, rel=tolerance)


def test_the_other_formulas():
    ice = formulas.Ice(0.5)
    assert formulas.rise(HULL) == pytest.approx(5.0)
    assert formulas.slide(HULL) == pytest.approx(70.83, rel=1e-4)
    assert 1e-3 * formulas.riska(HULL, ice, 1, parallel=72.9) == pytest.approx(422, rel=1e-3)
    assert 1e-3 * formulas.riska(HULL, ice, 1, parallel=96.4) == pytest.approx(466, rel=2e-3)
    for speed, resistance in ((0.5, 255), (1, 344), (2, 473)):
        assert 1e-3 * formulas.spencer_jones(HULL, ice, speed) == pytest.approx(resistance, rel=2e-3)


def test_a_stem_too_steep_or_rough_to_turn_ice_down_is_no_small_resistance():
    for hull in (HULL, formulas.Hull(120, 24, 6, math.radians(90), math.radians(27))):
        assert sum(formulas.lindqvist(hull, formulas.Ice(0.5, friction=2), 1)) == math.inf
    assert formulas.equilibrium(1e6, 8, lambda v: math.inf) == 0


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


def test_a_run_is_steady_slows_down_or_stops(tmp_path):
    write_run(tmp_path, [5.0] * 88 + [2.0 + 0.02 * math.sin(0.1 * i)
                                      for i in range(1000)])  # 220 m until the hull is full
    measured = level_ice.Measured(tmp_path, SHIP)
    assert measured.speed == pytest.approx(2, abs=0.02) and measured.is_within(0.03) and not measured.is_stuck
    assert (1e-3 * measured.contact, 1e-3 * measured.submerged) == (pytest.approx(100), pytest.approx(40))
    write_run(tmp_path, [5.0] * 100 + [3 - 0.002 * i for i in range(1000)])
    assert not level_ice.Measured(tmp_path, SHIP).is_within(0.03)
    write_run(tmp_path, [3.0] * 200 + [0.0] * 800)
    measured = level_ice.Measured(tmp_path, SHIP)
    assert measured.is_stuck and measured.speed == 0 and measured.is_within(0.03)


@pytest.mark.parametrize("option, key", [
    ("--thickness", "ice.thickness_m"), ("--flexural-strength", "ice.flexural_strength_Pa"),
    ("--friction", "ice.friction"), ("--step", "time.step_s")])
def test_options_have_the_ranges_of_the_scenes_keys(option, key, capsys):
    field = json.loads(succeeded("schema").stdout)
    for step in key.split("."):
        field = field["properties"][step]
    field = field.get("anyOf", [field])[0]
    low, high = field["minimum"], field["maximum"]
    read = lambda value: getattr(command_line().parse_args(["ship", f"{option}={value!r}"]),
                                 option[2:].replace("-", "_"))
    assert read(low) in (low, [low]) and read(high) in (high, [high])
    for wrong in (math.nextafter(low, -1), math.nextafter(high, math.inf), math.nan, math.inf, "x", ""):
        with pytest.raises(SystemExit) as ended:
            read(wrong)
        assert ended.value.code == 2
        assert re.search(rf"{option}: found .*, allowed: a number ≥ {low:g}, ≤ {high:g}".replace("+", r"\+"),
                         capsys.readouterr().err)


def test_other_options_have_ranges_too(capsys):
    for wrong in ("--error=0", "--error=1", "--error=nan", "--jobs=0", "--jobs=1.5", "--thickness=0.5,,1"):
        with pytest.raises(SystemExit):
            command_line().parse_args(["ship", wrong])
        assert "allowed: " in capsys.readouterr().err


VALUES = {"thickness": "0.5", "flexural_strength": "5e5", "friction": "0.1", "step": "0.01", "out": "x", "jobs": "2",
          "cover": "0.8", "floe_size": "20", "fields": "3", "speed": "2", "error": "0.05"}


@pytest.mark.parametrize("use", list(USES))
def test_an_option_that_a_use_ignores_is_refused_with_the_uses_it_is_for(use, capsys):
    words = ["ship", *(word for word in use.split() if word.startswith("--"))]
    assert set(VALUES) == set().union(*USES.values())
    for name, value in VALUES.items():
        option = f"--{name.replace('_', '-')}"
        problem = problem_of(command_line().parse_args([*words, f"{option}={value}"]))
        assert (problem == "") == (name in USES[use])
        if problem:
            assert problem.startswith(f"{option}: {use} does not use it; it is for: ")
            with pytest.raises(SystemExit) as ended_by:
                read_options([*words, f"{option}={value}"])
            assert ended_by.value.code == 2 and capsys.readouterr().err.startswith(f"polynya performance: {problem}\n")


def test_what_is_not_given_has_its_value():
    read = read_options(["polaris"])
    assert (read.error, read.fields) == (0.03, 2) and read.jobs >= 1


def test_every_column_of_the_ice_classes_has_its_unit():
    printed = succeeded("performance", "polaris", "--channel", "--list").stdout
    lines = printed.splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith("class"))
    names, units = re.split(r"  +", lines[at]), lines[at + 1].split()
    assert len(units) == len(names) - 1 and set(units) == {"[m]", "[kN]", "[MW]"}
    ends = lambda line: [match.end() for match in re.finditer(r"\S+(?: \S+)*", line)]
    assert ends(lines[at])[1:] == ends(lines[at + 1])  # each unit is below its name
    assert "not computed without runs" in printed and "IA Super" in printed


def test_two_hundred_changed_ships_are_read_or_refused_with_their_places(tmp_path):
    chance = random.Random(31)
    path, refused = tmp_path / "ship.json", []
    for _ in range(200):
        ship = {"name": "x", "mass_kg": 1.65e7, "speed_m_per_s": 2, **json.loads(json.dumps(SHIP))}
        ship["propulsion"]["engine"] |= {"power_MW": 22.4, "propellers": 2, "propeller_diameter_m": 4.87}
        ship["hull"]["block_coefficient"] = 0.58
        text = mutated(chance, ship)
        path.write_text(text)
        done = ended("ships", "ship.json", "--json", "--for-performance", cwd=tmp_path, timeout=60)
        assert done.returncode in (0, 3), text
        if done.returncode == 0:
            hull_of(json.loads(done.stdout)["ship"])
            assert all(0 < number < math.inf for number in json.loads(done.stdout)["engine"].values())
        else:
            refused.append(text)
            *problems, count = done.stderr.splitlines()
            assert problems and all(re.match(r"ship\.json:\d+:\d+: ", problem) for problem in problems), text
            assert count.endswith(" in ship.json; nothing was written")
    assert 100 < len(refused) < 200
    for text in refused[:4]:
        path.write_text(text)
        done = ended("performance", "ship.json", "--list", cwd=tmp_path, timeout=60)
        assert done.returncode == 3 and done.stdout == ""
        assert done.stderr.startswith("ship.json:") and "Traceback" not in done.stderr


def test_a_ship_that_is_none_ends_the_command_with_what_was_meant(capfd, tmp_path):
    for name, code, message in (("araoon", 2, "did you mean araon?"),
                                (str(tmp_path / "none.json"), 5, "none.json: no such file")):
        with pytest.raises(SystemExit) as ended:
            ship_of(name)
        assert ended.value.code == code and message in capfd.readouterr().err


def rows_of(*thickness, speed=3.0):
    """Points at that speed in the formulas' band from 2.5 to 3.5 m/s."""
    formulas_of = {"lindqvist_m_per_s": 2.5, "riska_m_per_s": 3.0, "spencer_jones_m_per_s": 3.5}
    return [formulas_of | {"speed_m_per_s": speed, "thickness_m": h, "error_m_per_s": 0.01, "is_stuck": False,
                           "is_steady": True, "contact_kN": 1.0, "submerged_kN": 1.0, "formula_share": 0.4 + 0.2 * h,
                           "is_in_validated_range": h <= 0.5,
                           "beyond_formulas": beyond_band(speed, formulas_of.values())} for h in thickness]


def test_points_outside_validation_are_marked_in_table_and_figure(capsys, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    from polynya.performance import figure
    matplotlib.rcParams["svg.fonttype"] = "none"
    for thickness, is_marked in (((0.25, 0.5), False), ((0.5, 0.8), True)):
        print_table(rows_of(*thickness))
        table = capsys.readouterr().out
        assert ("0.8* " in table) == is_marked and "0.5*" not in table and "!" not in table
        assert ("outside the range of validation" in table) == is_marked
        assert "statistical scatter alone, not the model's error" in table
        share = "45 to 50" if not is_marked else "50 to 56"
        assert f"{share} % of its resistance is Lindqvist's formula" in table
        figure.draw(rows_of(*thickness), "title", [], tmp_path / "figure.svg")
        drawn = (tmp_path / "figure.svg").read_text()
        assert ("thicker than 0.5 m: outside validation" in drawn) == is_marked and "run's own scatter" in drawn
        assert f"{share} % of its resistance" in drawn
        assert "outside the band of the formulas" not in drawn


@pytest.mark.parametrize("speed, words", [(2.4, "slower than by every formula"), (2.5, ""), (3.5, ""),
                                          (3.51, "faster than by every formula")])
def test_points_out_of_the_formulas_band_are_marked_in_thin_ice_too(speed, words, capsys, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    from polynya.performance import figure
    matplotlib.rcParams["svg.fonttype"] = "none"
    print_table(rows_of(0.25, 0.5, speed=speed))
    table = capsys.readouterr().out
    assert ("0.5! " in table) == ("in 0.25 m, 0.5 m" in table) == bool(words) and words in table
    figure.draw(rows_of(0.25, speed=speed), "title", [], tmp_path / "figure.svg")
    assert ("outside the band of the formulas" in (tmp_path / "figure.svg").read_text()) == bool(words)


def test_the_figure_of_one_thickness_shows_the_formulas_beside_it(tmp_path):
    """A line through one point cannot be seen: the formulas are drawn around it, and the point is not at the edge."""
    matplotlib = pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure
    from polynya.performance import figure
    curve = Curve(SHIP, hull_of(SHIP), {"bollard_pull_N": 1e6, "open_water_speed_m_per_s": 8},
                  formulas.Ice(0, flexural_strength=500e3, friction=0.1), str(tmp_path), "polynya", 0.03, 0.01)
    rows = rows_of(0.8, speed=6.0)
    around = figure.formula_rows(curve, rows)
    assert around[0]["thickness_m"] < 0.8 < around[-1]["thickness_m"] and len(around) == figure.POINTS
    drawn, keep = [], Figure.savefig
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", lambda self, *of, **more: (drawn.append(self), keep(self, *of, **more)))
        figure.draw(rows, "our " * 40 + "ship\nice", [], tmp_path / "one.png", around)
        figure.draw(rows, "title", [], tmp_path / "marks.png")
    for page, is_line in zip(drawn, (True, False)):
        axes = page.axes[0]
        lines = [line for line in axes.lines if line.get_color() == "0.35"]
        assert len(lines) == 3 and all((len(line.get_xdata()) > 1) == is_line for line in lines)
        assert all(is_line or line.get_marker() == "_" for line in lines)
        low, high = axes.get_xlim()
        assert low < 0.8 - 0.05 and high > 0.8 + 0.05 and axes.get_ylim()[1] > 6.1
        width = page.get_size_inches()[0] * page.dpi
        assert all(0 <= text.get_window_extent().x0 and text.get_window_extent().x1 <= width for text in page.texts)
    assert matplotlib


SPARSE = {"hull": {"length_m": 84, "beam_m": 20, "draught_m": 7, "block_coefficient": 0.62},
          "propulsion": {"engine": {"power_MW": 9}}}


def test_the_table_shows_what_one_finds_by_changing_the_file(tmp_path):
    """Each cell is the change of the formulas' mean where the file states that value a tenth more or less."""
    path = tmp_path / "ship.json"
    path.write_text(json.dumps(SPARSE))
    found = ship_of(str(path))
    ice = formulas.Ice(0, flexural_strength=500e3, friction=0.1)
    of = (hull_of(found["ship"]), found["engine"], ice)
    listed = sensitivity.particulars(found["ship"], *of, found["from"], {"flexural_strength": True, "friction": False})
    assert {one.key for one in listed if one.is_guess} == {
        "hull.stem_angle_deg", "hull.entrance_angle_deg", "propulsion.engine.open_water_speed_m_per_s",
        "propulsion.engine.propeller_diameter_m", "propulsion.engine.propellers", "ice.friction"}
    rows = dict((one.key, pairs[0]) for one, pairs in sensitivity.table(listed, [0.6], *of))
    whole = found["ship"]
    for key, factors in (("propulsion.engine.power_MW", (0.9, 1.1)), ("hull.beam_m", (0.9, 1.1)),
                         ("propulsion.engine.propeller_diameter_m", (0.9, 1.1)),
                         ("propulsion.engine.open_water_speed_m_per_s", (0.9, 1.1)),
                         ("propulsion.engine.propellers", (None, 2))):
        for factor, moved in zip(factors, rows[key]):
            if factor is None:
                assert moved is None
                continue
            changed = json.loads(json.dumps(whole))
            place = changed
            *way, last = key.split(".")
            for step in way:
                place = place[step]
            place[last] *= factor
            path.write_text(json.dumps(changed))
            other = ship_of(str(path))
            speeds = [formulas.level_ice_speeds(hull_of(one["ship"]), one["engine"], formulas.Ice(
                0.6, flexural_strength=500e3, friction=0.1)) for one in (found, other)]
            before, after = (sum(by.values()) / 3 for by in speeds)
            assert moved == pytest.approx(after - before, abs=2e-3), key


def test_guesses_lead_the_table_the_largest_first(tmp_path, capsys):
    path = tmp_path / "ship.json"
    path.write_text(json.dumps(SPARSE))
    printed = succeeded("performance", str(path), "--list", "--thickness", "0.4,0.5,0.6,0.7").stdout
    lines = [line for line in printed.splitlines() if line.startswith(("hull.", "propulsion.", "ice.")) and ": " not in
             line]
    marks = ["?" in line for line in lines]
    assert marks == sorted(marks, reverse=True) and 5 < sum(marks) < len(marks)
    assert "0.4 m" in printed and "0.6 m" in printed and "0.5 m" not in printed, "three thicknesses"
    assert "[Holtrop1984]" in printed and "nobody stated it" in printed


@pytest.mark.parametrize("name", ["araon", "polaris", "nordica", "oden", "xuelong-2"])
def test_the_open_water_speed_of_known_ships_is_estimated_within_what_the_page_says(name, tmp_path):
    ship = ship_of(name)["ship"]
    known = ship["propulsion"]["engine"].pop("open_water_speed_m_per_s")
    path = tmp_path / "ship.json"
    path.write_text(json.dumps(ship))
    found = ship_of(str(path))
    assert found["from"]["propulsion.engine.open_water_speed_m_per_s"] == "estimated"
    assert found["engine"]["open_water_speed_m_per_s"] == pytest.approx(known, rel=0.12)


def test_the_range_of_validation_is_the_documents():
    for page in ("validation.md", "ships.md"):
        words = (SCENES.parent / "docs" / page).read_text(encoding="utf-8").split()
        assert f"up to {VALIDATED_THICKNESS:g} m" in " ".join(words), page


def test_the_curve_starts_near_the_formulas(tmp_path):
    ice = formulas.Ice(0, flexural_strength=500e3, friction=0.1)
    engine = {"bollard_pull_N": 1e6, "open_water_speed_m_per_s": 8}
    curve = Curve(SHIP, hull_of(SHIP), engine, ice, str(tmp_path), "polynya", 0.03, 0.01)
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
    found = ship_of(str(path))
    ship, polaris = found["ship"], ship_of("polaris")["ship"]
    assert found["title"] == "deeper" and found["reported"]
    assert ship["hull"] == polaris["hull"] | {"draught_m": 8.5}
    assert ship["propulsion"] == polaris["propulsion"]


def test_the_course_is_straight_ahead_wherever_the_ship_of_the_file_went():
    turned = SHIP | {"heading_deg": 90, "yaw_rate_deg_per_s": 3, "pilot": {"hold_speed": {}},
                     "position_m": [7, 7], "steering": {"rudder": {}}}
    (ship,) = level_ice.scene(turned, formulas.Ice(0.5), 2, 8, 0.01)["ships"]
    assert ship["heading_deg"] == 0 and ship["position_m"] == [-52, 0] and "yaw_rate_deg_per_s" not in ship
    assert ship["pilot"] == {"hold_heading": {"heading_deg": 0, "lever": 1}}


def test_a_run_of_an_old_scene_is_never_taken_for_one_of_a_new_scene(tmp_path):
    scene = {"time": {"until_s": 1, "step_s": 0.1}, "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 20}}]}
    assert kept_run(program(), tmp_path, "a", scene) == tmp_path / "a"
    for _ in range(2):
        with pytest.raises(RunFailed):
            kept_run(program(), tmp_path, "a", {**scene, "time": {"until_s": -1}})
    assert kept_run(program(), tmp_path, "a", scene) == tmp_path / "a"
