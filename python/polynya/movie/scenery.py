"""What a film shows of a run at a time, as few paths in the world [m]."""
from __future__ import annotations

import functools

import numpy
from matplotlib.path import Path

from ..figures.map_extent import extent_of
from ..figures.map_paths import NOTHING, codes_of, path_of

WHOLE, BROKEN, CAME_UP, UNDER = range(4)


class Scenery:
    """The floes, hulls and fractures of a run, ready to be drawn at any of its times."""

    def __init__(self, run):
        self.run = run
        self._outlines = {}
        events = run.event_columns
        is_fracture = numpy.isin(events["kind"], ("bend", "split", "grind"))
        order = numpy.flatnonzero(is_fracture)
        self._fracture_times = events["t_s"][order]
        self._fracture_kinds = events["kind"][order]
        self._fracture_points = numpy.column_stack((events["x_m"][order], events["y_m"][order])).astype(float)

    def floes(self, frame):
        """Floes as one path a kind: whole as in the scene, broken, come up from under a hull, and under one."""
        births, ids = self.run.births, frame.ids
        kinds = numpy.where(births["generation"][ids] == 0, WHOLE, numpy.where(births["came_up"][ids], CAME_UP, BROKEN))
        kinds[frame.is_under] = UNDER
        return [self._path(ids[kinds == kind], frame.poses[kinds == kind]) for kind in range(4)]

    def _path(self, ids, poses):
        """The floes' outlines in the world, one compound path."""
        if len(ids) == 0:
            return NOTHING
        outlines = self._outlines_of(ids)
        counts = [len(codes) for _, codes in outlines]
        x, y, angle = numpy.repeat(poses, counts, axis=0).T
        in_body = numpy.concatenate([points for points, _ in outlines])
        c, s = numpy.cos(angle), numpy.sin(angle)
        in_world = numpy.column_stack((x + c * in_body[:, 0] - s * in_body[:, 1], y + s * in_body[:, 0] + c * in_body[:, 1]))
        return Path(in_world, numpy.concatenate([codes for _, codes in outlines]))

    def _outlines_of(self, ids):
        """Closed rings one after the other and their codes, of each floe, in its body frame."""
        missing = [floe for floe in ids.tolist() if floe not in self._outlines]
        for floe, rings in self.run.shapes.of(missing).items() if missing else ():
            points = numpy.concatenate([ring[numpy.r_[: len(ring), 0]] for ring in rings])
            self._outlines[floe] = points, numpy.concatenate([codes_of(len(ring) + 1) for ring in rings])
        return [self._outlines[floe] for floe in ids.tolist()]

    def forget(self, time):
        """Drops the outlines of floes that broke before a time [s]."""
        died = self.run.births["died_s"]
        self._outlines = {floe: outline for floe, outline in self._outlines.items() if died[floe] > time}

    @functools.cached_property
    def ice_at_start(self):
        """As one path."""
        frame = self.run.frame(self.run.start_time)
        return self._path(frame.ids, frame.poses)

    def hulls(self, frame):
        """Ships and structures as one path, walls as another."""
        walls = self.run.wall_names
        return tuple(path_of([ring for name, ring in frame.hulls.items() if (name in walls) == is_wall]) for is_wall in (False, True))

    def tracks(self, time):
        """Of ships, not of structures and walls, up to a time [s], each n × 2."""
        past = [*self.run.times[self.run.times < time], time]
        ships = len(self.run.scene.get("ships", []))
        places = numpy.array([self.run.motions.ships_at(at)[:ships, :2] for at in past])
        return list(numpy.swapaxes(places, 0, 1))

    def fractures(self, kind, start, end):
        """Where ice broke so between two times [s], n × 2, and how long before the end."""
        among = (self._fracture_kinds == kind) & (self._fracture_times > start) & (self._fracture_times <= end)
        return self._fracture_points[among], end - self._fracture_times[among]

    @functools.cached_property
    def extent(self):
        """Of ice at the start and end and of all tracks: x0, y0, x1, y1 [m]."""
        end = self.run.frame(self.run.end_time)
        pieces = [self.ice_at_start.vertices, *(path.vertices for path in (*self.floes(end), *self.hulls(end))),
                  *(path.vertices for path in self.hulls(self.run.frame(self.run.start_time))), *self.tracks(self.run.end_time)]
        return extent_of(pieces)
