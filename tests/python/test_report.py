"""A study's page: its pictures, its statistics, and the way from a case into the player."""
import json
import re
import types

import numpy

from program import SCENES, rows
from polynya import statistics
from polynya.study import pictures, sample
from polynya.study.folder import PLAN, RESULT, open_study
from polynya.study.plan import write_cases
from study_command import study as study_command


def synthetic(folder, groups=3, of_group=40):
    """A study whose cases are written, not run: peaks of Gumbel's distribution with a location that grows with the
    thickness."""
    rng = numpy.random.default_rng(1)
    folder.mkdir()
    values = [{"ice.thickness_m": 0.4 + 0.1 * (i % groups), "ice.friction": 0.1 * (1 + i // groups % 2), "seed": i}
              for i in range(groups * of_group)]
    write_cases(folder, [json.dumps({"scene": 0, "set": v}) + "\n" for v in values])
    plan = {"format": 1, "name": "synthetic", "cases": len(values), "chunk": 1, "archive": False, "keep": "summary",
            "set": {}, "source": "", "scenes": ["scenes/0/a.json"],
            "varied": ["ice.thickness_m", "ice.friction", "seed"], "collect": {},
            "report": {"group_by": "ice.thickness_m", "against": "ice.thickness_m"}}
    (folder / PLAN).write_text(json.dumps(plan))
    study = open_study(folder)
    for i, v in enumerate(values):
        case = study.case_folder(i)
        case.mkdir(parents=True)
        measures = {"resistance_mean_N": rng.normal(1e5, 1e4),
                    "resistance_peak_N": rng.gumbel(1e6 * v["ice.thickness_m"], 5e4),
                    "outcome": "bent" if v["ice.friction"] < 0.15 else "split"}
        (case / RESULT).write_text(json.dumps({"state": "finished", "case": i, "measures": measures}))
    return study


def test_the_page_has_its_pictures_statistics_and_cases_and_needs_no_network(tmp_path):
    study = synthetic(tmp_path / "s")
    study_command("report", study.folder)
    page = (study.folder / "study.html").read_text()
    shown = re.findall(r"<img src='([^']+)'", page)
    kinds = ("exceedance-resistance_peak_N", "means-resistance_mean_N", "outcomes")
    assert {f"report/{kind}.svg" for kind in kinds} <= set(shown)
    for name in shown:
        assert (study.folder / name).stat().st_size > 5000 and (study.folder / name).with_suffix(".png").exists()
    assert "http" not in page
    assert "resistance peak [MN]" in page[page.index("<h2>Cases") :] and not re.search(r">[\d.]+e\+\d", page)
    before = {p: p.read_bytes() for p in [study.folder / "study.html", *(study.folder / "report").iterdir()]}
    study_command("report", study.folder)
    assert before == {p: p.read_bytes() for p in before}, "the same study gives the same page"
    assert page.count("--keep all</code>") == 120  # thinned: the command that brings the run back
    peaks = [row for row in rows(study.folder / "report/statistics.csv") if row["measure"] == "resistance_peak_N"]
    assert [row["group"] for row in peaks] == ["0.4", "0.5", "0.6"]
    for row, thickness in zip(peaks, (0.4, 0.5, 0.6)):
        assert int(row["cases"]) == 40
        assert float(row["gumbel_location_low"]) < 1e6 * thickness < float(row["gumbel_location_high"])
        assert float(row["mean_low"]) < 1e6 * thickness + 0.5772 * 5e4 < float(row["mean_high"])


PILOTS = [{"manage": {"body": "rig", "pattern": pattern, "width_m": 160}} for pattern in ("circular", "racetrack")]


def of_objects(folder, cases=36):
    """A study over pilots and drifts; the peaks of circles fit no distribution."""
    rng = numpy.random.default_rng(2)
    folder.mkdir()
    values = [{"ships[0].pilot": PILOTS[i % 2], "water.drift_m_per_s[0]": -0.5 - 0.3 * (i // 2 % 2), "seed": i}
              for i in range(cases)]
    write_cases(folder, [json.dumps({"scene": 0, "set": v}) + "\n" for v in values])
    plan = {"format": 1, "name": "objects", "cases": cases, "chunk": 1, "archive": False, "keep": "summary", "set": {},
            "source": "", "scenes": ["scenes/0/a.json"], "varied": list(values[0]), "collect": {},
            "report": {"group_by": "ships[0].pilot"}}
    (folder / PLAN).write_text(json.dumps(plan))
    study = open_study(folder)
    for i, v in enumerate(values):
        case = study.case_folder(i)
        case.mkdir(parents=True)
        peak = rng.normal(2e6, 5e4) if i % 2 else 1e6 * (1 + 8 * (i % 4 == 0)) * rng.normal(1, 0.01)
        measures = {"resistance_mean_N": rng.normal(1e5, 1e4), "resistance_peak_N": peak, "outcome": "bent"}
        (case / RESULT).write_text(json.dumps({"state": "finished", "case": i, "measures": measures}))
    return study


def test_objects_have_short_names_everywhere(tmp_path):
    study = of_objects(tmp_path / "s")
    printed = study_command("report", study.folder)
    assert "Warning" not in printed and "matplotlib" not in printed
    page = (study.folder / "study.html").read_text()
    shown = page[:page.index("<h2>Names</h2>")]
    assert "manage" not in shown and "<td>circular</td>" in shown and "<td>racetrack</td>" in shown
    assert "&quot;pattern&quot;: &quot;racetrack&quot;" in page[page.index("<h2>Names</h2>"):]
    groups = {row["group"] for row in rows(study.folder / "report/statistics.csv")}
    assert groups == {"circular", "racetrack"}
    one = of_objects(tmp_path / "one", cases=1)
    assert "Warning" not in study_command("report", one.folder)


def test_a_refuted_fit_is_struck_through_and_gives_no_value(tmp_path):
    study = of_objects(tmp_path / "s")
    study_command("report", study.folder)
    peaks = {row["group"]: row for row in rows(study.folder / "report/statistics.csv")
             if row["measure"] == "resistance_peak_N"}
    assert peaks["circular"]["gumbel_exceeded_by_1_percent"] == "" and "refuted: p" in peaks["circular"]["gumbel_note"]
    assert float(peaks["racetrack"]["weibull_exceeded_by_1_percent"]) > 2e6
    assert "<s>" in (study.folder / "study.html").read_text()


def test_numbers_have_one_format_and_their_unit():
    assert [pictures.in_words(v) for v in (906693.0, 1.57945e6, 12345678, 0.35, 0.4000001)] == [
        "906693", "1579450", "12345678", "0.35", "0.4"]
    assert [pictures.in_words(v, 4) for v in (1.57945e6, 0.906693, float("inf"))] == ["1579000", "0.9067", "∞"]


def test_a_page_of_a_part_of_the_study_says_so(tmp_path):
    study = synthetic(tmp_path / "s")
    for i in range(30):
        (study.case_folder(i) / RESULT).unlink()
        study.case_folder(i).rmdir()
    study_command("report", study.folder, code=75)
    assert "This page shows a part of the study" in (study.folder / "study.html").read_text()
    unfinished = synthetic(tmp_path / "one", 1, 1)
    (unfinished.case_folder(0) / RESULT).unlink()
    assert "no case is finished" in study_command("report", unfinished.folder, code=75)
    assert "--cases 0-29" in json.loads((study.folder / "gather.json").read_text())["repair"]["missing"]


def test_a_kept_run_opens_in_the_player(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s.json").write_text(json.dumps({"scene": str(SCENES.resolve() / "level-plate.json"),
                                                 "set": {"time.until_s": 10}, "grid": {"ice.thickness_m": [0.4, 0.5]}}))
    study_command("run", "s.json", "--quiet")
    study_command("report", "studies/s")
    page = (tmp_path / "studies/s/study.html").read_text()
    links = re.findall(r"<a href='([^']+view.html)'>play", page)
    assert len(links) == 2 and all((tmp_path / "studies/s" / link).stat().st_size > 50000 for link in links)
    assert "channels.svg" in page


def test_labels_have_their_units():
    assert pictures.label_of("resistance_peak_N") == ("resistance peak [MN]", 1e-6)
    assert pictures.label_of("mean_speed_m_per_s") == ("mean speed [m/s]", 1)
    assert pictures.label_of("floes[0].field.concentration") == ("concentration", 1)
    assert pictures.label_of("ships[0].position_m[1]") == ("position y [m]", 1)


def test_small_loads_are_in_smaller_units():
    assert pictures.label_for("mean_load_N", [5e4, numpy.nan]) == ("mean load [kN]", 1e-3)
    assert pictures.label_for("mean_load_N", [5e4, -2e5]) == ("mean load [MN]", 1e-6)
    assert pictures.label_for("width_m", []) == ("width [m]", 1)


def test_a_parameter_that_was_set_together_with_another_divides_nothing():
    columns = {"pilot": numpy.array(list("abab")), "x": numpy.array([1.0, 2, 1, 2]), "y": numpy.array([1.0, 1, 2, 2])}
    study = types.SimpleNamespace(columns=columns, values_of=lambda name: sorted(set(columns[name].tolist())))
    assert sample.independent(study, ["pilot", "x", "y"]) == ["pilot", "y"]
    assert sample.independent(study, ["x", "pilot"]) == ["x"]


def test_small_groups_are_not_fitted():
    assert "fewer than" in sample.fits_of(numpy.arange(5.0))["gumbel"]
    assert isinstance(sample.fits_of(numpy.random.default_rng(1).gumbel(5, 1, 30))["weibull"], statistics.Fit)
