"""The two factors by tests: runs at points of a plane of factors, a smooth surface through what they had, and the point
of that surface nearest to what was measured.

Everything is in logarithms: of the factors, and of mean and standard deviation over those measured."""
import dataclasses
import math

import numpy as np

RANGES = ((0.4, 3.0), (0.35, 2.0))  # of the load's factor and the cusp radius's that are searched
LOW, HIGH = (np.log([ends[k] for ends in RANGES]) for k in (0, 1))
TOLERANCE = np.array([0.2, 0.4])  # of the logarithms of mean and standard deviation: residuals are in these
# deviation of a factor's logarithm from 0 before any test: mean resistance leaves a valley of
# factors
BEFORE = np.log(2)
NEAR = 0.6  # width of the surface's weights, in logarithms of the factors
SPEEDS = 0.03  # runs are within this share of a test's speed: cusps settle into patterns that differ with it
GRID = np.stack(np.meshgrid(*(np.linspace(low, high, 61) for low, high in zip(LOW, HIGH)), indexing="ij"),
                -1).reshape(-1, 2)


def spread(count, centre, half):
    """Points that fill a box of half that width about a centre evenly, each with a share of the speed: a sequence of
    low discrepancy."""
    ratio = 1.2207440846057596  # whose powers of its inverse are independent in three dimensions
    at = (0.5 + np.outer(np.arange(1, count + 1), [ratio**-1, ratio**-2, ratio**-3])) % 1
    points = np.clip(centre + half * (2 * at[:, :2] - 1), LOW, HIGH)
    return points, 1 + SPEEDS * (2 * at[:, 2] - 1)


def terms(points):
    a, b = np.moveaxis(points, -1, 0)
    return np.stack([np.ones_like(a), a, b, a * a, a * b, b * b], -1)


def surface(points, values, wanted):
    """Values [point, …] as a quadratic fitted by weights about each wanted point."""
    design, flat = terms(points), values.reshape(len(points), -1)
    found = np.empty((len(wanted), flat.shape[1]))
    for i, at in enumerate(wanted):
        weight = np.exp(-0.5 * ((points - at) ** 2).sum(-1) / NEAR**2)[:, None]
        moved = terms(points - at)
        inverse = np.linalg.inv(moved.T @ (weight * moved)
                                + 1e-3 * np.eye(design.shape[1]) * weight.sum() / len(points))
        found[i] = (inverse @ (moved.T @ (weight * flat)))[0]
    return found.reshape(len(wanted), *values.shape[1:])


@dataclasses.dataclass(frozen=True)
class Fit:
    """Factors with their interval of 68 %, and at which of them the residuals are least."""

    factors: np.ndarray
    low: np.ndarray
    high: np.ndarray
    misfit: float  # root mean square of the residuals, in the tolerance
    is_at_edge: bool
    at: int  # in GRID


def fit(on_grid):
    """Of logarithms of mean and sd over measured [point of GRID, test, 2]. What is left of the residuals, but not less
    than the tolerance, stands for the model's error; before any test a factor is 1 within BEFORE."""
    residuals = (on_grid / TOLERANCE).reshape(len(GRID), -1)
    sums = (residuals**2).sum(1)
    before = ((GRID / BEFORE) ** 2).sum(1)
    at = int((sums + before).argmin())
    freedom = residuals.shape[1] - 2
    scale = max(1.0, sums[at] / freedom) if freedom > 0 else 1.0
    likelihood = np.exp(-0.5 * ((sums - sums[at]) / scale + before - before[at]))
    ends = [[weighted_quantile(GRID[:, k], likelihood, share) for k in (0, 1)] for share in (0.16, 0.84)]
    is_at_edge = bool(((GRID[at] == LOW) | (GRID[at] == HIGH)).any())
    misfit = math.sqrt(sums[at] / residuals.shape[1])
    return Fit(np.exp(GRID[at]), np.exp(ends[0]), np.exp(ends[1]), misfit, is_at_edge, at)


def weighted_quantile(values, weights, share):
    order = np.argsort(values, kind="stable")
    sums = np.cumsum(weights[order])
    return values[order][np.searchsorted(sums, share * sums[-1])]


def leave_one_out(on_grid):
    """For each test the fit of the others, and mean and sd over measured that it predicts for the one."""
    found = []
    for i in range(on_grid.shape[1]):
        others = fit(np.delete(on_grid, i, 1))
        found.append((others, np.exp(on_grid[others.at, i])))
    return found
