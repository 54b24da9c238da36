"""What `polynya loads` found, in sentences: on the terminal, and for its page."""
import math

from polynya import extremes

from . import estimate


def plain(value):
    """Three digits, without an exponent: 0.0123, 1250, 40000."""
    rounded = float(f"{value:.3g}")
    return f"{rounded:.0f}" if abs(rounded) >= 100 else f"{rounded:.6g}"


def hours(value):
    """A time as people say it: 90 s, 12 min, 3.5 h."""
    for most, unit, name in ((1 / 30, 3600, "s"), (2, 60, "min")):
        if value < most:
            return f"{plain(value * unit)} {name}"
    return f"{plain(value)} h"


def force(value):
    for factor, name in ((1e6, "MN"), (1e3, "kN")):
        if abs(value) >= factor:
            return f"{value / factor:.3g} {name}"
    return f"{value:.3g} N"


def span(low, high):
    """An interval of forces; an end without a limit is open."""
    return f"{force(low)} to {force(high) if math.isfinite(high) else 'no limit'}"


def of_fit(fit):
    tail, gap = fit.tail, fit.events.gap
    bursts = f", peaks within {gap:.3g} s of each other as one" if gap else ""
    return (f"{tail.count} peaks above {force(tail.threshold)}{bursts}: shape {tail.shape.value:.2f} "
            f"({tail.shape.low:.2f} to {tail.shape.high:.2f}), scale {force(tail.scale.value)}, p {fit.goodness_p:.2g}")


def of_answer(given):
    """What is exceeded once in a period, or why that is not said."""
    if given.value_N is None:
        return f"withheld: {given.why}"
    mark = " EXTRAPOLATED: no interval was tested so far beyond a record" if given.is_extrapolated else ""
    return f"{force(given.value_N)} ({span(given.low_N, given.high_N)}){mark}"


def of_seen(given):
    return span(given.seen_low_N, given.seen_high_N)


def of_record(given, half_width):
    """How long a record has to be."""
    if given.record_needed_h:
        return f"{hours(given.record_needed_h)} for ±{100 * half_width:g} %"
    return f"at least {hours(given.period_h / extremes.FARTHEST)}"


def of_loads(loads):
    """How much was recorded."""
    runs = len(loads.cases)
    kinds = f" of {len(loads.kinds())} kinds" if len(loads.kinds()) > 1 else ""
    reach = f", {loads.kilometres:.3g} km" if loads.kilometres > 1e-6 else ""
    gauge = f"; through a gauge of {loads.gauge_s:g} s" if loads.gauge_s else ""
    return (f"{len(loads.forces)} peaks on {loads.ship} in {runs} run{'s' if runs > 1 else ''}{kinds}, "
            f"{hours(loads.hours)}{reach}{gauge}")


def lines_of(loads, estimates, answers, half_width):
    """The lines that the command prints, at most some for each kind of runs."""
    yield of_loads(loads)
    for kind, (of, found) in estimates.items():
        if len(estimates) > 1:
            yield f"{kind}: {len(of.forces)} peaks in {hours(of.hours)}"
        for fit in found.fits:
            yield f"  {'fit     ' if fit is found.fits[-1] and not found.why else 'refuted '} {of_fit(fit)}"
        if found.why:
            yield f"  no fit    {found.why}"
        for _, given in [pair for pair in answers if pair[0] == kind]:
            yield (f"  once in {hours(given.period_h)}, {plain(given.records)} records: {of_answer(given)}; "
                   f"by peaks seen {of_seen(given)}; record needed {of_record(given, half_width)}")


EXPLAINED = (
    f"Intervals hold {100 * extremes.LEVEL:g} %. A fit with p below {estimate.REFUTED:g} is refuted and gives no return "
    f"value: it is struck through. Return values beyond {extremes.FARTHEST:g} records are withheld but with "
    "--extrapolate. “By peaks seen” needs no fit. How often the intervals hold the truth is in docs/loads.md.")
