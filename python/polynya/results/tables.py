"""Columns of files as tables: pandas frames, or numpy's structured arrays."""
from __future__ import annotations

import importlib

import numpy

from polynya import files
from polynya.errors import FolderError, how_to_get

NONE = -1  #: id that means no floe
LARGEST_WHOLE = 2.0**53
WORDS = {"ship", "by_ship", "state_hash", "ended_by"}
WHOLE = {"floe_id", "by_floe_id", "steps", "station", "contacts", "contacts_with_ships", "rams", "panel", "row"}


def optional(name, wanted):
    """Imports a module if it is installed and `wanted` is None. It must be installed if `wanted` is True, and is not
    used if it is False."""
    if wanted is False:
        return None
    try:
        return importlib.import_module(name)
    except ImportError as error:
        if wanted:
            package = name.partition(".")[0]
            raise ImportError(f"{package} is wanted and not installed: {how_to_get(package)} ({error})") from error
        return None


def table(columns, pandas=None):
    """Returns columns of equal length as a pandas.DataFrame, or as a structured array if pandas is not installed or is
    False."""
    frames = optional("pandas", pandas)
    if frames:
        return frames.DataFrame(columns)
    size = len(next(iter(columns.values()))) if columns else 0
    rows = numpy.empty(size, dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        rows[name] = values
    return rows


def column(name, cells, path):
    """Values of a column, whose type follows from its name (docs/run-folder.md): texts, whole numbers (-1 for none),
    truth values, or else numbers."""
    if name in WORDS:
        return numpy.array(cells, dtype=object)
    values = numpy.array(files.numbers(cells, path, name), dtype=float)
    if name in WHOLE:
        values = numpy.where(numpy.isnan(values), NONE, values)
        wrong = numpy.flatnonzero((values != numpy.floor(values)) | (numpy.abs(values) > LARGEST_WHOLE))
        if len(wrong):
            raise FolderError(f"{path}:{wrong[0] + 2}: {name}: found {cells[wrong[0]]}, allowed: a whole number")
        return values.astype(numpy.int64)
    return values == 1 if name.startswith(("is_", "has_")) else values


def read_csv(path):
    """Columns of a run's table by name, with the numbers exactly as in the file."""
    return files.Columns({name: column(name, cells, path) for name, cells in files.read_cells(path).items()}, path)


FIRST = {"t_s": float, "kind": str, "ship": str, "by_ship": str, "floe": int, "parent": int,
         "by_floe": int, "children": tuple}


def flattened(event):
    """Members of an event in one row. Point, normal and offset become coordinates; members of the criterion keep their
    names, and its rule becomes `criterion`."""
    row = {}
    for key, value in event.items():
        if key == "point_m":
            row["x_m"], row["y_m"] = value
        elif key == "normal":
            row["normal_x"], row["normal_y"] = value
        elif key == "offset_m":
            row["offset_along_m"], row["offset_across_m"] = value
        elif key == "criterion":
            row.update({"criterion" if name == "kind" else name: of for name, of in value.items()})
        else:
            row[key] = value
    return row


def event_columns(events):
    """Columns of events.ndjson. -1 means no floe, NaN no number, an empty text no text."""
    rows = [flattened(event) for event in events]
    kinds = dict(FIRST)
    kinds.update({name: float for name in ("x_m", "y_m", "normal_x", "normal_y")})
    for row in rows:
        for name, value in row.items():
            kinds.setdefault(name, bool if isinstance(value, bool) else str if isinstance(value, str) else float)
    columns = {}
    for name, kind in kinds.items():
        absent = {float: numpy.nan, int: NONE, bool: False}.get(kind, kind())
        given = [row.get(name) for row in rows]
        values = [absent if value is None else value for value in given]
        if kind in (str, tuple):
            columns[name] = numpy.empty(len(values), dtype=object)
            for i, value in enumerate(values):
                columns[name][i] = kind(value)
        else:
            columns[name] = numpy.array(values, dtype={float: float, int: numpy.int64, bool: bool}[kind])
    return columns
