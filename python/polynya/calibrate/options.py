"""The command line of `polynya calibrate`."""
import os

from ..arguments import Parser, number

MEANING = "Fit the two factors of bending to level-ice tests of a ship"
EXAMPLES = (
    "calibrate our-ship.json our-tests.csv                  a fit, its errors, and a ship file with the factors",
    "calibrate our-ship.json our-tests.csv --leave-out 7,9  these two are predicted instead",
    "calibrate polaris tests.csv --friction 0.05 --out calibrated",
)
REST = """TESTS.csv has a line a test, in full scale: thickness_m, flexural_strength_kPa, speed_m_per_s,
resistance_mean_kN, resistance_sd_kN, and where they are known test (its name), youngs_modulus_MPa,
compressive_strength_kPa, friction (docs/ships.md). Each run is the ship at constant speed in fast ice over
100 m; finished runs are kept: a calibration that was stopped goes on. Needs Python 3 with numpy, and
matplotlib for the figure (./setup.sh python).
"""


def command_line():
    parser = Parser("polynya calibrate", MEANING, EXAMPLES, REST)
    parser.add("ship", "A preset (polynya ships), or a JSON file with a ship as scenes have it", metavar="SHIP")
    parser.add("tests", "The tests, a CSV file", metavar="TESTS")
    meaning = "Names of tests that are not fitted but predicted, as 7,9"
    parser.add("--leave-out", meaning, type=lambda text: text.split(","), default=[], metavar="LIST")
    meaning = "Of ice on the hull where the tests have no column of it; 0.1 if not given"
    parser.add("--friction", meaning, type=number(0, 2), default=0.1, metavar="MU")
    meaning = "Points of the plane of factors that are run; 18 if not given"
    parser.add("--points", meaning, type=number(8, 1000, kind=int), default=18, metavar="N")
    meaning = "Folder of the runs, the ship file and the figure; runs/calibrate-SHIP if not given"
    parser.add("--out", meaning, metavar="DIR")
    meaning = "Runs at a time; one a processor if not given"
    parser.add("--jobs", meaning, type=number(1, 1024, kind=int), default=os.cpu_count() or 1, metavar="N")
    return parser
