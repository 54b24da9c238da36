"""Finds and starts the program `polynya`, which is written in C++."""
import os
import sys


def program():
    """Returns the path of the program. The environment variable POLYNYA_PROGRAM is used if it is set and not empty,
    without a check that such a file exists. Otherwise the program is searched beside this package: in a wheel, a build
    folder and an installation, in this order. If it is in none of them, the result is the bare name, which the system
    searches in PATH when the program is started; starting it raises FileNotFoundError if it is not there either."""
    given = os.environ.get("POLYNYA_PROGRAM")
    if given:
        return given
    above = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    # `above` is the folder that contains the package. Links are not resolved, because the package in a build folder is
    # a link into the source tree, where there is no program.
    for place in (("polynya", "bin", "polynya"), ("..", "app", "polynya"), ("..", "..", "..", "bin", "polynya")):
        found = os.path.normpath(os.path.join(above, *place))
        if os.access(found, os.X_OK):
            return found
    return "polynya"


def main():
    """The command `polynya` of a wheel: replaces this process by the program, with the same arguments. Commands that
    are written in Python use the Python in which the wheel is installed, unless POLYNYA_PYTHON names another one. It
    does not return. Raises OSError if the program cannot be started."""
    os.environ.setdefault("POLYNYA_PYTHON", sys.executable)
    own = program()
    os.execvp(own, [own] + sys.argv[1:])
