"""Collects peaks and panels of a run, or of all cases of a study."""
from __future__ import annotations

import dataclasses
import json
import math
import pathlib
from typing import Optional

import numpy

from polynya.errors import FolderError, InputError
from polynya.naming import names_of
from polynya.results.run import Run
from polynya.results.tables import read_csv

COMMON = 2.5  # length of panels if neither --panel nor the scene states it [m]


class Waterline:
    """Waterline of a hull. Positions are measured from the stem to port along it, as in contacts.csv
    (simulation/ship/waterline.cpp)."""

    def __init__(self, ring):
        ring = numpy.asarray(ring, dtype=float)
        following = numpy.roll(ring, -1, axis=0)
        if numpy.sum(ring[:, 0] * following[:, 1] - following[:, 0] * ring[:, 1]) < 0:
            ring = ring[::-1]
        foremost = ring[:, 0] > ring[:, 0].max() - 1e-9
        first = next(i for i in range(len(ring)) if foremost[i] and not foremost[i - 1])
        ring = numpy.roll(ring, -first, axis=0)
        closed = numpy.vstack([ring, ring[:1]])
        arcs = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(closed, axis=0).T))])
        self.length = float(arcs[-1])  #: [m]
        stem = arcs[1] / 2 if numpy.count_nonzero(foremost) > 1 else 0.0
        self._points, self._arcs = closed, arcs - stem

    def at(self, arc):
        """Points at these distances from the stem, in the hull's frame [m]."""
        along = numpy.mod(numpy.asarray(arc, dtype=float) - self._arcs[0], self.length) + self._arcs[0]
        return numpy.column_stack([numpy.interp(along, self._arcs, self._points[:, k]) for k in (0, 1)])


@dataclasses.dataclass(frozen=True)
class Case:
    """One of the gathered runs."""

    number: int
    start_s: float
    hours: float
    kilometres: float  #: distance over ground
    kind: str = ""  #: runs of one kind differ only in their seeds


@dataclasses.dataclass
class Loads:
    """Loads of one ship or structure. `peaks` has columns of equal length: those of contacts.csv, `case`, and
    `force_N`, the force along the contact's normal. `panels` has the columns of panels.csv, or is None if there are
    none."""

    name: str
    ship: str
    is_fixed: bool  #: True without propulsion; then loads are also drawn by direction
    waterline: Waterline
    panel_m: float
    cases: list[Case]
    peaks: dict
    panels: Optional[dict]
    interval_s: float  #: length of the interval of a row of panels [s]
    left_out: int  #: number of peaks below the smallest that the runs record, in the whole runs
    beyond_limit: int = 0  #: number of peaks beyond the number that the runs record, in the whole runs
    gauge_s: float = 0.0  #: time constant of the gauge that measured the peaks
    ended: int = 0  #: number of runs that end before the first time that counts, and are left out

    @property
    def hours(self):
        return sum(case.hours for case in self.cases)

    @property
    def kilometres(self):
        return sum(case.kilometres for case in self.cases)

    @property
    def forces(self):
        """Forces of the peaks [N]."""
        return self.peaks["force_N"]

    def kinds(self):
        """Names of the kinds of runs, in the order of the cases."""
        return list(dict.fromkeys(case.kind for case in self.cases))

    def of_kind(self, kind):
        """The loads of one kind of runs."""
        cases = [case for case in self.cases if case.kind == kind]
        numbers = [case.number for case in cases]
        chosen = {name: table and {key: values[numpy.isin(table["case"], numbers)] for key, values in table.items()}
                  for name, table in (("peaks", self.peaks), ("panels", self.panels))}
        return dataclasses.replace(self, cases=cases, **chosen)

    def panel_of(self, arc):
        """Numbers of the panels at these positions [m]: 0 is the first one from the stem to port, -1 to starboard."""
        return numpy.floor(numpy.asarray(arc) / self.panel_m).astype(int)


def runs_of(folder):
    """(number of the case, folder) of each run."""
    folder = pathlib.Path(folder)
    from polynya.study import folder as folders
    if not (folder / folders.PLAN).is_file():
        return [(0, folder)]
    study = folders.open_study(folder)
    found = [(n, study.case_folder(n) / folders.RUN) for n in range(study.count)]
    found = [(n, run) for n, run in found if run.is_dir()]
    if not found:
        raise FolderError(f"{folder}: the study has no run folders: polynya study run {folder} makes them; a study "
                          f"with "
                          '"keep": "summary" or "archive" has none')
    return found


def of_ship(columns, ship, start):
    chosen = (columns["ship"] == ship) & (columns["t_s"] >= start)
    return {name: values[chosen] for name, values in columns.items()}


def kind_of(scene):
    """The common properties of runs of one kind: the scene without its seed, duration and texts."""
    shared = {key: value for key, value in scene.items() if key not in ("seed", "name", "description")}
    shared["time"] = {key: value for key, value in scene["time"].items() if key != "until_s"}
    return json.dumps(shared, sort_keys=True)


def with_kinds(cases, scenes):
    """Adds names of their kinds to the cases, formed from the differences; no names if all are of one kind."""
    different = list(dict.fromkeys(scenes))
    names = names_of(different) if len(different) > 1 else {scene: "" for scene in different}
    return [dataclasses.replace(case, kind=names[scene]) for case, scene in zip(cases, scenes)]


def case_of(number, run, ship, start):
    """Duration of a run from `start` on [s], and the distance that the ship moves."""
    rows = of_ship(run.force_columns, ship, start)
    way = numpy.hypot(numpy.diff(rows["x_m"]), numpy.diff(rows["y_m"])).sum() if len(rows["t_s"]) else 0.0
    begin = max(start, run.start_time)
    return Case(number, begin, max(0.0, run.end_time - begin) / 3600, float(way) / 1000)


def body_of(run, ship):
    name = ship or (run.ship_names[0] if run.ship_names else None)
    if not run.ship_names:
        raise InputError(f"{run.folder}: the run has no ship or structure, so it has no loads")
    if name not in run.ship_names:
        raise InputError(f"{run.folder}: no ship or structure is named {name}; it has: {', '.join(run.ship_names)}")
    return next(body for key in ("ships", "structures", "walls") for body in run.scene.get(key, [])
                if body["name"] == name)


def joined(parts):
    return {name: numpy.concatenate([part[name] for part in parts]) for name in parts[0]}


def with_time(cases, scenes, start, end):
    """The cases that have some time from `start` [s] on, with their scenes. `end` is the end of the longest run [s]."""
    kept = [(case, scene) for case, scene in zip(cases, scenes) if case.hours > 0]
    if not kept:
        raise InputError(f"--from {start:g}: there are no records after {start:g} s, because the longest run ends at "
                         f"{end:g} s: give an earlier time, or run longer (polynya resume RUN --until S)")
    return [list(column) for column in zip(*kept)]


def gather(folder, ship=None, start=0.0, panel=None) -> Loads:
    """Reads the peaks, and if they were recorded the panels, of a ship or structure (the first by default). Only times
    from `start` [s] of each run count. `panel` is the length of the panels by which peaks are counted [m]. Recorded
    panels are used only if all runs have them, with this length. Of the waterlines of runs only the numbers of vertices
    are compared. Unfinished runs count up to their last record."""
    cases, scenes, peaks, panels, left_out, beyond, end = [], [], [], [], 0, 0, 0.0
    first = None
    for number, run_folder in runs_of(folder):
        run = Run(run_folder, unfinished=True, pandas=False, shapely=False)
        body = body_of(run, ship)
        first = first or (run, body)
        if run.waterlines[body["name"]].shape != first[0].waterlines[first[1]["name"]].shape:
            raise InputError(f"{run.folder}: another waterline than in {first[0].folder}: places are not the same")
        cases.append(case_of(number, run, body["name"], start))
        end = max(end, run.end_time)
        scenes.append(kind_of(run.scene))
        of_run = of_ship({name: numpy.asarray(run.peaks[name]) for name in run.peaks.dtype.names}, body["name"], start)
        of_run["case"] = numpy.full(len(of_run["t_s"]), number)
        peaks.append(of_run)
        counts = run.summary.get("load_peaks", {})
        left_out += counts.get("below_least", 0)
        beyond += counts.get("beyond_limit", 0)
        if body.get("panels"):
            rows = of_ship(read_csv(run.folder / "panels.csv"), body["name"], start)
            rows["case"] = numpy.full(len(rows["t_s"]), number)
            panels.append(rows)
    run, body = first
    with_records, scenes = with_time(cases, scenes, start, end)
    all_peaks = joined(peaks)
    all_peaks["force_N"] = all_peaks["pressure_Pa"] * all_peaks["width_m"] * all_peaks["height_m"]
    length = (body.get("panels") or {}).get("length_m", COMMON)
    is_recorded = len(panels) == len(cases) and panel in (None, length)  # panels of another length were not recorded
    return Loads(name=pathlib.Path(folder).resolve().name, ship=body["name"], is_fixed="propulsion" not in body,
                 waterline=Waterline(run.waterlines[body["name"]]), panel_m=panel or length,
                 cases=with_kinds(with_records, scenes), ended=len(cases) - len(with_records),
                 peaks=all_peaks, panels=joined(panels) if is_recorded else None,
                 interval_s=run.summary["forces_interval_s"], left_out=left_out, beyond_limit=beyond,
                 gauge_s=run.scene["record"].get("peak_response_s", 0.0))


def facing(loads, columns):
    """Directions of the middles of panels with these numbers from the middle of the waterline, as angles from ahead to
    port [rad]."""
    half = loads.waterline.length / 2
    low = numpy.clip(columns * loads.panel_m, -half, half)
    high = numpy.clip((columns + 1) * loads.panel_m, -half, half)
    points = loads.waterline.at((low + high) / 2)
    middle = loads.waterline.at(numpy.linspace(-half, half, 721)[:-1]).mean(axis=0)
    return numpy.array([math.atan2(y, x) for x, y in points - middle])
