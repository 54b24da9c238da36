"""Exceptions of the package, and messages about packages that this Python lacks. SceneError and SimulationError are
raised by the compiled module; the others are raised in Python."""
import dataclasses
import importlib.util
import os
import sys
import typing

# Path of Debian's own Python, the one that finds the modules of Debian's packages. Messages suggest it, and suggest
# apt-get if it is the Python that runs, otherwise pip.
DEBIANS = "/usr/bin/python3"


@dataclasses.dataclass(frozen=True)
class Problem:
    """An error or an unusual value in a scene, as `polynya validate --json` prints it."""

    file: str  #: file of the scene, or a name for a scene that is not in a file
    line: typing.Optional[int]  #: from 1; None if there is none, as for a scene from a dict
    column: typing.Optional[int]  #: from 1, in characters
    path: str  #: path of the value: "ships[0].hull.length_m"
    found: str  #: the value that was found, in words
    allowed: str  #: the values that are allowed, in words
    suggestion: str  #: nearest known key or choice; empty if none is near
    severity: str  #: "error", "warning" or "hint"
    message: str  #: message for people, without the place

    def __str__(self):
        place = [self.file] + [str(number) for number in (self.line, self.column) if number is not None]
        words = [":".join(place)] + ([] if self.severity == "error"
                                     else [self.severity]) + ([self.path] if self.path else [])
        return ": ".join(words + [self.message])


class SceneError(ValueError):
    """A scene that is wrong. `problems` lists all its errors as Problem, without warnings and hints. Its text has a
    line for each of them."""

    def __init__(self, problems):
        super().__init__(problems)
        self.problems: typing.List[Problem] = list(problems)

    def __str__(self):
        return "\n".join(str(problem) for problem in self.problems)


class InputError(Exception):
    """Wrong input of a command. `problems`, a list or one value, become the lines of its message. `code` is the exit
    code with which the command ends (app/command_line/console.hpp): 3 for a wrong scene or study, 2 for a wrong command
    line, 5 for a file."""

    def __init__(self, problems, code=3):
        self.problems = list(problems) if isinstance(problems, (list, tuple)) else [problems]
        self.code = code
        super().__init__(self.problems)

    def __str__(self):
        return "\n".join(str(problem) for problem in self.problems)


def how_to_get(*packages):
    """Returns the command, as a text, that installs packages for this Python: apt-get for Debian's own Python, pip for
    any other one, such as that of a virtual environment. `packages` are names as in imports, which Debian prefixes by
    "python3-"."""
    is_debians = os.path.realpath(sys.executable) == os.path.realpath(DEBIANS) and sys.prefix == sys.base_prefix
    if is_debians:
        return "apt-get install " + " ".join(f"python3-{name}" for name in packages)
    return f"{sys.executable} -m pip install {' '.join(packages)}"


def missing_package(error):
    """Returns a message for an ImportError: which Python lacks which package, and what to do. The message is empty if
    the missing module is a part of polynya, because this is a defect that no installation repairs. If the error does
    not name a module, as for a damaged library, the message has the text of the error."""
    name = (error.name or "").partition(".")[0]
    if name == "polynya":
        return ""
    version = sys.version.split()[0]
    found = f"{sys.executable} (Python {version}) has no {name}" if name else f"{sys.executable}: {error}"
    own = how_to_get("numpy", "scipy", "matplotlib")
    if own.startswith("apt-get"):
        return f"{found}: ./setup.sh python, or {own}"
    other = how_to_get(name) if name else "repair it there"
    return f"{found}: {other}, or use {DEBIANS} (its packages: ./setup.sh python; POLYNYA_PYTHON names it)"


def require(*packages):
    """Ends a script with a message on stderr and exit code 1 if this Python lacks one of these packages; otherwise it
    does nothing. Scripts call it before they import them. Only the first missing package is named."""
    for name in packages:
        if importlib.util.find_spec(name) is None:
            sys.exit(missing_package(ModuleNotFoundError(name=name)))


class SimulationError(RuntimeError):
    """A run that cannot continue, because a body has a speed that is not finite or is 1000 m/s or more (kRunawaySpeed),
    or because a load is more than four times the largest force that its ice can carry (overload_of in
    simulation/world/step.hpp). Both are numerical failures. The text has the time [s] and the reason."""


class FolderError(ValueError):
    """A folder of a run or a study, or a file in it, that cannot be read. The message states the file, the problem and
    what to do. The commands end with exit code 5."""


class NotARunError(FolderError):
    """A folder that contains no run."""


class NotAStudyError(FolderError):
    """A folder that contains no study."""


class UnfinishedError(FolderError):
    """A run or a study that is not finished, and was read without `unfinished=True`, which would accept it."""


class VersionError(FolderError):
    """A folder of a version that this polynya cannot read, or of a version that did not record the requested data."""
