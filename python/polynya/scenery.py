"""Objects on a map of a run at a time, as few paths in the world [m]. Maps of figures and of films use it.

Floes outside of the picture are left out, and films, and figures with very many vertices, draw floes of a few pixels as
squares of their area. So the time to draw a field of 100 000 floes depends on the visible part."""
from __future__ import annotations

import functools

import numpy
from matplotlib.path import Path

# Light ice on medium water, which differ in greyscale; marks use the Okabe–Ito palette [Okabe2008], which people with
# impaired colour vision can distinguish. The colours must be those of views/map/final_map.cpp, which draws no channel,
# so that final.svg and figures of a run can be compared.
WATER = "#8fb8d0"
AT_START = "#a9cadd"  # where ice was at the start; visible where it is open now
CHANNEL = "#5e93b5"
ICE = "#ffffff"
BROKEN_ICE = "#fbeec2"
RESURFACED_ICE = "#f0c987"
ICE_UNDER = "#56b4e9"
EDGE = "#3d5261"
SHIP = "#2b2b2b"
WALL = "#8a8a8a"
TRACK = "#d55e00"
MARKS = {"bend": "#0072b2", "split": "#d55e00", "grind": "#7a5c2e"}

WHOLE, BROKEN, CAME_UP, UNDER = range(4)  # kinds of floes, as Scenery.kinds() explains them
COLOURS = (ICE, BROKEN_ICE, RESURFACED_ICE, ICE_UNDER)  # by kind
# Kinds of events that are marked as fractures: a bend breaks off a cusp, a split divides a floe, grinding removes ice.
FRACTURES = ("bend", "split", "grind")
# √area of the smallest floe that is drawn in its shape instead of as a square [px]. Larger values draw faster, and
# squares become visible as such; smaller values are slower.
LEAST_PIXELS = 3.0

NOTHING = Path(numpy.empty((0, 2)), numpy.empty(0, Path.code_type))  # a path without points
# Closed ring of a square with sides of 1 and its middle at the origin, which is scaled to the √area of a floe.
SQUARE = numpy.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]])


@functools.lru_cache(maxsize=None)
def codes_of(count):
    """Path codes of a closed ring with this number of points, the last of which repeats the first. The array is kept
    and shared by all rings of that length, so it must not be changed."""
    codes = numpy.full(count, Path.LINETO, Path.code_type)
    codes[0], codes[-1] = Path.MOVETO, Path.CLOSEPOLY
    return codes


def path_of(rings):
    """One path of several rings, each n × 2, open, which it closes: a polygon with its holes, or several polygons.
    NOTHING without rings."""
    if not rings:
        return NOTHING
    closed = [numpy.concatenate([ring, ring[:1]]) for ring in rings]
    return Path(numpy.concatenate(closed), numpy.concatenate([codes_of(len(ring)) for ring in closed]))


def extent_of(pieces):
    """Box x0, y0, x1, y1 around points [m], each piece n × 2, with a margin of 2 % of its longer side, but at least 1
    m. Without points it is that around a square of 100 m, so that an empty map has a scale."""
    points = numpy.concatenate([piece for piece in pieces if len(piece)] or [numpy.array([[0.0, 0.0], [100.0, 100.0]])])
    low, high = points.min(axis=0), points.max(axis=0)
    room = max(1.0, 0.02 * (high - low).max())
    return (*(low - room), *(high + room))


def counted(count, noun):
    """A count with its noun: 1 split, 2 splits."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def turned(points, poses):
    """Transforms points, n × 2 [m], from the body frames with these poses (x, y [m], angle [rad]), n × 3, one per
    point, to the world."""
    x, y, angle = poses.T
    c, s = numpy.cos(angle), numpy.sin(angle)
    return numpy.column_stack((x + c * points[:, 0] - s * points[:, 1], y + s * points[:, 0] + c * points[:, 1]))


class Outlines:
    """Outlines of a run's floes in their body frames [m], stored as closed rings one after the other, with the index of
    the first point of each floe (−1: not loaded). `ids` are arrays of floe ids, `poses` their poses x, y [m], angle
    [rad], one row each. Methods load outlines that they need and raise FolderError if a shape is damaged."""

    def __init__(self, run):
        self._run = run
        self._first = numpy.full(len(run.births["floe_id"]), -1)
        self._count = numpy.zeros(len(self._first), dtype=int)
        self._reach = numpy.zeros(len(self._first))  # distance of the farthest vertex from the centroid [m]
        self._points, self._codes = numpy.empty((0, 2)), numpy.empty(0, Path.code_type)

    def load(self, ids):
        """Reads outlines that are not loaded yet."""
        missing = ids[self._first[ids] < 0]
        if len(missing) == 0:
            return
        points, codes, at = [self._points], [self._codes], len(self._points)
        for floe, rings in self._run.shapes.of(missing).items():
            self._first[floe] = at
            for ring in rings:
                points += (ring, ring[:1])
                codes.append(codes_of(len(ring) + 1))
                at += len(ring) + 1
            self._count[floe] = at - self._first[floe]
            self._reach[floe] = numpy.sqrt(numpy.square(rings[0] - self._run.centroids[floe]).sum(axis=1).max())
        self._points, self._codes = numpy.concatenate(points), numpy.concatenate(codes)

    def forget(self, floes):
        """Drops the outlines of floes to free memory; `floes` is a mask of all floes. They are read again if needed."""
        kept = numpy.flatnonzero((self._first >= 0) & ~floes)
        rows = self._rows(kept)
        self._points, self._codes = self._points[rows], self._codes[rows]
        self._first[:] = -1
        self._first[kept] = numpy.cumsum(self._count[kept]) - self._count[kept]

    def reach(self, ids):
        """Distances from the centroids to the farthest vertices [m]."""
        self.load(ids)
        return self._reach[ids]

    def count(self, ids):
        """Number of points in the floes' paths together, with one more per ring that closes it."""
        self.load(ids)
        return int(self._count[ids].sum())

    def _rows(self, ids):
        """Indices in the stored points of all points of floes that are loaded, one floe after the other."""
        counts = self._count[ids]
        return numpy.arange(counts.sum()) + numpy.repeat(self._first[ids] - (numpy.cumsum(counts) - counts), counts)

    def boxes(self, ids, poses):
        """Lower left and upper right corners of the boxes around the floes in the world, each n × 2 [m]. There must be
        at least one floe."""
        points = self.path(ids, poses).vertices
        first = numpy.cumsum(self._count[ids]) - self._count[ids]
        return numpy.minimum.reduceat(points, first), numpy.maximum.reduceat(points, first)

    def path(self, ids, poses):
        """The floes in the world as one path [m], in the order of the ids; NOTHING without floes."""
        if len(ids) == 0:
            return NOTHING
        self.load(ids)
        rows = self._rows(ids)
        return Path(turned(self._points[rows], numpy.repeat(poses, self._count[ids], axis=0)), self._codes[rows])


def joined(one, other):
    """One path with the points of two; if one of them is empty, the other one itself."""
    if len(one.vertices) == 0 or len(other.vertices) == 0:
        return one if len(other.vertices) == 0 else other
    return Path(numpy.concatenate((one.vertices, other.vertices)), numpy.concatenate((one.codes, other.codes)))


class Scenery:
    """Floes, hulls, tracks and fractures of a run (results.run.Run), prepared for drawing at any of its times. `frame`
    is one of Run.frame(), `window` a box x0, y0, x1, y1 in the world [m]. All paths and points are in the world [m]."""

    def __init__(self, run):
        self.run = run
        self.outlines = Outlines(run)
        events = run.event_columns
        order = numpy.flatnonzero(numpy.isin(events["kind"], FRACTURES))
        self._fracture_times = events["t_s"][order]
        self._fracture_kinds = events["kind"][order]
        self._fracture_points = numpy.column_stack((events["x_m"][order], events["y_m"][order])).astype(float)

    def kinds(self, frame):
        """For each floe of a frame: WHOLE (not broken since the start), BROKEN, CAME_UP (broken, and it or a floe from
        which it broke came up from under a hull) or UNDER (under a hull now, which counts before all others)."""
        births, ids = self.run.births, frame.ids
        kinds = numpy.where(births["generation"][ids] == 0, WHOLE, numpy.where(births["came_up"][ids], CAME_UP, BROKEN))
        kinds[frame.is_under] = UNDER
        return kinds

    def seen(self, frame, window):
        """Mask of the floes of a frame whose boxes extend into the window; all floes without a window (None)."""
        if window is None:
            return numpy.ones(len(frame.ids), dtype=bool)
        corners, ids, poses = numpy.reshape(window, (2, 2)), frame.ids, frame.poses
        centres, reach = turned(self.run.centroids[ids], poses), self.outlines.reach(ids)[:, None]
        shown = ((centres + reach > corners[0]) & (centres - reach < corners[1])).all(axis=1)
        is_inside = ((centres - reach > corners[0]) & (centres + reach < corners[1])).all(axis=1)
        at_edge = numpy.flatnonzero(shown & ~is_inside)
        if len(at_edge):
            low, high = self.outlines.boxes(ids[at_edge], poses[at_edge])
            shown[at_edge] = ((high > corners[0]) & (low < corners[1])).all(axis=1)
        return shown

    def floes(self, frame, window=None, least=0.0, among=None):
        """Floes as a list of one path for each kind, NOTHING for a kind without floes. `among` is a mask of the frame's
        floes to draw, None means all; only those that extend into the window are drawn. Floes with √area below `least`
        [m] are squares of their area."""
        kinds = self.kinds(frame)
        shown = self.seen(frame, window) if among is None else self.seen(frame, window) & among
        return [self._path(frame.ids[shown & (kinds == kind)], frame.poses[shown & (kinds == kind)], least)
                for kind in range(4)]

    def _path(self, ids, poses, least):
        """One path of floes in the world [m]: shapes, then squares for those with √area below `least` [m]."""
        side = numpy.sqrt(self.run.births["area_m2"][ids])
        is_small = side < least
        return joined(self.outlines.path(ids[~is_small], poses[~is_small]),
                      self._squares(ids[is_small], poses[is_small], side[is_small]))

    def _squares(self, ids, poses, sides):
        """One path of squares with these sides [m], in place of the floes: at their centroids and turned with them."""
        if len(ids) == 0:
            return NOTHING
        in_body = self.run.centroids[ids][:, None] + sides[:, None, None] * SQUARE
        return Path(turned(in_body.reshape(-1, 2), numpy.repeat(poses, len(SQUARE), axis=0)),
                    numpy.tile(codes_of(len(SQUARE)), len(ids)))

    def forget(self, time):
        """Drops the outlines of floes that ended before a time [s] or at it, for pictures of later times."""
        self.outlines.forget(self.run.births["died_s"] <= time)

    def ice_at_start(self, window=None, least=0.0):
        """The ice at the start as one path. `window` and `least` as for floes()."""
        frame = self.run.frame(self.run.start_time)
        seen = self.seen(frame, window)
        return self._path(frame.ids[seen], frame.poses[seen], least)

    def hulls(self, frame):
        """Ships and structures as one path, walls as another."""
        walls = self.run.wall_names
        return tuple(path_of([ring for name, ring in frame.hulls.items() if (name in walls) == is_wall])
                     for is_wall in (False, True))

    @functools.cached_property
    def _recorded_places(self):
        """Positions of ships, structures and walls at each recorded frame, n × bodies × 2 [m]."""
        return numpy.array([self.run.motions.ships_at(time)[:, :2] for time in self.run.times])

    def tracks(self, time):
        """Tracks of ships and structures that moved, up to a time [s], each n × 2 with a point per frame. A body that
        has not moved has none; without frames there are none."""
        if len(self.run.times) == 0:
            return []
        here = self.run.motions.ships_at(time)[None, :, :2]
        places = numpy.concatenate((self._recorded_places[self.run.times < time], here))
        walls = self.run.wall_names
        return [places[:, i] for i, name in enumerate(self.run.ship_names) if name not in walls
                and numpy.ptp(places[:, i], axis=0).max() > 0]

    def fractures(self, kind, start, end):
        """Positions of fractures of a kind (one of FRACTURES) after `start` [s] and up to `end` [s], n × 2, and their
        age at `end` [s]."""
        among = (self._fracture_kinds == kind) & (self._fracture_times > start) & (self._fracture_times <= end)
        return self._fracture_points[among], end - self._fracture_times[among]

    def points(self, frame):
        """Points that determine the extent of a map at the time of a frame, as a list: ice, hulls, walls and tracks,
        each n × 2, perhaps empty."""
        return [*(path.vertices for path in (*self.floes(frame), *self.hulls(frame))), *self.tracks(frame.time)]

    @functools.cached_property
    def extent(self):
        """Extent of ice and hulls at the start and end and of all tracks, with the margin of extent_of(): x0, y0, x1,
        y1 [m]."""
        return extent_of([points for time in (self.run.start_time, self.run.end_time)
                          for points in self.points(self.run.frame(time))])
