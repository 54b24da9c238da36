"""Rings as paths that matplotlib draws."""
import functools

import numpy
from matplotlib.path import Path

NOTHING = Path(numpy.empty((0, 2)), numpy.empty(0, Path.code_type))


def path_of(rings):
    """Rings, each n × 2, as one path that closes them: a polygon with its holes, or several."""
    if not rings:
        return NOTHING
    closed = [numpy.concatenate([ring, ring[:1]]) for ring in rings]
    return Path(numpy.concatenate(closed), numpy.concatenate([codes_of(len(ring)) for ring in closed]))


@functools.lru_cache(maxsize=None)
def codes_of(count):
    """Of a closed ring of so many points, the first of them repeated."""
    codes = numpy.full(count, Path.LINETO, Path.code_type)
    codes[0], codes[-1] = Path.MOVETO, Path.CLOSEPOLY
    return codes
