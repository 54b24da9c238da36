"""Ranks patterns of ice management by the mean of a measure over fields of ice, with Student's intervals and tests of
the differences. All measures that are ranked are the better the smaller they are: loads and sizes of floes.

Patterns are compared field by field. A field is named by its seeds, and the same seeds give the same ice, so effects of
a field that are the same for all patterns cancel in the differences. The values of a pattern are {field: value}, finite
numbers; a field without a value is left out. The mean of a pattern is over all its fields, but differences, ratios and
tests are over the fields that both patterns have."""
from __future__ import annotations

import dataclasses
import itertools
import math
from typing import Optional

#: Probability with which an interval contains the true mean, and with which no test of a ranking finds a difference
#: that does not exist [-]. Larger: wider intervals, and fewer significant differences. The columns of words.py with
#: "95_percent" in their names state it too.
LEVEL = 0.95


@dataclasses.dataclass(frozen=True)
class Mean:
    """A mean over fields, in the unit of the measure."""

    value: float
    half: Optional[float]  #: half of its Student interval: value ± half; None if there is only one field
    count: int  #: number of fields


def student(count):
    """Returns half of the interval of the mean of `count` values (at least 2), divided by their standard deviation."""
    from scipy import stats

    return float(stats.t.ppf((1 + LEVEL) / 2, count - 1)) / math.sqrt(count)


# Standard deviation of a sample of at least two values.
def deviation(values):
    middle = math.fsum(values) / len(values)
    return math.sqrt(math.fsum((value - middle) ** 2 for value in values) / (len(values) - 1))


def mean_of(values):
    """Returns the Mean of values; None if there are none."""
    values = list(values)
    if not values:
        return None
    middle = math.fsum(values) / len(values)
    half = student(len(values)) * deviation(values) if len(values) > 1 else None
    return Mean(middle, half, len(values))


def common(one, other):
    """Returns the values of two patterns, as two lists, in the fields that both have."""
    fields = [field for field in one if field in other]
    return [one[field] for field in fields], [other[field] for field in fields]


def difference(one, other):
    """Returns the Mean of `one` minus `other` over the fields that both have; None if there are none."""
    first, second = common(one, other)
    return mean_of(a - b for a, b in zip(first, second))


def share_left(managed, unmanaged):
    """Returns the measure with management divided by that without, as (ratio, low, high): the ratio of the means over
    common fields, with its interval by Fieller's theorem [Fieller1954]. Returns None if there is no common field or the
    mean without management is 0. The limits are None for fewer than two fields, or if the interval of the mean without
    management contains 0, because the ratio may then be arbitrarily large."""
    top, low = common(managed, unmanaged)
    if not top or math.fsum(low) == 0:
        return None
    ratio = math.fsum(top) / math.fsum(low)
    if len(top) < 2:
        return ratio, None, None
    t = student(len(top)) ** 2 * len(top)  # t² of Student's distribution
    count, a, b = len(top), math.fsum(top) / len(top), math.fsum(low) / len(low)
    of_a, of_b = deviation(top) ** 2 / count, deviation(low) ** 2 / count
    both = math.fsum((x - a) * (y - b) for x, y in zip(top, low)) / (count - 1) / count
    # (a − ρ b)² = t² (s_aa − 2 ρ s_ab + ρ² s_bb) at both ends ρ of the interval
    square, middle, rest = b * b - t * of_b, a * b - t * both, a * a - t * of_a
    root = middle * middle - square * rest  # below 0 for square > 0 by rounding only
    if square <= 0 or root < 0:
        return ratio, None, None
    return ratio, (middle - math.sqrt(root)) / square, (middle + math.sqrt(root)) / square


def p_value(one, other):
    """Returns the p value of the paired t test of two patterns over their common fields. It is 1 if there are fewer
    than two fields or all differences are 0, and 0 if all differences are equal and not 0."""
    from scipy import stats

    first, second = common(one, other)
    differences = {a - b for a, b in zip(first, second)}
    if len(first) < 2 or differences == {0}:
        return 1.0
    return 0.0 if len(differences) == 1 else float(stats.ttest_rel(first, second).pvalue)


def told_apart(patterns):
    """Returns the pairs of patterns, as a set of frozensets of two names, whose means differ significantly by Holm's
    rule over all pairs [Holm1979]. The probability that at least one pair is returned wrongly is at most 1 − LEVEL.
    `patterns` is {name: {field: value}}."""
    pairs = sorted((p_value(patterns[a], patterns[b]), a, b) for a, b in itertools.combinations(patterns, 2))
    found = set()
    for rank, (p, a, b) in enumerate(pairs):
        if p * (len(pairs) - rank) > 1 - LEVEL:
            break
        found.add(frozenset((a, b)))
    return found


@dataclasses.dataclass(frozen=True)
class Place:
    """A pattern in a ranking, in which the pattern with the smallest mean is the first."""

    name: str
    mean: Mean
    left: Optional[tuple]  #: result of share_left(): its mean divided by the unmanaged one; None for that one itself
    benefit: Optional[Mean]  #: mean of the unmanaged value minus its value, over common fields; None as for `left`
    like: list  #: names of the patterns from which it does not differ significantly


def ranking(patterns, unmanaged=None):
    """Returns the patterns {name: {field: value}} as a list of Place, the smallest mean first. Patterns without values
    are left out. `unmanaged` is the name of the pattern without management; if there is none, no pattern has `left` and
    `benefit`."""
    patterns = {name: of for name, of in patterns.items() if of}
    apart = told_apart(patterns)
    base = patterns.get(unmanaged)
    places = []
    for name, of in sorted(patterns.items(), key=lambda item: mean_of(item[1].values()).value):
        is_base = base is None or name == unmanaged
        like = [other for other in patterns if other != name and frozenset((name, other)) not in apart]
        places.append(Place(name, mean_of(of.values()), None if is_base else share_left(of, base),
                            None if is_base else difference(base, of), like))
    return places


def alike(places):
    """Returns groups of neighbouring patterns in a ranking, as lists of names, in which no pattern differs
    significantly from another one. Each group has at least two patterns and is as large as possible; groups may
    overlap."""
    names = [place.name for place in places]
    likes = {place.name: set(place.like) for place in places}
    found = []
    for begin in range(len(names)):
        end = begin + 1
        while end < len(names) and all(names[end] in likes[name] for name in names[begin:end]):
            end += 1
        if end - begin > 1 and not any(set(names[begin:end]) <= set(group) for group in found):
            found.append(names[begin:end])
    return found
