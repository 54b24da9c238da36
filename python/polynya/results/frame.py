"""A run at one time."""
from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

import numpy

from .motions import placed
from .tables import optional, table

if TYPE_CHECKING:
    from .run import Run


class Frame:
    """Where ships and floes of a run are at a time. Floes are in the order of their ids; those under hulls are among them."""

    def __init__(self, run: Run, time: float):
        self._run = run
        self.time: float = float(time)  #: [s]

    def __repr__(self):
        return f"<polynya frame at {self.time:g} s: {len(self._ids)} floes, {len(self._run.ship_names)} ships and structures>"

    @property
    def ships(self) -> Any:
        """A table: `ship`, `x_m`, `y_m`, `heading_rad`, `vx_m_per_s`, `vy_m_per_s`, `yaw_rate_rad_per_s`."""
        names = ("x_m", "y_m", "heading_rad", "vx_m_per_s", "vy_m_per_s", "yaw_rate_rad_per_s")
        return table({"ship": numpy.array(self._run.ship_names, dtype=object), **dict(zip(names, self.ship_motions.T))}, self._run.pandas)

    @property
    def floes(self) -> Any:
        """A table: `floe_id`, `parent_id` (-1 of a floe of the scene), `born_s`, `generation`, `area_m2`, `mass_kg`, `is_under` a hull, `came_up`
        from under one (or broke from such a floe), the centre of mass `x_m`, `y_m`, the turn `angle_rad`, and their rates, NaN where no
        frame has the floe."""
        births = {name: values[self._ids] for name, values in self._run.births.items() if name not in ("died_s", "went_under_s")}
        names = ("x_m", "y_m", "angle_rad", "vx_m_per_s", "vy_m_per_s", "spin_rad_per_s")
        return table({**births, "is_under": self.is_under, **dict(zip(names, self._motions.T))}, self._run.pandas)

    @property
    def rings(self) -> list[list[numpy.ndarray]]:
        """Of each floe its outer ring and its holes in the world, arrays of n × 2 [m], not closed."""
        shapes = self._run.shapes.of(self._ids)
        return [[placed(ring, *pose) for ring in shapes[floe]] for floe, pose in zip(self._ids.tolist(), self._poses)]

    @property
    def polygons(self) -> list[Any]:
        """Of each floe a shapely Polygon in the world [m], or a GeoJSON Polygon, a dict, where shapely is not installed."""
        return [polygon_of(rings, self._run.shapely) for rings in self.rings]

    @property
    def hulls(self) -> dict[str, numpy.ndarray]:
        """Waterlines of ships and structures in the world, arrays of n × 2 [m], by name."""
        return {name: placed(self._run.waterlines[name], *motion[:3]) for name, motion in zip(self._run.ship_names, self.ship_motions)}

    @functools.cached_property
    def is_under(self) -> numpy.ndarray:
        """Which of the floes are under a hull, or wait behind it for room."""
        return self._run.births["went_under_s"][self._ids] <= self.time

    @property
    def ids(self) -> numpy.ndarray:
        """Of the floes."""
        return self._ids

    @property
    def poses(self) -> numpy.ndarray:
        """Of each floe's body frame in the world, n × 3: x, y [m], angle [rad]; its shape is in `run.shapes`."""
        return self._poses

    @functools.cached_property
    def _ids(self):
        births = self._run.births
        return numpy.flatnonzero((births["born_s"] <= self.time) & (self.time < births["died_s"]))

    @functools.cached_property
    def ship_motions(self) -> numpy.ndarray:
        """n × 6, as the columns of `ships`."""
        moved = self._run.motions.ships_at(self.time)
        return moved if len(moved) else self._run.first_motions

    @functools.cached_property
    def _recorded(self):
        return self._run.motions.floes_at(self._ids, self.time)

    @functools.cached_property
    def _poses(self):
        """Of each floe's body frame in the world: x, y, angle; of a floe that no frame has, that of the one it broke from."""
        poses = body_poses(self._recorded, self._run.centroids[self._ids])
        parents = self._run.births["parent_id"]
        for i in numpy.flatnonzero(numpy.isnan(poses[:, 0])):
            at = int(parents[self._ids[i]])
            poses[i] = 0
            while at >= 0:
                one = numpy.array([at])
                pose = body_poses(self._run.motions.floes_at(one, self.time), self._run.centroids[one])[0]
                if not numpy.isnan(pose[0]):
                    poses[i] = pose
                    break
                at = int(parents[at])
        return poses

    @functools.cached_property
    def _motions(self):
        """The records, and where there is none the centre of mass where the pose puts it."""
        found, (x, y, angle) = self._recorded.copy(), self._poses.T
        centre = self._run.centroids[self._ids]
        c, s = numpy.cos(angle), numpy.sin(angle)
        missing = numpy.isnan(found[:, 0])
        by_pose = numpy.column_stack((x + c * centre[:, 0] - s * centre[:, 1], y + s * centre[:, 0] + c * centre[:, 1], angle))
        found[missing, :3] = by_pose[missing]
        return found


def body_poses(motions, centroids):
    """The body frames of floes whose centres of mass move so: x, y, angle."""
    x, y, angle = motions[:, 0], motions[:, 1], motions[:, 2]
    c, s = numpy.cos(angle), numpy.sin(angle)
    return numpy.column_stack(
        (x - (c * centroids[:, 0] - s * centroids[:, 1]), y - (s * centroids[:, 0] + c * centroids[:, 1]), angle))


def polygon_of(rings, shapely):
    """A shapely Polygon of rings, or a GeoJSON one."""
    geometry = optional("shapely.geometry", shapely)
    if geometry:
        return geometry.Polygon(rings[0], rings[1:])
    closed = [[tuple(point) for point in (*ring.tolist(), ring[0].tolist())] for ring in rings]
    return {"type": "Polygon", "coordinates": closed}


class Frames:
    """The recorded frames of a run, in order."""

    def __init__(self, run):
        self._run = run

    def __len__(self):
        return len(self._run.times)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [Frame(self._run, time) for time in self._run.times[index]]
        return Frame(self._run, self._run.times[index])
