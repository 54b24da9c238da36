"""Estimates from peaks of a load: rates with confidence bands, tails, return values, and the loads of each panel."""
from __future__ import annotations

import dataclasses
import math
from typing import Optional

import numpy
from scipy import stats

from polynya import extremes
from polynya.readable import in_hours

from . import bursts

#: A fit with a smaller p value of extremes.goodness() is refuted [-]; of right fits, at most about 5 % are. Larger:
#: more right fits are refuted and give no return values; smaller: more wrong ones are used.
REFUTED = 0.05
#: Largest shape of a tail that gives return values [-]. From a shape of 0.5 on, the peaks of the fitted tail have an
#: infinite variance, so that a few more peaks may change a return value by any amount. Larger: values of short records
#: of heavy tails are given, which are several times the true ones.
HEAVIEST = 0.5
#: Default half of an interval relative to its value, for which the required length of record is stated [-]. Smaller:
#: longer records are required. The default of --half-width is the same number, in loads/options.py.
HALF_WIDTH = 0.2


def exceedance(loads, level=extremes.LEVEL):
    """Returns columns of the exceedance of a load: force of each peak in descending order [N], number of peaks that are
    at least as large, and their rates per hour and per kilometre sailed. The limits of a rate contain it with the
    probability `level` if peaks are independent (exact Poisson limits [Garwood1936]); as peaks of one jam follow each
    other, the true uncertainty is larger. A rate is left out if the record has no such length, as the rate per
    kilometre of a structure."""
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

    tail: extremes.Tail  #: distribution of the events above the threshold
    events: bursts.Events  #: the independent peaks to which the tail was fitted
    goodness_p: float  #: common p value of the three tests of extremes.goodness()

    @property
    def is_heavy(self):
        """Returns True if the tail is too heavy for return values, whatever the tests say."""
        return self.tail.shape.value > HEAVIEST

    @property
    def refuting_tests(self):
        """Sentences on the tests that refute the fit, with what to do."""
        if self.goodness_p < REFUTED:
            yield (f"the peaks do not follow the fitted tail (p {self.goodness_p:.2g}, below {REFUTED:g}): record "
                   "longer, or fit the large peaks alone (--least)")
        if self.events.counts_p < bursts.UNLIKE:
            yield (f"peaks come more often in some parts of the record than in others (p {self.events.counts_p:.2g}, "
                   f"below {bursts.UNLIKE:g}): leave out the start of the runs (--from), or record longer")
        if self.events.sizes_p < bursts.UNLIKE:
            yield (f"peaks are larger in some runs or parts than in others (p {self.events.sizes_p:.2g}, below "
                   f"{bursts.UNLIKE:g}): leave out the start of the runs (--from), or record longer")

    @property
    def refuted(self):
        """Reasons why the fit gives no return values; empty if it gives them."""
        reasons = list(self.refuting_tests)
        if self.is_heavy:
            reasons.append(f"the shape {self.tail.shape.value:.2f} of the tail is above {HEAVIEST:g}, so that its "
                           "peaks have an infinite variance and the record is too short to decide rare loads: "
                           "record longer")
        return "; ".join(reasons)


@dataclasses.dataclass(frozen=True)
class Estimate:
    """The fits that were tried, in ascending order of the threshold. The last one is used unless it is refuted."""

    fits: list  #: list of Fit; empty if there was none to try
    hours: float  #: length of the record [h]
    why: str  #: reason why no fit can be used; empty if one can

    # The fit that gives return values; None if none can be used (`why`).
    @property
    def used(self) -> Optional[Fit]:
        return None if self.why else self.fits[-1]


def thresholds(forces, least=None):
    """Thresholds to try until a fit is not refuted [N]: only `least` if it is given, otherwise those that leave all
    peaks except the smallest, half of them, a quarter and so on, as long as about extremes.LEAST_PEAKS are left.
    `forces` are those of all peaks [N]. Without peaks the list is empty."""
    if least is not None:
        return [float(least)]
    ordered = numpy.sort(forces)
    halvings = int(math.log2(max(1, len(ordered) / extremes.LEAST_PEAKS)))
    return list(dict.fromkeys(float(ordered[int(len(ordered) * (1 - 0.5**k))]) for k in range(halvings + 1)
                              if len(ordered)))


def estimate(loads, least=None):
    """Returns the Estimate of the tail of runs of one kind, from the lowest threshold whose fit is not refuted. `least`
    is the only threshold to try [N], if it is given. For several kinds of runs no estimate is made; `loads.kinds()`
    lists the kinds, and `loads.of_kind()` separates them. Higher thresholds are not tried after a fit whose only fault
    is a heavy tail."""
    record = bursts.record_of(loads)
    if len(loads.kinds()) > 1:
        return Estimate([], record.hours, "the runs differ in more than their seeds, so they are not pooled: each kind "
                                          "has its own answer")
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
        if not list(fits[-1].refuting_tests):  # fewer peaks decide the shape of a heavy tail no better
            break
    if fits:
        which = "the fit is refuted" if len(fits) == 1 else "every fit is refuted; the last"
        return Estimate(fits, record.hours, f"{which}: {fits[-1].refuted}")
    return Estimate([], record.hours, too_few(record, least))


def too_few(record, least):
    """Says that there are too few peaks of a bursts.Record for a fit, and what to do. `least` is the threshold that the
    user gave [N], or None."""
    count = int(numpy.count_nonzero(record.forces > (least or 0)))
    above = f" above {least:g} N" if least else ""
    lower = ", or give a smaller --least" if least else ""
    return (f"a fit needs {extremes.LEAST_PEAKS} independent peaks above a threshold, and {count} peaks{above} make "
            f"fewer: record longer{lower}")


@dataclasses.dataclass(frozen=True)
class Answer:
    """The value that is exceeded once in a period on average, or the reasons why it is not given. Forces in N, times in
    hours."""

    period_h: float
    records: float  #: period divided by the length of the record
    value_N: Optional[float]  #: None if it is not given
    low_N: Optional[float]  #: limits of its interval, which holds extremes.LEVEL
    high_N: Optional[float]
    is_extrapolated: bool  #: true if a value is given for a longer period than the intervals were tested for
    seen_low_N: float  #: limits of the value between observed peaks, without a fit; 0 if too few peaks exceed it
    seen_high_N: float  #: infinite if too few peaks were observed for it
    #: Length of record for an interval of the requested half-width [h]; None if no fit gives it.
    record_needed_h: Optional[float]
    #: Least length of record for which the period is not too long: a tenth of it (extremes.FARTHEST) [h]. None without
    #: a fit that could give the value.
    least_record_h: Optional[float]
    reasons: tuple = ()  #: reasons why there is no value

    @property
    def why(self):
        """The reasons in one text; empty if there is a value."""
        return ". ".join(self.reasons)


def standard_periods(hours):
    """The default periods: the length of the record and ten times that length (extremes.FARTHEST), the longest for
    which a value is given without --extrapolate [h]."""
    return [hours, extremes.FARTHEST * hours]


def returns(loads, hours=None, least=None, extrapolate=False, half_width=HALF_WIDTH):
    """Returns an Answer for each of the return periods `hours` [h]; none if the record has no length. Default periods
    are those of standard_periods(). `least` is the threshold of the fit [N], and otherwise as in answer()."""
    found = estimate(loads, least)
    if found.hours <= 0:
        return []
    return [answer(found, loads.forces, period, extrapolate, half_width)
            for period in (standard_periods(found.hours) if hours is None else hours)]


def too_far(found, period):
    """Says that a period [h] is too long for the record of an Estimate, and what to do."""
    most, needed = extremes.FARTHEST * found.hours, period / extremes.FARTHEST
    return (f"a return period may be at most {extremes.FARTHEST:g} times the record, here {in_hours(most)}: record "
            f"{in_hours(needed)} or more, ask for shorter periods (--returns), or give --extrapolate for a value that "
            "is marked as untested")


def too_near(period):
    """Says that a period [h] is too short for a fit, and what to do."""
    return (f"peaks above the fit's threshold come more often than once in {in_hours(period)}: ask for a longer period "
            "(--returns), or read the value from the peaks seen")


def reasons_of(found, period, is_far):
    """Yields the reasons why no value is given for a period [h]. `is_far` is true if the period is too long for the
    record and was not asked for by `extrapolate`."""
    if found.why:
        yield found.why
    if is_far:
        yield too_far(found, period)
    elif found.used and not found.used.tail.reaches(period):
        yield too_near(period)


def answer(found, forces, period, extrapolate=False, half_width=HALF_WIDTH):
    """Returns the Answer for a return period [h] from the Estimate `found` and the `forces` of all peaks [N]. With
    `extrapolate`, periods longer than extremes.FARTHEST records are answered too. `half_width` is that of the interval
    for which the needed length of record is stated, as a fraction of the value. The record must have a length
    (found.hours > 0). If a reason speaks against a value, the Answer has the reasons and the limits from observed
    peaks, which are those of the last fit's events, or of all peaks without a fit."""
    records = period / found.hours
    is_far = records > extremes.FARTHEST * (1 + 1e-9)
    tail, reasons = found.used and found.used.tail, tuple(reasons_of(found, period, is_far and not extrapolate))
    value = None if reasons else tail.level(period)
    events = found.fits[-1].events.forces if found.fits else forces
    low, high = extremes.level_of_order(events, found.hours, period)
    needs_record = tail is not None and tail.reaches(period)
    return Answer(period, records, *((None,) * 3 if value is None else (value.value, value.low, value.high)),
                  is_far and value is not None, low, high,
                  tail.record_needed(period, half_width) if needs_record else None,
                  period / extremes.FARTHEST if needs_record else None, reasons)


def panels(loads):
    """Returns a row for each panel that ice loaded: its peaks and, if panels.csv has it, its force in the largest step,
    its mean over the whole time, the time under load, and the largest mean pressure of an interval. Rows of panels are
    separate in one column; peaks belong to columns. "panel" is the number of the column from the stem (0 to port, -1 to
    starboard), "from_m" and "to_m" are its limits along the waterline [m], and forces are in N. A column without a peak
    has 0 for its peaks. Without panels.csv rows have no members of row_of()."""
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
    """Members of the table of panels for one row of a panel, from panels.csv: forces [N], the mean of which is taken
    over the whole record, time under load [s] and largest pressure [Pa]. The record must have a length. "largest_N" is
    the largest force in one time step, and the pressure is a mean over the panel and an interval of panels.csv."""
    table = loads.panels
    chosen = (table["panel"] == panel) & (table["row"] == row)
    force = table["force_N"][chosen]
    return {"row": row, "largest_N": float(table["force_max_N"][chosen].max()),
            "mean_N": float(force.sum() * loads.interval_s / (3600 * loads.hours)),
            "loaded_s": float(table["loaded_s"][chosen].sum()),
            "largest_pressure_Pa": float(table["pressure_Pa"][chosen].max())}

