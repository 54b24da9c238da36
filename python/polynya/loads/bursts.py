"""Peaks of a record as independent events: peaks of one burst count once, and runs that are not alike are found.

Peaks of one jam follow each other. As independent ones they would promise more than the record knows. Peaks nearer to
each other than a gap are therefore one event, of which the largest counts. The gap is the shortest by which the events
pass two tests: they are as many in each part of the record as chance has it, and as large."""
from __future__ import annotations

import dataclasses

import numpy

PARTS = 20  #: of the record, at least, in which events are counted
HALVINGS = 6  #: the shortest gap is a part's length halved as often
SIMULATED = 499  #: samples of a test
COVERED = 0.25  #: of the time of a run that bursts with the gaps behind them may cover
UNLIKE = 0.01  #: p values below say that parts of the record differ


@dataclasses.dataclass(frozen=True)
class Record:
    """Peaks in the order of their cases and times. `starts` and `lengths` are those of the cases [s]."""

    cases: numpy.ndarray  #: of each peak, the place of its case in the lists below
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
        """The part of the record in which each event is: equal parts of every case, at least PARTS in all."""
        parts = self.parts_of_case
        share = (times - self.starts[cases]) / self.lengths[cases]
        return cases * parts + numpy.clip((share * parts).astype(int), 0, parts - 1)

    @property
    def part_lengths(self):
        return numpy.repeat(self.lengths / self.parts_of_case, self.parts_of_case)

    def gaps(self):
        """The gaps that are tried [s]: none, then from a 64th of a part of the record to a whole one."""
        part = float(self.lengths.max()) / self.parts_of_case
        return [0.0, *(part / 2**k for k in range(HALVINGS, -1, -1))]


def record_of(loads):
    """The peaks of gathered cases that have a length."""
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
    """The largest peaks of bursts above a threshold, and the tests of whether they are independent and alike."""

    forces: numpy.ndarray  #: [N]
    gap: float  #: [s]
    counts_p: float  #: of their numbers in parts of the record
    sizes_p: float  #: of their sizes in its cases or parts
    covered: float  #: share of a run's time that bursts and the gaps behind them cover, in the run where it is largest

    @property
    def are_alike(self):
        return min(self.counts_p, self.sizes_p) >= UNLIKE


def counts_p(counts, lengths, rng):
    """How often as many events that come by chance are spread as unevenly over parts of these lengths (chi-squared
    distance)."""
    total, share = int(counts.sum()), lengths / lengths.sum()
    if total == 0:
        return 1.0
    expected = total * share
    own = ((counts - expected) ** 2 / expected).sum()
    simulated = rng.multinomial(total, share, SIMULATED)
    far = ((simulated - expected) ** 2 / expected).sum(axis=1)
    return float((1 + numpy.count_nonzero(far >= own - 1e-9)) / (SIMULATED + 1))


def sizes_p(forces, groups, rng):
    """How often the same events, dealt to the groups by chance, differ as much between groups: Kruskal and Wallis's
    distance of their ranks."""
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
    """The events of peaks above a threshold by that gap, tested."""
    above = record.forces > threshold
    cases, times, forces = record.cases[above], record.times[above], record.forces[above]
    is_first = numpy.ones(len(times), dtype=bool)
    is_first[1:] = (cases[1:] != cases[:-1]) | (numpy.diff(times) > gap)
    burst = numpy.cumsum(is_first) - 1
    ends = numpy.flatnonzero(numpy.append(is_first[1:], True)) if len(times) else numpy.array([], dtype=int)
    covered = numpy.bincount(cases[is_first], times[ends] - times[is_first] + gap, len(record.lengths)) / record.lengths
    order = numpy.lexsort((-forces, burst))  # of each burst the largest first
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
    """The events by the shortest gap by which they pass; by the longest that leaves `least` of them where none does;
    None where there are fewer to begin with. Bursts may cover at most COVERED of each run: longer ones join what comes
    by chance, and hide that runs differ. Only where there are PARTS runs may a burst be a whole run: the largest peak
    of each run is then the event, and runs that differ in their seeds alone have independent ones."""
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
