"""Estimates of a load's peaks: rates with bands, fits, return values, and what each panel bore."""
from __future__ import annotations

import dataclasses
import math

import numpy
from scipy import stats

from polynya import statistics

LEVEL = 0.95
LEAST = 10  # values that a distribution is fitted to
BLOCKS = 20  # of one run, whose maxima are taken


@dataclasses.dataclass(frozen=True)
class Tail:
    """Peaks above a force: how often they come, and how far they go beyond it."""

    least: float  #: [N]
    rate: float  #: per hour
    excesses: numpy.ndarray  #: [N]


@dataclasses.dataclass(frozen=True)
class Maxima:
    """The largest peaks of stretches of equal length, independent of each other where they are cases."""

    hours: float  #: of a stretch
    values: numpy.ndarray  #: [N]
    words: str  #: of what


def exceedance(loads, level=LEVEL):
    """Columns: each peak's force, from the largest, how many are at least as large per hour, and between which limits
    the
    rate lies if peaks come independently of each other (exact Poisson limits [Garwood1936])."""
    force = numpy.sort(loads.forces)[::-1]
    count = numpy.arange(1, len(force) + 1)
    low = stats.chi2.ppf((1 - level) / 2, 2 * count) / 2
    high = stats.chi2.ppf((1 + level) / 2, 2 * count + 2) / 2
    columns = {"force_N": force, "count": count}
    for name, exposure in (("hour", loads.hours), ("km", loads.kilometres)):
        if exposure > 1e-6:
            columns.update({f"per_{name}": count / exposure, f"per_{name}_low": low / exposure,
                            f"per_{name}_high": high / exposure})
    return columns


def tail(loads, least=None):
    """The peaks above a force [N], their median where none is given."""
    if least is None:
        least = float(numpy.median(loads.forces)) if len(loads.forces) else 0.0
    above = loads.forces[loads.forces > least]
    return Tail(least, len(above) / loads.hours if loads.hours else 0.0, above - least)


def maxima(loads):
    """Of each case, where there are ten of them at least; else of equal stretches of each run. Stretches without a peak
    have none: a distribution of maxima is of those with one."""
    several = len(loads.cases) >= LEAST
    parts = 1 if several else max(1, math.ceil(BLOCKS / len(loads.cases)))
    found = []
    for case in loads.cases:
        chosen = loads.peaks["case"] == case.number
        times, forces = loads.peaks["t_s"][chosen], loads.forces[chosen]
        edges = case.start_s + numpy.linspace(0, case.hours * 3600, parts + 1)[1:-1]
        place = numpy.searchsorted(edges, times, side="right")
        found += [forces[place == part].max() for part in range(parts) if numpy.any(place == part)]
    return Maxima(loads.hours / (parts * len(loads.cases)), numpy.array(found),
                  "of a case" if several else f"of a {parts}th of a run")


def fits(loads, least=None):
    """(of what, the sample [N], its fit) of all that has enough values: Gumbel and Weibull of the maxima, Weibull of
    what peaks have above a force, whose shape is 1 where the tail is exponential."""
    samples = [("maxima", "gumbel", maxima(loads).values), ("maxima", "weibull", maxima(loads).values),
               ("tail", "weibull", tail(loads, least).excesses)]
    return [(of, values, statistics.fit(name, values))
            for of, name, values in samples if len(values) >= LEAST and values.min() < values.max()]


def returns(loads, hours, least=None):
    """Rows of what is exceeded once in so many hours in the mean, by each fit, with its bootstrap interval: of the tail
    by its rate, of maxima by the length of their stretches. Periods that a fit does not reach are left out."""
    rows, above, blocks = [], tail(loads, least), maxima(loads)
    for of, values, fit in fits(loads, least):
        for period in hours:
            probability = 1 / (above.rate * period) if of == "tail" else -math.expm1(-blocks.hours / period)
            if not 0 < probability < 1:
                continue
            value = statistics.level_interval(fit.name, values, probability)
            base = above.least if of == "tail" else 0.0
            rows.append({"of": of, "fit": fit.name, "period_h": period, "value_N": base + value.value,
                         "low_N": base + value.low, "high_N": base + value.high})
    return rows


def panels(loads):
    """A row for each panel that ice pressed: its peaks and, where panels.csv has it, its force: the largest step, the
    mean over all the time, how long it was under load, the largest mean pressure of an interval. Rows of a column stand
    apart; peaks belong to columns."""
    number = loads.panel_of(loads.peaks["arc_m"])
    rows = []
    table = loads.panels
    of_table = set(zip(table["panel"].tolist(), table["row"].tolist())) if table else set()
    columns = sorted(set(number.tolist()) | {panel for panel, _ in of_table})
    for panel in columns:
        forces = loads.forces[number == panel]
        own = {"panel": panel, "from_m": panel * loads.panel_m, "to_m": (panel + 1) * loads.panel_m,
               "peaks": len(forces),
               "largest_peak_N": float(forces.max()) if len(forces) else 0.0,
               "mean_peak_N": float(forces.mean()) if len(forces) else 0.0}
        for row in sorted(row for of, row in of_table if of == panel) or [None]:
            rows.append({**own, **(row_of(loads, panel, row) if row is not None else {})})
    return rows


def row_of(loads, panel, row):
    table = loads.panels
    chosen = (table["panel"] == panel) & (table["row"] == row)
    force = table["force_N"][chosen]
    return {"row": row, "largest_N": float(table["force_max_N"][chosen].max()),
            "mean_N": float(force.sum() * loads.interval_s / (3600 * loads.hours)),
            "loaded_s": float(table["loaded_s"][chosen].sum()),
            "largest_pressure_Pa": float(table["pressure_Pa"][chosen].max())}

