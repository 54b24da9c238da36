"""Reads the folder of a study: its plan, its table and its runs."""
from __future__ import annotations

import os
import pathlib
from typing import Any, Optional, Union

import numpy

from polynya.errors import FolderError, NotAStudyError, UnfinishedError, VersionError
from polynya.files import is_number, numbers, read_cells
from polynya.study import archive, folder as folders
from polynya.study.gather import SUMMARY, TABLE, read_summary
from polynya.study.located_json import StudyError

from .run import Run
from .tables import table


class Study:
    """A folder that `polynya study` planned, ran and gathered (docs/studies.md).

    `pandas` selects the kind of `table` and of the tables of runs: a pandas frame (True), a structured array (False),
    or a frame if pandas is installed (None).

    Raises NotAStudyError if the folder has no plan; VersionError if the plan is of another format or damaged;
    FolderError if the table has not been gathered or its summary is damaged; and UnfinishedError if not all cases had
    finished when the table was gathered, except with `unfinished=True`. `table["state"]` then says which cases are
    "finished", "failed", "unfinished" (begun) or "missing" (not begun)."""

    def __init__(self, folder: Union[str, os.PathLike[str]], *, unfinished: bool = False,
                 pandas: Optional[bool] = None):
        self.folder = pathlib.Path(folder)
        self._pandas = pandas
        if not (self.folder / folders.PLAN).is_file():
            what = f"has no {folders.PLAN}" if self.folder.is_dir() else "is a file"
            what = what if self.folder.exists() else "does not exist"
            raise NotAStudyError(f"not a study's folder: {self.folder} {what}: polynya study plan FILE makes one")
        try:
            self._study = folders.open_study(self.folder)
        except StudyError as error:
            raise VersionError(str(error)) from None
        if not (self.folder / SUMMARY).is_file() or not (self.folder / TABLE).is_file():
            raise FolderError(f"{self.folder}: the study has no table: polynya study gather {self.folder} makes it")
        self.plan: dict = self._study.plan  #: contents of plan.json
        #: contents of gather.json: numbers of cases in each state, and the names of parameters and columns of the table
        self.summary: dict = read_summary(self.folder)
        if not self.summary["is_complete"] and not unfinished:
            raise UnfinishedError(
                f"{self.folder}: {self.summary['finished']} of {self.summary['cases']} cases are in the table: polynya "
                f"study run {self.folder} and "
                f"polynya study gather {self.folder} continue it; Study(folder, unfinished=True) reads what is there")

    def __repr__(self):
        return (f"<polynya study {self.name} in {self.folder}: {self.summary['finished']} of "
                f"{self.summary['cases']} cases>")

    def _repr_html_(self):
        from polynya.showing import html_of_study
        return html_of_study(self)

    @property
    def name(self) -> str:
        """Name of the study, which may differ from that of its folder."""
        return self.plan["name"]

    @property
    def parameters(self) -> list[str]:
        """Names of the columns with the varied parameters: paths of the scene, and "scene" if there are several."""
        return list(self.summary["parameters"])

    @property
    def measures(self) -> list[str]:
        """Names of the columns with measures (docs/studies.md, "Measures"); empty if no case has finished."""
        return [name for name in self.summary["columns"] if name not in ("case", "state", *self.parameters)]

    @property
    def table(self) -> Any:
        """table.csv as it was last gathered, one row per case, as a pandas frame or a structured array. A column has
        numbers if all its values are numbers, with NaN for no value, otherwise texts, with "" for no value. Each access
        reads the file. Raises FolderError if the file is damaged."""
        cells = read_cells(self.folder / TABLE)
        return table({name: values_of(name, of, cells.path) for name, of in cells.items()}, self._pandas)

    def run(self, case: int, **options: Any) -> Run:
        """The run of a case, counted from 0. Options are those of Run, with the study's `pandas` by default. Raises
        IndexError if there is no such case, and FolderError if its run folder is not there: the case has not run, the
        study keeps only summaries, or the case is packed. An existing run that is not finished is refused by Run."""
        if not 0 <= case < self._study.count:
            raise IndexError(f"there is no case {case}; the study has 0 to {self._study.count - 1}")
        found = self._study.case_folder(case) / folders.RUN
        if not found.exists():
            chunk = case // self._study.chunk_size
            packed = self._study.archive(chunk)
            why = f"is packed in {packed}" if packed.exists() else archive.state_of(found.parent)[0]
            raise FolderError(f"{found}: is not there: case {case} {'' if why.startswith('is ') else 'is '}{why}")
        return Run(found, **{"pandas": self._pandas, **options})


def values_of(name, cells, path):
    """A column of table.csv as an array: integers for "case", floats if all cells are numbers or empty, otherwise
    texts. Empty cells are NaN among numbers. `path` is the file in messages. Raises FolderError for a case that is no
    number."""
    if name == "case":
        return numpy.array(numbers(cells, path, name, absent=()), dtype=numpy.int64)
    if not all(cell == "" or is_number(cell) for cell in cells):
        return numpy.array(cells, dtype=object)
    return numpy.array(numbers(cells, path, name), dtype=float)
