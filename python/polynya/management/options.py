"""The command line of `polynya management`."""
from ..arguments import Parser, choice, choices, number
from ..figures.options import FORMATS, STYLES

EXAMPLES = (
    "management runs/ice-management",
    "management runs/managed runs/unmanaged --body drillship --upstream 700 --width 300",
    "management runs/ice-management --size 30 --out pictures",
    "management studies/ice-management             gathers a study and ranks its patterns, with intervals",
)
REST = """Gates are lines across the drift, upstream of the body that is protected (docs/management.md). Of a study the
measures are those that its collect.management asks for. Needs Python 3 with numpy, and matplotlib for the figures
(./setup.sh python).
"""


def command_line():
    meaning = "State what ice management did, and rank the patterns of a study"
    parser = Parser("polynya management", meaning, EXAMPLES, REST)
    parser.add("folders", "Run folders, which are compared, or a study's folder", metavar="FOLDER", nargs="+")
    parser.add("--body", "The protected ship or structure; that of the pilots if not given", metavar="NAME")
    distance = number(0, 1e6, "m", is_open=True)
    parser.add("--upstream", "Distance of the gate before management; beyond the patterns if not given",
               type=distance, metavar="M")
    parser.add("--near", "Distance of the gate at the body; 1.5 of its radius if not given", type=distance, metavar="M")
    parser.add("--width", "Of the gates; that of the widest pattern if not given", type=distance, metavar="M")
    parser.add("--size", "√area of the least floe that counts as a hit; 20 if not given", type=distance, metavar="M")
    parser.add("--from", "Counts nothing before; 0 if not given", type=number(0, 1e7, "s"), dest="start", metavar="S")
    parser.add("--out", "Folder of tables and figures; the first folder given if not", metavar="DIR")
    meaning = "Names of the runs, separated by commas; by what differs in their folders if not given"
    parser.add("--label", meaning, type=lambda text: text.split(","), action="extend", default=[], metavar="NAME,...")
    meaning = "What for: a column of a page, its whole width (if not given), or slides"
    parser.add("--style", meaning, type=choice(STYLES), default="two-columns", metavar="|".join(STYLES))
    meaning = "Which files of a figure, separated by commas; svg,png if not given"
    parser.add("--format", meaning, type=choices(FORMATS), default=["svg", "png"], metavar="|".join(FORMATS))
    parser.add("--json", "Print the measures as JSON, and write nothing", action="store_true")
    return parser
