"""Where the program `polynya` is."""
import os
import sys


def program():
    """POLYNYA_PROGRAM where it is set, else that of this package's wheel, build or installation, else the first in the
    path."""
    given = os.environ.get("POLYNYA_PROGRAM")
    if given:
        return given
    above = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # the folder of the package, not resolved
    for place in (("polynya", "bin", "polynya"), ("..", "app", "polynya"), ("..", "..", "..", "bin", "polynya")):
        found = os.path.normpath(os.path.join(above, *place))
        if os.access(found, os.X_OK):
            return found
    return "polynya"


def main():
    """The command `polynya` of a wheel: its commands in Python run by the Python that the wheel is installed in."""
    os.environ.setdefault("POLYNYA_PYTHON", sys.executable)
    own = program()
    os.execv(own, [own] + sys.argv[1:])
