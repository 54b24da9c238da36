"""Folder of a planned study: its files, and the places of its cases. Cases have numbers from 0, and chunks of
consecutive cases too. A chunk is what one Slurm task runs and what an archive contains.

    plan.json            the plan
    cases.ndjson         one line per case: {"scene": 0, "set": {path: value}}
    cases.index          start of each line: 8 bytes, little-endian
    scenes/…             the scenes by number, with the floe files that they name
    cases/000012/000137  a case (in the folder of its chunk if chunks have more than one case)
    cases/000012.tar     a chunk with packed cases
"""
import dataclasses
import json
import os
import pathlib
import struct
import zlib

from .. import files
from ..errors import FolderError
from .located_json import StudyError, shown

PLAN, CASES, INDEX = "plan.json", "cases.ndjson", "cases.index"
FORMAT = 1  # version of plan.json; plans of another version are refused
# Members that plan.json must have, and their types. `cases` is the number of cases, `chunk` the number of cases in a
# chunk. `archive` is true if ended chunks are packed. `keep` is "all", or "summary" if finished cases keep no run
# folder. `set` has the values, by path, that are the same for all cases. `scenes` has the files of the scenes, `varied`
# the paths that vary. `collect` and `report` are copied from the study's file (docs/studies.md).
KEYS = {
    "format": int, "name": str, "cases": int, "chunk": int, "archive": bool, "keep": str, "set": dict, "scenes": list,
    "varied": list, "collect": dict, "report": dict,
}
RESULT = "case.json"  # in a case's folder, after it has finished or failed
RUN = "run"  # run folder in a case's folder


@dataclasses.dataclass(frozen=True)
class Study:
    """A planned study."""

    folder: pathlib.Path
    plan: dict  # contents of plan.json

    @property
    def count(self):
        """Number of cases."""
        return self.plan["cases"]

    @property
    def chunk_size(self):
        """Number of cases of a chunk; the last chunk may have fewer."""
        return self.plan["chunk"]

    @property
    def chunks(self):
        """Number of chunks."""
        return -(-self.count // self.chunk_size)

    def cases_of(self, chunk):
        """The numbers of a chunk's cases."""
        return range(chunk * self.chunk_size, min((chunk + 1) * self.chunk_size, self.count))

    def chunk_folder(self, chunk):
        return self.folder / "cases" / f"{chunk:06d}"

    def archive(self, chunk):
        """The file of a packed chunk, which exists only if the chunk is packed (archive.py)."""
        return self.folder / "cases" / f"{chunk:06d}.tar"

    def case_folder(self, number):
        if self.chunk_size == 1:
            return self.folder / "cases" / f"{number:06d}"
        return self.chunk_folder(number // self.chunk_size) / f"{number:06d}"

    def case(self, number):
        """The scene's file and all values of one case by path, including those that the study sets for all. It reads
        only 8 bytes and one line, because a study may have millions of cases. Raises StudyError if the case is damaged
        or there is none with this number, and FolderError if a file cannot be opened."""
        with files.open_regular(self.folder / INDEX) as index, files.open_regular(self.folder / CASES) as cases:
            index.seek(8 * number)
            offset = index.read(8)
            cases.seek(struct.unpack("<Q", offset)[0] if len(offset) == 8 else 0, 0 if len(offset) == 8 else 2)
            return self._whole(cases.readline(), number)

    def all_cases(self):
        """Yields the scene's file and all values of every case, in order."""
        with files.open_regular(self.folder / CASES) as cases:
            for number, line in enumerate(cases):
                yield self._whole(line, number)

    def _whole(self, line, number):
        """Scene and values of a case from its line of cases.ndjson."""
        try:
            case = json.loads(line)
            return self.folder / self.plan["scenes"][case["scene"]], {**self.plan["set"], **case["set"]}
        except (ValueError, LookupError, TypeError):
            raise StudyError(f"{self.folder / CASES}:{number + 1}: damaged; remove the folder and plan the study again",
                             5) from None


def open_study(given):
    """Opens the planned study in a folder, or that of a study's file, which is planned as studies/<name>."""
    folder = planned_folder(given)
    if not (folder / PLAN).exists():
        hint = f"polynya study plan {given}" if folder != pathlib.Path(given) else "polynya study plan FILE"
        raise StudyError(f"{folder}: no study is planned there; plan it: {hint}", 5)
    return Study(folder, read_plan(folder))


def read_plan(folder):
    """Reads the plan of a planned study's folder. Raises StudyError (code 5) if it is damaged, has been changed by hand
    or has another FORMAT."""
    try:
        plan = files.read_json(folder / PLAN)
    except FolderError as error:
        raise StudyError(str(error), 5) from None
    if plan.get("format") != FORMAT:
        raise StudyError(f"{folder / PLAN}: of format {shown(plan.get('format'))}; this polynya reads format {FORMAT}: "
                         f"read it with the polynya that wrote it, or choose another folder (--out)", 5)
    damaged = [key for key, kind in KEYS.items() if not isinstance(plan.get(key), kind)]
    is_changed = plan.get("crc32") not in (None, checksum_of(plan))  # plans of older versions have no checksum
    if damaged or is_changed or plan["cases"] < 0 or plan["chunk"] < 1:
        what = f'"{damaged[0]}" is missing or of another kind' if damaged else "it is not as it was written"
        raise StudyError(f"{folder / PLAN}: damaged, {what}; remove the folder and plan the study again", 5)
    return plan


def write_plan(folder, plan):
    """Writes the plan with its checksum, which it also adds to `plan`. The checksum reveals changes by hand, because
    what was checked when the study was planned is not checked again."""
    plan["crc32"] = checksum_of(plan)
    write_atomically(folder / PLAN, json.dumps(plan, indent=1) + "\n")


def checksum_of(plan):
    """CRC-32 of a plan without its checksum, in hexadecimal digits."""
    rest = {key: value for key, value in plan.items() if key != "crc32"}
    return f"{zlib.crc32(json.dumps(rest, sort_keys=True).encode()):08x}"


def planned_folder(given):
    """The folder of a study: `given` itself, or if that is a study's file studies/<name> in the working directory,
    where it is planned by default. The folder need not exist."""
    path = pathlib.Path(given)
    if not path.is_file():
        return path
    from .definition import read_definition  # imported here, because running a case does not need it

    return pathlib.Path("studies") / read_definition(path).name


def write_atomically(path, text):
    """Replaces a file in one step, so that readers find the old or the new file, even after a kill."""
    draft = path.with_name(path.name + f".{os.getpid()}.tmp")
    with files.naming(path):
        with files.writing(draft) as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(draft, path)


def counted(count, noun):
    """A count with its noun: 1 case, 2 cases."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def list_of_numbers(numbers):
    """A list such as "3,7-9,12" for sorted numbers."""
    parts, numbers = [], list(numbers)
    i = 0
    while i < len(numbers):
        k = i
        while k + 1 < len(numbers) and numbers[k + 1] == numbers[k] + 1:
            k += 1
        parts.append(str(numbers[i]) if k == i else f"{numbers[i]}-{numbers[k]}")
        i = k + 1
    return ",".join(parts)


def numbers_of_list(words, count, what):
    """The numbers of a list such as "3,7-9,12", as of --cases, sorted and each once. Each must be below `count`. `what`
    names them in messages. Raises StudyError (code 2) for another text."""
    numbers = []
    for part in words.split(","):
        low, dash, high = part.partition("-")
        is_number = words.isascii() and low.isdigit() and (not dash or high.isdigit())
        if not is_number or int(high or low) < int(low):
            raise StudyError(f'"{words}" is no list of {what}s, such as 3,7-9,12', 2)
        if int(high or low) >= count:
            raise StudyError(f"there is no {what} {high or low}; the study has 0 to {count - 1}", 2)
        numbers.extend(range(int(low), int(high or low) + 1))
    return sorted(set(numbers))
