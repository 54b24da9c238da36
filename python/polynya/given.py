"""The forms in which a scene may be given to polynya.Scene: a dict, JSON text, or the path of a file."""
import collections.abc
import errno
import json
import math
import os


def _plain(value):
    """Converts numpy's arrays and numbers, and paths, to types that JSON has. json.dumps calls it for each value that
    it cannot write. Raises TypeError, with the type and the value, for any other type."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a scene has no {type(value).__name__}: {value!r}")


def _first_not_finite(value, path=""):
    """Returns the path and the value of the first number that is infinite or no number, such as ("ships[0].speed",
    nan), or None if all numbers are finite. `path` is the path of `value` itself."""
    if isinstance(value, float):
        return None if math.isfinite(value) else (path, value)
    if isinstance(value, collections.abc.Mapping):
        below = ((f"{path}.{key}" if path else str(key), item) for key, item in value.items())
    elif isinstance(value, (list, tuple)):
        below = ((f"{path}[{i}]", item) for i, item in enumerate(value))
    else:
        return _first_not_finite(value.tolist(), path) if hasattr(value, "tolist") else None
    return next(filter(None, (_first_not_finite(item, at) for at, item in below)), None)


def _json_of(given):
    """JSON text of a dict. Raises ValueError with the place of a number that is not finite."""
    try:
        return json.dumps(dict(given), default=_plain, allow_nan=False)
    except ValueError:  # also for a dict that holds itself, in which the search raises RecursionError
        found = _first_not_finite(given)
        if found is None:
            raise
        raise ValueError(f"{found[0]}: found {found[1]}, allowed: a finite number") from None


def scene_parts(given):
    """Returns (path, text, has_lines) of a scene. One of path and JSON text is empty. `has_lines` is False for a dict,
    whose text is written here, so that messages must not name its lines. A str with a brace is JSON text, any other one
    a path; a path with a brace must be a pathlib.Path. Raises TypeError if the scene, or a value of the dict, has a
    type that is not allowed, FileNotFoundError if there is no such file, and ValueError for a dict with a number that
    is not finite, or nested too deep. Whether the text is a valid scene is not checked here."""
    if isinstance(given, collections.abc.Mapping):
        try:
            return "", _json_of(given), False
        except RecursionError:
            raise ValueError("the scene holds itself, or is nested too deep") from None
    if isinstance(given, str) and "{" in given:
        return "", given, True
    if not isinstance(given, (str, os.PathLike)):
        raise TypeError(f"a scene is a dict, JSON text or a path, not {type(given).__name__}")
    path = os.fsdecode(given)
    if not os.path.exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
    return path, "", True
