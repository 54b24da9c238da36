"""Results of `polynya loads` in sentences, for the terminal, its page and its figures. `loads` is a gather.Loads, `fit`
an estimate.Fit, `found` an estimate.Estimate, and `given` an estimate.Answer for one return period."""
import math
import textwrap

from polynya import extremes
from polynya.readable import force, in_hours as hours, plain

from . import estimate

#: Largest width of a printed reason [characters]; longer ones continue on the next line. Tables are not limited by it.
WIDEST = 118
#: Largest number of kinds of runs whose answers are printed, so that those of a large study stay readable;
#: loads-returns.csv contains all kinds.
MOST_KINDS = 12


def shape(value):
    """Returns the shape of a tail with two decimals, never as "-0.00"."""
    return f"{round(value, 2) + 0:.2f}"


def span(low, high):
    """Returns an interval of forces [N] in words, such as "1.2 MN to 3 MN"; an infinite upper end is "no limit"."""
    return f"{force(low)} to {force(high) if math.isfinite(high) else 'no limit'}"


# Describes the fit in use: number of its peaks, threshold, gap within which peaks count as one, shape with interval,
# scale, and p value of its tests (small: the peaks do not follow the fit).
def of_fit(fit):
    tail, gap = fit.tail, fit.events.gap
    bursts = f", peaks within {gap:.3g} s of each other as one" if gap else ""
    return (f"{tail.count} peaks above {force(tail.threshold)}{bursts}: shape {shape(tail.shape.value)} "
            f"({shape(tail.shape.low)} to {shape(tail.shape.high)}), scale {force(tail.scale.value)}, p "
            f"{fit.goodness_p:.2g}")


def of_answer(given):
    """Describes the return value of a period with its 90 % interval, marked if extrapolated. It is "withheld" if the
    Answer has no value; reasons() says why."""
    if given.value_N is None:
        return "withheld"
    mark = ", EXTRAPOLATED" if given.is_extrapolated else ""
    return f"{force(given.value_N)} ({span(given.low_N, given.high_N)}){mark}"


def reasons(answers, found):
    """Yields the reasons why return values of one kind of runs are withheld, and a note if any is extrapolated. A
    reason that concerns all periods (`found.why`) comes first; each other one is stated once, with its periods. Yields
    nothing if all values are given and none is extrapolated."""
    if found.why:
        yield found.why
    periods = {}
    for given in answers:
        for why in given.reasons:
            if why != found.why:
                periods.setdefault(why, []).append(hours(given.period_h))
    for why, of in periods.items():
        yield f"{', '.join(of)} {'also ' if found.why else ''}withheld: {why}"
    if any(given.is_extrapolated for given in answers):
        yield f"extrapolated: no interval was tested beyond {extremes.FARTHEST:g} records"


def of_seen(given):
    """Returns the interval of the return value that follows from the observed peaks without a fit. It is also given
    where the value is withheld; "no limit" if too few peaks were observed for an upper end."""
    return span(given.seen_low_N, given.seen_high_N)


def of_record(given, half_width):
    """Says how long a record must be for an interval of ± `half_width`, a fraction of the value. If that length is not
    known, states the length from which on a value is given. Returns a dash if no fit can be used or if the period is
    too short for its threshold."""
    if given.record_needed_h:
        return f"{hours(given.record_needed_h)} for ±{100 * half_width:g} %"
    return f"at least {hours(given.least_record_h)}" if given.least_record_h else "-"


def of_loads(loads):
    """Describes the record: the number of peaks, the ship, the runs, and the time and distance that count. The distance
    is left out for a ship or structure that hardly moves."""
    runs = len(loads.cases)
    kinds = f" of {len(loads.kinds())} kinds" if len(loads.kinds()) > 1 else ""
    reach = f", {loads.kilometres:.3g} km" if loads.kilometres > 1e-6 else ""
    gauge = f"; through a gauge of {loads.gauge_s:g} s" if loads.gauge_s else ""
    ended = f"; {loads.ended} more runs end before --from" if loads.ended else ""
    return (f"{len(loads.forces)} peaks on {loads.ship} in {runs} run{'s' if runs > 1 else ''}{kinds}, "
            f"{hours(loads.hours)}{reach}{gauge}{ended}")


def of_fits(found):
    """Yields a line for the refuted fits together, with the range of their thresholds, and a line for the fit in use;
    neither if there is none."""
    rest = [fit for fit in found.fits if fit is not found.used]
    if rest:
        reach = dict.fromkeys(force(fit.tail.threshold) for fit in (rest[0], rest[-1]))
        count = "1 fit" if len(rest) == 1 else f"{len(rest)} fits"
        yield f"refuted  {count} above {' to '.join(reach)} (loads-fits.csv says why)"
    if found.used:
        yield f"fit      {of_fit(found.used)}"


# Returns rows of texts as lines whose columns are aligned to the left. All rows must have equally many texts.
def aligned(rows):
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths)).rstrip() for row in rows]


def lines_of(loads, estimates, answers, half_width):
    """Yields the lines that the command prints: the record, and a section for each of the first MOST_KINDS kinds of
    runs with its fits, a row per return period, and the reasons of values that are withheld. `estimates` has (Loads,
    Estimate) by kind, `answers` are pairs (kind, Answer), and `half_width` is that of of_record()."""
    yield of_loads(loads)
    for kind, (of, found) in list(estimates.items())[:MOST_KINDS]:
        if len(estimates) > 1:
            yield f"{kind}: {len(of.forces)} peaks in {hours(of.hours)}"
        own = [given for of_kind, given in answers if of_kind == kind]
        rows = [["once in", "records", "force (90 %)", "by peaks seen", "record needed"]]
        rows += [[hours(given.period_h), plain(given.records), of_answer(given), of_seen(given),
                  of_record(given, half_width)] for given in own]
        yield from (f"  {line}" for line in (*of_fits(found), *aligned(rows)))
        for why in reasons(own, found):
            yield from textwrap.wrap(why, WIDEST, initial_indent="  ", subsequent_indent="    ")
    if len(estimates) > MOST_KINDS:
        yield f"and {len(estimates) - MOST_KINDS} more kinds of runs: loads-returns.csv"


# Explanation below the table of return values on the page, with the limits that decided about them.
EXPLAINED = (
    f"Intervals hold {100 * extremes.LEVEL:g} %. A fit with p below {estimate.REFUTED:g} or a shape above "
    f"{estimate.HEAVIEST:g} is refuted and gives no return value: it is struck through. Return values beyond "
    f"{extremes.FARTHEST:g} records are withheld but with --extrapolate. “By peaks seen” needs no fit. How often the "
    "intervals hold the truth is in docs/loads.md.")
