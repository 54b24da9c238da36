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

# Length of panels if neither --panel nor the scene states it [m], as in the examples of docs/loads.md. Longer panels
# have more peaks each, shorter ones show places more finely.
COMMON = 2.5


class Waterline:
    """Waterline of a hull. Positions are measured from the stem to port along it, as in contacts.csv
    (simulation/ship/waterline.cpp). The stem is the foremost vertex, or the middle of the foremost edge. `ring` is the
    outline in the hull's frame [m], in either direction and not closed. It must be the same rule as in C++, or loads
    are drawn at wrong places."""

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
        """Points at these arc lengths from the stem, in the hull's frame [m], as an array of n × 2. Negative lengths
        lead to starboard, and lengths beyond the ends go on around the hull."""
        along = numpy.mod(numpy.asarray(arc, dtype=float) - self._arcs[0], self.length) + self._arcs[0]
        return numpy.column_stack([numpy.interp(along, self._arcs, self._points[:, k]) for k in (0, 1)])


@dataclasses.dataclass(frozen=True)
class Case:
    """One of the gathered runs."""

    number: int  #: number of the case in its study, 0 for a single run
    start_s: float  #: first simulated time that counts [s]
    hours: float  #: simulated time from then on to the end of the run [h]
    kilometres: float  #: distance over ground in that time [km]
    #: Name of the kind; empty if all runs are of one kind. Runs of one kind differ only in the scene's seed, name,
    #: description and duration.
    kind: str = ""


@dataclasses.dataclass
class Loads:
    """Loads of one ship or structure. `peaks` has columns of equal length: those of contacts.csv, `case`, and
    `force_N`, the force along the contact's normal. `panels` has the columns of panels.csv, or is None if there are
    none."""

    name: str  #: name of the folder of the run or study
    ship: str  #: name of the ship, structure or wall
    is_fixed: bool  #: True without propulsion; then loads are also drawn by direction
    waterline: Waterline
    panel_m: float  #: length of the panels by which peaks are counted [m]
    cases: list[Case]  #: the runs that count
    peaks: dict
    panels: Optional[dict]
    interval_s: float  #: length of the interval of a row of panels [s]
    left_out: int  #: number of peaks below the smallest that the runs record, in the whole runs
    beyond_limit: int = 0  #: number of peaks beyond the number that the runs record, in the whole runs
    gauge_s: float = 0.0  #: time constant of the gauge that measured the peaks [s]; 0: the force of each step
    ended: int = 0  #: number of runs that end before the first time that counts, and are left out

    # Simulated time of all cases together [h], the exposure of all rates.
    @property
    def hours(self):
        return sum(case.hours for case in self.cases)

    # Distance over ground of all cases together [km].
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
        """The loads of one kind of runs, as another Loads. Counts of peaks that were left out stay those of all
        runs."""
        cases = [case for case in self.cases if case.kind == kind]
        numbers = [case.number for case in cases]
        chosen = {name: table and {key: values[numpy.isin(table["case"], numbers)] for key, values in table.items()}
                  for name, table in (("peaks", self.peaks), ("panels", self.panels))}
        return dataclasses.replace(self, cases=cases, **chosen)

    def panel_of(self, arc):
        """Numbers of the panels at these positions [m]: 0 is the first one from the stem to port, -1 to starboard."""
        return numpy.floor(numpy.asarray(arc) / self.panel_m).astype(int)


def runs_of(folder):
    """(number of the case, folder) of each run: of a study those cases whose run folder is kept, otherwise the folder
    itself with the number 0. Raises FolderError if a study has no run folder."""
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


# Returns the rows of columns {name: array} that belong to a ship, from the time `start` on [s].
def of_ship(columns, ship, start):
    chosen = (columns["ship"] == ship) & (columns["t_s"] >= start)
    return {name: values[chosen] for name, values in columns.items()}


def kind_of(scene):
    """The common properties of runs of one kind, as JSON: the scene without its seed, duration, name and description.
    Seeds of fields and of draws remain, so runs that differ in these are of different kinds."""
    shared = {key: value for key, value in scene.items() if key not in ("seed", "name", "description")}
    shared["time"] = {key: value for key, value in scene["time"].items() if key != "until_s"}
    return json.dumps(shared, sort_keys=True)


def with_kinds(cases, scenes):
    """Returns the cases with the names of their kinds, formed from the differences; the names are empty if all are of
    one kind. `scenes` has what kind_of() returns for each case."""
    different = list(dict.fromkeys(scenes))
    names = names_of(different) if len(different) > 1 else {scene: "" for scene in different}
    return [dataclasses.replace(case, kind=names[scene]) for case, scene in zip(cases, scenes)]


def case_of(number, run, ship, start):
    """Returns the Case of a run from the time `start` on [s]: its duration [h] and the distance that the ship moves
    [km]. Both are 0 for a run that ends before `start`."""
    rows = of_ship(run.force_columns, ship, start)
    way = numpy.hypot(numpy.diff(rows["x_m"]), numpy.diff(rows["y_m"])).sum() if len(rows["t_s"]) else 0.0
    begin = max(start, run.start_time)
    return Case(number, begin, max(0.0, run.end_time - begin) / 3600, float(way) / 1000)


# Returns the member of the scene for the ship, structure or wall with this name; None: the first one. Raises InputError
# if there is none.
def body_of(run, ship):
    name = ship or (run.ship_names[0] if run.ship_names else None)
    if not run.ship_names:
        raise InputError(f"{run.folder}: the run has no ship or structure, so it has no loads")
    if name not in run.ship_names:
        raise InputError(f"{run.folder}: no ship or structure is named {name}; it has: {', '.join(run.ship_names)}")
    return next(body for key in ("ships", "structures", "walls") for body in run.scene.get(key, [])
                if body["name"] == name)


# Joins the columns {name: array} of several runs, which must have the same names.
def joined(parts):
    return {name: numpy.concatenate([part[name] for part in parts]) for name in parts[0]}


def with_time(cases, scenes, start, end):
    """Returns the cases that have some time from `start` [s] on, and the list of their scenes. `end` is the end of the
    longest run [s]. Raises InputError if no case is left."""
    kept = [(case, scene) for case, scene in zip(cases, scenes) if case.hours > 0]
    if not kept:
        raise InputError(f"--from {start:g}: there are no records after {start:g} s, because the longest run ends at "
                         f"{end:g} s: give an earlier time, or run longer (polynya resume RUN --until S)")
    return [list(column) for column in zip(*kept)]


def gather(folder, ship=None, start=0.0, panel=None) -> Loads:
    """Reads the peaks, and if they were recorded the panels, of a ship or structure (the first by default). Only times
    from `start` [s] of each run count. `panel` is the length of the panels by which peaks are counted [m]. Recorded
    panels are used only if all runs have them, with this length. Of the waterlines of runs only the numbers of vertices
    are compared. Unfinished runs count up to their last record. Raises InputError if a run has no such body or another
    waterline, or no time counts, and FolderError if a folder cannot be read."""
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
    port [rad], from −π to π, in the frame of the hull."""
    half = loads.waterline.length / 2
    low = numpy.clip(columns * loads.panel_m, -half, half)
    high = numpy.clip((columns + 1) * loads.panel_m, -half, half)
    points = loads.waterline.at((low + high) / 2)
    middle = loads.waterline.at(numpy.linspace(-half, half, 721)[:-1]).mean(axis=0)
    return numpy.array([math.atan2(y, x) for x, y in points - middle])
