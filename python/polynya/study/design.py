"""A design of cases as a CSV file that other programs write. The first line has paths of keys of the scene, and each
further line the values of one case. Empty lines are ignored. Problems name a row by its number among the rows of the
CSV file, from 1 with empty ones. It is the line of the file unless a quoted value contains a line break."""
import csv
import json
import math

from ..files import naming
from .located_json import Problem, StudyError, shown

# Largest number of cases of a design. A larger file is refused as a mistake, because all its values are kept in memory.
# A larger value would let such a file fill the memory.
LARGEST = 10**7


def read_design(file):
    """Returns {path: values}, with one value per case in the order of the file, which is UTF-8 (a byte order mark is
    ignored). Raises StudyError with the first 20 problems, each with its line, or with one problem if the file is no
    CSV or has no case. Raises OSError with the file's name if the file cannot be read."""
    with naming(file), open(file, encoding="utf-8-sig", newline="") as opened:
        try:
            rows = list(csv.reader(opened, strict=True))
        except (csv.Error, UnicodeDecodeError) as error:
            raise StudyError(Problem(str(file), "", f"found no CSV: {error}")) from None
    rows = [(number, row) for number, row in enumerate(rows, 1) if row]
    if len(rows) < 2:
        raise StudyError(Problem(str(file), "", "found no case, allowed: a line of paths, and a line a case below it"))
    return Design(str(file)).read([path.strip() for path in rows[0][1]], rows[1:])


class Design:
    """Reads the rows of one design and collects their problems, so that all are shown together; each object is used
    once. `file` is the name of the design in messages."""

    def __init__(self, file):
        self.file, self.problems = file, []

    def report(self, line, path, message):
        """Adds a problem at the first column of a line, counted from 1; `path` is empty if it concerns no single
        path."""
        self.problems.append(Problem(self.file, path, message, line, 1))

    def read(self, paths, rows):
        """Returns {path: values} for rows of (line, cells). Raises StudyError with the first 20 problems: a path twice
        or an empty one, too many cases, a row with another number of cells than there are paths, and those of value().
        Whether the scene has such a path is not checked here."""
        for path in {path for path in paths if paths.count(path) > 1 or not path}:
            self.report(1, path, "found a path twice or an empty one, allowed: each path once")
        if len(rows) > LARGEST:
            self.report(1, "", f"found {len(rows)} cases, allowed: at most {LARGEST}")
        columns = {path: [] for path in paths}
        for number, row in rows:
            if len(row) != len(paths):
                self.report(number, "", f"found {len(row)} values, allowed: {len(paths)}, one a path")
                continue
            for path, text in zip(paths, row):
                columns[path].append(self.value(number, path, text.strip()))
        if self.problems:
            raise StudyError(self.problems[:20])
        return columns

    def value(self, number, path, text):
        """Returns the value of a cell: that of a JSON text (a number, true, false, null, a quoted text, a list, an
        object), otherwise the text itself. A whole number up to 2⁵³ such as 1e3 or 2.0 becomes an int, because some
        keys of a scene accept only those; larger ones are not exact and stay floats. An empty cell is a problem and
        gives None; an infinite number or NaN is a problem too."""
        if not text:
            self.report(number, path, "found an empty value, allowed: a value in each row")
            return None
        try:
            value = json.loads(text)
        except ValueError:
            return text
        if isinstance(value, float):
            if not math.isfinite(value):
                self.report(number, path, f"found {shown(value)}, allowed: finite numbers")
            elif value.is_integer() and abs(value) <= 2**53:
                return int(value)
        return value
