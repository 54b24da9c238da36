"""The command line of `polynya loads`. Needs neither numpy nor matplotlib."""
from ..arguments import Parser, choice, choices, number, numbers
from ..figures.options import FORMATS, STYLES

# Lines of --help, each with the arguments of a command and its effect. Parser puts "polynya" in front.
EXAMPLES = (
    "loads runs/sawamura2017-fig4b                         writes tables, figures and loads.html to its folder loads",
    "loads studies/load-peaks --out loads --from 20        all cases of a study, from 20 s of each on",
    "loads studies/load-peaks --out loads --returns 3,30   return values for 3 h and 30 h",
    "run scenes/level-plate.json --panel 2.5               also records the loads of panels",
)
# Text that --help prints after the options.
REST = """Needs Python 3 with numpy, scipy and matplotlib (./setup.sh python).
Exit codes: 0 done, 2 usage, 5 input/output, or numpy, scipy or matplotlib is missing.
"""


def command_line():
    """Returns the parser of the command. It checks the values, and stores numbers and lists instead of texts. A value
    that is not allowed ends the process with a message and exit code 2. An option that is not given is None, unless it
    has a default here; gather() and estimate then choose the value that the help states."""
    parser = Parser("polynya loads", "Peaks of the ice force by place on the hull: statistics, return values, figures",
                    EXAMPLES, REST)
    parser.add("folder", "Folder of a run or of a study", metavar="RUN|STUDY")
    meaning = "Folder for tables, figures and loads.html; if not given, loads in the folder of the run or study"
    parser.add("--out", meaning, metavar="DIR")
    parser.add("--ship", "Name of the ship or structure; the first one if not given", metavar="NAME")
    meaning = "Length of the panels by which peaks are counted [m]; if not given, that of the scene, otherwise 2.5"
    parser.add("--panel", meaning, type=number(0.1, 1000, "m"), metavar="M")
    parser.add("--from", "Use only times of each run from here on [s]", dest="start",
               type=number(0), default=0.0, metavar="S")
    meaning = ("Threshold above which the tail of the peaks is fitted [N]; if not given, the lowest one whose fit is "
               "not refuted")
    parser.add("--least", meaning, type=number(0), metavar="N")
    meaning = "Return periods [h]; the length of the record and ten times that if not given"
    parser.add("--returns", meaning, type=numbers(number(0, is_open=True)), metavar="H,H,...")
    meaning = "Also give return values for periods beyond ten times the record, with a mark"
    parser.add("--extrapolate", meaning, action="store_true")
    meaning = ("Half-width of intervals, as a fraction of the value, for which the record needed is stated; 0.2 if "
               "not given")
    parser.add("--half-width", meaning, type=number(0, 10, is_open=True), default=0.2, metavar="SHARE")
    meaning = "Size of the figures: for one column of a page, for its whole width (if not given), or for slides"
    parser.add("--style", meaning, type=choice(STYLES), default="two-columns", metavar="|".join(STYLES))
    meaning = "File formats of the figures, separated by commas; all if not given"
    parser.add("--format", meaning, type=choices(FORMATS), default=list(FORMATS), metavar="|".join(FORMATS))
    return parser
