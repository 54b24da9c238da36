"""Polynya in Python: a simulator of icebreakers in ice that cuts floes exactly (docs/python.md).

    import polynya
    simulation = polynya.Simulation("scenes/two-floes.json")
    simulation.run(until=5)
    print(simulation.time, simulation.floes.poses)

`Scene` and `Simulation` step the simulator in this process, `cut` cuts polygons exactly; these need the compiled
module. `Run` and `Study` read the folders of runs and studies back; these need numpy and the program `polynya`.
`polynya.study` plans, runs and gathers many runs of one scene (docs/studies.md); it needs plain Python and the program,
and its reports more. `polynya.statistics` has the estimators of the reports, and needs numpy and scipy.

Each public name is imported when it is first used (`__getattr__`), so that `import polynya` takes little time and a
missing package matters only to the names that need it.
"""
import os as _os

# Type checkers take this name for true, as that of typing, and so see the imports below. typing itself is not imported,
# because each case of a study starts by importing this file.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from polynya._core import FloeMemory, Floes, PilotView, Scene, SeenShip, Ship, Simulation
    from polynya.cutting import Cut, cut
    from polynya.errors import (
        FolderError, NotARunError, NotAStudyError, Problem, SceneError, SimulationError, UnfinishedError, VersionError,
        require)
    from polynya.results.run import Run
    from polynya.results.study import Study
    __version__: str

__all__ = ["Cut", "FloeMemory", "Floes", "PilotView", "Problem", "Run", "Scene",
           "SceneError", "SeenShip", "Ship", "Simulation", "SimulationError", "Study", "cut"]
__all__ += ["FolderError", "NotARunError", "NotAStudyError", "UnfinishedError", "VersionError", "require"]

# The compiled module `_core` is in the folder python_core of a build or an installation, beside the folder `python`
# that contains this package. There the package may be a link into the source tree, so the path is not resolved. From
# the source tree itself the compiled module is not found.
__path__.append(_os.path.join(_os.path.dirname(_os.path.dirname(_os.path.dirname(_os.path.abspath(__file__)))),
                              "python_core"))

# Names that __getattr__ takes from the compiled module, and from polynya.errors. A new public name belongs here or into
# __getattr__, into __all__, and into the imports above; without the first it cannot be used.
_COMPILED = {"FloeMemory", "Floes", "PilotView", "Scene", "SeenShip", "Ship", "Simulation"}
_ERRORS = {"FolderError", "NotARunError", "NotAStudyError", "Problem", "SceneError",
           "SimulationError", "UnfinishedError", "VersionError"}


def _module(name):
    """Imports the module with that full name and returns it. If a package that it needs is missing, raises ImportError
    that says how to install it. Any other ImportError is raised again as it is."""
    import importlib
    try:
        return importlib.import_module(name)
    except ImportError as error:
        from polynya.errors import missing_package
        if not missing_package(error):
            raise
        raise ImportError(f"polynya: {missing_package(error)}", name=error.name) from None


def _compiled():
    """Returns the compiled module, after adding the methods of its classes that are written in Python: record and plot
    of Simulation, and the HTML of notebooks. If it cannot be imported, raises ImportError that says why and what to do,
    for example that it is built for another version of Python; if numpy is missing, how to install it."""
    import glob
    import sys
    try:
        from polynya import _core
        _module("numpy")  # the compiled module needs it when it makes its first array
        if not hasattr(_core.Simulation, "record"):
            from polynya import recording, showing
            _core.Simulation.record, _core.Simulation.plot = recording.record, showing.plot
            _core.Simulation._repr_html_, _core.Scene._repr_html_ = showing.html_of_simulation, showing.html_of_scene
        return _core
    except ImportError as error:
        if error.name == "numpy":
            raise
        reason = error
    built = [match for folder in __path__ for match in glob.glob(_os.path.join(folder, "_core.cpython-*.so"))]
    digits = built[0].rpartition("_core.cpython-")[2].partition("-")[0] if built else ""
    running = "%d.%d" % sys.version_info[:2]
    version = f"{digits[:1]}.{digits[1:]}"
    if digits and version != running:
        raise ImportError(
            f"polynya's compiled module is built for Python {version}, and this is {running} ({sys.executable}): use "
            f"/usr/bin/python3, or build Polynya again with -DPython_EXECUTABLE={sys.executable}") from None
    raise ImportError(
        f"polynya's compiled module cannot be imported ({reason}): ./quickstart builds it and what it needs; then have "
        "build/release/python in PYTHONPATH, not the source's python folder") from reason


def _version():
    """Version of Polynya, such as "1.2.3": the one that CMake wrote beside the compiled module, or in a source tree
    that is not built, the one in CMakeLists.txt. Raises OSError if there is neither."""
    try:
        from polynya import _written_version
        return _written_version.VERSION
    except ImportError:
        import pathlib
        import re
        project = pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt"
        return re.search(r"^project\(polynya VERSION ([0-9.]+)", project.read_text(encoding="utf-8"), re.M)[1]


# Python calls this function for a name that the package itself does not have. The name is looked up in its module at
# each use, which takes little time after the first one. Raises ImportError as _module() and _compiled() do, and
# AttributeError for a name that is not public.
def __getattr__(name):
    if name in _COMPILED:
        return getattr(_compiled(), name)
    if name in ("Cut", "cut"):
        _compiled()
        return getattr(_module("polynya.cutting"), name)
    if name == "Run":
        return _module("polynya.results.run").Run
    if name == "Study":
        return _module("polynya.results.study").Study
    if name == "require":
        from polynya.errors import require
        return require
    if name in _ERRORS:
        from polynya import errors
        return getattr(errors, name)
    if name == "__version__":
        return _version()
    raise AttributeError(f"module 'polynya' has no attribute {name!r}")


def __dir__():
    return sorted(set(globals()) | set(__all__))
