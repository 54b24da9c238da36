"""Rows of the tables of `polynya loads` as dicts, one member per column, and the CSV files of these tables. Forces are
in N and times in the unit at the end of a column's name."""
import csv
import math

from ..files import writing
from . import estimate


def estimates_of(loads, least):
    """Returns {kind: (Loads, Estimate)} for each kind of runs: the loads of that kind alone, and the estimate from
    them. Runs of one kind differ only in seeds, durations and texts; if all are of one kind, its name is empty. `least`
    is the only threshold for the fits [N]; if it is None, several thresholds are tried."""
    kinds = {kind: loads if len(loads.kinds()) == 1 else loads.of_kind(kind) for kind in loads.kinds()}
    return {kind: (of, estimate.estimate(of, least)) for kind, of in kinds.items()}


def fit_rows(estimates):
    """Yields the rows of loads-fits.csv: every fit that was tried, with the estimates and their limits (columns ending
    in _low and _high, which contain the value with the probability extremes.LEVEL), the p values of the tests, and in
    "refuted" the reasons why a fit is refuted, empty if it is not. No rows if there were too few peaks for a fit."""
    for kind, (_, found) in estimates.items():
        for fit in found.fits:
            tail, events = fit.tail, fit.events
            row = {"runs": kind, "threshold_N": tail.threshold, "events": tail.count, "gap_s": events.gap}
            named = {"per_hour": tail.rate, "shape": tail.shape, "scale_N": tail.scale}
            for name, interval in named.items():
                row.update({name: interval.value, f"{name}_low": interval.low, f"{name}_high": interval.high})
            yield {**row, "goodness_p": fit.goodness_p, "counts_p": events.counts_p, "sizes_p": events.sizes_p,
                   "refuted": fit.refuted}


def answers_of(estimates, options):
    """Yields (kind, Answer) for each kind of runs and each return period of the options. Default periods are those of
    estimate.standard_periods(). Kinds without a record have no answers. `options` are those of the command line, of
    which `returns` [h], `extrapolate` and `half_width` are used. An Answer may have reasons instead of a value."""
    for kind, (loads, found) in estimates.items():
        if found.hours <= 0:
            continue
        for period in options.returns or estimate.standard_periods(found.hours):
            yield kind, estimate.answer(found, loads.forces, period, options.extrapolate, options.half_width)


def return_rows(answers):
    """Yields the rows of loads-returns.csv from pairs (kind, Answer). "records" is the period divided by the length of
    the record; "seen_low_N" and "seen_high_N" are the limits from the observed peaks without a fit; "withheld" has the
    reasons why there is no value. A missing value stays an empty cell, and so does an upper limit of the observed peaks
    that is infinite."""
    for kind, given in answers:
        yield {"runs": kind, "period_h": given.period_h, "records": given.records, "value_N": given.value_N,
               "low_N": given.low_N, "high_N": given.high_N,
               "is_extrapolated": "yes" if given.is_extrapolated else "no", "seen_low_N": given.seen_low_N,
               "seen_high_N": given.seen_high_N if math.isfinite(given.seen_high_N) else None,
               "record_needed_h": given.record_needed_h, "withheld": given.why}


def rows_of(columns):
    """Converts columns of equal length, {name: values}, to a list of rows. Longer columns would be cut to the shortest
    one."""
    names = list(columns)
    return [dict(zip(names, values)) for values in zip(*(columns[name] for name in names))]


def exceedance_rows(estimates):
    """Rows of loads-exceedance.csv: how often each force is exceeded, per kind of runs."""
    return [{"runs": kind, **row} for kind, (of, _) in estimates.items() for row in rows_of(estimate.exceedance(of))]


def names_of(rows):
    """The names of all columns in the order in which the rows first have them; rows may lack some."""
    return list(dict.fromkeys(name for row in rows for name in row))


def write_csv(path, rows):
    """Writes the rows as CSV with a line of names, and replaces a file of an earlier call. Missing cells are empty, and
    so are those with None. Without rows the file has one empty line, so callers leave such a table out. An OSError
    names the file."""
    with writing(path, newline="") as file:
        writer = csv.DictWriter(file, names_of(rows), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
