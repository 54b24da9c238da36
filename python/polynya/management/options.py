"""The command line of `polynya management`.

Options for the gates (--body, --upstream, --near, --width, --size, --from) have no default here: those that are not
given are None. gates.gates_of computes the values that are not given; the help states them. For a study these options
and --label are refused, because its cases were measured with the gates of its own collect.management."""
from ..arguments import Parser, choice, choices, number
from ..figures.options import FORMATS, STYLES

# Examples in the help, without the word "polynya", and (REST) the text after the options.
EXAMPLES = (
    "management runs/ice-management",
    "management runs/managed runs/unmanaged --body drillship --upstream 700 --width 300",
    "management runs/ice-management --size 30 --out pictures",
    "management studies/ice-management             gathers a study and ranks its patterns, with intervals",
)
REST = """Gates are lines across the drift, upstream of the protected body (docs/management.md). For a study, the
measures are those that its collect.management requests. Needs Python 3 with numpy, scipy for the ranking of a
study, and matplotlib for the figures (./setup.sh python).
"""


def command_line():
    """Returns the parser of the command. A value that is not allowed ends the process with a message and exit code 2.
    Distances must be above 0 and below 1e6 m."""
    meaning = "Measure the effect of ice management, and rank the patterns of a study"
    parser = Parser("polynya management", meaning, EXAMPLES, REST)
    parser.add("folders", "Run folders, which are compared, or the folder of a study", metavar="FOLDER", nargs="+")
    meaning = ("Name of the protected ship or structure; if not given, the one that the pilots protect, otherwise the "
               "first moored ship, otherwise the first structure")
    parser.add("--body", meaning, metavar="NAME")
    distance = number(0, 1e6, "m", is_open=True)
    parser.add("--upstream", "Distance of the upstream gate from the body [m]; beyond the patterns if not given",
               type=distance, metavar="M")
    meaning = "Distance of the gate near the body [m]; 1.5 times the body's radius if not given"
    parser.add("--near", meaning, type=distance, metavar="M")
    parser.add("--width", "Width of the gates [m]; that of the widest pattern if not given", type=distance, metavar="M")
    meaning = "Size √area of the smallest floe that counts as a hit [m]; 20 if not given"
    parser.add("--size", meaning, type=distance, metavar="M")
    meaning = "Count only from this time on [s]; 0 if not given"
    parser.add("--from", meaning, type=number(0, 1e7, "s"), dest="start", metavar="S")
    parser.add("--out", "Folder for tables and figures; the first given folder if not given", metavar="DIR")
    meaning = "Names of the runs, separated by commas; the differences of their folder names if not given"
    parser.add("--label", meaning, type=lambda text: text.split(","), action="extend", default=[], metavar="NAME,...")
    meaning = "Size of the figures: for one column of a page, for its whole width (if not given), or for slides"
    parser.add("--style", meaning, type=choice(STYLES), default="two-columns", metavar="|".join(STYLES))
    meaning = "File formats of the figures, separated by commas; svg,png if not given"
    parser.add("--format", meaning, type=choices(FORMATS), default=["svg", "png"], metavar="|".join(FORMATS))
    parser.add("--json", "Print the measures or the ranking as JSON, and write no table or figure", action="store_true")
    return parser
