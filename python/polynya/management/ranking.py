"""Ranks patterns by means over the same ice fields, with Student's intervals and tests of the differences.

Patterns are compared field by field. The same seed gives the same ice, so effects of a field that are the same for all
patterns cancel in the differences."""
from __future__ import annotations

import dataclasses
import itertools
import math
from typing import Optional

LEVEL = 0.95  #: probability of intervals and of the tests [-]


@dataclasses.dataclass(frozen=True)
class Mean:
    """A mean over fields, and half of its Student interval; None if there is only one field."""

    value: float
    half: Optional[float]
    count: int


def student(count):
    """Half of an interval divided by the standard deviation, for the mean of `count` values."""
    from scipy import stats

    return float(stats.t.ppf((1 + LEVEL) / 2, count - 1)) / math.sqrt(count)


def deviation(values):
    middle = math.fsum(values) / len(values)
    return math.sqrt(math.fsum((value - middle) ** 2 for value in values) / (len(values) - 1))


def mean_of(values):
    """Mean of values; None if there are none."""
    values = list(values)
    if not values:
        return None
    middle = math.fsum(values) / len(values)
    half = student(len(values)) * deviation(values) if len(values) > 1 else None
    return Mean(middle, half, len(values))


def common(one, other):
    """The values of two {field: value} in the fields that both have."""
    fields = [field for field in one if field in other]
    return [one[field] for field in fields], [other[field] for field in fields]


def difference(one, other):
    """Mean difference of two patterns over their common fields; None if there are none."""
    first, second = common(one, other)
    return mean_of(a - b for a, b in zip(first, second))


def share_left(managed, unmanaged):
    """The load with management divided by that without: the ratio of the means over common fields, with its interval by
    Fieller's theorem [Fieller1954]. Returns (ratio, low, high). Returns None if there is no common field, and no limits
    for fewer than two fields or if the mean without management may be 0."""
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
    root = middle * middle - square * rest
    if square <= 0 or root < 0:
        return ratio, None, None
    return ratio, (middle - math.sqrt(root)) / square, (middle + math.sqrt(root)) / square


def p_value(one, other):
    """p value of the paired t test over the common fields; 1 if there are fewer than two, or if all differences are
    0."""
    from scipy import stats

    first, second = common(one, other)
    differences = {a - b for a, b in zip(first, second)}
    if len(first) < 2 or differences == {0}:
        return 1.0
    return 0.0 if len(differences) == 1 else float(stats.ttest_rel(first, second).pvalue)


def told_apart(patterns):
    """Pairs of {name: {field: value}} that differ, by Holm's rule over all pairs [Holm1979]. The probability that any
    of these pairs is wrong is at most 1 − LEVEL."""
    pairs = sorted((p_value(patterns[a], patterns[b]), a, b) for a, b in itertools.combinations(patterns, 2))
    found = set()
    for rank, (p, a, b) in enumerate(pairs):
        if p * (len(pairs) - rank) > 1 - LEVEL:
            break
        found.add(frozenset((a, b)))
    return found


@dataclasses.dataclass(frozen=True)
class Place:
    """A pattern in a ranking. The first one has the smallest mean."""

    name: str
    mean: Mean
    left: Optional[tuple]  #: its mean relative to the unmanaged one: (ratio, low, high)
    benefit: Optional[Mean]  #: unmanaged mean minus this one
    like: list  #: patterns from which it does not differ significantly


def ranking(patterns, unmanaged=None):
    """Ranks {name: {field: value}} by ascending mean. `unmanaged` names the pattern without management."""
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
    """Groups of neighbouring patterns in a ranking that do not differ significantly from each other. Each group is as
    large as possible."""
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
