"""JSON whose values know their place, as the program itself reads it (`polynya read-json`), and problems with it."""
import dataclasses
import json
import re
import subprocess

from ..errors import InputError
from ..program import program

LONGEST_SHOWN = 60  # of a value in a message [characters]


@dataclasses.dataclass(frozen=True)
class Problem:
    """One thing wrong in a file."""

    file: str
    path: str
    message: str
    line: int = 0  # from 1; 0 where there is no place
    column: int = 0

    def __str__(self):
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{place}: {self.path}: {self.message}" if self.path else f"{place}: {self.message}"


class StudyError(InputError):
    """What is wrong with a study."""


class LocatedJson:
    """A JSON file with comments. `value` is what it holds; `problem(path, …)` names a place in it."""

    def __init__(self, file):
        """Raises StudyError with every fault of the text, or with why the file cannot be read (code 5)."""
        self.file = str(file)
        done = subprocess.run([program(), "read-json", "--", self.file], capture_output=True, check=False)
        if done.returncode != 0:
            words = done.stderr.decode("utf-8", "surrogateescape").splitlines()
            code = 3 if done.returncode == 3 else 5
            raise StudyError(words or f"{self.file}: polynya read-json: {done.returncode}", code)
        read = json.loads(done.stdout, parse_float=number)
        self.value, self._places = read["value"], read["places"]

    def problem(self, path, message, of_key=False):
        """A problem of the value at a path of keys and indices, or of its key, or of the nearest one that there is."""
        known = len(path)
        while pointer(path[:known]) not in self._places:
            known -= 1
        place = self._places[pointer(path[:known])]
        line, column = place[2:] if of_key and known == len(path) and len(place) == 4 else place[:2]
        return Problem(self.file, path_in_words(path), message, line, column)


def number(text):
    """Whole where it is one, 1e3 too: in the file every number is a double."""
    value = float(text)
    return int(value) if value.is_integer() and abs(value) <= 2**53 else value


def read_json(path):
    """The value of a JSON file with comments, without places."""
    return LocatedJson(path).value


def pointer(path):
    """RFC 6901"""
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)


def path_in_words(path):
    """draw.of["ice.thickness_m"].normal.sd"""
    words = ""
    for step in path:
        if isinstance(step, int):
            words += f"[{step}]"
        elif re.fullmatch(r"\w+", step):
            words += ("." if words else "") + shortened(step)
        else:
            words += f"[{shortened(json.dumps(step, ensure_ascii=False))}]"
    return words


def shortened(words):
    return words if len(words) <= LONGEST_SHOWN else words[: LONGEST_SHOWN - 1] + "…"


def shown(value):
    """A value in a message."""
    words = {dict: "an object", list: "a list"}.get(type(value))
    return words or shortened(json.dumps(value, ensure_ascii=False))
