"""The command line of `polynya performance`; ranges are those of the scene's keys."""
import os

from ..arguments import Parser, number, numbers

FLEXURAL_STRENGTH, FRICTION = 500e3, 0.1  # where the command line has none [Pa], [-]

EXAMPLES = (
    "performance polaris                       ten thicknesses, on all processors",
    "performance araon --flexural-strength 630e3 --friction 0.1",
    "performance ship.json --thickness 0.4,0.8,1.2 --out runs/our-ship",
    "performance oden --list                   the formulas alone, without a run",
)
REST = """Each thickness is a run in a plate of fast ice, repeated twice as long until the mean speed's standard error
and its change between the halves are below the error asked for. Finished runs are kept: a curve that was stopped goes
on. What a ship's file does not state is estimated where it can be (polynya ships FILE --for-performance lists it), and
a table shows how far the speed moves with each particular, by the published formulas. Needs Python 3 with numpy, and
matplotlib for the figure (./setup.sh python).
"""


def thicknesses(text):
    return sorted(set(numbers(number(1e-3, 20, "m"))(text)))


def command_line():
    meaning = "Find the speed that a ship keeps in level ice, by thickness"
    parser = Parser("polynya performance", meaning, EXAMPLES, REST)
    parser.add("ship", "A preset (polynya ships), or a JSON file with a ship as scenes have it", metavar="SHIP")
    meaning = "Thicknesses [m], as 0.4,0.8,1.2; ten up to where formulas stop the ship if not given"
    parser.add("--thickness", meaning, type=thicknesses, metavar="LIST")
    meaning = f"Of the ice; {FLEXURAL_STRENGTH:g} if not given"
    parser.add("--flexural-strength", meaning, type=number(1, 1e9, "Pa"), metavar="PA")
    meaning = f"Of ice on the hull; {FRICTION:g} if not given"
    parser.add("--friction", meaning, type=number(0, 2), metavar="MU")
    meaning = "Largest error of a mean speed, of that speed; 0.03 if not given"
    parser.add("--error", meaning, type=number(0, 1, is_open=True), default=0.03, metavar="SHARE")
    parser.add("--step", "Time step; 0.01 if not given", type=number(1e-5, 1, "s"), default=0.01, metavar="S")
    meaning = "Folder of the runs, the table and the figure; runs/performance-SHIP if not given"
    parser.add("--out", meaning, metavar="DIR")
    meaning = "Runs at a time; one a processor if not given"
    parser.add("--jobs", meaning, type=number(1, 1024, kind=int), default=os.cpu_count() or 1, metavar="N")
    parser.add("--list", "Print the formulas' speeds and run nothing", action="store_true")
    return parser
