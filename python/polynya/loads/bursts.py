"""Peaks of a record as independent events.

Peaks of one jam follow each other. Counted as independent, they would suggest more information than the record has. So
successive peaks of a run that are at most a gap apart form one event, a burst, of which only the largest peak counts.
The gap is the shortest one for which the events pass two tests: their numbers in the parts of the record vary only as
much as chance explains, and so do their sizes. The record is that of one or several runs (cases)."""
from __future__ import annotations

import dataclasses

import numpy

#: Least number of parts into which the whole record is divided to count events. More parts show shorter clusters, but
#: have fewer events each, so that the test finds less.
PARTS = 20
#: Gaps are tried from the length of a part halved this number of times (1/64), and doubled up to the whole part.
#: Larger: shorter gaps are tried first, which keep more events, but each gap takes two tests. The gap 0 is tried
#: before.
HALVINGS = 6
#: Number of random samples of a test. The smallest p value is 1/500, which must be below UNLIKE. More samples: p is
#: more exact and takes longer.
SIMULATED = 499
#: Largest fraction of a run's time that bursts and the gaps after them may cover [-]. Larger: long gaps may join peaks
#: that are independent; smaller: gaps with which the tests would pass may not be allowed.
COVERED = 0.25
#: With a p value below this, parts of the record differ, and a fit to the events is refuted [-]. Each of the two or
#: three tests of a gap refutes independent peaks by chance this often. Larger: longer gaps, fewer events and more
#: refuted fits; smaller: peaks that depend on each other may count as independent, so that intervals are too narrow.
UNLIKE = 0.01


@dataclasses.dataclass(frozen=True)
class Record:
    """The peaks of all cases, in the order of cases and times, and the durations of the cases."""

    cases: numpy.ndarray  #: for each peak the index of its case in `starts` and `lengths`
    times: numpy.ndarray  #: for each peak its time in its case [s]
    forces: numpy.ndarray  #: for each peak its force [N]
    starts: numpy.ndarray  #: for each case the time from which peaks count [s]
    lengths: numpy.ndarray  #: for each case the duration from then on [s]

    # Length of the whole record [h].
    @property
    def hours(self):
        return float(self.lengths.sum()) / 3600

    # Number of parts of each case, so that there are at least PARTS in total: 20 for one case, 1 from 20 cases on.
    @property
    def parts_of_case(self):
        return max(1, -(-PARTS // max(1, len(self.lengths))))

    def part_of(self, cases, times):
        """Returns for each event the number of the part of the record in which it is, from 0. Each case is divided into
        `parts_of_case` parts of equal length. `cases` and `times` [s] are arrays with the case and the time of each
        event. An event outside of its case's time belongs to the nearest part."""
        parts = self.parts_of_case
        share = (times - self.starts[cases]) / self.lengths[cases]
        return cases * parts + numpy.clip((share * parts).astype(int), 0, parts - 1)

    # Length of each part [s], by its number.
    @property
    def part_lengths(self):
        return numpy.repeat(self.lengths / self.parts_of_case, self.parts_of_case)

    def gaps(self):
        """Returns the gaps to try [s], shortest first: 0, then from 1/64 of a part of the longest case to the whole
        part, each twice as long as the one before."""
        part = float(self.lengths.max()) / self.parts_of_case
        return [0.0, *(part / 2**k for k in range(HALVINGS, -1, -1))]


def record_of(loads):
    """Returns the Record of a gather.Loads. Cases that end before the first time that counts are left out, with their
    peaks. The record of no case has empty arrays."""
    cases = [case for case in loads.cases if case.hours > 0]
    numbers = numpy.array([case.number for case in cases], dtype=int)
    place = {number: at for at, number in enumerate(numbers.tolist())}
    at = numpy.array([place.get(number, -1) for number in numpy.asarray(loads.peaks["case"]).tolist()], dtype=int)
    order = numpy.lexsort((loads.peaks["t_s"], at))
    order = order[at[order] >= 0]
    return Record(at[order], numpy.asarray(loads.peaks["t_s"])[order], loads.forces[order],
                  numpy.array([case.start_s for case in cases]), numpy.array([3600 * case.hours for case in cases]))


@dataclasses.dataclass(frozen=True)
class Events:
    """The largest peaks of bursts above a threshold, and the results of the tests."""

    forces: numpy.ndarray  #: largest peak of each burst, in the order of cases and times [N]
    gap: float  #: successive peaks at most this long apart are one burst [s]
    #: p value of their numbers in the parts of the record. If cases are divided into parts, the numbers in whole cases
    #: are tested too, and the smaller p value counts.
    counts_p: float
    sizes_p: float  #: p value of their sizes: in the cases if there are several, otherwise in the parts
    #: Fraction of a run's time that bursts and the gaps after them cover, in the run where it is largest; 0 without
    #: events. It may exceed 1, because the gap after the last burst may go beyond the end.
    covered: float

    # True if neither test finds that parts of the record differ.
    @property
    def are_alike(self):
        return min(self.counts_p, self.sizes_p) >= UNLIKE


def counts_p(counts, lengths, rng):
    """Returns the p value of the numbers of events in parts of these lengths [s]: the fraction of SIMULATED samples,
    with the same number of events at random times, that are at least as uneven (chi-squared distance), where the data
    count as one more sample. `rng` is numpy's generator, which advances. The result is 1 without events."""
    total, share = int(counts.sum()), lengths / lengths.sum()
    if total == 0:
        return 1.0
    expected = total * share
    own = ((counts - expected) ** 2 / expected).sum()
    simulated = rng.multinomial(total, share, SIMULATED)
    far = ((simulated - expected) ** 2 / expected).sum(axis=1)
    return float((1 + numpy.count_nonzero(far >= own - 1e-9)) / (SIMULATED + 1))


def sizes_p(forces, groups, rng):
    """Returns the p value of the sizes of events in groups: the fraction of random assignments of the events to the
    groups in which the groups differ at least as much (Kruskal and Wallis's distance of ranks). `groups` has the number
    of the group of each event. The result is 1 if there is only one group, if each group has one event, or without
    events."""
    _, groups = numpy.unique(groups, return_inverse=True)
    number = numpy.bincount(groups)
    if len(number) < 2 or number.max() < 2:
        return 1.0
    ranks = numpy.argsort(numpy.argsort(forces)).astype(float)

    def distance(of):
        return (numpy.bincount(groups, of) ** 2 / number).sum()

    own = distance(ranks)
    far = sum(distance(rng.permutation(ranks)) >= own - 1e-9 for _ in range(SIMULATED))
    return float((1 + far) / (SIMULATED + 1))


def events_above(record, threshold, gap, seed=0):
    """Returns the Events of the peaks above a threshold [N] for a gap [s], with the results of the tests, which depend
    on `seed` through their random samples. Peaks of different cases never form one burst. Without a peak above the
    threshold the Events are empty and pass."""
    above = record.forces > threshold
    cases, times, forces = record.cases[above], record.times[above], record.forces[above]
    is_first = numpy.ones(len(times), dtype=bool)
    is_first[1:] = (cases[1:] != cases[:-1]) | (numpy.diff(times) > gap)
    burst = numpy.cumsum(is_first) - 1
    ends = numpy.flatnonzero(numpy.append(is_first[1:], True)) if len(times) else numpy.array([], dtype=int)
    covered = numpy.bincount(cases[is_first], times[ends] - times[is_first] + gap, len(record.lengths)) / record.lengths
    order = numpy.lexsort((-forces, burst))  # the largest peak of each burst first
    largest = order[numpy.flatnonzero(numpy.diff(burst[order], prepend=-1))]
    cases, times, forces = cases[largest], times[largest], forces[largest]
    rng = numpy.random.default_rng(seed)
    parts = record.part_of(cases, times)
    found = [counts_p(numpy.bincount(parts, minlength=len(record.part_lengths)), record.part_lengths, rng)]
    several = len(record.lengths) > 1
    if several and record.parts_of_case > 1:
        found.append(counts_p(numpy.bincount(cases, minlength=len(record.lengths)), record.lengths, rng))
    return Events(forces, gap, min(found), sizes_p(forces, cases if several else parts, rng),
                  float(covered.max(initial=0)))


def independent(record, threshold, least, seed=0):
    """Returns the Events above a threshold [N] for the shortest gap with which they pass the tests. If there is no such
    gap, the longest allowed one is used, and the p values of the result tell that it fails. A gap is allowed if it
    leaves `least` events, and if bursts cover at most COVERED of each run, because longer bursts would join peaks that
    are independent, and would hide differences between runs. Returns None if even the gap 0 leaves fewer
    than `least` events.

    With at least PARTS runs, a burst may be a whole run. The largest peak of each run is then the event; such events
    are independent if the runs differ only in their seeds."""
    best = None
    for gap in record.gaps():
        events = events_above(record, threshold, gap, seed)
        is_whole = events.covered > COVERED and gap > 0
        if len(events.forces) < least or (is_whole and record.parts_of_case > 1):
            return best
        best = events
        if events.are_alike:
            return best
    return best
