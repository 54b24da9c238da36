"""What goes wrong: problems of scenes with their places, and runs that cannot continue."""
import dataclasses
import typing


@dataclasses.dataclass(frozen=True)
class Problem:
    """One thing wrong, or unusual, in a scene."""

    file: str
    line: typing.Optional[int]  #: from 1; None where there is none: a scene from a dict
    column: typing.Optional[int]  #: from 1, in characters
    path: str  #: of the value: "ships[0].hull.length_m"
    found: str
    allowed: str
    suggestion: str  #: the nearest known key or choice; empty where none is near
    severity: str  #: "error", "warning" or "hint"
    message: str  #: for people, without the place

    def __str__(self):
        place = [self.file] + [str(number) for number in (self.line, self.column) if number is not None]
        words = [":".join(place)] + ([] if self.severity == "error" else [self.severity]) + ([self.path] if self.path else [])
        return ": ".join(words + [self.message])


class SceneError(ValueError):
    """A scene that is wrong. `problems` lists all that is, each with its place."""

    def __init__(self, problems):
        super().__init__(problems)
        self.problems: typing.List[Problem] = list(problems)

    def __str__(self):
        return "\n".join(str(problem) for problem in self.problems)


class SimulationError(RuntimeError):
    """A run that cannot continue: numbers that are none, or a runaway speed."""


class FolderError(ValueError):
    """A folder of a run or a study that cannot be read. The message has the file, what is wrong and what to do."""


class NotARunError(FolderError):
    """A folder that holds no run."""


class NotAStudyError(FolderError):
    """A folder that holds no study."""


class UnfinishedError(FolderError):
    """A run or a study that is not finished, read without `unfinished=True`."""


class VersionError(FolderError):
    """A folder of a version that this polynya does not read, or of one that did not record what is asked for."""
