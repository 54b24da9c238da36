"""JSON with comments whose values have places in the file, and problems with places. The program reads the text
(`polynya read-json`), so that studies and scenes follow the same rules."""
import dataclasses
import json
import re
import subprocess

from ..errors import InputError
from ..program import program

# Longest value in a message [characters]; a longer one is cut and ends with "…". It keeps messages at one or two lines
# of a terminal. Larger: a whole list may fill the screen; smaller: users may not recognise their value.
LONGEST_SHOWN = 60


@dataclasses.dataclass(frozen=True)
class Problem:
    """A problem of a file. Its text is "file:line:column: path: message"."""

    file: str  # the file as the user named it
    path: str  # keys and indices of the value, as path_in_words() writes them; empty for the whole file
    message: str
    line: int = 0  # from 1; 0 if there is no place
    column: int = 0  # from 1, in characters; not shown without a line

    def __str__(self):
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{place}: {self.path}: {self.message}" if self.path else f"{place}: {self.message}"


class StudyError(InputError):
    """Raised if a study cannot be used. It has the problems, as Problem or text, and the exit code of the command: 3 if
    the study is invalid (the default), 5 if files are missing or damaged, 2 if options are wrong."""


class LocatedJson:
    """A JSON file with comments. `value` is its contents as dicts, lists, texts and numbers (number()). problem() makes
    a problem with the place of a value. `_places` has for each value, by its JSON pointer, the line and column of the
    value, and for a member of an object also those of its key."""

    def __init__(self, file):
        """Reads the file. Raises StudyError with all faults of the text (code 3), or with the reason why the file
        cannot be read (code 5), and OSError if the program cannot be started."""
        self.file = str(file)
        done = subprocess.run([program(), "read-json", "--", self.file], capture_output=True, check=False)
        if done.returncode != 0:
            words = done.stderr.decode("utf-8", "surrogateescape").splitlines()
            code = 3 if done.returncode == 3 else 5
            raise StudyError(words or f"{self.file}: polynya read-json: {done.returncode}", code)
        read = json.loads(done.stdout, parse_float=number)
        self.value, self._places = read["value"], read["places"]

    def problem(self, path, message, of_key=False):
        """Returns a Problem of the value at a path, a list of keys and indices. Its place is that of the value, or with
        `of_key` that of the key of the value. If the file has no such value, the place is that of the innermost value
        on the path that exists, at the least the whole document. `message` says what is wrong. Nothing is raised."""
        known = len(path)
        while pointer(path[:known]) not in self._places:
            known -= 1
        place = self._places[pointer(path[:known])]
        line, column = place[2:] if of_key and known == len(path) and len(place) == 4 else place[:2]
        return Problem(self.file, path_in_words(path), message, line, column)


def number(text):
    """A number of the file: an int if its value is a whole number up to 2⁵³, also if it is written as 1e3; otherwise a
    float. The program itself reads all numbers as doubles, which are exact up to 2⁵³."""
    value = float(text)
    return int(value) if value.is_integer() and abs(value) <= 2**53 else value


def read_json(path):
    """The value of a JSON file with comments, without places. Raises what LocatedJson() raises."""
    return LocatedJson(path).value


def pointer(path):
    """A path, a list of keys and indices, as a JSON pointer (RFC 6901): /draw/of/0. The empty path is the root."""
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)


def path_in_words(path):
    """A path in the notation of messages, such as draw.of["ice.thickness_m"].normal.sd. A key that is not only letters,
    digits and underscores is in brackets and quotes; an index from 0 is in brackets. Long keys are cut. The empty path
    is an empty text."""
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
    """Cuts a text of more than LONGEST_SHOWN characters, and ends it with "…"."""
    return words if len(words) <= LONGEST_SHOWN else words[: LONGEST_SHOWN - 1] + "…"


def shown(value):
    """A value as messages show it: a JSON text, or "an object" or "a list"."""
    words = {dict: "an object", list: "a list"}.get(type(value))
    return words or shortened(json.dumps(value, ensure_ascii=False))
