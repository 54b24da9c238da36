"""polynya loads: places, rates and their limits, fits and return values of samples that are known, and the command."""
import numpy
import polynya
import pytest
from program import ended, rows, run_of, succeeded
from polynya import loads
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
    columns = loads.estimate.exceedance(made([3, 1, 2]))
    assert columns["force_N"].tolist() == [3, 2, 1] and numpy.allclose(columns["per_hour"], [0.1, 0.2, 0.3])
    assert numpy.allclose(columns["per_hour_low"] * 10, [0.0253, 0.2422, 0.6187], atol=1e-4)  # tables of Garwood
    assert numpy.allclose(columns["per_hour_high"] * 10, [5.5716, 7.2247, 8.7673], atol=1e-4)
    assert numpy.allclose(columns["per_km"], [1, 2, 3])


def test_return_values_of_known_tails_are_found():
    draws = numpy.random.default_rng(5)
    exponential = made(2e5 * draws.exponential(size=4000), hours=100.0)
    fit = next(fit for of, _, fit in loads.estimate.fits(exponential, least=1e5) if of == "tail")
    assert fit.parameters["shape"].value == pytest.approx(1, abs=0.05) and fit.ks_p > 0.05
    row = next(row for row in loads.estimate.returns(exponential, [10.0], least=1e5) if row["of"] == "tail")
    assert row["low_N"] < 2e5 * numpy.log(400) < row["high_N"]  # 40 peaks an hour
    gumbel = made(draws.gumbel(1e6, 2e5, size=400), hours=400.0, cases=400)
    row = next(row for row in loads.estimate.returns(gumbel, [100.0]) if row["fit"] == "gumbel")
    assert row["low_N"] < 1e6 - 2e5 * numpy.log(0.01) < row["high_N"]  # -ln of the share below is b/T
    assert not loads.estimate.fits(made([1e5] * 3))


def test_maxima_of_one_run_are_of_twenty_equal_parts():
    found = loads.estimate.maxima(made(numpy.arange(1, 201), hours=20.0))
    assert found.hours == pytest.approx(1) and found.values.tolist() == list(range(10, 201, 10))


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
    wrong = ended("loads", "run", "--out", "out", "--ship", "nobody", cwd=folder)
    assert wrong.returncode == 2 and "no ship or structure is named nobody; it has: pile" in wrong.stderr
