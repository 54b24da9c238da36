"""Columns of files as tables: pandas frames, or numpy's structured arrays."""
from __future__ import annotations

import importlib

import numpy

from polynya import files
from polynya.errors import FolderError, how_to_get

NONE = -1  #: value of an absent whole number, such as the id of a floe if a body is no floe
LARGEST_WHOLE = 2.0**53  #: largest whole number of a table; up to it doubles have every whole number exactly
#: Columns of texts, in all tables of a run. A column of texts that is missing here is refused, because its cells are no
#: numbers.
WORDS = {"ship", "by_ship", "state_hash", "ended_by"}
#: Columns of whole numbers. A column that is missing here becomes one of doubles, with NaN instead of -1.
WHOLE = {"floe_id", "by_floe_id", "steps", "station", "contacts", "contacts_with_ships", "rams", "panel", "row"}


def optional(name, wanted):
    """Returns the module with this name, or None if it is not to be used. If `wanted` is None, it is used if it is
    installed; if True, it must be installed, otherwise ImportError says how to install it; if False, it is not used."""
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
    """Returns columns of equal length, {name: array}, as a pandas.DataFrame, or as a structured array of numpy if
    pandas is not installed or `pandas` is False. If `pandas` is True, it must be installed."""
    frames = optional("pandas", pandas)
    if frames:
        return frames.DataFrame(columns)
    size = len(next(iter(columns.values()))) if columns else 0
    rows = numpy.empty(size, dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        rows[name] = values
    return rows


def column(name, cells, path):
    """Converts the cells of a column, which are texts, to an array. Its type follows from its name
    (docs/run-folder.md): texts for WORDS, integers for WHOLE (NONE for an absent one), truth values for names that
    begin with is_ or has_ (True for 1, otherwise False), and otherwise numbers (NaN for an absent one). An absent
    number is an empty cell or `null`. Raises FolderError with the line of a wrong cell."""
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
    """Columns of a run's table by name, with the numbers as in the file: in its units, and not rounded. A last line
    that a killed run left incomplete is ignored. To access a missing column raises FolderError."""
    return files.Columns({name: column(name, cells, path) for name, cells in files.read_cells(path).items()}, path)


#: First columns of events and their types. They are there even if no event has them, and so are x_m, y_m, normal_x and
#: normal_y after them. Other members become columns after these, in the order in which events first have them.
FIRST = {"t_s": float, "kind": str, "ship": str, "by_ship": str, "floe": int, "parent": int,
         "by_floe": int, "children": tuple}


def flattened(event):
    """Members of an event in one row. Point, normal and offset become coordinates; members of the criterion keep their
    names, and its rule becomes `criterion`. Of two members that get the same name the later one remains, so the names
    of a criterion must differ from those of events."""
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
    """Columns of the events of events.ndjson, {name: array}, with a row for each event. An event that lacks a member,
    or has null for it, has NONE for a floe, NaN for a number, False for a truth value, and an empty text or tuple. The
    type of a column that is not in FIRST is that of its first value: truth value, text, or otherwise number."""
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
