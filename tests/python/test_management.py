"""What ice management is said to have done: gates pass what was put in, and each number is that of its definition."""
import dataclasses
import json
import math
import pathlib
import re
import shutil

import numpy
import pytest

import polynya
from program import ended, rows, run_of as folder_of, succeeded
from polynya.errors import InputError
from polynya.figures.page import Page
from polynya.management import cautions, cover, encounters, measures, ranking, study, study_figure
from polynya.management.drift import by_rows, free_drift, tide
from polynya.management.gates import Gates, Passage, gates_of, managed_width, passages
from polynya.results.run import Frame
from polynya.study.folder import PLAN, RESULT, open_study
from polynya.study.plan import write_cases

RIG = {"name": "rig", "radius_m": 10}
DRIFTING = {
    "time": {"step_s": 0.1, "until_s": 270}, "water": {"drift_m_per_s": [-1, 0]}, "structures": [RIG],
    "record": {"forces_interval_s": 1, "frames_interval_s": 2},
    "floes": [{"field": {"corner_m": [330, -150], "extent_m": [80, 300], "concentration": 0.6,
                         "sizes": {"mean_m": 9, "spread": 0.4}}}],
}
GATES = {"upstream_m": 320, "near_m": 145, "width_m": 320}


def run_of(home, name, scene):
    return polynya.Run(folder_of(home, name, scene), pandas=False)


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    return tmp_path_factory.mktemp("management")


@pytest.fixture(scope="module")
def drifting(home):
    return run_of(home, "drifting", DRIFTING)


@pytest.fixture(scope="module")
def hit(home):
    """One floe drifts onto a rig, a larger one past it."""
    floes = [{"rectangle": {"corner_m": [40, -15], "size_m": 30}}, {"rectangle": {"corner_m": [40, 60], "size_m": 40}}]
    return run_of(home, "hit", {**DRIFTING, "time": {"step_s": 0.05, "until_s": 60}, "floes": floes})


def test_where_nobody_breaks_gates_pass_what_was_put_in(drifting):
    areas = numpy.sort(drifting.births["area_m2"])
    for passage in passages(drifting, gates_of(drifting, GATES)):
        assert numpy.array_equal(numpy.sort(passage.areas), areas)
        assert numpy.all(numpy.abs(passage.across) < 150)
    # Half of the floes pass through half of the width, within the counting error.
    for passage in passages(drifting, gates_of(drifting, {**GATES, "width_m": 150})):
        count = len(areas) / 2
        assert abs(len(passage.areas) - count) < 3 * math.sqrt(count)
        low, high = (numpy.searchsorted(areas, numpy.sort(passage.areas)[k]) / len(areas)
                     for k in (len(passage.areas) // 4, 3 * len(passage.areas) // 4))
        assert abs(high - low - 0.5) < 3 * math.sqrt(0.25 / len(passage.areas))
    # The field is 80 m long in the direction of the drift, with a cover of 0.6.
    for share in cover.covers(drifting, gates_of(drifting, {**GATES, "width_m": 300})):
        assert share == pytest.approx(0.6, rel=0.15)


def test_the_cover_of_a_gate_is_the_share_of_it_under_ice(hit):
    """A floe of 30 m lies on a gate for 20 s, and beside it one of 40 m for 30 s. Few floes do not make more cover than
    there is ice, as their area over that of the water between the first centre and the last would."""
    gates = gates_of(hit, {"upstream_m": 50, "near_m": 35, "width_m": 300})
    assert cover.covers(hit, gates)[0] == pytest.approx((30 * 20 + 40 * 30) / 30 / 300, rel=0.05)
    narrow = dataclasses.replace(gates, width=20.0)
    assert cover.covers(hit, narrow)[0] == 1
    assert cover.covers(hit, dataclasses.replace(gates, upstream=500.0))[0] is None
    assert cover.covered([(-3, -1), (-2, 1), (5, 40)], 10) == 4 + 5


SQUARE = numpy.array([[0, 0], [10, 0], [10, 10], [0, 10.0]])


def test_the_distance_of_outlines_is_that_of_their_nearest_points():
    assert encounters.ring_distance(SQUARE, SQUARE + [13, 14]) == pytest.approx(5)  # from corner to corner
    assert encounters.ring_distance(SQUARE, SQUARE + [12, 3]) == pytest.approx(2)  # from side to side
    assert encounters.ring_distance(SQUARE, SQUARE + [9, 9]) == 0
    assert encounters.ring_distance(SQUARE, 0.1 * SQUARE + 4) == 0  # one inside the other
    assert encounters.ring_distance(SQUARE, [-3, 5] + numpy.array([[0, 0], [2, 1], [0, 2.0]])) == pytest.approx(1)


def visit(offset, **more):
    """A ship passes a moored one from upstream with its middle `offset` metres beside the other's. There is no ice."""
    hull = {"length_m": 40, "beam_m": 10, "entrance_angle_deg": 30, "draught_m": 4, "block_coefficient": 0.6}
    moored = {"surge_stiffness_N_per_m": 2e5, "sway_stiffness_N_per_m": 2e5, "yaw_stiffness_Nm_per_rad": 1e8,
              "surge_damping_N_s_per_m": 5e5, "sway_damping_N_s_per_m": 5e5, "yaw_damping_Nm_s_per_rad": 2e8}
    ships = [{"name": "moored", "hull": hull, "propulsion": {"thrust_N": 0}, "mooring": moored},
             {"name": "visitor", "hull": hull, "position_m": [150, offset], "heading_deg": 180, "speed_m_per_s": 4,
              "propulsion": {"constant_speed_m_per_s": 4}}]
    return {**DRIFTING, "time": {"step_s": 0.05, "until_s": 60}, "structures": [], "floes": [], "ships": ships, **more}


def test_a_ship_that_passes_is_no_ice_and_its_distance_is_that_of_the_hulls(home):
    run = run_of(home, "visit", visit(25))
    found = measures.measures_of(run, {"body": "moored", "upstream_m": 100, "near_m": 40, "width_m": 300})
    of = lambda name: found[f"management_{name}"]
    assert of("floes_upstream") == of("floes_at_body") == of("ice_load_peak_N") == 0 and of("cover_upstream") is None
    assert of("ship_hits") == of("ship_load_peak_N") == 0
    moored = run.frame(run.end_time).ship_motions[0]
    assert of("ship_distance_m") == pytest.approx(15, abs=0.5) and abs(moored[1]) < 1
    assert of("ships_beyond_gate_s") == pytest.approx((170 - 100) / 4, abs=2.1)  # its stern leaves 170 m
    words = list(cautions.of_measures(found, "moored"))
    assert len(words) == 2 and "no ice arrived at moored" in words[0] and "beyond the upstream gate" in words[1]


def test_a_hit_is_found_with_its_load(home):
    run = run_of(home, "hit-by-ship", visit(4))
    found = measures.measures_of(run, {"body": "moored", "upstream_m": 300, "near_m": 40, "width_m": 300})
    assert found["management_ship_hits"] >= 1 and found["management_ship_distance_m"] == 0
    loads = measures.rows_of(run, "moored")
    assert found["management_ship_load_peak_N"] == numpy.hypot(loads["surge_from_ships_N"],
                                                               loads["sway_from_ships_N"]).max() > 1e5
    assert found["management_ice_load_peak_N"] == 0
    assert found["management_mooring_load_peak_N"] > 0 and found["management_moorings_broken"] == 0
    printed = succeeded("management", "hit-by-ship", "--upstream", 300, "--near", 40, "--width", 300, cwd=home).stdout
    assert printed.startswith("WARNING: hit-by-ship: a ship hit moored ")


def test_gates_turn_with_the_drift(home):
    turned = {**DRIFTING, "water": {"drift_table": [{"t_s": 0, "speed_m_per_s": 1, "direction_deg": -90}]}}
    turned["floes"] = [{"field": {**DRIFTING["floes"][0]["field"], "corner_m": [-150, 330], "extent_m": [300, 80]}}]
    run = run_of(home, "turned", turned)
    for passage in passages(run, gates_of(run, GATES)):
        assert len(passage.areas) == len(run.births["area_m2"])


class Broken:
    """Stands for a run: floe 0 breaks at 3 s into 1, still upstream, and 2, which has passed; 3 is a piece of 2."""

    scene = {"water": {"drift_m_per_s": [-10, 0], "density_kg_per_m3": 1000, "skin_drag_coefficient": 0}, "wind": {}}
    times = numpy.arange(8.0)
    ship_names = ["rig"]
    births = {"floe_id": numpy.arange(4), "parent_id": numpy.array([-1, 0, 0, 2]),
              "born_s": numpy.array([0, 3.0, 3.0, 5.0]),
              "died_s": numpy.array([3.0, math.inf, 5.0, math.inf]), "went_under_s": numpy.full(4, math.inf),
              "area_m2": numpy.array([300.0, 100, 200, 150])}

    class motions:
        def ships_at(_, time):
            return numpy.zeros((1, 6))

        def floes_at(_, ids, time):
            start = numpy.array([60.0, 75, 55, 54])[ids]
            return numpy.column_stack((start - 10 * time, numpy.zeros((len(ids), 5))))

    motions = motions()
    frame = staticmethod(lambda time: Frame(Broken, time))


def test_a_floe_that_broke_passes_as_its_pieces_and_once():
    # Floe 0 is at 40 when it breaks at 2 to 3 s. At 3 s its pieces are at 45 and 25.
    upstream, near = passages(Broken, Gates("rig", 45.5, 30, 100, 20))
    assert upstream.floes.tolist() == [0]
    assert near.floes.tolist() == [1, 2] and near.areas.tolist() == [100, 200]


def test_hits_are_of_floes_of_the_size(hit):
    gates = gates_of(hit, {"upstream_m": 50, "width_m": 300, "size_m": 25})
    sizes, number, seconds = measures.hits_on(hit, gates)
    assert number == len(sizes) >= 1 and sizes.max() <= 30 and 0 < seconds <= 60
    assert measures.hits_on(hit, dataclasses.replace(gates, size=31.0))[1:] == (0, 0.0)
    assert measures.largest_touch(hit, gates) == pytest.approx(30, rel=0.02)
    loads = measures.loads_on(hit, gates)
    rows = measures.rows_of(hit, "rig")
    assert loads["ice_load"].max() == numpy.hypot(rows["surge_N"], rows["sway_N"]).max() > 0
    assert "mooring_load" not in loads  # a rig has no mooring, and 0 would rank as the least load


def test_the_managed_width_is_what_large_floes_leave():
    gates = Gates("rig", 100, 50, 80, 20)
    passage = lambda *floes: Passage(numpy.arange(len(floes)), numpy.zeros(len(floes)),
                                     numpy.array([y for y, _ in floes]), numpy.array([size**2 for _, size in floes]))
    assert managed_width(passage((0, 19)), gates) == 80
    assert managed_width(passage((0, 21)), gates) == 0
    # The range is −40 to 25, without the bins that the edge of the floe at 15 touches.
    assert managed_width(passage((25, 20.0), (-3, 5)), gates) == pytest.approx(40 + 14, abs=2)


def test_the_drift_is_the_programs(home):
    ellipse = {"period_s": 300, "major_m_per_s": 0.5, "minor_m_per_s": -0.2, "direction_deg": 40, "phase_deg": 30}
    rows = [{"t_s": 0, "speed_m_per_s": 0.4, "direction_deg": 10},
            {"t_s": 100, "speed_m_per_s": 0.8, "direction_deg": 120}]
    scene = {**DRIFTING, "time": {"step_s": 0.1, "until_s": 150}, "water": {"drift_table": rows, "tide": ellipse},
             "floes": [{"rectangle": {"corner_m": [500, 0], "size_m": 10}}]}
    run = run_of(home, "tide", scene)
    floe = numpy.array([0])
    times = numpy.linspace(0, 150, 15001)
    drift = numpy.array([free_drift(run.scene, t) for t in times])
    path = ((drift[1:] + drift[:-1]) / 2 * numpy.diff(times)[:, None]).sum(axis=0)
    moved = run.motions.floes_at(floe, 150.0)[0, :2] - run.motions.floes_at(floe, 0.0)[0, :2]
    assert moved == pytest.approx(path, abs=0.02)
    assert by_rows(rows, 50) == pytest.approx((numpy.array(by_rows(rows, 0)) + by_rows(rows, 100)) / 2)
    assert numpy.hypot(*tide({**ellipse, "phase_deg": 0}, 0)) == pytest.approx(0.5)


def test_a_fleets_effort_is_that_of_its_rows(home):
    ship = {"ship": "reference", "position_m": [300, 0], "heading_deg": 90, "speed_m_per_s": 3,
            "pilot": {"manage": {"body": "rig", "pattern": "circular", "distance_m": 400,
                                 "width_m": 400, "speed_m_per_s": 3, "safety_radius_m": 150}}}
    run = run_of(home, "effort", {**DRIFTING, "time": {"step_s": 0.1, "until_s": 100}, "ships": [ship], "floes": []})
    of = measures.effort(run)["ship-1"]
    rows = measures.rows_of(run, "ship-1")
    assert of["distance_m"] == pytest.approx((rows["speed_m_per_s"] * numpy.diff(rows["t_s"], prepend=0)).sum())
    assert 150 < of["distance_m"] < 350
    assert of["energy_J"] == pytest.approx(rows["delivered_power_W"].mean() * 100, rel=0.02)
    gates = gates_of(run, {})
    assert (gates.body, gates.width, gates.upstream) == ("rig", 400, pytest.approx(600 + 10, abs=0.1))


@pytest.mark.parametrize("settings, words", [({}, "no ship of the run manages ice"),
                                             ({**GATES, "near_m": 330}, "not nearer"),
                                             ({"body": "Fram"}, 'no ship or structure "Fram"')])
def test_what_cannot_be_measured_is_refused(drifting, settings, words):
    with pytest.raises(InputError, match=words):
        gates_of(drifting, settings)


def test_the_command_writes_tables_and_a_figure(home, drifting, hit):
    gates = ["--upstream", 50, "--near", 20, "--width", 300]
    succeeded("management", "drifting", "hit", *gates, "--out", "out", cwd=home)
    names = {path.name for path in (home / "out").iterdir()}
    assert names == {"management.csv", "management-sizes.csv", "management.svg", "management.png"}
    printed = succeeded("management", "hit", *gates, "--json", cwd=home)
    found = json.loads(printed.stdout)["hit"]
    assert found == polynya.management.of_folder(home / "hit", {"upstream_m": 50, "near_m": 20, "width_m": 300})
    assert ended("management", "hit", cwd=home).returncode == 3


def test_columns_are_named_by_folder_case_or_label(home, hit, tmp_path):
    for name in ("A", "B"):
        shutil.copytree(home / "hit", tmp_path / name / "run")
    gates = ["--upstream", 50, "--near", 20, "--width", 300, "--json"]
    printed = succeeded("management", "A/run", "B/run", *gates, cwd=tmp_path).stdout
    assert list(json.loads(printed)) == ["A", "B"]
    printed = succeeded("management", "A/run", "B/run", *gates, "--label", "first,second", cwd=tmp_path).stdout
    assert list(json.loads(printed)) == ["first", "second"]
    wrong = ended("management", "A/run", "B/run", *gates, "--label", "first", cwd=tmp_path)
    assert wrong.returncode == 2 and "one for each of the 2 folders" in wrong.stderr


def test_ice_that_left_by_a_rule_is_counted(home):
    """A ship breaks ice whose cusps are taken to be gone, or stay."""
    ship = {"ship": "reference", "position_m": [-60, 0], "speed_m_per_s": 3,
            "propulsion": {"constant_speed_m_per_s": 3}}
    plate = [{"rectangle": {"corner_m": [0, -100], "size_m": [200, 200]}}]
    for fate, least, most in (("submerge", 1000, 4000), ("under_hull", 0, 400)):
        far = {**RIG, "position_m": [-300, 0]}
        run = run_of(home, f"lost-{fate}", {**DRIFTING, "time": {"until_s": 40}, "water": {}, "ships": [ship],
                                            "structures": [far], "floes": plate, "fracture": {"cusp_fate": fate}})
        area, share = measures.ice_lost(run.summary["ledger"])
        assert least <= area <= most and share == pytest.approx(area / 40000)
        found = measures.measures_of(run, {"body": "rig", "upstream_m": 150, "near_m": 20, "width_m": 50})
        assert found["management_ice_lost_m2"] == area and found["management_icebreakers"] == 0


def synthetic(folder, patterns, fields=6, drifts=(0.5, 0.8), keep=lambda case: True, more=lambda name, seed: {}):
    """A study of patterns, {name: share of the unmanaged load}, whose cases are written, not run. `more` gives further
    measures of a pattern and a field."""
    rng = numpy.random.default_rng(3)
    field_loads = {(seed, drift): rng.normal(1e4, 2e3) for seed in range(fields) for drift in drifts}
    folder.mkdir()
    pilots = {name: {"manage": {"body": "rig", "pattern": name, "width_m": 160}} if share < 1
              else {"constant": {"lever": 0}} for name, share in patterns.items()}
    values = [{"ships[1].pilot": pilots[name], "ships[1].position_m[0]": -3000 if share == 1 else 250,
               "water.drift_m_per_s[0]": -drift, "seed": seed}
              for seed in range(fields) for name, share in patterns.items() for drift in drifts]
    write_cases(folder, [json.dumps({"scene": 0, "set": v}) + "\n" for v in values])
    varied = [name for name in values[0] if name != "water.drift_m_per_s[0]" or len(drifts) > 1]
    plan = {"format": 1, "name": "synthetic", "cases": len(values), "chunk": 1, "archive": False, "keep": "summary",
            "set": {}, "source": "", "scenes": ["scenes/0/a.json"], "varied": varied,
            "collect": {"management": {"body": "rig"}}, "report": {}}
    (folder / PLAN).write_text(json.dumps(plan))
    planned = open_study(folder)
    shares = {json.dumps(pilots[name]): (name, share) for name, share in patterns.items()}
    for i, v in enumerate(values):
        case = planned.case_folder(i)
        case.mkdir(parents=True)
        name, share = shares[json.dumps(v["ships[1].pilot"])]
        mean = share * field_loads[v["seed"], -v["water.drift_m_per_s[0]"]] * rng.normal(1, 0.02)
        found = {"management_ice_load_mean_N": mean, "management_ice_load_q99_N": 4 * mean,
                 "management_largest_at_body_m": 40 * share, "management_icebreakers": int(share < 1),
                 "management_ice_lost_m2": 300.0, "management_ice_lost_share": 0.003,
                 **{f"management_{key}": value for key, value in more(name, v["seed"]).items()}}
        if keep(i):
            (case / RESULT).write_text(json.dumps({"state": "finished", "case": i, "measures": found}))
    return planned


def test_a_study_ranks_patterns_and_says_which_it_cannot_tell_apart(tmp_path):
    shares = {"linear": 0.5, "circular": 0.2, "racetrack": 0.201, "none": 1}
    made = synthetic(tmp_path / "s", shares)
    printed = succeeded("management", made.folder, "--out", tmp_path / "out").stdout
    assert printed.count("Not distinguishable: circular and racetrack.") + printed.count(
        "Not distinguishable: racetrack and circular.") >= 4
    assert "mean load of the ice, drift 0.5 m/s" in printed and "300 m² (0.3 %)" in printed and "not managed" in printed
    found = study.read(made.folder)
    assert found.patterns == ["linear", "circular", "racetrack", "not managed"]  # by what differs: the pattern
    for condition in found.conditions:
        places = condition.ranked("management_ice_load_mean_N")
        assert [place.name for place in places][2:] == ["linear", "not managed"]
        for place in places[:3]:
            ratio, low, high = place.left
            assert low < shares[place.name] < high and high - low < 0.1 and ratio == pytest.approx((low + high) / 2,
                                                                                                   rel=0.05)
            assert place.benefit.half > 0
    table = rows(tmp_path / "out/management-ranking.csv")
    assert len(table) == 2 * 3 * 4 and table[0]["ice_lost_m2"] == "300.0"
    stems = ("management", "management-ranking")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        f"{stem}.{suffix}" for stem in stems for suffix in ("csv", "svg", "png")}


def ships_meet(name, seed):
    """The circular pattern hits the protected ship in the first field; the others keep their distance."""
    is_hit = name == "circular" and seed == 0
    return {"ship_hits": int(is_hit), "ship_load_peak_N": 2.5e6 * is_hit, "ship_distance_m": 0.0 if is_hit else 84.0,
            "floes_at_body": 20, "floes_upstream": 30}


def test_a_pattern_whose_ship_hits_the_protected_ship_is_warned_of_first_and_is_not_the_best(tmp_path):
    made = synthetic(tmp_path / "s", {"linear": 0.5, "circular": 0.2, "none": 1}, drifts=(0.5,), more=ships_meet)
    printed = succeeded("management", made.folder, "--out", tmp_path / "out").stdout
    assert printed.startswith("WARNING: circular: a ship hit rig in 1 of 6 fields, with up to 2.5 MN")
    assert printed.count("circular comes first, but is not the best: a ship hit rig in 1 of 6 fields.") == 3
    assert re.search(r"\n +linear +0 of 6 +- +84 m\n", printed)
    found = json.loads(succeeded("management", made.folder, "--json").stdout)
    assert len(found["warnings"]) == 1 and "circular" in found["warnings"][0]
    assert found["conditions"][0]["contacts"]["circular"] == {"hit": 1, "fields": 6, "load": 2.5e6, "closest": 0.0}
    table = rows(tmp_path / "out/management-ranking.csv")
    assert {row["fields_hit_by_a_ship"] for row in table if row["pattern"] == "circular"} == {"1"}
    drawn = study_figure.draw_ranking(study.read(made.folder), Page())
    texts = [text.get_text() for axes in drawn.axes for text in axes.texts]
    assert "circular (hit in 1 of 6)" in texts


def test_an_axis_of_words_is_refused(tmp_path):
    planned = synthetic(tmp_path / "study", {"linear": 0.5, "none": 1})
    plan = json.loads((planned.folder / PLAN).read_text())
    (planned.folder / PLAN).write_text(json.dumps({**plan, "report": {"against": "ships[1].pilot"}}))
    assert "report.against: ships[1].pilot has values that are no numbers" in ended("management", planned.folder).stderr


def test_results_of_a_version_that_did_not_measure_contacts_say_so(tmp_path):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "none": 1}, drifts=(0.5,))
    assert "it was not measured whether an icebreaker hit rig" in succeeded("management", made.folder).stdout


def test_a_study_to_which_no_ice_came_ranks_nothing(tmp_path):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "none": 1}, drifts=(0.5,), more=lambda name, seed: {
        "floes_upstream": 3, "floes_at_body": 0, "ice_load_peak_N": 0.0})
    printed = succeeded("management", made.folder, "--out", tmp_path / "out").stdout
    assert printed.startswith("WARNING: no ice arrived at rig in any pattern, so nothing was measured")
    assert "1.  " not in printed and "±" not in printed
    assert not rows(tmp_path / "out/management-ranking.csv") and not (tmp_path / "out/management-ranking.png").exists()


def test_fields_of_a_pattern_without_ice_are_named(tmp_path):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "none": 1}, drifts=(0.5,), more=lambda name, seed: {
        "floes_upstream": int(seed > 1), "floes_at_body": 5 * (seed > 1), "ice_load_peak_N": 9.0 * (seed > 1)})
    printed = succeeded("management", made.folder).stdout
    assert "WARNING: circular: no ice passed either gate in 2 of 6 fields." in printed and "  1.  circular" in printed


def moored_loads(name, seed):
    return {"mooring_load_mean_N": {"circular": 9e3, "linear": 2e3, "none": 1e4}[name] + seed,
            "moorings_broken": int(name == "linear" and seed == 2)}


def test_the_load_of_a_mooring_is_ranked_where_there_is_one(tmp_path):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "linear": 0.5, "none": 1}, drifts=(0.5,), more=moored_loads)
    printed = succeeded("management", made.folder).stdout
    assert "mean load of the mooring\n" in printed and "WARNING: linear: the mooring of rig broke in 1 of 6" in printed
    places = study.read(made.folder).conditions[0].ranked("management_mooring_load_mean_N")
    assert [place.name for place in places] == ["linear", "circular", "not managed"]


@pytest.mark.parametrize("fields, is_warned", [(2, True), (4, True), (5, False)])
def test_intervals_over_few_fields_are_not_to_be_trusted_and_axes_start_at_zero(tmp_path, fields, is_warned):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "none": 1}, fields=fields, drifts=(0.5,), more=ships_meet)
    lines = succeeded("management", made.folder).stdout.splitlines()
    assert lines[1].startswith(f"WARNING: {fields} fields of ice (seeds): intervals over fewer than 5") == is_warned
    drawn = study_figure.draw_ranking(study.read(made.folder), Page())
    assert all(axes.get_xlim()[0] == 0 for axes in drawn.axes if axes.axison)
    assert len([axes for axes in drawn.axes if axes.axison]) == 3


def test_a_study_of_the_pattern_alone_and_of_one_field_is_ranked_without_intervals(tmp_path):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "none": 1}, fields=1, drifts=(0.5,))
    ran = ended("management", made.folder)
    assert ran.returncode == 0 and "nothing is told apart" in ran.stdout and "Warning" not in ran.stderr
    assert ran.stdout.count("±") == 1  # of the explanation
    assert "20 %" in ran.stdout
    assert not (made.folder / "management.png").exists() and (made.folder / "management-ranking.png").exists()


def test_patterns_are_compared_in_the_fields_that_both_have(tmp_path):
    made = synthetic(tmp_path / "s", {"circular": 0.2, "none": 1}, fields=5, drifts=(0.5,), keep=lambda case: case != 1)
    ended("study", "gather", made.folder)
    places = study.read(made.folder).conditions[0].ranked("management_ice_load_mean_N")
    assert [place.mean.count for place in places] == [5, 4] and places[0].benefit.count == 4
    none = synthetic(tmp_path / "t", {"circular": 0.2, "none": 1}, keep=lambda case: False)
    ended("study", "gather", none.folder)
    assert "no case is finished" in ended("management", none.folder).stderr


def test_a_study_without_icebreakers_is_ranked_by_what_it_varies(home):
    (home / "base.json").write_text(json.dumps({**DRIFTING, "time": {"step_s": 0.1, "until_s": 60}}))
    (home / "s.json").write_text(json.dumps({
        "scene": "base.json", "repetitions": 2, "grid": {"water.drift_m_per_s[0]": [-1, -2],
                                                         "ice.thickness_m": [0.4, 0.6]},
        "collect": {"management": {"upstream_m": 330, "near_m": 290, "width_m": 300}}}))
    succeeded("study", "run", "s.json", cwd=home)
    found = json.loads(succeeded("management", "studies/s", "--json", cwd=home).stdout)
    assert [condition["name"] for condition in found["conditions"]] == ["drift 1 m/s", "drift 2 m/s"]
    means = found["conditions"][0]["means"]["management_cover_upstream"]
    assert set(means) == {"0.4", "0.6"} and means["0.4"]["count"] == 2
    printed = succeeded("management", "studies/s", cwd=home).stdout
    assert "no benefit is stated" in printed
    assert (pathlib.Path(home) / "studies/s/management.png").exists()
    assert ended("management", "studies/s", "--width", 3, cwd=home).returncode == 2


def test_means_have_students_interval():
    mean = ranking.mean_of([1.0, 2.0, 3.0])
    assert mean.value == 2 and mean.half == pytest.approx(4.302653 / math.sqrt(3), rel=1e-5)
    assert ranking.mean_of([]) is None and ranking.mean_of([4.0]) == ranking.Mean(4, None, 1)


def test_intervals_of_what_is_left_hold_the_truth_as_often_as_they_say():
    rng = numpy.random.default_rng(5)
    held = 0
    for _ in range(400):
        unmanaged = rng.normal(10, 3, 6)
        managed = 0.3 * unmanaged + rng.normal(0, 0.5, 6)
        _, low, high = ranking.share_left(dict(enumerate(managed)), dict(enumerate(unmanaged)))
        held += low is None or low <= 0.3 <= high
    assert 0.92 < held / 400 < 0.98
    assert ranking.share_left({0: 1.0}, {0: 2.0}) == (0.5, None, None)
    assert ranking.share_left({0: 1.0}, {1: 2.0}) is None
    assert ranking.share_left({0: 1.0, 1: 1.0}, {0: -1.0, 1: 2.0})[1:] == (None, None)  # may be 0 without management


def test_alike_patterns_are_rarely_told_apart():
    rng = numpy.random.default_rng(6)
    wrong = 0
    for _ in range(200):
        field = rng.normal(10, 3, 8)
        patterns = {name: dict(enumerate(field + rng.normal(0, 1, 8))) for name in "abcd"}
        wrong += bool(ranking.told_apart(patterns))
    assert wrong / 200 < 0.09
