"""Reading files of runs and studies strictly, and writing files so that every error names them.

Every fault in a file that is read raises FolderError, whose message names the file and, if there is one, the line. The
module needs no numpy, because the jobs of a study use it, which should need little memory."""
import contextlib
import csv
import json
import math
import os
import re
import stat
import subprocess

from .errors import FolderError
from .program import program

# Longest cell of a CSV file [characters]. Python's own limit of 131 072 could refuse a file that polynya has written.
# This one is the largest that Python accepts on every system; a smaller one may refuse long cells.
LONGEST_CELL = 2**31 - 1
# Longest value in a message [characters]; longer ones end in an ellipsis. Larger: a damaged file may fill the screen.
LONGEST_SHOWN = 60


def check_run(folder):
    """Lets the program read and check a run folder, as `polynya inspect` does, so that Python can read it afterwards
    without checking each value again. Returns nothing. Raises FolderError, with the program's message, if the folder is
    damaged or the program cannot be started."""
    words = [program(), "read-run", "--", os.fspath(folder)]
    try:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    except OSError as error:
        raise FolderError(f"{words[0]}: {error.strerror}: run folders are checked by the program polynya, which "
                          f"POLYNYA_PROGRAM names") from None
    if done.returncode != 0:
        message = done.stderr.decode("utf-8", "surrogateescape").strip()
        raise FolderError(message or f"{folder}: polynya read-run ended with {done.returncode}")


def open_regular(path):
    """Opens a file to read its bytes and returns the file object, which the caller closes. Raises FolderError if the
    file is missing or cannot be opened, or for pipes, devices and folders: reading a pipe could wait for ever."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError:
        raise FolderError(f"{path}: is not there") from None
    except OSError as error:
        raise FolderError(f"{path}: {error.strerror}") from None
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise FolderError(f"{path}: not a regular file")
    return open(descriptor, "rb")


# Returns the contents of a file as bytes. Raises FolderError if it cannot be opened or read.
def read_bytes(path):
    try:
        with open_regular(path) as file:
            return file.read()
    except OSError as error:
        raise FolderError(f"{path}: {error.strerror}") from None


def read_text(path):
    """Returns the text of a file in UTF-8, without a byte order mark at its start, and with its line ends as they are.
    Raises FolderError, with the line, for bytes that are not UTF-8."""
    data = read_bytes(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise FolderError(f"{path}:{line}: not a text in UTF-8: found the byte 0x{data[error.start]:02x}") from None


def whole_lines(path):
    """Returns the lines of a file without their line breaks. A last line that has no line break, which a killed run may
    leave, is incomplete and is ignored. Only "\\n" is a line break; a "\\r" before it stays in the line."""
    text = read_text(path)
    return text[: text.rfind("\n") + 1].split("\n")[:-1]


@contextlib.contextmanager
def naming(path):
    """Within this context an OSError without the name of a file gets the name `path`. An error of write(), for example
    on a full disk, has none, so that its message would not say which file is meant. All errors are raised again."""
    try:
        yield
    except OSError as error:
        if error.filename is None:
            error.filename = os.fspath(path)
        raise


@contextlib.contextmanager
def writing(path, **more):
    """Opens a text file for writing in UTF-8; an existing file is emptied first. An OSError names the file. After an
    error, the part that was written stays under the name. `more` are further arguments of open()."""
    with naming(path), open(path, "w", encoding="utf-8", **more) as file:
        yield file


class Members(dict):
    """A JSON object of a file. Accessing a missing member by [] raises FolderError with the file's name; get() returns
    its default as in any dict."""

    def __init__(self, pairs, path):
        super().__init__(pairs)
        self.path = path

    def __missing__(self, key):
        raise FolderError(f'{self.path}: there is no "{key}": the file is damaged, or of another version')


class _NoNumber(ValueError):
    """Raised while parsing for a literal that is not a finite number."""


# Functions with which json.loads() reads numbers; `literal` is the text of a number. Each raises _NoNumber for one that
# is not a finite double.
def _refuse(literal):
    raise _NoNumber(literal)


def _number(literal):
    value = float(literal)
    return value if math.isfinite(value) else _refuse(literal)


def _whole(literal):
    return int(literal) if len(literal) < 19 else _number(literal)  # longer ones may exceed 64 bits: rounded to doubles


# Python parses a number beyond the range of doubles as infinity, or as an integer of any length. The functions above
# refuse these, but make parsing about ten times slower. So they are used only if a text may contain such a number: an
# exponent of three digits, or 19 digits in a row.
MAY_BE_BEYOND = re.compile(r"[eE]\+?[0-9]{3}|[0-9]{19}")


def parse_json(text, path, line=1, pairs_hook=None):
    """Returns the value of a JSON text. `path` and `line` are the file and the line at which the text begins; they are
    used for messages alone. `pairs_hook` is the object_pairs_hook of json.loads(). Raises FolderError for a text that
    is not JSON or is nested too deep, and for NaN, Infinity and numbers beyond the range of doubles. If a key occurs
    twice in an object, the last value counts, unless the hook decides otherwise."""
    kinds = {"parse_float": _number, "parse_int": _whole} if MAY_BE_BEYOND.search(text) else {}
    try:
        return json.loads(text, object_pairs_hook=pairs_hook, parse_constant=_refuse, **kinds)
    except json.JSONDecodeError as error:
        raise FolderError(f"{path}:{line + error.lineno - 1}:{error.colno}: not JSON: {error.msg}") from None
    except _NoNumber as error:
        literal = str(error)
        at = line + text.count("\n", 0, max(0, text.find(literal)))
        raise FolderError(f"{path}:{at}: found {shortened(literal)}, allowed: a finite number") from None
    except RecursionError:
        raise FolderError(f"{path}:{line}: not JSON: nested too deep") from None


def read_json(path):
    """Returns the object of a JSON file as Members, as are all objects in it. Raises FolderError if the file is
    missing, damaged or has another value than an object."""
    found = parse_json(read_text(path), path, pairs_hook=lambda pairs: Members(pairs, path))
    if not isinstance(found, dict):
        raise FolderError(f"{path}:1: not a JSON object")
    return found


def read_json_lines(path):
    """Returns the objects of a file with one JSON object per line, as plain dicts. A last line without a line break is
    ignored (whole_lines()). Raises FolderError, with the line, for any other line, also an empty one."""
    found = []
    for number, line in enumerate(whole_lines(path), 1):
        found.append(parse_json(line, path, number))
        if not isinstance(found[-1], dict):
            raise FolderError(f"{path}:{number}: not a JSON object")
    return found


class Columns(dict):
    """Columns of a table by name, as lists or arrays. Accessing a missing column by [] raises FolderError with the
    file's name, `path`."""

    def __init__(self, columns, path):
        super().__init__(columns)
        self.path = path

    def __missing__(self, name):
        raise FolderError(f'{self.path}:1: there is no column "{name}": the file is damaged, or of another version')


def read_cells(path):
    """Returns the cells of a CSV file as Columns: for each name of the first line a list of texts, all of one length. A
    table with only its names has empty lists. An incomplete last line is ignored (whole_lines()). Raises FolderError
    for a missing file, a file without names, with a name twice, or with a row of another length."""
    csv.field_size_limit(LONGEST_CELL)
    reader = csv.reader(line + "\n" for line in whole_lines(path))
    rows, places = [], []
    try:
        for row in reader:
            rows.append(row)
            places.append(reader.line_num)
    except csv.Error as error:
        raise FolderError(f"{path}:{reader.line_num}: not CSV: {error}") from None
    if not rows or not rows[0]:
        raise FolderError(f"{path}: empty, without the names of its columns")
    names = rows[0]
    if len(set(names)) < len(names):
        raise FolderError(f"{path}:1: two columns of one name")
    for row, place in zip(rows, places):
        if len(row) != len(names):
            raise FolderError(f"{path}:{place}: {len(row)} cells below {len(names)} names of columns")
    return Columns({name: [row[i] for row in rows[1:]] for i, name in enumerate(names)}, path)


def is_number(cell):
    """Returns True if a cell is a finite number, such as 1.5 or -2e-3. Python would also accept 1_000 and nan."""
    try:
        return "_" not in cell and math.isfinite(float(cell))
    except ValueError:
        return False


def numbers(cells, path, name, absent=("", "null")):
    """Converts the cells of a column to a list of floats. A cell that is in `absent` becomes NaN. `path` and `name`, of
    the file and the column, are for messages. Raises FolderError for a cell that is neither a finite number nor absent;
    its line is right if no cell of the file contains a line break."""
    try:
        values = list(map(float, cells))
        if all(map(math.isfinite, values)) and "_" not in "".join(cells):
            return values
    except ValueError:
        pass
    for row, cell in enumerate(cells):
        if cell not in absent and not is_number(cell):
            raise FolderError(f"{path}:{row + 2}: {name}: found {shortened(cell)}, allowed: a finite number")
    return [math.nan if cell in absent else float(cell) for cell in cells]


def shortened(words):
    """Returns a text as a message shows it: at most LONGEST_SHOWN characters, and in quotes with escapes if it is not
    printable, so that a damaged file cannot send commands to the terminal."""
    words = repr(words) if not words.isprintable() else words
    return words if len(words) <= LONGEST_SHOWN else words[: LONGEST_SHOWN - 1] + "…"
