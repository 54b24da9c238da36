"""The command line of `polynya management`."""
from ..arguments import Parser, number

EXAMPLES = (
    "management runs/ice-management",
    "management runs/managed runs/unmanaged --body drillship --upstream 700 --width 300",
    "management runs/ice-management --size 30 --out pictures",
    "management studies/ice-management             of a gathered study, by what it varies",
)
REST = """Gates are lines across the drift, upstream of the body that is protected (docs/management.md). Of a study the
measures are those that its collect.management asks for. Needs Python 3 with numpy, and matplotlib for the figures
(./setup.sh python).
"""


def command_line():
    meaning = "State what ice management did: floes through gates, hits, loads, effort"
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
    parser.add("--json", "Print the measures as JSON, and write nothing", action="store_true")
    return parser
