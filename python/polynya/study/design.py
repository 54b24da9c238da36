"""A design of cases as a CSV file that other programs write. The first line has paths of keys of the scene, and each
further line the values of one case. Empty lines are ignored."""
import csv
import json
import math

from ..files import naming
from .located_json import Problem, StudyError, shown

# Largest number of cases of a design. A larger file is refused as a mistake; `polynya study plan` also refuses more
# cases than this unless --most is given.
LARGEST = 10**7


def read_design(file):
    """Returns {path: values}, with one value per case. Raises StudyError with the first 20 problems, each with the line
    of the file."""
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
    """Reads the rows of one design and collects their problems; each object is used once. `file` is the name of the
    design in messages."""

    def __init__(self, file):
        self.file, self.problems = file, []

    def report(self, line, path, message):
        """Adds a problem at a line of the file, counted from 1; `path` is empty if it concerns no single column."""
        self.problems.append(Problem(self.file, path, message, line, 1))

    def read(self, paths, rows):
        """Returns {path: values} for rows of (line, cells). Raises StudyError."""
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
        """Returns the value of a cell: that of a JSON text (a number, true, false, a list, an object), otherwise the
        text itself. A whole number such as 1e3 or 2.0 becomes an int, because some keys of a scene accept only
        those."""
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
