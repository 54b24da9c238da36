"""Imported by the examples before polynya: where none is installed, the one that ./quickstart (or ./test) built here is
found."""
import importlib.util
import pathlib
import sys

if importlib.util.find_spec("polynya") is None:
    build = pathlib.Path(__file__).resolve().parents[1] / "build"
    built = [str(build / preset / "python") for preset in ("release", "dev") if (build / preset / "python").is_dir()]
    if not built:
        sys.exit("no polynya is installed for this Python, and none is built here: ./quickstart builds it")
    sys.path.insert(0, built[0])
