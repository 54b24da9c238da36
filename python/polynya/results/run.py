"""Reads a run folder, and the state of the run at a time."""
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

# Newest version of run folders that this class reads. It must equal kRunFolderVersion of io/run/run_folder.hpp;
# with a smaller number, folders of the current program are refused. Older versions from 1 on are read too.
VERSION = 6


class Run:
    """A folder that `polynya run` wrote (docs/run-folder.md). Its parts are read when they are first used.

    Tables are pandas frames, or numpy's structured arrays if pandas is not installed (`pandas=True` requires frames,
    `False` gives arrays). Columns have the names and units of the files, and numbers are those of the files. Floes are
    shapely polygons, or GeoJSON polygons if shapely is not installed (`shapely=` works in the same way). If a required
    package is not installed, reading a table or polygons raises ImportError.

    Raises NotARunError; UnfinishedError (except with `unfinished=True`, which reads the part that exists);
    VersionError; and FolderError with the file and the line if a file is missing or damaged. The program reads the
    whole folder first, so this class accepts only folders that `polynya inspect` accepts."""

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
        self.scene: dict = read_json(self.folder / "scene.json")  #: with all defaults filled in
        self.summary: dict = read_json(self.folder / "summary.json")  #: contents of summary.json
        self.version: int = int(self.summary.get("folder_version", 1))  #: version of the folder
        if not self.is_finished and not unfinished:
            stopped = self.summary.get("stopped_by")
            raise UnfinishedError(
                f"{self.folder}: the run is not finished" + (f" (stopped by {stopped})" if stopped else "") +
                f": polynya resume {self.folder} continues it; Run(folder, unfinished=True) reads what is there")

    def _check_version(self):
        """Raises VersionError for a folder of a later version. This comes before other messages about the folder, which
        such a folder could cause."""
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
        """Name of the scene."""
        return self.scene.get("name", self.folder.name)

    @property
    def is_finished(self) -> bool:
        """True if the run reached its end, or if its summary does not say."""
        return bool(self.summary.get("finished", True))

    @property
    def ship_names(self) -> list[str]:
        """Names of ships, then structures, then walls, in the order of the scene. Rows of all arrays that have a row
        per ship have this order."""
        return list(self.waterlines)

    @property
    def wall_names(self) -> set[str]:
        """Names of the walls, which `waterlines` also contains."""
        return {wall["name"] for wall in self.scene.get("walls", [])}

    @functools.cached_property
    def waterlines(self) -> dict[str, numpy.ndarray]:
        """Waterlines of ships, structures and walls in their own frames [m], by name."""
        return {body["name"]: waterline(body) for body in self._bodies}

    @property
    def _bodies(self):
        return [*self.scene.get("ships", []), *self.scene.get("structures", []), *self.scene.get("walls", [])]

    # Tables

    @property
    def forces(self) -> Any:
        """forces.csv: loads and motion, one row for each ship, structure or wall and interval."""
        return table(self.force_columns, self.pandas)

    @property
    def events(self) -> Any:
        """events.ndjson, one row per event. `point_m` becomes `x_m`, `y_m`; `normal` becomes `normal_x`, `normal_y`;
        the `offset_m` of a mooring becomes `offset_along_m`, `offset_across_m`. Members of `criterion` keep their
        names, and its kind becomes `criterion`. -1 means no floe, NaN no number. `children` holds tuples."""
        return table(self.event_columns, self.pandas)

    @property
    def contacts(self) -> Any:
        """contacts.csv: the contacts at every frame that the scene's `record.contacts` selects; -1 if a body is no
        floe."""
        return table(self._contact_rows(of_peaks=False), self.pandas)

    @property
    def peaks(self) -> Any:
        """contacts.csv: peaks of the forces of contacts with hulls, in order of time, with the reason why each contact
        ended."""
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
        """panels.csv: loads of ice on each panel that it pressed in an interval, for scenes whose hulls have panels."""
        return self._table("panels.csv", "no ship or structure of the scene has panels, or its version")

    @property
    def crushed(self) -> Any:
        """crushed.csv: for each pair of bodies the areas of their overlap that contacts have crushed or tilted, the
        crushed volume and its work, at every frame."""
        return self._table("crushed.csv", "run folders of version 2 and before")

    @property
    def states(self) -> Any:
        """states.csv: a hash of the whole state at every frame."""
        return self._table("states.csv", "runs of early versions")

    @property
    def channel(self) -> Any:
        """channel.csv, one row per station, if `polynya channel` has written it. `measure_channel` measures at any
        time."""
        if not (self.folder / "channel.csv").exists():
            raise FolderError(f"{self.folder / 'channel.csv'}: is not there: polynya channel {self.folder} writes it; "
                              "Run.measure_channel() measures without writing")
        return table(read_csv(self.folder / "channel.csv"), self.pandas)

    def measure_channel(self, time: Optional[float] = None, ship: Optional[str] = None) -> channels.Channel:
        """Measures the channel behind a ship (the first by default) at a time [s] (the end by default) with `polynya
        channel`."""
        return channels.measure(self.folder, ship, time, self.pandas)

    @property
    def floes(self) -> Any:
        """floes.ndjson: all floes of the run, one row per floe. `died_s` is the time at which a floe broke, was ground,
        or surfaced as another floe or stayed under the ice after it had gone under a hull; `went_under_s` is the time
        at which it went under. Both are infinite if that did not happen. `came_up` is true if the floe, or a floe from
        which it broke, surfaced from there. `generation` is the number of ancestors of the floe, and area and mass are
        those at its birth. `frame(time)` has the shapes."""
        return table(self.births, self.pandas)

    def _table(self, name, lacking):
        """A table of a file; `lacking` says which runs do not have that file. Raises VersionError, which is a
        FolderError, if it is missing."""
        return table(self._columns(name, lacking), self.pandas)

    def _columns(self, name, lacking):
        if not (self.folder / name).exists():
            raise VersionError(f"{self.folder / name}: is not there; {lacking} did not record it: run its scene.json "
                               f"again")
        return read_csv(self.folder / name)

    @functools.cached_property
    def force_columns(self) -> dict[str, numpy.ndarray]:
        """Columns of `forces`."""
        return read_csv(self.folder / "forces.csv")

    @functools.cached_property
    def event_columns(self) -> dict[str, numpy.ndarray]:
        """Columns of `events`."""
        return event_columns(read_json_lines(self.folder / "events.ndjson"))

    # Frames

    @property
    def times(self) -> numpy.ndarray:
        """Times of the recorded frames [s]."""
        return self.motions.times

    @property
    def start_time(self) -> float:
        """Time of the first frame [s]; 0 if there is none."""
        return float(self.times[0]) if len(self.times) else 0.0

    @property
    def end_time(self) -> float:
        """Time of the last frame [s], which may come before the end of the scene in an unfinished run; 0 if there is
        none."""
        return float(self.times[-1]) if len(self.times) else 0.0

    @property
    def frames(self) -> Frames:
        """The recorded frames: `frames[-1]`, `for frame in frames`."""
        return Frames(self)

    def frame(self, time: float) -> Frame:
        """The run at a time [s] between its first and its last frame. Motion between frames is interpolated. Raises
        ValueError for another time."""
        if not self.start_time <= time <= self.end_time:
            raise ValueError(f"time {time:g}: the run goes from {self.start_time:g} to {self.end_time:g} s")
        return Frame(self, time)

    @functools.cached_property
    def _lines(self):
        return read_json_lines(self.folder / "floes.ndjson")

    @functools.cached_property
    def shapes(self) -> Shapes:
        """Shapes of floes in their body frames, to place in the world by Frame.poses."""
        return Shapes(self._lines, self.folder / "floes.ndjson")

    @functools.cached_property
    def motions(self) -> Motions:
        """Positions of ships and floes at any time, from frames.bin."""
        return Motions(self.folder / "frames.bin", len(self._lines))

    @functools.cached_property
    def centroids(self) -> numpy.ndarray:
        """Centroids of floes in their body frames, n × 2 [m]."""
        return numpy.array([line["centroid_m"] for line in self._lines], dtype=float).reshape(-1, 2)

    @functools.cached_property
    def births(self) -> dict[str, numpy.ndarray]:
        """Columns of `floes`, by floe id."""
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
                continue  # events of ships that touch have no floe
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
        """Initial poses of ships, structures and walls: x, y [m], heading [rad], and zeros in place of their rates.
        They are used if there is no frame."""
        return numpy.array([first_motion(body) for body in self._bodies], dtype=float).reshape(-1, 6)


class Frame:
    """Ships and floes of a run at a time. Floes are in the order of their ids, and include those under hulls but not
    those that broke. Frames are made by Run.frame() and Run.frames."""

    def __init__(self, run: Run, time: float):
        self._run = run
        self.time: float = float(time)  #: [s]

    def __repr__(self):
        return (f"<polynya frame at {self.time:g} s: {len(self._ids)} floes, "
                f"{len(self._run.ship_names)} ships and structures>")

    @property
    def ships(self) -> Any:
        """Table with `ship`, `x_m`, `y_m`, `heading_rad`, `vx_m_per_s`, `vy_m_per_s`, `yaw_rate_rad_per_s`."""
        names = ("x_m", "y_m", "heading_rad", "vx_m_per_s", "vy_m_per_s", "yaw_rate_rad_per_s")
        return table({"ship": numpy.array(self._run.ship_names, dtype=object),
                      **dict(zip(names, self.ship_motions.T))}, self._run.pandas)

    @property
    def floes(self) -> Any:
        """Table with `floe_id`, `parent_id` (-1 for a floe of the scene), `born_s`, `generation`, `area_m2`, `mass_kg`,
        `is_under` (under a hull), `came_up` (it, or a floe from which it broke, surfaced from under a hull), the centre
        of mass `x_m`, `y_m`, the rotation `angle_rad`, and their rates, NaN if no frame has the floe."""
        births = {name: values[self._ids] for name, values in self._run.births.items()
                  if name not in ("died_s", "went_under_s")}
        names = ("x_m", "y_m", "angle_rad", "vx_m_per_s", "vy_m_per_s", "spin_rad_per_s")
        return table({**births, "is_under": self.is_under, **dict(zip(names, self._motions.T))}, self._run.pandas)

    @property
    def rings(self) -> list[list[numpy.ndarray]]:
        """For each floe its outer ring and its holes in the world, arrays of n × 2 [m], not closed."""
        shapes = self._run.shapes.of(self._ids)
        return [[placed(ring, *pose) for ring in shapes[floe]] for floe, pose in zip(self._ids.tolist(), self._poses)]

    @property
    def polygons(self) -> list[Any]:
        """For each floe a shapely Polygon in the world [m], or a GeoJSON Polygon (a dict) if shapely is not
        installed."""
        return [polygon_of(rings, self._run.shapely) for rings in self.rings]

    @property
    def hulls(self) -> dict[str, numpy.ndarray]:
        """Waterlines of ships, structures and walls in the world, arrays of n × 2 [m], by name."""
        return {name: placed(self._run.waterlines[name], *motion[:3])
                for name, motion in zip(self._run.ship_names, self.ship_motions)}

    @functools.cached_property
    def is_under(self) -> numpy.ndarray:
        """Mask of the floes that are under a hull, or wait behind it for room to surface."""
        return self._run.births["went_under_s"][self._ids] <= self.time

    @property
    def ids(self) -> numpy.ndarray:
        """Ids of the floes that exist at that time, in ascending order. Other arrays of floes have the same order."""
        return self._ids

    @property
    def poses(self) -> numpy.ndarray:
        """Pose of each floe's body frame in the world, n × 3: x, y [m], angle [rad]. `run.shapes` has the shapes."""
        return self._poses

    @functools.cached_property
    def _ids(self):
        births = self._run.births
        return numpy.flatnonzero((births["born_s"] <= self.time) & (self.time < births["died_s"]))

    @functools.cached_property
    def ship_motions(self) -> numpy.ndarray:
        """Motions of ships, structures and walls, n × 6, as the columns of `ships`: x, y [m], heading [rad] and their
        rates."""
        moved = self._run.motions.ships_at(self.time)
        return moved if len(moved) else self._run.first_motions

    @functools.cached_property
    def _recorded(self):
        return self._run.motions.floes_at(self._ids, self.time)

    @functools.cached_property
    def _poses(self):
        """Poses of the floes' body frames in the world: x, y, angle. A floe that no frame has is placed as the floe
        from which it broke."""
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
        """Motions of the floes, n × 6, by the records: centre of mass, angle and their rates. Without a record the
        centre and angle follow from the pose, and the rates are NaN."""
        found, (x, y, angle) = self._recorded.copy(), self._poses.T
        centre = self._run.centroids[self._ids]
        c, s = numpy.cos(angle), numpy.sin(angle)
        missing = numpy.isnan(found[:, 0])
        by_pose = numpy.column_stack((x + c * centre[:, 0] - s * centre[:, 1], y + s * centre[:, 0] + c * centre[:, 1],
                                      angle))
        found[missing, :3] = by_pose[missing]
        return found


class Frames:
    """The recorded frames of a run, in order of time, as a sequence of Frame."""

    def __init__(self, run):
        self._run = run

    def __len__(self):
        return len(self._run.times)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [Frame(self._run, time) for time in self._run.times[index]]
        return Frame(self._run, self._run.times[index])


def body_poses(motions, centroids):
    """The poses x, y [m], angle [rad] of the body frames of floes, n × 3. `motions` begin with x, y and angle of their
    centres of mass in the world, and `centroids` are these centres in the body frames [m]."""
    x, y, angle = motions[:, 0], motions[:, 1], motions[:, 2]
    c, s = numpy.cos(angle), numpy.sin(angle)
    return numpy.column_stack(
        (x - (c * centroids[:, 0] - s * centroids[:, 1]), y - (s * centroids[:, 0] + c * centroids[:, 1]), angle))


def polygon_of(rings, shapely):
    """Makes a shapely Polygon from an outer ring and its holes, or a GeoJSON Polygon if shapely is not installed or
    `shapely` is False."""
    geometry = optional("shapely.geometry", shapely)
    if geometry:
        return geometry.Polygon(rings[0], rings[1:])
    closed = [[tuple(point) for point in (*ring.tolist(), ring[0].tolist())] for ring in rings]
    return {"type": "Polygon", "coordinates": closed}
