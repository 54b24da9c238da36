"""Estimators on samples of known distribution: they find its parameters, their intervals cover them as often as stated,
and they agree with scipy's own where that has one."""
import math

import numpy
import pytest
from scipy import stats

from polynya import statistics

TRIALS = 400


def scatter(level, trials=TRIALS):
    """Four standard deviations of what a right interval's coverage scatters by."""
    return 4 * math.sqrt(level * (1 - level) / trials)


@pytest.mark.parametrize("interval_of, draw, size, truth, trials, least, most", [
    (lambda x: statistics.mean(x, 0.8), lambda rng, n: rng.normal(3, 2, n), 6, 3, TRIALS,
     0.8 - scatter(0.8), 0.8 + scatter(0.8)),
    (lambda x: statistics.mean(x, 0.95), lambda rng, n: rng.normal(3, 2, n), 6, 3, TRIALS,
     0.95 - scatter(0.95), 0.95 + scatter(0.95)),
    # Percentile intervals of skewed samples are a little short.
    (lambda x: statistics.bootstrap_mean(x, count=400), lambda rng, n: rng.exponential(1, n), 60, 1, TRIALS,
     0.88, 0.98),
    # At least as often as stated.
    (lambda x: statistics.quantile(x, 0.5), lambda rng, n: rng.exponential(1, n), 30, stats.expon.ppf(0.5), TRIALS,
     0.95 - scatter(0.95), 0.995),
    (lambda x: statistics.quantile(x, 0.9), lambda rng, n: rng.exponential(1, n), 100, stats.expon.ppf(0.9), TRIALS,
     0.95 - scatter(0.95), 0.995),
    (lambda x: statistics.proportion(int(x.sum()), x.size), lambda rng, n: rng.random(n) < 0.2, 80, 0.2, TRIALS,
     0.95 - scatter(0.95), 0.95 + scatter(0.95)),
    (lambda x: statistics.level_interval("gumbel", x, 0.01, count=200), lambda rng, n: rng.gumbel(5, 2, n), 80,
     5 - 2 * math.log(-math.log1p(-0.01)), 150, 0.86, 0.99),
], ids=["student-0.8", "student-0.95", "bootstrap", "median", "quantile-0.9", "wilson", "gumbel-level"])
def test_intervals_cover_the_truth_as_often_as_stated(interval_of, draw, size, truth, trials, least, most):
    rng = numpy.random.default_rng(7)
    intervals = [interval_of(draw(rng, size)) for _ in range(trials)]
    assert least < sum(interval.low <= truth <= interval.high for interval in intervals) / trials < most


def test_students_interval_is_that_of_scipys_t_test():
    x = numpy.random.default_rng(1).gamma(2, 3, 25)
    own, peer = statistics.mean(x), stats.ttest_1samp(x, 0).confidence_interval(0.95)
    assert own.low == pytest.approx(peer.low) and own.high == pytest.approx(peer.high)


def test_bootstrap_depends_on_its_seed_alone():
    x = numpy.random.default_rng(1).normal(0, 1, 30)
    assert statistics.bootstrap_mean(x, seed=3) == statistics.bootstrap_mean(x, seed=3)
    assert statistics.bootstrap_mean(x, seed=3) != statistics.bootstrap_mean(x, seed=4)


def test_quantiles_proportions_and_exceedance_at_the_ends_of_a_sample():
    interval = statistics.quantile(range(10), 0.99)
    assert interval.high == math.inf and interval.low > 0
    values, above = statistics.exceedance([3, 1, 2])  # plotting positions
    assert values.tolist() == [1, 2, 3] and above.tolist() == pytest.approx([0.75, 0.5, 0.25])
    assert statistics.proportion(0, 10).low == 0 and statistics.proportion(0, 10).high > 0.2


@pytest.mark.parametrize("name, peer", [("gumbel", stats.gumbel_r.fit),
                                        ("weibull", lambda x: stats.weibull_min.fit(x, floc=0)[::2])])
@pytest.mark.parametrize("seed", range(5))
def test_fits_are_scipys(name, peer, seed):
    rng = numpy.random.default_rng(seed)
    x = rng.gumbel(3e5, 4e4, 80) if name == "gumbel" else 3e5 * rng.weibull(1.6, 80)
    assert statistics.fit(name, x, count=50).values() == pytest.approx(peer(x), rel=2e-3)


@pytest.mark.parametrize("name, truth, draw", [
    ("gumbel", (5, 2), lambda rng, n: rng.gumbel(5, 2, n)),
    ("weibull", (1.6, 4), lambda rng, n: 4 * rng.weibull(1.6, n))])
def test_fits_find_the_parameters_and_their_intervals_cover_them(name, truth, draw):
    rng = numpy.random.default_rng(11)
    large = statistics.fit(name, draw(rng, 20000), count=20)
    assert large.values() == pytest.approx(truth, rel=0.03)
    fits = [statistics.fit(name, draw(rng, 60), count=200) for _ in range(150)]
    for k, key in enumerate(statistics.NAMES[name]):
        part = numpy.mean([fit.parameters[key].low <= truth[k] <= fit.parameters[key].high for fit in fits])
        assert 0.86 < part < 0.99, key


@pytest.mark.parametrize("name", ["gumbel", "weibull"])
def test_goodness_is_uniform_for_the_right_distribution_and_small_for_a_wrong_one(name):
    rng = numpy.random.default_rng(5)
    right = (lambda: rng.gumbel(5, 2, 50)) if name == "gumbel" else (lambda: 4 * rng.weibull(1.6, 50))
    fits = [statistics.fit(name, right(), count=199) for _ in range(100)]
    for p in ([fit.ks_p for fit in fits], [fit.ad_p for fit in fits]):
        assert stats.kstest(p, "uniform").pvalue > 1e-3
    wrong = numpy.concatenate([rng.normal(1, 0.05, 100), rng.normal(3, 0.05, 100)])
    fitted = statistics.fit(name, wrong, count=199)
    assert fitted.ad_p < 0.01 and fitted.ks_p < 0.01


def test_the_level_of_a_probability_is_exceeded_by_it():
    rng = numpy.random.default_rng(2)
    for name, x in (("gumbel", rng.gumbel(1, 3, 50)), ("weibull", rng.weibull(2, 50))):
        fitted = statistics.fit(name, x, count=50)
        for p in (0.5, 0.01, 1e-6):
            assert float(fitted.exceedance(fitted.level_of(p))) == pytest.approx(p, rel=1e-9)


def test_as_many_cases_as_are_needed_make_the_interval_narrow_enough():
    rng = numpy.random.default_rng(3)
    first = rng.normal(10, 2, 400)
    n = statistics.cases_needed(first, 0.25)
    widths = [statistics.mean(rng.normal(10, 2, n)).half_width for _ in range(50)]
    assert numpy.mean(widths) == pytest.approx(0.25, rel=0.1)
    assert statistics.cases_needed([1, 1, 1], 0.1) == 2


@pytest.mark.parametrize("call", [
    lambda: statistics.mean([1]), lambda: statistics.mean([1, math.nan]), lambda: statistics.mean([[1, 2], [3, 4]]),
    lambda: statistics.fit("weibull", [1, 2, 3, 4, 0]), lambda: statistics.fit("normal", [1, 2, 3, 4, 5]),
    lambda: statistics.fit("gumbel", [2] * 8), lambda: statistics.cases_needed([1, 2], 0),
    lambda: statistics.proportion(3, 2)])
def test_what_is_no_sample_is_refused_with_words(call):
    with pytest.raises(ValueError, match="found|sample"):
        call()


def test_a_row_of_equal_values_has_a_fit_without_spread():
    rows = numpy.array([[2.0, 2, 2], [1, 2, 4], [3, 3, 3]])
    gumbel = statistics.parameters_of("gumbel", rows)
    assert gumbel[0].tolist() == [2, 0] and gumbel[2].tolist() == [3, 0]
    assert gumbel[1] == pytest.approx(statistics.parameters_of("gumbel", rows[1:2])[0])
    weibull = statistics.parameters_of("weibull", rows)
    assert weibull[0] == pytest.approx([math.inf, 2]) and numpy.isfinite(weibull[1]).all()
    level = statistics.level_interval("gumbel", numpy.array([1.0, 1, 1, 1, 2]), 0.1)
    assert level.low <= level.value <= level.high
