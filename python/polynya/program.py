"""Finds the program `polynya`."""
import os
import sys


def program():
    """Returns the path of the program: POLYNYA_PROGRAM if it is set, otherwise that of this package's wheel, build or
    installation, otherwise the first on the search path."""
    given = os.environ.get("POLYNYA_PROGRAM")
    if given:
        return given
    above = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # folder of the package; links are not resolved
    for place in (("polynya", "bin", "polynya"), ("..", "app", "polynya"), ("..", "..", "..", "bin", "polynya")):
        found = os.path.normpath(os.path.join(above, *place))
        if os.access(found, os.X_OK):
            return found
    return "polynya"


def main():
    """The command `polynya` of a wheel. Its Python commands use the Python in which the wheel is installed."""
    os.environ.setdefault("POLYNYA_PYTHON", sys.executable)
    own = program()
    os.execv(own, [own] + sys.argv[1:])
