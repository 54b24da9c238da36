"""Writes a run folder for a simulation that Python steps, as `polynya run` does."""
from __future__ import annotations

import os
import pathlib
import subprocess

from .program import program


class Recording:
    """Writes the folder while the simulation is stepped. The `with` block, or `close()`, ends it.

    The folder equals that of `polynya run` for the scene up to the simulated time at which it is closed, byte for byte
    except for wall times, unless a Python pilot has steered. An exception in the block leaves a run that was stopped,
    with a checkpoint, and is raised again. An end before the first step leaves a stopped run without a checkpoint.
    `polynya resume` continues a stopped run from its checkpoint, or without one from the beginning; with --until it
    also continues a finished one. It uses the scene's own pilots, not those in Python."""

    def __init__(self, simulation, folder, overwrite, map):
        self.folder = pathlib.Path(folder)
        self._simulation, self._map, self._is_open = simulation, map, True
        simulation._record(os.fspath(folder), overwrite)

    def __enter__(self):
        return self

    def __exit__(self, kind, error, traceback):
        # The reason is that of summary.json: "KeyError: 'mine'". The exception is raised again.
        self.close("" if kind is None else f"{kind.__name__}: {error}".rstrip(": "))

    def close(self, stopped_by=""):
        """Ends the run at the present time. With a reason, which the folder states, the run counts as stopped and not
        as finished. Later steps are not recorded. A second call does nothing. Raises FolderError if a file could not be
        written, also if that happened at an earlier step. That the map cannot be drawn is no error: it is then
        missing."""
        if not self._is_open:
            return
        self._is_open = False
        self._simulation._end_recording(stopped_by)
        if self._map and not stopped_by:  # the program draws the map that a finished run lacks
            subprocess.run([program(), "resume", self.folder], capture_output=True, check=False)

    @property
    def run(self):
        """Returns the folder as a polynya.Run, read anew at each access. Raises UnfinishedError if the recording is not
        closed or was stopped."""
        from .results.run import Run
        return Run(self.folder)


def record(self, folder, *, overwrite=False, map=True):
    """record(folder, overwrite=False, map=True)

    Writes a run folder as `polynya run` does (docs/run-folder.md). Call it before the first step. Returns a Recording,
    which ends the folder at the end of a `with` block or by its close(). With `overwrite` an earlier run in the folder
    is replaced; without it, such a folder is refused. A folder that contains something else is always refused. `map`
    draws final.svg and final.png at the end, unless the run was stopped. Raises FolderError if the folder cannot be
    used or written, and RuntimeError after the first step or if the simulation is recorded already."""
    return Recording(self, folder, overwrite, map)
