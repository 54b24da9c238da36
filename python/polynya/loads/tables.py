"""Rows of the tables of `polynya loads`, and their files."""
import csv
import math

from ..files import writing
from . import estimate

FIT_COLUMNS = ("shape", "scale_N")


def estimates_of(loads, least):
    """Returns {kind: (loads, Estimate)} for each kind of runs."""
    kinds = {kind: loads if len(loads.kinds()) == 1 else loads.of_kind(kind) for kind in loads.kinds()}
    return {kind: (of, estimate.estimate(of, least)) for kind, of in kinds.items()}


def fit_rows(estimates):
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
    """Returns (kind, Answer) for each period."""
    for kind, (loads, found) in estimates.items():
        if found.hours <= 0:
            continue
        for period in options.returns or estimate.standard_periods(found.hours):
            yield kind, estimate.answer(found, loads.forces, period, options.extrapolate, options.half_width)


def return_rows(answers):
    for kind, given in answers:
        yield {"runs": kind, "period_h": given.period_h, "records": given.records, "value_N": given.value_N,
               "low_N": given.low_N, "high_N": given.high_N,
               "is_extrapolated": "yes" if given.is_extrapolated else "no", "seen_low_N": given.seen_low_N,
               "seen_high_N": given.seen_high_N if math.isfinite(given.seen_high_N) else None,
               "record_needed_h": given.record_needed_h, "withheld": given.why}


def rows_of(columns):
    """Converts columns of equal length to rows."""
    names = list(columns)
    return [dict(zip(names, values)) for values in zip(*(columns[name] for name in names))]


def exceedance_rows(estimates):
    return [{"runs": kind, **row} for kind, (of, _) in estimates.items() for row in rows_of(estimate.exceedance(of))]


def names_of(rows):
    return list(dict.fromkeys(name for row in rows for name in row))


def write_csv(path, rows):
    with writing(path, newline="") as file:
        writer = csv.DictWriter(file, names_of(rows), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
