"""What a map shows of the world."""
import numpy


def extent_of(pieces):
    """x0, y0, x1, y1 of points, each n × 2, with a little room around [m]."""
    points = numpy.concatenate([piece for piece in pieces if len(piece)] or [numpy.array([[0.0, 0.0], [100.0, 100.0]])])
    low, high = points.min(axis=0), points.max(axis=0)
    room = max(1.0, 0.02 * (high - low).max())
    return (*(low - room), *(high + room))
