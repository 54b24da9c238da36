"""Where the program `polynya` is."""
import os


def program():
    """POLYNYA_PROGRAM where it is set, else the one beside this package, built or installed, else the first in the path."""
    given = os.environ.get("POLYNYA_PROGRAM")
    if given:
        return given
    above = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # the folder of the package, not resolved
    for place in (("..", "app", "polynya"), ("..", "..", "..", "bin", "polynya")):
        found = os.path.normpath(os.path.join(above, *place))
        if os.access(found, os.X_OK):
            return found
    return "polynya"
