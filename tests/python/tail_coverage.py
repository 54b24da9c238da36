#!/usr/bin/env python3
"""How often the intervals of return values hold the truth: records of known tails are made and answered as those of
`polynya loads`.

    PYTHONPATH=python tests/python/tail_coverage.py --trials 500
    PYTHONPATH=python tests/python/tail_coverage.py --trials 500 --method likelihood    # or bootstrap, for comparison

A record is of one run. Its peaks come by chance, 30 or 200 of them on average, and exceed a force by a generalised
Pareto distribution. The answer is for the record's length and ten times it. A row is printed for each kind of record:
how many of the answers hold the truth, miss it from above or below, and how many are withheld.
"""
import argparse
import itertools
import sys

import numpy
from scipy import stats

from polynya import extremes
from polynya.loads import estimate
from polynya.loads.gather import Case, Loads, Waterline

LEAST_FORCE, SCALE = 1e5, 2e5  # [N]
SHAPES, PEAKS, RECORDS = (-0.2, 0.0, 0.2), (30, 200), (1.0, 10.0)
ALLOWED = (0.85, 0.95)


def record(rng, shape, peaks, hours=2.0):
    """The loads of one run."""
    number = rng.poisson(peaks)
    force = LEAST_FORCE + SCALE * extremes.stretched(shape, rng.exponential(size=number))
    columns = {"t_s": numpy.sort(rng.uniform(0, 3600 * hours, number)), "case": numpy.zeros(number, dtype=int),
               "arc_m": numpy.zeros(number), "force_N": force}
    ring = [(5, -5), (5, 5), (-5, 5), (-5, -5)]
    return Loads("made", "a ship", False, Waterline(ring), 2.5, [Case(0, 0.0, hours, 1.0)], columns, None, 0.1, 0)


def by_likelihood(tail, period):
    """The interval by the profile of the likelihood, without a penalty on the shape."""
    shapes, scales = numpy.meshgrid(numpy.linspace(-0.9, 1.5, 121), tail.excesses.mean() * numpy.geomspace(0.2, 5, 121))
    logs = extremes.log_likelihood(shapes, numpy.log(scales), tail.excesses)
    levels = scales * extremes.stretched(shapes, numpy.log(tail.rate.value * period))
    found = levels[logs >= logs.max() - stats.chi2.ppf(extremes.LEVEL, 1) / 2]
    return tail.threshold + found.min(), tail.threshold + found.max()


def by_bootstrap(tail, period):
    """The interval by percentiles of resamples, of the most likely fit of each."""
    rows = numpy.random.default_rng(0).choice(tail.excesses, (400, tail.count))
    shapes, scales = extremes.most_likely(rows)
    levels = tail.threshold + scales * extremes.stretched(shapes, numpy.log(tail.rate.value * period))
    return tuple(numpy.quantile(levels, [(1 - extremes.LEVEL) / 2, (1 + extremes.LEVEL) / 2]))


METHODS = {"likelihood": by_likelihood, "bootstrap": by_bootstrap}


def compared(method, loads):
    """The answers of another method to the tail of all peaks, untested."""
    ordered = numpy.sort(loads.forces)
    tail = extremes.Tail(ordered[0], loads.hours, ordered[1:] - ordered[0])
    for records in RECORDS:
        low, high = METHODS[method](tail, records * loads.hours)
        yield estimate.Answer(records * loads.hours, records, (low + high) / 2, low, high, False, 0, 0, None, None)


def trials(shape, peaks, number, seed=1, method=None):
    """For each period over the record's length: counts of answers that hold the truth, lie above it, lie below it, and
    are withheld; and the median width of an interval over the truth."""
    rng = numpy.random.default_rng([seed, peaks, int(1000 * (shape + 1))])
    found = {records: {"held": 0, "above": 0, "below": 0, "withheld": 0} for records in RECORDS}
    widths = {records: [] for records in RECORDS}
    for _ in range(number):
        made = record(rng, shape, peaks)
        for given in compared(method, made) if method else estimate.returns(made):
            truth = LEAST_FORCE + SCALE * float(extremes.stretched(shape, numpy.log(peaks * given.records)))
            word = ("withheld" if given.value_N is None else "above" if given.low_N > truth
                    else "below" if given.high_N < truth else "held")
            found[round(given.records)][word] += 1
            if given.value_N is not None:
                widths[round(given.records)].append((given.high_N - given.low_N) / truth)
    return {records: {**found[records], "width": float(numpy.median(widths[records]))} for records in RECORDS}


def share(row):
    """Of the answers that hold the truth."""
    return row["held"] / max(1, row["held"] + row["above"] + row["below"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=500)
    parser.add_argument("--shapes", type=lambda text: [float(part) for part in text.split(",")], default=SHAPES)
    parser.add_argument("--method", choices=METHODS, help="another method, for comparison, without tests of its fits")
    options = parser.parse_args()
    print("| peaks | shape | period / record | hold the truth | too high | too low | withheld | width |")
    print("|---|---|---|---|---|---|---|---|")
    is_good = True
    for peaks, shape in itertools.product(PEAKS, options.shapes):
        for records, row in trials(shape, peaks, options.trials, method=options.method).items():
            is_good = is_good and ALLOWED[0] <= share(row) <= ALLOWED[1]
            print(f"| {peaks} | {shape:g} | {records:g} | {100 * share(row):.1f} % | {row['above']} | {row['below']} | "
                  f"{row['withheld']} | {row['width']:.2f} |", flush=True)
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
