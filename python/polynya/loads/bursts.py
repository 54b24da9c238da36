"""Peaks of a record as independent events.

Peaks of one jam follow each other. Counted as independent, they would suggest more information than the record has. So
peaks that are closer in time than a gap form one event, and its largest peak counts. The gap is the shortest one for
which the events pass two tests: their numbers in the parts of the record vary only as much as chance explains, and so
do their sizes."""
from __future__ import annotations

import dataclasses

import numpy

PARTS = 20  #: least number of parts of the record in which events are counted
HALVINGS = 6  #: the shortest gap is the length of a part, halved this number of times
SIMULATED = 499  #: number of samples of a test
COVERED = 0.25  #: largest fraction of a run's time that bursts and the gaps after them may cover [-]
UNLIKE = 0.01  #: p values below this mean that parts of the record differ


@dataclasses.dataclass(frozen=True)
class Record:
    """Peaks in the order of their cases and times. `starts` and `lengths` are those of the cases [s]."""

    cases: numpy.ndarray  #: index of the case of each peak in the lists below
    times: numpy.ndarray  #: [s]
    forces: numpy.ndarray  #: [N]
    starts: numpy.ndarray
    lengths: numpy.ndarray

    @property
    def hours(self):
        return float(self.lengths.sum()) / 3600

    @property
    def parts_of_case(self):
        return max(1, -(-PARTS // max(1, len(self.lengths))))

    def part_of(self, cases, times):
        """The part of the record in which each event is. All cases are divided into equal parts, at least PARTS in
        total."""
        parts = self.parts_of_case
        share = (times - self.starts[cases]) / self.lengths[cases]
        return cases * parts + numpy.clip((share * parts).astype(int), 0, parts - 1)

    @property
    def part_lengths(self):
        return numpy.repeat(self.lengths / self.parts_of_case, self.parts_of_case)

    def gaps(self):
        """Gaps to try [s]: none, then from 1/64 of a part of the record to a whole part."""
        part = float(self.lengths.max()) / self.parts_of_case
        return [0.0, *(part / 2**k for k in range(HALVINGS, -1, -1))]


def record_of(loads):
    """Returns the peaks of the gathered cases that have a length."""
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

    forces: numpy.ndarray  #: [N]
    gap: float  #: [s]
    counts_p: float  #: p value of their numbers in parts of the record
    sizes_p: float  #: p value of their sizes in its cases or parts
    #: Fraction of a run's time that bursts and the gaps after them cover, in the run where it is largest.
    covered: float

    @property
    def are_alike(self):
        return min(self.counts_p, self.sizes_p) >= UNLIKE


def counts_p(counts, lengths, rng):
    """Fraction of simulations in which as many events at random times are distributed over parts of these lengths at
    least as unevenly (chi-squared distance)."""
    total, share = int(counts.sum()), lengths / lengths.sum()
    if total == 0:
        return 1.0
    expected = total * share
    own = ((counts - expected) ** 2 / expected).sum()
    simulated = rng.multinomial(total, share, SIMULATED)
    far = ((simulated - expected) ** 2 / expected).sum(axis=1)
    return float((1 + numpy.count_nonzero(far >= own - 1e-9)) / (SIMULATED + 1))


def sizes_p(forces, groups, rng):
    """Fraction of random assignments of the events to the groups in which the groups differ at least as much (Kruskal
    and Wallis's distance of ranks)."""
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
    """Returns the events of the peaks above a threshold for a gap, with the results of the tests."""
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
    """Returns the events for the shortest gap with which they pass the tests. If there is none, it is the longest gap
    that leaves `least` events; if there are fewer events from the start, returns None. Bursts may cover at most COVERED
    of each run, because longer ones would join peaks that are independent, and would hide differences between runs.
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
