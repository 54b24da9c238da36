"""The cover of ice at gates across the drift: the fraction of a gate's length that lies under ice. It shows how much
ice arrives, independently of the sizes of its floes."""
from __future__ import annotations

import numpy

from ..results.motions import placed
from .gates import axes_over_time


class Outlines:
    """Rings of a run's floes in their body frames [m], the outer one first and then the holes, and the reach of each
    floe: the largest distance of a vertex from the origin of its frame [m]. A floe farther from a line than its reach
    cannot cross the line, so that its rings need not be computed."""

    def __init__(self, run):
        self._run = run
        self._reach = numpy.full(len(run.births["floe_id"]), numpy.nan)

    def reach_of(self, ids):
        """Reaches of floes [m], as an array in the order of the ids. Each is computed once."""
        unknown = ids[numpy.isnan(self._reach[ids])]
        for floe, rings in self._run.shapes.of(unknown).items():
            self._reach[floe] = numpy.hypot(*rings[0].T).max()
        return self._reach[ids]

    def of(self, ids):
        """{id: rings} of the floes with these ids, in their body frames [m]."""
        return self._run.shapes.of(ids)


def crossings(rings, line):
    """Sorted positions y [m] at which the rings of one floe, given in the coordinates of the gates (x upstream, y
    across), cross the line x = `line` [m]. Their number is even, and 0 if no ring crosses it. The ice lies between the
    first and the second one, between the third and the fourth one, and so on; holes are left out by this."""
    found = []
    for ring in rings:
        (x, y), following = ring.T, numpy.roll(ring, -1, axis=0)
        crosses = (x > line) != (following[:, 0] > line)
        share = (line - x[crosses]) / (following[crosses, 0] - x[crosses])
        found.append(y[crosses] + share * (following[crosses, 1] - y[crosses]))
    return numpy.sort(numpy.concatenate(found))


def covered(stretches, half):
    """Length of the union of stretches (low, high), in any order, within −half to half [m]. Ice counts once where
    stretches overlap."""
    total, reached = 0.0, -half
    for low, high in sorted(stretches):
        low, high = max(low, reached), min(high, half)
        if high > low:
            total += high - low
            reached = high
    return total


def covers_at(frame, outlines, axis, origin, gates):
    """Fractions of the length of the upstream gate and of the gate at the body that lie under floating ice in a frame
    of the run, as a list of two, from 0 to 1. `axis` is the unit vector upstream and `origin` the position of the body
    in the world [m]. Ice under a hull does not count."""
    ids, poses = frame.ids[~frame.is_under], frame.poses[~frame.is_under]
    along, reach = (poses[:, :2] - origin) @ axis, outlines.reach_of(ids)
    across = numpy.array([-axis[1], axis[0]])
    found = []
    for line in (gates.upstream, gates.near):
        near = numpy.flatnonzero(numpy.abs(along - line) <= reach)
        shapes, stretches = outlines.of(ids[near]), []
        for k in near.tolist():
            rings = [placed(ring, *poses[k]) - origin for ring in shapes[int(ids[k])]]
            ends = crossings([numpy.column_stack((ring @ axis, ring @ across)) for ring in rings], line)
            stretches += zip(ends[::2].tolist(), ends[1::2].tolist())
        found.append(covered(stretches, 0.5 * gates.width) / gates.width)
    return found


def covers(run, gates):
    """Returns a list of the cover at the upstream gate and at the gate at the body [-]: the mean fraction of the gate's
    length that lies under ice, from the first frame with ice on the gate to the last one, with each frame weighted by
    the distance that the ice drifts until the next. It lies between 0 and 1, because ice is counted once where floes
    overlap. Frames up to gates.start do not count. None for a gate if no ice lay on it, or if the water rests."""
    upstream, ways = axes_over_time(run)
    number, outlines = run.ship_names.index(gates.body), Outlines(run)
    rows = numpy.zeros((len(run.times), 2))
    for k, (time, axis) in enumerate(zip(run.times, upstream)):
        if time > gates.start:
            frame = run.frame(time)
            rows[k] = covers_at(frame, outlines, axis, frame.ship_motions[number, :2], gates)
    found = []
    for shares in rows.T:
        with_ice = numpy.flatnonzero(shares > 0)
        stretch = slice(with_ice[0], with_ice[-1] + 1) if len(with_ice) else slice(0)
        weights = ways[stretch]
        found.append(float((shares[stretch] * weights).sum() / weights.sum()) if weights.sum() > 0 else None)
    return found
