"""Estimators for samples of independent runs: means, quantiles, exceedance and extreme-value fits, with intervals.

A sample is a one-dimensional array of finite numbers in any unit. Intervals are two-sided with probability `level`.
Bootstrap intervals are percentile intervals [Efron1993]; their random draws depend only on `seed`.
"""
import dataclasses
import math

import numpy
from scipy import special, stats

LEVEL = 0.95  # default probability of intervals [-]
RESAMPLES = 1000  # default number of bootstrap samples; more make limits and p values less noisy, and cost time


@dataclasses.dataclass(frozen=True)
class Interval:
    """An estimate and its limits."""

    value: float
    low: float
    high: float

    @property
    def half_width(self):
        return (self.high - self.low) / 2


@dataclasses.dataclass(frozen=True)
class Fit:
    """A distribution fitted by maximum likelihood. `ks` and `ad` are the Kolmogorov–Smirnov and Anderson–Darling
    distances. Their p values come from a parametric bootstrap, because the parameters were fitted to the same
    sample. A small p value speaks against the distribution."""

    name: str  # gumbel or weibull
    parameters: dict  # name -> Interval
    ks: float
    ks_p: float
    ad: float
    ad_p: float
    size: int

    def values(self):
        return [interval.value for interval in self.parameters.values()]

    def exceedance(self, x):
        """Probability of a value above x."""
        return exceedance_of(self.name, self.values(), numpy.asarray(x, dtype=float))

    def level_of(self, probability):
        """The value that is exceeded with this probability."""
        return value_exceeded(self.name, self.values(), numpy.asarray(probability, dtype=float))


def sample_of(values, least):
    """Returns the values as an array. Raises ValueError if they are no sample of at least `least` numbers."""
    sample = numpy.asarray(values, dtype=float)
    if sample.ndim != 1 or not numpy.all(numpy.isfinite(sample)):
        raise ValueError("a sample is a list of finite numbers")
    if sample.size < least:
        raise ValueError(f"found {sample.size} values, allowed: at least {least}")
    return sample


def mean(values, level=LEVEL):
    """Mean with Student's interval. The interval is exact for normal samples, and approximate for large ones by the
    central limit theorem."""
    sample = sample_of(values, 2)
    middle = sample.mean()
    half = stats.t.ppf((1 + level) / 2, sample.size - 1) * sample.std(ddof=1) / math.sqrt(sample.size)
    return Interval(float(middle), float(middle - half), float(middle + half))


def resampled(sample, seed, count=RESAMPLES):
    """`count` resamples with replacement, one per row."""
    return numpy.random.default_rng(seed).choice(sample, (count, sample.size))


def bootstrap(values, statistic, level=LEVEL, seed=0, count=RESAMPLES):
    """A statistic with its percentile interval. `statistic` maps the last axis of an array to a number."""
    sample = sample_of(values, 2)
    of_resamples = statistic(resampled(sample, seed, count))
    low, high = numpy.quantile(of_resamples, [(1 - level) / 2, (1 + level) / 2])
    return Interval(float(statistic(sample)), float(low), float(high))


def bootstrap_mean(values, level=LEVEL, seed=0, count=RESAMPLES):
    """Mean with a percentile interval. It assumes no normal distribution, and reports show it beside Student's."""
    return bootstrap(values, lambda rows: rows.mean(axis=-1), level, seed, count)


def quantile(values, probability, level=LEVEL):
    """A quantile with the interval of order statistics, which is valid for any continuous distribution, because the
    number of values below the quantile is binomial. A limit is infinite if the sample is too small for it."""
    sample = numpy.sort(sample_of(values, 1))
    n = sample.size
    lower = int(stats.binom.ppf((1 - level) / 2, n, probability))  # the low limit is the lower-th smallest value
    upper = int(stats.binom.ppf((1 + level) / 2, n, probability)) + 1  # the high limit is the upper-th smallest value
    low = sample[lower - 1] if lower >= 1 else -math.inf
    high = sample[upper - 1] if upper <= n else math.inf
    return Interval(float(numpy.quantile(sample, probability)), float(low), float(high))


def exceedance(values):
    """Sorted values and the empirical probability of a value above each: 1 − i/(n + 1), Weibull's plotting
    positions."""
    sample = numpy.sort(sample_of(values, 1))
    return sample, 1 - numpy.arange(1, sample.size + 1) / (sample.size + 1)


def proportion(count, of, level=LEVEL):
    """A proportion with Wilson's interval."""
    if not 0 <= count <= of or of < 1:
        raise ValueError(f"found {count} of {of}")
    z = stats.norm.ppf((1 + level) / 2)
    p, denominator = count / of, 1 + z * z / of
    middle = (p + z * z / (2 * of)) / denominator
    half = z / denominator * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return Interval(p, max(0.0, middle - half), min(1.0, middle + half))


def cases_needed(values, half_width, level=LEVEL):
    """Total number of cases, these included, for which the interval of the mean is at most ± half_width, estimated from
    the standard deviation of these."""
    sample = sample_of(values, 2)
    if not half_width > 0:
        raise ValueError(f"found a half width of {half_width}, allowed: a number > 0")
    spread = sample.std(ddof=1) / half_width
    n = max(2, math.ceil((stats.norm.ppf((1 + level) / 2) * spread) ** 2))
    while stats.t.ppf((1 + level) / 2, n - 1) * spread > math.sqrt(n):
        n += 1
    return n


# --- Extreme values ---


def gumbel_parameters(rows):
    """Location and scale of the Gumbel distribution of largest values for each row, by maximum likelihood. The scale β
    solves β = x̄ − Σ x e^(−x/β) / Σ e^(−x/β) [Johnson1995]. It is found by Newton's method for log β, starting from the
    method of moments. A row of equal values has the scale 0 and that value as its location."""
    rows = numpy.atleast_2d(rows)
    location, scale = rows[:, 0].astype(float), numpy.zeros(len(rows))
    is_spread = rows.min(axis=1) < rows.max(axis=1)
    if is_spread.any():
        location[is_spread], scale[is_spread] = _spread_gumbel_parameters(rows[is_spread])
    return location, scale


def _spread_gumbel_parameters(rows):
    """The same for rows that each have different values."""
    low = rows.min(axis=1, keepdims=True)
    x = rows - low
    middle = x.mean(axis=1)
    scale = x.std(axis=1) * math.sqrt(6) / math.pi
    for _ in range(100):  # far more steps than a row needs; a row that has not converged is not reported
        weights = numpy.exp(-x / scale[:, None])
        total = weights.sum(axis=1)
        first = (x * weights).sum(axis=1) / total
        second = (x * x * weights).sum(axis=1) / total
        miss = scale - middle + first
        slope = scale + (second - first * first) / scale  # derivative of the residual with respect to log β
        change = numpy.clip(-miss / slope, -1, 1)  # at most a factor e a step, so that a poor start does not diverge
        scale = scale * numpy.exp(change)
        if numpy.all(numpy.abs(change) < 1e-12):  # relative change of the scale
            break
    location = -scale * numpy.log(numpy.exp(-x / scale[:, None]).mean(axis=1)) + low[:, 0]
    return location, scale


def weibull_parameters(rows):
    """Shape and scale of the Weibull distribution from zero for each row of positive numbers, by maximum likelihood.
    −ln X then has a Gumbel distribution with location −ln scale and scale 1/shape."""
    location, scale = gumbel_parameters(-numpy.log(rows))
    with numpy.errstate(divide="ignore"):  # equal values have the scale 0 there: an infinite shape here
        return 1 / scale, numpy.exp(-location)


def parameters_of(name, rows):
    """Fitted parameters, one row per sample, with columns in the order of NAMES."""
    return numpy.column_stack(gumbel_parameters(rows) if name == "gumbel" else weibull_parameters(rows))


# The distributions that can be fitted, with their two parameters. The functions of this file take every name except
# "gumbel" for Weibull, so another distribution needs a branch in each of them.
NAMES = {"gumbel": ("location", "scale"), "weibull": ("shape", "scale")}


def exceedance_of(name, parameters, x):
    """Probability of a value above x. `parameters` is the pair of NAMES."""
    first, second = parameters
    if name == "gumbel":
        return -special.expm1(-numpy.exp(-(x - first) / second))
    return numpy.exp(-numpy.power(numpy.maximum(x, 0) / second, first))


def value_exceeded(name, parameters, probability):
    """The value that is exceeded with this probability, the inverse of `exceedance_of`."""
    first, second = parameters
    if name == "gumbel":
        return first - second * numpy.log(-numpy.log1p(-probability))
    return second * numpy.power(-numpy.log(probability), 1 / first)


def distances(name, parameters, rows):
    """Kolmogorov–Smirnov and Anderson–Darling distances of each row from its distribution. Probabilities are clipped
    away from 0 and 1, so that their logarithms are finite."""
    ordered = numpy.sort(rows, axis=1)
    n = ordered.shape[1]
    above = exceedance_of(name, (parameters[:, :1], parameters[:, 1:]), ordered)
    above = numpy.clip(above, 1e-300, 1 - 1e-16)
    below = 1 - above
    i = numpy.arange(1, n + 1)
    ks = numpy.maximum(i / n - below, below - (i - 1) / n).max(axis=1)
    ad = -n - ((2 * i - 1) * (numpy.log(numpy.clip(below, 1e-300, 1)) + numpy.log(above[:, ::-1]))).sum(axis=1) / n
    return ks, ad


def fit(name, values, level=LEVEL, seed=0, count=RESAMPLES):
    """Fits a Gumbel or Weibull distribution to a sample of extremes, with bootstrap intervals and tests of the fit.
    A resample of equal values, which is likely for 5 values and rare for more than 7, makes the limits of the intervals
    NaN. Studies fit at least study.sample.LEAST_FIT values."""
    sample = sample_of(values, 5)
    if name not in NAMES:
        raise ValueError(f'found "{name}", allowed: {", ".join(NAMES)}')
    if name == "weibull" and sample.min() <= 0:
        raise ValueError("found values that are not positive, which no Weibull distribution from zero has")
    if sample.min() == sample.max():
        raise ValueError("found equal values, which no distribution is fitted to")
    own = parameters_of(name, sample[None, :])
    of_resamples = parameters_of(name, resampled(sample, seed, count))
    low, high = numpy.quantile(of_resamples, [(1 - level) / 2, (1 + level) / 2], axis=0)
    parameters = {key: Interval(float(own[0, k]), float(low[k]), float(high[k])) for k, key in enumerate(NAMES[name])}
    ks, ad = (float(distance[0]) for distance in distances(name, own, sample[None, :]))
    # Samples of the fitted distribution for the p values. The other seed makes them independent of the resamples. The
    # least probability is above 0, because the value that is never exceeded is infinite.
    simulated = value_exceeded(name, own[0], numpy.random.default_rng(seed + 1).uniform(1e-16, 1, (count, sample.size)))
    ks_of, ad_of = distances(name, parameters_of(name, simulated), simulated)
    return Fit(
        name,
        parameters,
        ks,
        float((1 + (ks_of >= ks).sum()) / (count + 1)),
        ad,
        float((1 + (ad_of >= ad).sum()) / (count + 1)),
        sample.size,
    )


def level_interval(name, values, probability, level=LEVEL, seed=0, count=RESAMPLES):
    """The value that is exceeded with this probability by the fit, with its bootstrap interval. Neither the name nor
    the range of the values is checked; call it for samples that `fit` accepts."""
    sample = sample_of(values, 5)

    def of(rows):
        parameters = parameters_of(name, rows)
        return value_exceeded(name, (parameters[:, 0], parameters[:, 1]), probability)

    low, high = numpy.quantile(of(resampled(sample, seed, count)), [(1 - level) / 2, (1 + level) / 2])
    return Interval(float(of(sample[None, :])[0]), float(low), float(high))
