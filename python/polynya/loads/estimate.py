"""Estimates from peaks of a load: rates with confidence bands, tails, return values, and the loads of each panel."""
from __future__ import annotations

import dataclasses
import math
from typing import Optional

import numpy
from scipy import stats

from polynya import extremes

from . import bursts

REFUTED = 0.05  #: a fit with a smaller p value is refuted
HALF_WIDTH = 0.2  #: half of an interval relative to its value, for which the required length of record is stated [-]


def exceedance(loads, level=extremes.LEVEL):
    """Columns: force of each peak in descending order, number of peaks per hour that are at least as large, and the
    limits of that rate if peaks are independent (exact Poisson limits [Garwood1936])."""
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


@dataclasses.dataclass(frozen=True)
class Fit:
    """A tail fitted to the events above a threshold, and the tests that may refute it."""

    tail: extremes.Tail
    events: bursts.Events
    goodness_p: float  #: p value of Anderson and Darling's test

    @property
    def refuted(self):
        """Reason why the fit gives no return values; empty if it gives them."""
        reasons = []
        if self.goodness_p < REFUTED:
            reasons.append(f"the peaks do not follow the fitted tail (p {self.goodness_p:.2g})")
        if self.events.counts_p < bursts.UNLIKE:
            reasons.append(f"peaks come more often in some parts of the record than in others (p "
                           f"{self.events.counts_p:.2g})")
        if self.events.sizes_p < bursts.UNLIKE:
            reasons.append(f"peaks are larger in some runs or parts than in others (p {self.events.sizes_p:.2g})")
        return "; ".join(reasons)


@dataclasses.dataclass(frozen=True)
class Estimate:
    """The fits that were tried, in ascending order of the threshold. The last one is used unless it is refuted."""

    fits: list
    hours: float
    why: str  #: reason why no fit can be used; empty if one can

    @property
    def used(self) -> Optional[Fit]:
        return None if self.why else self.fits[-1]


def thresholds(forces, least=None):
    """Thresholds to try until a fit is not refuted [N]: only `least` if it is given, otherwise those that leave all
    peaks except the smallest, half of them, a quarter and so on."""
    if least is not None:
        return [float(least)]
    ordered = numpy.sort(forces)
    halvings = int(math.log2(max(1, len(ordered) / extremes.LEAST_PEAKS)))
    return list(dict.fromkeys(float(ordered[int(len(ordered) * (1 - 0.5**k))]) for k in range(halvings + 1)
                              if len(ordered)))


def estimate(loads, least=None):
    """Estimates the tail of runs of one kind. For several kinds of runs no estimate is given; `loads.kinds()` lists the
    kinds."""
    record = bursts.record_of(loads)
    if len(loads.kinds()) > 1:
        return Estimate([], record.hours, "the runs differ in more than their seeds; each kind has its own answer")
    if loads.beyond_limit:
        return Estimate([], record.hours, f"{loads.beyond_limit} peaks are not in contacts.csv, whose limit was "
                                          "reached: raise record.least_peak_N and run again")
    fits = []
    for threshold in thresholds(record.forces, least):
        events = bursts.independent(record, threshold, extremes.LEAST_PEAKS)
        if events is None:
            continue
        excesses = events.forces - threshold
        fits.append(Fit(extremes.Tail(threshold, record.hours, excesses), events, extremes.goodness(excesses)))
        if not fits[-1].refuted:
            return Estimate(fits, record.hours, "")
    if fits:
        which = "the fit is refuted" if len(fits) == 1 else "every fit is refuted; the last"
        return Estimate(fits, record.hours, f"{which}: {fits[-1].refuted}")
    count = numpy.count_nonzero(record.forces > (least or 0))
    return Estimate([], record.hours, f"{count} peaks{f' above {least:g} N' if least else ''} make fewer than "
                                      f"{extremes.LEAST_PEAKS} independent ones above a threshold")


@dataclasses.dataclass(frozen=True)
class Answer:
    """The value that is exceeded once in a period on average, or the reason why it is not given. Forces in N, times in
    hours."""

    period_h: float
    records: float  #: period divided by the length of the record
    value_N: Optional[float]
    low_N: Optional[float]
    high_N: Optional[float]
    is_extrapolated: bool  #: true if the period is longer than those for which the intervals were tested
    seen_low_N: float  #: limits between observed peaks, without a fit
    seen_high_N: float
    record_needed_h: Optional[float]
    why: str  #: reason why there is no value


def standard_periods(hours):
    """The default periods: the length of the record and ten times that length [h]."""
    return [hours, extremes.FARTHEST * hours]


def returns(loads, hours=None, least=None, extrapolate=False, half_width=HALF_WIDTH):
    """Returns an Answer for each return period [h]. Default periods are the length of the record and ten times that
    length."""
    found = estimate(loads, least)
    if found.hours <= 0:
        return []
    return [answer(found, loads.forces, period, extrapolate, half_width)
            for period in (standard_periods(found.hours) if hours is None else hours)]


def answer(found, forces, period, extrapolate=False, half_width=HALF_WIDTH):
    records = period / found.hours
    is_far = records > extremes.FARTHEST * (1 + 1e-9)
    tail, why, value = found.used and found.used.tail, found.why, None
    if not why and is_far and not extrapolate:
        why = (f"the period is {float(f'{records:.3g}'):.6g} times the record, more than {extremes.FARTHEST:g}; "
               "--extrapolate answers all the same")
    if not why and not tail.reaches(period):
        why = f"peaks above the fit's threshold come more often than once in {period:.3g} h"
    if not why:
        value = tail.level(period)
    events = found.fits[-1].events.forces if found.fits else forces
    low, high = extremes.level_of_order(events, found.hours, period)
    return Answer(period, records, *((None,) * 3 if value is None else (value.value, value.low, value.high)),
                  is_far and value is not None, low, high,
                  tail.record_needed(period, half_width) if tail else None, why)


def panels(loads):
    """Returns a row for each panel that ice loaded: its peaks and, if panels.csv has it, its force in the largest step,
    its mean over the whole time, the time under load, and the largest mean pressure of an interval. Rows of panels are
    separate in one column; peaks belong to columns."""
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

