"""A design of cases as a CSV file that other programs write: a column for each path of a scene's key, a row for each
case."""
import csv
import json
import math

from ..files import naming
from .located_json import Problem, StudyError, shown

LARGEST = 10**7  # largest number of rows


def read_design(file):
    """Values by path, as lists with one value per row. Raises StudyError with all problems."""
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
    """Reads one design; each object is used once."""

    def __init__(self, file):
        self.file, self.problems = file, []

    def report(self, line, path, message):
        self.problems.append(Problem(self.file, path, message, line, 1))

    def read(self, paths, rows):
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
        """A number, true or false, JSON, or otherwise the text itself."""
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
