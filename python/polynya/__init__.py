"""Polynya in Python: exact fracture of ice by icebreakers (docs/python.md).

    import polynya
    simulation = polynya.Simulation("scenes/two-floes.json")
    simulation.run(until=5)
    print(simulation.time, simulation.floes.poses)

`Scene` and `Simulation` step the simulator in this process, `cut` cuts polygons exactly; these need the compiled module.
`Run` and `Study` read the folders of runs and studies back; these need numpy.
`polynya.study` plans, runs and gathers many runs of one scene (docs/studies.md), `polynya.statistics` has the estimators of its reports;
these need plain Python and the program `polynya`.
"""
import os as _os

TYPE_CHECKING = False  # typing's, without its import: every case of a study starts with this file
if TYPE_CHECKING:
    from polynya._core import FloeMemory, Floes, PilotView, Scene, SeenShip, Ship, Simulation
    from polynya.cutting import Cut, cut
    from polynya.errors import (
        FolderError, NotARunError, NotAStudyError, Problem, SceneError, SimulationError, UnfinishedError, VersionError)
    from polynya.results.run import Run
    from polynya.results.study import Study
    __version__: str

__all__ = ["Cut", "FloeMemory", "Floes", "PilotView", "Problem", "Run", "Scene", "SceneError", "SeenShip", "Ship", "Simulation", "SimulationError", "Study", "cut"]
__all__ += ["FolderError", "NotARunError", "NotAStudyError", "UnfinishedError", "VersionError"]

# The compiled module lies beside the folder that this package is in: that may be a link into the source tree, so its own
# path is not resolved.
__path__.append(_os.path.join(_os.path.dirname(_os.path.dirname(_os.path.dirname(_os.path.abspath(__file__)))), "python_core"))

_COMPILED = {"FloeMemory", "Floes", "PilotView", "Scene", "SeenShip", "Ship", "Simulation"}
_ERRORS = {"FolderError", "NotARunError", "NotAStudyError", "Problem", "SceneError", "SimulationError", "UnfinishedError", "VersionError"}


def _compiled():
    try:
        from polynya import _core
    except ImportError as error:
        raise ImportError(
            f"polynya's compiled module cannot be imported ({error}): install what it needs with ./setup.sh python, build Polynya "
            "again (cmake --preset dev && cmake --build --preset dev), and have build/dev/python in PYTHONPATH, not the source's "
            "python folder") from error
    return _core


def _version():
    """CMake's PROJECT_VERSION: as it wrote it beside the package, or in a source tree that is not built, its own text."""
    try:
        from polynya import _written_version
        return _written_version.VERSION
    except ImportError:
        import pathlib
        import re
        project = pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt"
        return re.search(r"^project\(polynya VERSION ([0-9.]+)", project.read_text(encoding="utf-8"), re.M)[1]


def __getattr__(name):
    if name in _COMPILED:
        return getattr(_compiled(), name)
    if name in ("Cut", "cut"):
        _compiled()
        from polynya import cutting
        return getattr(cutting, name)
    if name == "Run":
        from polynya.results import run
        return run.Run
    if name == "Study":
        from polynya.results import study as of_studies
        return of_studies.Study
    if name in _ERRORS:
        from polynya import errors
        return getattr(errors, name)
    if name == "__version__":
        return _version()
    raise AttributeError(f"module 'polynya' has no attribute {name!r}")


def __dir__():
    return sorted(set(globals()) | set(__all__))
