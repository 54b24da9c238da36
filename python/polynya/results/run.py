"""A run folder read back, and the run at one time."""
from __future__ import annotations

import functools
import os
import pathlib
from typing import Any, Optional, Union

import numpy

from polynya.errors import FolderError, NotARunError, UnfinishedError, VersionError
from polynya.files import check_run, read_json, read_json_lines

from . import channel as channels
from .hulls import first_motion, waterline
from .motions import Motions, placed
from .shapes import Shapes
from .tables import NONE, event_columns, optional, read_csv, table

VERSION = 6  # of run folders, kRunFolderVersion of io/run/summary.hpp


class Run:
    """A folder that `polynya run` wrote (docs/run-folder.md), read as its parts are asked for.

    Tables are pandas' frames, or numpy's structured arrays where pandas is not installed (`pandas=True` insists on
    frames, `False` on arrays). Their columns are those of the files, with their units in their names, and each number
    is the file's. Floes are shapely's polygons, or GeoJSON's where shapely is not installed (`shapely=` likewise).

    Raises NotARunError, UnfinishedError (but with `unfinished=True`, which reads what is there), VersionError, and
    FolderError with the file and the line where one is missing or damaged: the program reads the whole folder first, so
    that this class reads nothing that `polynya inspect` would refuse."""

    def __init__(self, folder: Union[str, os.PathLike[str]], *, unfinished: bool = False,
                 pandas: Optional[bool] = None, shapely: Optional[bool] = None):
        self.folder = pathlib.Path(folder)
        self.pandas, self.shapely = pandas, shapely
        if not (self.folder / "scene.json").is_file():
            what = "has no scene.json" if self.folder.is_dir() else "is a file"
            what = what if self.folder.exists() else "does not exist"
            raise NotARunError(f"not a run folder: {self.folder} {what}")
        try:
            check_run(self.folder)
        except FolderError:
            self._check_version()
            raise
        self._check_version()
        self.scene: dict = read_json(self.folder / "scene.json")  #: with every default filled in
        self.summary: dict = read_json(self.folder / "summary.json")  #: how it went
        self.version: int = int(self.summary.get("folder_version", 1))  #: of the folder
        if not self.is_finished and not unfinished:
            stopped = self.summary.get("stopped_by")
            raise UnfinishedError(
                f"{self.folder}: the run is not finished" + (f" (stopped by {stopped})" if stopped else "") +
                f": polynya resume {self.folder} continues it; Run(folder, unfinished=True) reads what is there")

    def _check_version(self):
        """Refuses a folder that another version wrote, whatever else the program says of it."""
        try:
            summary = read_json(self.folder / "summary.json")
        except FolderError:
            return
        version = summary.get("folder_version", 1)
        if isinstance(version, (int, float)) and version not in range(1, VERSION + 1):
            raise VersionError(
                f"{self.folder / 'summary.json'}: a run folder of version {version:g}; this polynya reads 1 to "
                f"{VERSION}: read it with the polynya that wrote it ({summary.get('version', 'unknown')}), or run its "
                f"scene.json again")

    def __repr__(self):
        state = "" if self.is_finished else ", not finished"
        return (f"<polynya run {self.name} in {self.folder}: {self.start_time:g} to {self.end_time:g} s, "
                f"{len(self.times)} frames{state}>")

    def _repr_html_(self):
        from polynya.showing import html_of_run
        return html_of_run(self)

    @property
    def name(self) -> str:
        """The scene's."""
        return self.scene.get("name", self.folder.name)

    @property
    def is_finished(self) -> bool:
        """Whether it ran to its end."""
        return bool(self.summary.get("finished", True))

    @property
    def ship_names(self) -> list[str]:
        """Of ships, then of structures, then of walls: their order everywhere."""
        return list(self.waterlines)

    @property
    def wall_names(self) -> set[str]:
        """Of the scene's walls, which `waterlines` has among the others."""
        return {wall["name"] for wall in self.scene.get("walls", [])}

    @functools.cached_property
    def waterlines(self) -> dict[str, numpy.ndarray]:
        """Of ships, structures and walls, in their own frames [m], by name."""
        return {body["name"]: waterline(body) for body in self._bodies}

    @property
    def _bodies(self):
        return [*self.scene.get("ships", []), *self.scene.get("structures", []), *self.scene.get("walls", [])]

    # Tables

    @property
    def forces(self) -> Any:
        """forces.csv: loads and motion, a row for each ship or structure and interval."""
        return table(self.force_columns, self.pandas)

    @property
    def events(self) -> Any:
        """events.ndjson, a row an event: `point_m` as `x_m`, `y_m`, `normal` as `normal_x`, `normal_y`, a mooring's
        `offset_m` as `offset_along_m`, `offset_across_m`, the members of `criterion` by their names, its kind as
        `criterion`; -1 where there is no floe, NaN where there is no number. `children` holds tuples."""
        return table(self.event_columns, self.pandas)

    @property
    def contacts(self) -> Any:
        """contacts.csv: who touched whom at every frame; -1 where a body is no floe."""
        return table(self._contact_rows(of_peaks=False), self.pandas)

    @property
    def peaks(self) -> Any:
        """contacts.csv: the peaks of the forces of contacts with hulls, as time goes, with what ended each."""
        return table(self._contact_rows(of_peaks=True), self.pandas)

    def _contact_rows(self, of_peaks):
        rows = self._columns("contacts.csv", "runs of early versions")
        if "ended_by" not in rows:
            if of_peaks:
                raise VersionError(f"{self.folder / 'contacts.csv'}: without peaks; run folders of version 4 and "
                                   f"before did not record them: run its scene.json again")
            return rows
        is_peak = rows["ended_by"] != ""
        if not of_peaks:
            return {name: values[~is_peak] for name, values in rows.items()}
        order = numpy.argsort(rows["t_s"][is_peak], kind="stable")
        return {name: values[is_peak][order] for name, values in rows.items()}

    @property
    def panels(self) -> Any:
        """panels.csv: what the ice did to each panel that it pressed in an interval; of scenes whose hulls have
        panels."""
        return self._table("panels.csv", "no ship or structure of the scene has panels, or its version")

    @property
    def crushed(self) -> Any:
        """crushed.csv: how much of their overlap two bodies have crushed."""
        return self._table("crushed.csv", "run folders of version 2 and before")

    @property
    def states(self) -> Any:
        """states.csv: a hash of everything that moves, of every frame."""
        return self._table("states.csv", "runs of early versions")

    @property
    def channel(self) -> Any:
        """channel.csv, a row a station, where `polynya channel` wrote it; `measure_channel` measures at any time."""
        if not (self.folder / "channel.csv").exists():
            raise FolderError(f"{self.folder / 'channel.csv'}: is not there: polynya channel {self.folder} writes it; "
                              "Run.measure_channel() measures without writing")
        return table(read_csv(self.folder / "channel.csv"), self.pandas)

    def measure_channel(self, time: Optional[float] = None, ship: Optional[str] = None) -> channels.Channel:
        """The channel behind a ship (the first one) at a time [s] (the end), by the program `polynya channel`."""
        return channels.measure(self.folder, ship, time, self.pandas)

    @property
    def floes(self) -> Any:
        """floes.ndjson: every floe that there was, with `died_s`, when it broke, and `went_under_s`, when it went under
        a hull (infinite where it did not), and whether it, or one that it broke from, `came_up` from there. The shapes
        are in `frame(time)`."""
        return table(self.births, self.pandas)

    def _table(self, name, lacking):
        return table(self._columns(name, lacking), self.pandas)

    def _columns(self, name, lacking):
        if not (self.folder / name).exists():
            raise VersionError(f"{self.folder / name}: is not there; {lacking} did not record it: run its scene.json "
                               f"again")
        return read_csv(self.folder / name)

    @functools.cached_property
    def force_columns(self) -> dict[str, numpy.ndarray]:
        """The columns of `forces`."""
        return read_csv(self.folder / "forces.csv")

    @functools.cached_property
    def event_columns(self) -> dict[str, numpy.ndarray]:
        """The columns of `events`."""
        return event_columns(read_json_lines(self.folder / "events.ndjson"))

    # Frames

    @property
    def times(self) -> numpy.ndarray:
        """Of the recorded frames [s]."""
        return self.motions.times

    @property
    def start_time(self) -> float:
        """Of the first frame [s]."""
        return float(self.times[0]) if len(self.times) else 0.0

    @property
    def end_time(self) -> float:
        """Of the last frame [s]."""
        return float(self.times[-1]) if len(self.times) else 0.0

    @property
    def frames(self) -> Frames:
        """The recorded frames: `frames[-1]`, `for frame in frames`."""
        return Frames(self)

    def frame(self, time: float) -> Frame:
        """The run at a time [s] between its first and its last frame."""
        if not self.start_time <= time <= self.end_time:
            raise ValueError(f"time {time:g}: the run goes from {self.start_time:g} to {self.end_time:g} s")
        return Frame(self, time)

    @functools.cached_property
    def _lines(self):
        return read_json_lines(self.folder / "floes.ndjson")

    @functools.cached_property
    def shapes(self) -> Shapes:
        """Of floes, in their body frames."""
        return Shapes(self._lines, self.folder / "floes.ndjson")

    @functools.cached_property
    def motions(self) -> Motions:
        """The records of frames.bin."""
        return Motions(self.folder / "frames.bin", len(self._lines))

    @functools.cached_property
    def centroids(self) -> numpy.ndarray:
        """Of floes, in their body frames, n × 2 [m]."""
        return numpy.array([line["centroid_m"] for line in self._lines], dtype=float).reshape(-1, 2)

    @functools.cached_property
    def births(self) -> dict[str, numpy.ndarray]:
        """The columns of `floes`, by floe id."""
        lines = self._lines
        columns = {"floe_id": numpy.arange(len(lines))}
        columns["parent_id"] = numpy.array([NONE if line["parent_id"] is None else line["parent_id"]
                                            for line in lines], dtype=numpy.int64)
        for name, kind in (("born_s", float), ("generation", numpy.int64), ("area_m2", float), ("mass_kg", float)):
            columns[name] = numpy.array([line[name] for line in lines], dtype=kind)
        died, went_under = numpy.full(len(lines), numpy.inf), numpy.full(len(lines), numpy.inf)
        came_up = numpy.zeros(len(lines), dtype=bool)
        events = self.event_columns
        for time, kind, floe, children in zip(events["t_s"], events["kind"], events["floe"].tolist(),
                                              events["children"]):
            if not 0 <= floe < len(lines):
                continue  # of ships that touch
            if kind == "submerge":
                went_under[floe] = time
            elif kind != "rejected_cut":
                died[floe] = time
            for child in children:
                if child < len(lines):
                    came_up[child] = kind == "resurface" or came_up[floe]
        return {**columns, "died_s": died, "went_under_s": went_under, "came_up": came_up}

    @property
    def first_motions(self) -> numpy.ndarray:
        """Where the scene puts ships, structures and walls, at rest: x, y, heading and their rates."""
        return numpy.array([first_motion(body) for body in self._bodies], dtype=float).reshape(-1, 6)


class Frame:
    """Where ships and floes of a run are at a time. Floes are in the order of their ids; those under hulls are among
    them."""

    def __init__(self, run: Run, time: float):
        self._run = run
        self.time: float = float(time)  #: [s]

    def __repr__(self):
        return (f"<polynya frame at {self.time:g} s: {len(self._ids)} floes, "
                f"{len(self._run.ship_names)} ships and structures>")

    @property
    def ships(self) -> Any:
        """A table: `ship`, `x_m`, `y_m`, `heading_rad`, `vx_m_per_s`, `vy_m_per_s`, `yaw_rate_rad_per_s`."""
        names = ("x_m", "y_m", "heading_rad", "vx_m_per_s", "vy_m_per_s", "yaw_rate_rad_per_s")
        return table({"ship": numpy.array(self._run.ship_names, dtype=object),
                      **dict(zip(names, self.ship_motions.T))}, self._run.pandas)

    @property
    def floes(self) -> Any:
        """A table: `floe_id`, `parent_id` (-1 of a floe of the scene), `born_s`, `generation`, `area_m2`, `mass_kg`,
        `is_under` a hull, `came_up` from under one (or broke from such a floe), the centre of mass `x_m`, `y_m`, the
        turn `angle_rad`, and their rates, NaN where no frame has the floe."""
        births = {name: values[self._ids] for name, values in self._run.births.items()
                  if name not in ("died_s", "went_under_s")}
        names = ("x_m", "y_m", "angle_rad", "vx_m_per_s", "vy_m_per_s", "spin_rad_per_s")
        return table({**births, "is_under": self.is_under, **dict(zip(names, self._motions.T))}, self._run.pandas)

    @property
    def rings(self) -> list[list[numpy.ndarray]]:
        """Of each floe its outer ring and its holes in the world, arrays of n × 2 [m], not closed."""
        shapes = self._run.shapes.of(self._ids)
        return [[placed(ring, *pose) for ring in shapes[floe]] for floe, pose in zip(self._ids.tolist(), self._poses)]

    @property
    def polygons(self) -> list[Any]:
        """Of each floe a shapely Polygon in the world [m], or a GeoJSON Polygon, a dict, where shapely is not
        installed."""
        return [polygon_of(rings, self._run.shapely) for rings in self.rings]

    @property
    def hulls(self) -> dict[str, numpy.ndarray]:
        """Waterlines of ships and structures in the world, arrays of n × 2 [m], by name."""
        return {name: placed(self._run.waterlines[name], *motion[:3])
                for name, motion in zip(self._run.ship_names, self.ship_motions)}

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
        """Of each floe's body frame in the world: x, y, angle; of a floe that no frame has, that of the one it broke
        from."""
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
        by_pose = numpy.column_stack((x + c * centre[:, 0] - s * centre[:, 1], y + s * centre[:, 0] + c * centre[:, 1],
                                      angle))
        found[missing, :3] = by_pose[missing]
        return found


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
