"""polynya loads: places, rates and their limits, fits and return values of samples that are known, and the command."""
import dataclasses
import json
import resource

import numpy
import polynya
import pytest
import tail_coverage
from program import ended, rows, run_of, started, succeeded
from polynya import extremes, loads
from polynya.loads import pictures, words
from polynya.loads.gather import Case, Loads, Waterline

SCENE = {
    "time": {"step_s": 0.02, "until_s": 20}, "record": {"frames_interval_s": 5, "least_peak_N": 0},
    "structures": [{"name": "pile", "radius_m": 5, "panels": {"length_m": 2, "bottom_m": -1, "top_m": 1, "rows": 2}}],
    "floes": [{"rectangle": {"corner_m": [6, -20], "size_m": 20}, "velocity_m_per_s": [-0.5, 0.3]},
              {"rectangle": {"corner_m": [27, -20], "size_m": 20}, "velocity_m_per_s": [-0.5, 0.2]}]}


@pytest.fixture(scope="module", name="folder")
def ran(tmp_path_factory):
    return run_of(tmp_path_factory.mktemp("loads"), "run", SCENE).parent


def made(forces, hours=10.0, cases=1):
    """Loads with these peaks, spread evenly over the cases and their time."""
    forces = numpy.asarray(forces, dtype=float)
    number = numpy.arange(len(forces)) % cases
    peaks = {"t_s": numpy.linspace(0, 3600 * hours / cases, len(forces), endpoint=False),
             "arc_m": numpy.linspace(-4, 4, len(forces)), "case": number,
             "force_N": forces}
    ring = [(5, -5), (5, 5), (-5, 5), (-5, -5)]
    return Loads("made", "a ship", False, Waterline(ring), 2.5,
                 [Case(n, 0.0, hours / cases, 1.0) for n in range(cases)], peaks, None, 0.1, 0)


def test_a_place_is_that_of_the_program(folder):
    run = polynya.Run(folder / "run", pandas=False)
    line = Waterline(run.waterlines["pile"])
    assert len(run.peaks) > 3
    points = line.at(run.peaks["arc_m"])
    on_world = numpy.column_stack([run.peaks["x_m"], run.peaks["y_m"]])
    assert numpy.allclose(points, on_world, atol=0.2)  # within the overlap
    assert numpy.allclose(5 - on_world[:, 0], run.peaks["station_m"], atol=1e-9)
    assert numpy.allclose(line.at([0, line.length]), [5, 0], atol=0.05)
    square = Waterline([(5, 5), (5, -5), (-5, -5), (-5, 5)])  # clockwise
    assert numpy.allclose(square.at([0, 5, 10, -5, 19.5]), [(5, 0), (5, 5), (0, 5), (5, -5), (-5, 0.5)])


def test_rates_have_the_limits_of_a_poisson_count():
    columns = loads.estimate.exceedance(made([3, 1, 2]), level=0.95)
    assert columns["force_N"].tolist() == [3, 2, 1] and numpy.allclose(columns["per_hour"], [0.1, 0.2, 0.3])
    assert numpy.allclose(columns["per_hour_low"] * 10, [0.0253, 0.2422, 0.6187], atol=1e-4)  # tables of Garwood
    assert numpy.allclose(columns["per_hour_high"] * 10, [5.5716, 7.2247, 8.7673], atol=1e-4)
    assert numpy.allclose(columns["per_km"], [1, 2, 3])


def test_return_values_of_a_known_tail_are_found():
    draws = numpy.random.default_rng(5)
    exponential = made(1e5 + 2e5 * draws.exponential(size=4000), hours=100.0)
    fit = loads.estimate.estimate(exponential).used
    assert fit.tail.shape.low < 0 < fit.tail.shape.high and fit.tail.scale.value == pytest.approx(2e5, rel=0.05)
    near, far = loads.estimate.returns(exponential)
    for given, peaks in ((near, 4000), (far, 40000)):
        assert given.low_N < 1e5 + 2e5 * numpy.log(peaks) < given.high_N and not given.is_extrapolated
    assert near.seen_low_N <= near.value_N <= near.seen_high_N


def test_a_refuted_fit_gives_no_return_value_and_says_why():
    """Many equal small peaks and a few large ones: no tail through all of them is one of the family."""
    draws = numpy.random.default_rng(2)
    forces = numpy.concatenate([draws.normal(1e5, 2e3, 300), draws.normal(9e5, 1e4, 30)])
    two_kinds = made(draws.permutation(forces), hours=10)
    found = loads.estimate.estimate(two_kinds, least=5e4)
    assert found.used is None and len(found.fits) == 1 and "do not follow the fitted tail" in found.why
    for given in loads.estimate.returns(two_kinds, least=5e4):
        assert given.value_N is None and "refuted" in given.why
        assert 8e5 < given.seen_low_N  # read from the observed peaks, without a fit
    higher = loads.estimate.estimate(two_kinds)  # the refuted thresholds are kept beside the one that is used
    assert higher.fits[0].refuted and (higher.used is None or higher.used.tail.threshold > 1e5)


def test_the_largest_peak_refutes_a_fit_that_makes_it_impossible():
    """400 peaks of a tail that ends at 2 MN, and one far beyond it."""
    draws = numpy.random.default_rng(4)
    ending = 2e6 * (1 - draws.uniform(size=400) ** 0.5)
    assert not loads.estimate.estimate(made(ending), least=1e3).why
    assert "do not follow" in loads.estimate.estimate(made([*ending, 4e6]), least=1e3).why


def test_far_periods_are_withheld_or_marked():
    peaks = made(1e5 + 2e5 * numpy.random.default_rng(6).exponential(size=100), hours=2.0)
    near, far, lowest = loads.estimate.returns(peaks, [20.0, 20.1, 0.01])
    assert near.value_N and not near.is_extrapolated
    assert far.value_N is None and far.record_needed_h > 2.01
    assert far.why.startswith("a return period may be at most 10 times the record, here 20 h: record 2.01 h or more")
    assert lowest.value_N is None and "more often" in lowest.why
    marked = loads.estimate.returns(peaks, [20.1], extrapolate=True)[0]
    assert marked.is_extrapolated and marked.value_N > near.value_N


def test_a_tail_of_infinite_variance_gives_no_return_value():
    """No test refutes the tail, because the peaks are those of one, but its values for rare loads mean nothing."""
    heavy = made(1e5 + 2e5 * extremes.stretched(1.0, numpy.random.default_rng(3).exponential(size=200)), hours=1.0)
    found = loads.estimate.estimate(heavy)
    assert found.used is None and len(found.fits) == 1 and not list(found.fits[0].refuting_tests)
    assert "of the tail is above 0.5" in found.why and "record longer" in found.why
    near, far = loads.estimate.returns(heavy, [1.0, 11.0])
    assert near.value_N is None and near.record_needed_h is None and words.of_record(near, 0.2) == "-"
    assert far.reasons[0] == near.why and "may be at most 10 times the record, here 10 h" in far.reasons[1]
    said = list(words.reasons([near, far], found))
    assert len(said) == 2 and said[1].startswith("11 h also withheld: ")
    light = made(1e5 + 2e5 * numpy.random.default_rng(3).exponential(size=200), hours=1.0)
    assert loads.estimate.estimate(light).used and words.of_record(loads.estimate.returns(light)[0], 0.2) != "-"


def test_every_reason_says_what_to_do():
    draws = numpy.random.default_rng(2)
    few = loads.estimate.estimate(made(draws.exponential(size=10)), least=1e-3)
    assert few.why.endswith("record longer, or give a smaller --least")
    mixed = made(draws.permutation([*draws.normal(1e5, 2e3, 300), *draws.normal(9e5, 1e4, 30)]), hours=10)
    assert "record longer, or fit the large peaks alone (--least)" in loads.estimate.estimate(mixed, least=5e4).why
    near = loads.estimate.returns(made(1e5 + 2e5 * draws.exponential(size=100)), [0.001])[0]
    assert "ask for a longer period (--returns)" in near.why and words.of_record(near, 0.2) == "-"


def test_a_start_after_the_end_of_all_runs_is_refused(folder):
    late = ended("loads", "run", "--from", 500, "--out", "late", cwd=folder)
    assert late.returncode == 2 and late.stdout == "" and not (folder / "late").exists()
    assert late.stderr == ("polynya loads: --from 500: there are no records after 500 s, because the longest run ends "
                           "at 20 s: give an earlier time, or run longer (polynya resume RUN --until S)\n")


def test_runs_that_end_before_the_start_are_left_out_and_counted(tmp_path):
    (tmp_path / "base.json").write_text(json.dumps(SCENE))
    (tmp_path / "s.json").write_text(json.dumps({"scene": "base.json", "grid": {"time.until_s": [2, 8]}}))
    succeeded("study", "run", "s.json", "--quiet", cwd=tmp_path)
    found = loads.gather(tmp_path / "studies/s", start=4)
    assert len(found.cases) == 1 and found.ended == 1 and "1 more runs end before --from" in words.of_loads(found)


def test_the_figure_of_pressure_over_area_holds_every_peak():
    """Peaks of very different areas and pressures lie within the axes; those that have none are counted."""
    draws = numpy.random.default_rng(7)
    found = made(draws.exponential(size=300))
    found.peaks.update(width_m=10 ** draws.uniform(-3, 2, 300), height_m=numpy.ones(300),
                       pressure_Pa=10 ** draws.uniform(1, 8, 300), ended_by=numpy.full(300, "bend"))
    found.peaks["pressure_Pa"][:4] = 0
    axes = pictures.pressure_area(found).axes[0]
    points = next(line for line in axes.lines if line.get_marker() == "o")
    assert len(points.get_xdata()) == 296
    for values, (low, high) in ((points.get_xdata(), axes.get_xlim()), (points.get_ydata(), axes.get_ylim())):
        assert low < values.min() and values.max() < high


def test_the_record_needed_gives_the_interval_wanted():
    draws = numpy.random.default_rng(8)
    first = loads.estimate.returns(made(1e5 + 2e5 * draws.exponential(size=500), hours=10.0), [50.0])[0]
    hours = loads.estimate.returns(made(1e5 + 2e5 * draws.exponential(size=500), hours=10.0), [50.0],
                                   half_width=0.1)[0].record_needed_h
    assert hours > first.record_needed_h
    widths = []
    for _ in range(20):
        longer = made(1e5 + 2e5 * draws.exponential(size=draws.poisson(50 * hours)), hours=hours)
        found = loads.estimate.returns(longer, [50.0], least=1e5)[0]
        widths += [] if found.value_N is None else [(found.high_N - found.low_N) / 2 / found.value_N]
    assert numpy.median(widths) == pytest.approx(0.1, rel=0.25)


def test_bursts_count_as_one_peak():
    draws = numpy.random.default_rng(9)
    single = made(1e5 + 2e5 * draws.exponential(size=100), hours=10.0)
    times = draws.uniform(0, 36000, 100)
    copies = draws.uniform(0.8, 1, (100, 8))
    copies[:, 0] = 1
    bursts = made((single.forces[:, None] * copies).ravel(), hours=10.0)
    bursts.peaks["t_s"] = (times[:, None] + numpy.arange(8)).ravel()
    record = loads.bursts.record_of(bursts)
    every, found = loads.bursts.events_above(record, 1e5, 0.0), loads.bursts.independent(record, 1e5, 20)
    assert not every.are_alike and len(every.forces) > 500
    assert found.are_alike and found.gap > 1 and 80 < len(found.forces) <= 100
    steady = loads.bursts.independent(loads.bursts.record_of(single), 1e5, 20)
    assert steady.gap == 0 and len(steady.forces) == 100


def test_runs_are_pooled_only_where_they_are_alike():
    draws = numpy.random.default_rng(10)
    forces = 1e5 + 2e5 * draws.exponential(size=120)
    alike = made(forces, cases=4)
    assert loads.estimate.estimate(alike).used
    larger = made(numpy.where(numpy.arange(120) % 4 == 0, 3, 1) * forces, cases=4)
    assert "larger in some runs" in loads.estimate.estimate(larger, least=5e4).why
    fewer = made(forces, cases=4)
    fewer.peaks["case"] = numpy.where(numpy.arange(120) < 90, 0, numpy.arange(120) % 4)
    fewer.peaks["t_s"] = draws.uniform(0, 9000, 120)
    assert "more often in some" in loads.estimate.estimate(fewer, least=5e4).why
    kinds = made(forces, cases=4)
    kinds.cases[:] = [dataclasses.replace(case, kind=f"thickness {case.number % 2}") for case in kinds.cases]
    assert "differ in more than their seeds" in loads.estimate.estimate(kinds).why
    assert [len(kinds.of_kind(kind).forces) for kind in kinds.kinds()] == [60, 60]


def test_intervals_hold_the_truth_as_often_as_they_say():
    """With few trials; tail_coverage.py makes the table of docs/loads.md."""
    for row in tail_coverage.trials(0.2, 30, 40).values():
        assert 0.75 <= tail_coverage.share(row) and row["withheld"] < 10


def test_rules_are_as_they_are_cited():
    assert loads.rules.iso_local_pressure(1) == pytest.approx(7.4e6)
    assert loads.rules.iso_local_pressure(20) == pytest.approx(1.48e6)
    assert loads.rules.iso_global_pressure(20, 0.5, 1.8e6) * 20 * 0.5 == pytest.approx(13.2e6, rel=0.005)
    assert loads.rules.polar_class_pressure(1, "PC7") == pytest.approx(1.25e6)


def test_the_command_writes_what_the_runs_hold(folder):
    succeeded("loads", "run", "--out", "out", "--format", "png", cwd=folder)
    run = polynya.Run(folder / "run", pandas=False)
    panels = rows(folder / "out/loads-panels.csv")
    assert sum(int(row["peaks"]) for row in {row["panel"]: row for row in panels}.values()) == len(run.peaks)
    mean = sum(float(row["mean_N"]) for row in panels)
    assert mean * 20 == pytest.approx(run.panels["force_N"].sum() * run.summary["forces_interval_s"])
    assert sum(float(row["loaded_s"]) for row in panels) == pytest.approx(run.panels["loaded_s"].sum())
    page = (folder / "out/loads.html").read_text()
    for name in ("exceedance", "pressure-area", "along", "unrolled", "polar"):
        assert (folder / f"out/loads-{name}.png").stat().st_size > 5000 and f'src="loads-{name}.svg"' in page
    succeeded("loads", "run", "--format", "svg", cwd=folder)
    assert (folder / "run/loads/loads.html").is_file()
    wrong = ended("loads", "run", "--out", "out", "--ship", "nobody", cwd=folder)
    assert wrong.returncode == 2 and "no ship or structure is named nobody; it has: pile" in wrong.stderr


def test_a_full_disk_is_told_with_the_name_of_the_file(folder):
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
    full = started("loads", "run", "--out", "full", cwd=folder, preexec_fn=limit)
    assert full.returncode == 5 and full.stderr == "polynya loads: full/loads-peaks.csv: File too large\n"


def test_a_study_of_several_kinds_is_answered_by_kind(tmp_path):
    """Seeds of one scene are pooled, thicknesses are not."""
    (tmp_path / "base.json").write_text(json.dumps(SCENE))
    (tmp_path / "s.json").write_text(json.dumps({
        "scene": "base.json", "set": {"time.until_s": 5}, "grid": {"ice.thickness_m": [0.4, 0.8]}, "repetitions": 2}))
    succeeded("study", "run", "s.json", "--quiet", cwd=tmp_path)
    printed = succeeded("loads", "studies/s", "--out", "out", cwd=tmp_path).stdout
    found = loads.gather(tmp_path / "studies/s")
    assert found.kinds() == ["thickness 0.4 m", "thickness 0.8 m"] and [case.kind for case in found.cases].count(
        "thickness 0.4 m") == 2
    assert "of 2 kinds" in printed and "thickness 0.8 m: " in printed
    returns = rows(tmp_path / "out/loads-returns.csv")
    assert {row["runs"] for row in returns} == set(found.kinds()) and all(row["withheld"] for row in returns)
