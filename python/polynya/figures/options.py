"""The command line of `polynya figures`. Needs neither numpy nor matplotlib, so that --help and wrong options are
answered without them."""
from ..arguments import Parser, choice, choices, number, numbers

#: Figures that can be drawn. Each is written to figure-<name>, in all formats of --format. io/run/run_folder.hpp has
#: the same names, so that a run that gets another end loses its figures.
FIGURES = ("floes", "loads", "motion", "sizes", "energy")
#: Loads that loads.py can draw. "true" draws "mean" and "max" together. "ships" needs a run with several ships or
#: structures, and "j-over-tau-c" (docs/glossary.md) needs one that splits floes by the model `michel`.
LOADS = ("true", "mean", "max", "ships", "j-over-tau-c")
#: Styles of page.py, in its order. A style sets the width (85, 170 and 300 mm), the largest height, the sizes of text
#: and the number of maps if no times are given.
STYLES = ("one-column", "two-columns", "slides")
FORMATS = ("svg", "png", "pdf")  #: endings of the files that are written
#: Lines of --help: the arguments of a command without "polynya", and its effect.
EXAMPLES = (
    "figures runs/sawamura2017-fig4b                       figure-floes.svg, -loads, -motion, ...",
    "figures runs/sawamura2017-fig4b --at 0,185,285,550 --style one-column --format pdf",
    "figures runs/6a runs/6b --out figures                 side by side, in one scale",
    'figures runs/6a runs/6b --label "10 m","20 m" --width-mm 85 --title ""',
    "figures runs/6a --only loads --from 200 --until 300   a part of the time",
)
#: Text at the end of --help.
REST = """Needs Python 3 with numpy and matplotlib (./setup.sh python); a run's final.svg and the player need neither.
Exit codes: 0 done, 2 usage, 5 input/output, or numpy or matplotlib is missing.
"""


def command_line():
    """Returns the parser. It checks each option alone; __main__.problem_of checks them against the runs. --from and
    --until limit the curves and the times of the maps that are chosen automatically, but not those of --at."""
    parser = Parser("polynya figures", "Draw figures of a run, or of several side by side, for print", EXAMPLES, REST)
    parser.add("runs", "The run folders", nargs="+", metavar="RUN")
    meaning = "Figures to draw, separated by commas; all if not given"
    parser.add("--only", meaning, type=choices(FIGURES), default=list(FIGURES), metavar="|".join(FIGURES))
    meaning = (
        "Load to draw: true force of the ice (mean of each recording interval and largest step, or one of the two), "
        "force of other ships and structures, or the paper's j/tau_c; true if not given"
    )
    parser.add("--load", meaning, type=choice(LOADS), default="true", metavar="|".join(LOADS))
    meaning = "Size of the figures: for one column of a page, for its whole width (if not given), or for slides"
    parser.add("--style", meaning, type=choice(STYLES), default="two-columns", metavar="|".join(STYLES))
    meaning = "File formats, separated by commas; all if not given"
    parser.add("--format", meaning, type=choices(FORMATS), default=list(FORMATS), metavar="|".join(FORMATS))
    meaning = "Times of the maps [s]; chosen automatically if not given"
    parser.add("--at", meaning, type=numbers(), default=[], metavar="S,S,...")
    meaning = "Draw from this time on [s]; from the start if not given"
    parser.add("--from", meaning, dest="start", type=number(), metavar="S")
    parser.add("--until", "Draw up to this time [s]; to the end if not given", dest="end", type=number(), metavar="S")
    meaning = "Part of the world that the maps show [m]; everything if not given"
    parser.add("--window", meaning, type=numbers(count=4), metavar="X0,Y0,X1,Y1")
    meaning = "Names of the runs, separated by commas; those of their scenes if not given"
    parser.add("--label", meaning, type=lambda text: text.split(","), action="extend", default=[], metavar="NAME,...")
    parser.add("--title", 'Title that replaces those of the figures; "" for none', metavar="TEXT")
    meaning = "Width on paper [mm], instead of 85, 170 or 300 for the styles; text keeps its size"
    parser.add("--width-mm", meaning, type=number(60, 400, "mm"), metavar="MM")
    parser.add("--out", "Folder for the figures; the folder of the first run if not given", default="", metavar="DIR")
    return parser
