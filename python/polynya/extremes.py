"""Rare loads: loads that are exceeded once in a long time, estimated from the peaks of a shorter record.

Peaks above a threshold are taken as a Poisson process, and their excess over the threshold as having a generalised
Pareto distribution [Coles2001]. Peaks of one jam follow each other, so only the largest of each burst may be given
(loads/bursts.py). Its shape is the curvature of the tail: 0 is an exponential tail, below 0 the tail has
an end, above 0 it is heavy. The estimate is Bayesian, because few peaks say little about the shape. The prior of the
shape is normal with mean 0 and standard deviation SHAPE_SPREAD, that of the scale is uniform in its logarithm, and that
of the rate is Jeffreys's 1/√rate. Intervals contain the fraction LEVEL of the posterior. How often they contain the
true value was measured (docs/loads.md, tests/python/tail_coverage.py).

Names and docstrings assume forces in newtons and times in hours, but the formulas hold for any units.
"""
from __future__ import annotations

import dataclasses
import functools
import math

import numpy
from scipy import optimize, stats

from .statistics import Interval

LEVEL = 0.90  #: probability of all intervals of this module [-]
SHAPE_SPREAD = 0.4  #: standard deviation of the prior of the shape [-]; smaller: fits are nearer to an exponential tail
LEAST_SHAPE, MOST_SHAPE = -0.75, 1.5  #: range of the shape on the grid of the posterior [-]
LEAST_PEAKS = 20  #: least number of peaks for a fit; the callers in loads/ keep to it
#: Largest ratio of return period to length of the record for which the coverage of intervals was measured [-]. For
#: longer periods `polynya loads` gives values only with --extrapolate.
FARTHEST = 10.0
RESAMPLES = 499  #: number of simulated samples of a test; more: p values are more exact and take longer
NODES = (71, 61, 25)  #: number of grid points of the posterior for shape, scale and rate


def stretched(shape, logarithm):
    """((λT)^ξ − 1)/ξ as a function of ln λT. At ξ = 0 it is the limit ln λT."""
    x = numpy.asarray(shape * logarithm, dtype=float)
    small = numpy.abs(x) < 1e-8
    return logarithm * numpy.where(small, 1 + x / 2, numpy.expm1(x) / numpy.where(small, 1, x))


def log_likelihood(shape, log_scale, excesses):
    """Log-likelihood of the excesses for the generalised Pareto distribution, for arrays of equal shape; -inf if a peak
    lies beyond the end of the tail."""
    found = numpy.full(shape.shape, -numpy.inf)
    chunk = max(1, int(2e6 / len(excesses)))
    for begin in range(0, shape.size, chunk):
        part = slice(begin, begin + chunk)
        xi, scale = shape.flat[part][:, None], numpy.exp(log_scale.flat[part])[:, None]
        inside = xi * excesses[None, :] / scale
        with numpy.errstate(divide="ignore", invalid="ignore"):
            bent = numpy.where(numpy.abs(xi) < 1e-9, excesses / scale, numpy.log1p(inside) / xi)
            total = -len(excesses) * numpy.log(scale[:, 0]) - ((1 + xi) * bent).sum(axis=1)
        found.flat[part] = numpy.where((inside > -1).all(axis=1), total, -numpy.inf)
    return found


def penalty(shape):
    return -0.5 * (shape / SHAPE_SPREAD) ** 2


def best_shape(bent, count):
    """The shape ξ with the largest posterior at a fixed ξ/σ, from the mean of ln(1 + y ξ/σ) over the excesses. It is
    the only root of ξ³/SHAPE_SPREAD² + count (ξ − bent) = 0."""
    shape = bent
    for _ in range(20):
        shape = shape - ((shape**3 / SHAPE_SPREAD**2 + count * (shape - bent))
                         / (3 * shape**2 / SHAPE_SPREAD**2 + count))
    return shape


def profile(guess, rows):
    """For each row of excesses, the logarithm of the largest posterior at a fixed ξ/σ, with the shape and scale there.
    ξ/σ is that of a distribution with the shape `guess` and the row's mean."""
    mean, count = rows.mean(axis=1), rows.shape[1]
    ratio = guess / ((1 - guess) * mean)
    ratio = numpy.where(numpy.abs(ratio * mean) < 1e-7, 1e-7 / mean, ratio)
    inside = ratio[:, None] * rows
    with numpy.errstate(divide="ignore", invalid="ignore"):
        bent = numpy.log1p(numpy.maximum(inside, -1)).mean(axis=1)
    shape = best_shape(numpy.maximum(bent, -50), count)
    scale = shape / ratio
    log = -count * (numpy.log(scale) + (1 + 1 / shape) * bent) - 0.5 * (shape / SHAPE_SPREAD) ** 2
    return numpy.where(numpy.isfinite(bent), log, -numpy.inf), shape, scale


def most_likely(rows):
    """Shape and scale with the largest posterior for each row of excesses, by golden-section search over the `guess` of
    profile(). Its upper limit, 0.8, is below 1, where the mean of the distribution would be infinite."""
    rows = numpy.atleast_2d(rows)
    mean = rows.mean(axis=1)
    end = -mean / rows.max(axis=1)  # beyond this value the largest peak lies beyond the end of the tail
    low = numpy.maximum(LEAST_SHAPE, end / numpy.maximum(1 + end, 1e-9))
    high = numpy.full(len(rows), 0.8)
    share = (math.sqrt(5) - 1) / 2
    left, right = high - share * (high - low), low + share * (high - low)
    of_left, of_right = profile(left, rows)[0], profile(right, rows)[0]
    for _ in range(22):
        is_left = of_left > of_right
        low, high = numpy.where(is_left, low, left), numpy.where(is_left, right, high)
        new = numpy.where(is_left, high - share * (high - low), low + share * (high - low))
        of_new = profile(new, rows)[0]
        left, right = numpy.where(is_left, new, right), numpy.where(is_left, left, new)
        of_left, of_right = numpy.where(is_left, of_new, of_right), numpy.where(is_left, of_left, of_new)
    return profile(0.5 * (low + high), rows)[1:]


def weighted_quantiles(values, weights, levels):
    order = numpy.argsort(values, axis=None)
    values, weights = values.ravel()[order], weights.ravel()[order]
    total = numpy.cumsum(weights)
    return numpy.interp(levels, (total - 0.5 * weights) / total[-1], values)


def interval_of(values, weights):
    low, middle, high = weighted_quantiles(values, weights, [(1 - LEVEL) / 2, 0.5, (1 + LEVEL) / 2])
    return Interval(float(middle), float(low), float(high))


@dataclasses.dataclass(frozen=True)
class Tail:
    """The tail of a record: its peaks above a threshold, and estimates of rarer ones."""

    threshold: float  #: [N]
    hours: float  #: length of the record
    excesses: numpy.ndarray  #: excesses of the peaks above the threshold [N]

    @property
    def count(self):
        return len(self.excesses)

    @functools.cached_property
    def posterior(self):
        """Shapes, scales [N] and weights on a grid around their most likely values. To each side the grid extends by
        several standard errors, 7.8/√count for the shape and 7/√count for the logarithm of the scale, with upper limits
        for few peaks."""
        shape, scale = (float(found[0]) for found in most_likely(self.excesses))
        reach = 6 * min(SHAPE_SPREAD, 1.3 / math.sqrt(self.count))
        shapes = numpy.linspace(max(LEAST_SHAPE, shape - reach), min(MOST_SHAPE, shape + reach), NODES[0])
        scales = math.log(scale) + numpy.linspace(-1, 1, NODES[1]) * min(2.5, 7 / math.sqrt(self.count))
        shapes, scales = numpy.meshgrid(shapes, scales, indexing="ij")
        logs = log_likelihood(shapes, scales, self.excesses) + penalty(shapes)
        weights = numpy.exp(logs - logs.max())
        kept = weights > 1e-9
        return shapes[kept], numpy.exp(scales[kept]), weights[kept] / weights[kept].sum()

    @property
    def rates(self):
        """Grid points of equal weight for the rate of peaks above the threshold [1/h]."""
        middles = (numpy.arange(NODES[2]) + 0.5) / NODES[2]
        return stats.gamma.ppf(middles, self.count + 0.5) / self.hours

    @functools.cached_property
    def shape(self):
        """Median of the shape [-], with its interval."""
        shapes, _, weights = self.posterior
        return interval_of(shapes, weights)

    @functools.cached_property
    def scale(self):
        """Median of the scale [N], with its interval."""
        _, scales, weights = self.posterior
        return interval_of(scales, weights)

    @property
    def rate(self):
        """Rate of peaks above the threshold [1/h]."""
        low, high = stats.gamma.ppf([(1 - LEVEL) / 2, (1 + LEVEL) / 2], self.count + 0.5) / self.hours
        return Interval(self.count / self.hours, float(low), float(high))

    def reaches(self, period):
        """Returns True if the return value of a period [h] lies above the threshold."""
        return self.count * period / self.hours > 1

    def level(self, period):
        """The value that is exceeded once per period [h] on average [N]: median and interval of the posterior.
        It is never below the threshold, so ask only for periods that the tail reaches."""
        shapes, scales, weights = self.posterior
        logarithms = numpy.maximum(numpy.log(self.rates * period), 0)
        levels = scales[:, None] * stretched(shapes[:, None], logarithms[None, :])
        found = interval_of(levels, numpy.broadcast_to(weights[:, None], levels.shape))
        return Interval(*(self.threshold + value for value in dataclasses.astuple(found)))

    def spread_of_level(self, period, hours):
        """Half of the interval of `level` that a record of another length [h] would give [N]. It follows from the
        Fisher information of the expected number of peaks, at the shape and scale found here."""
        shape, scale, logarithm = self.shape.value, self.scale.value, math.log(self.count * period / self.hours)
        count = self.count * hours / self.hours
        information = count * numpy.array([[2 / ((1 + shape) * (1 + 2 * shape)), 1 / ((1 + shape) * (1 + 2 * shape))],
                                           [1 / ((1 + shape) * (1 + 2 * shape)), 1 / (1 + 2 * shape)]])
        information[0, 0] += 1 / SHAPE_SPREAD**2
        step = 1e-4
        slope = scale * float(stretched(shape + step, logarithm) - stretched(shape - step, logarithm)) / (2 * step)
        gradient = numpy.array([slope, scale * float(stretched(shape, logarithm))])
        of_rate = scale * math.exp(shape * logarithm) / math.sqrt(count)
        spread = math.sqrt(gradient @ numpy.linalg.solve(information, gradient) + of_rate**2)
        return float(stats.norm.ppf((1 + LEVEL) / 2)) * spread

    def record_needed(self, period, half_width):
        """The length of record [h] for which the interval of `level` is at most ± half_width of the value, and the
        period is at most FARTHEST records. The interval of this record is scaled by the information of more peaks. None
        if the shape is near -0.5, below which the formula fails, if the tail does not reach the period, or if more than
        a million periods were needed."""
        if self.shape.value <= -0.45 or not self.reaches(period):
            return None
        level = self.level(period)
        # The interval of few peaks is wider than the information gives.
        scale = level.half_width / self.spread_of_level(period, self.hours)
        most = half_width * level.value / scale
        low, high = math.log(period / FARTHEST), math.log(1e6 * period)
        too_wide = lambda hours: self.spread_of_level(period, math.exp(hours)) - most
        if too_wide(low) <= 0:
            return math.exp(low)
        return math.exp(optimize.brentq(too_wide, low, high, xtol=1e-3)) if too_wide(high) < 0 else None


def distances(rows):
    """For each sorted row of excesses, its distance from the distribution fitted to it (Anderson and Darling), and the
    improbability of its largest peak."""
    shape, scale = (found[:, None] for found in most_likely(rows))
    with numpy.errstate(divide="ignore", invalid="ignore"):
        # Logarithm of the fraction above each value.
        logs = -numpy.log1p(numpy.maximum(shape * rows / scale, -1)) / shape
    logs = numpy.clip(logs, -60, -1e-16)
    below = numpy.log(-numpy.expm1(logs))
    count = rows.shape[1]
    weights = 2 * numpy.arange(1, count + 1) - 1
    return -count - (weights * (below + logs[:, ::-1])).sum(axis=1) / count, -logs[:, -1]


def goodness(excesses, seed=0):
    """p value of the fit, by a parametric bootstrap; a small one refutes the fit (estimate.REFUTED). The p value of a
    test is the fraction of samples of the fitted distribution that are as far from their own fits as this sample is
    from its fit. The result is three times the smallest of three p values, so that it is small by chance no more often
    than one test. The tests are Anderson and Darling's distance, for the whole tail, and two for the largest peak,
    which a fit to many small peaks may make impossible, or may predict to be larger than the ice can carry."""
    own = numpy.sort(excesses)[None, :]
    shape, scale = (float(found[0]) for found in most_likely(own))
    # Enough samples to recognise p = 0.05 even in a long record.
    samples = min(RESAMPLES, max(99, int(2e6 / own.shape[1])))
    uniform = numpy.random.default_rng(seed).uniform(1e-16, 1, (samples, own.shape[1]))
    simulated = numpy.sort(scale * stretched(shape, -numpy.log(uniform)), axis=1)
    (whole, largest), (own_whole, own_largest) = distances(simulated), distances(own)
    as_far = (whole >= own_whole, largest >= own_largest, largest <= own_largest)
    return float(min(1.0, 3 * min((1 + numpy.count_nonzero(found)) / (samples + 1) for found in as_far)))


def level_of_order(values, hours, period):
    """The value that is exceeded once per period [h] on average, as an interval between observed peaks, without a fit.
    Its limits follow from the Poisson distribution of the number of peaks in the record that exceed it. They are
    infinite, or 0, if no peak can be named."""
    ordered = numpy.sort(values)[::-1]
    expected = hours / period
    most = int(stats.poisson.ppf((1 + LEVEL) / 2, expected))  # largest number of peaks that may exceed it
    least = int(stats.poisson.ppf((1 - LEVEL) / 2, expected))
    low = float(ordered[most]) if most < len(ordered) else 0.0
    high = float(ordered[least - 1]) if 0 < least <= len(ordered) else math.inf
    return low, high
