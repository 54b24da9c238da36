"""The command line of `polynya loads`. Needs neither numpy nor matplotlib."""
from ..arguments import Parser, choice, choices, number, numbers
from ..figures.options import FORMATS, STYLES

EXAMPLES = (
    "loads runs/sawamura2017-fig4b                         tables, figures and loads.html, in its folder loads",
    "loads studies/load-peaks --out loads --from 20        of all its cases, from 20 s of each on",
    "loads studies/load-peaks --out loads --returns 3,30   what is exceeded once in 3 h and in 30 h",
    "run scenes/level-plate.json --panel 2.5               records the loads of panels too",
)
REST = """Needs Python 3 with numpy, scipy and matplotlib (./setup.sh python).
Exit codes: 0 done, 2 usage, 5 input/output, or numpy, scipy or matplotlib is missing.
"""


def command_line():
    parser = Parser("polynya loads", "Peaks of the ice's force by place: statistics, return values, figures",
                    EXAMPLES, REST)
    parser.add("folder", "A run's folder, or a study's", metavar="RUN|STUDY")
    meaning = "Folder for tables, figures and loads.html; loads in the run's or study's folder if not given"
    parser.add("--out", meaning, metavar="DIR")
    parser.add("--ship", "The ship or structure; the first one if not given", metavar="NAME")
    meaning = "Length of the panels by which peaks are counted [m]; the scene's, else 2.5, if not given"
    parser.add("--panel", meaning, type=number(0.1, 1000, "m"), metavar="M")
    parser.add("--from", "Leave out what is before that time of a run [s]", dest="start",
               type=number(0), default=0.0, metavar="S")
    meaning = ("Fit the tail of peaks above this force [N]; the lowest of some forces whose tail is not refuted if not "
               "given")
    parser.add("--least", meaning, type=number(0), metavar="N")
    meaning = "Return periods [h]; the record's length and ten times it if not given"
    parser.add("--returns", meaning, type=numbers(number(0, is_open=True)), metavar="H,H,...")
    parser.add("--extrapolate", "Answer, and mark, return periods beyond ten times the record too", action="store_true")
    meaning = "State the record needed for intervals of ± this share of the value; 0.2 if not given"
    parser.add("--half-width", meaning, type=number(0, 10, is_open=True), default=0.2, metavar="SHARE")
    meaning = "What for: a column of a page, its whole width (if not given), or slides"
    parser.add("--style", meaning, type=choice(STYLES), default="two-columns", metavar="|".join(STYLES))
    meaning = "Which files of a figure, separated by commas; all if not given"
    parser.add("--format", meaning, type=choices(FORMATS), default=list(FORMATS), metavar="|".join(FORMATS))
    return parser
