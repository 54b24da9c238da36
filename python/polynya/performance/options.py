"""The command line of `polynya performance`. The allowed ranges of thickness, strength, friction and time step are
those of the scene's keys, so that no run is refused because of an option.

An option that is not given is None until read_options fills in DEFAULTS. Other defaults depend on the use of the
command: those of fields are in coefficients.py, that of the thicknesses in __main__.py."""
import os

from ..arguments import Parser, number, numbers

# Flexural strength [Pa] and friction on the hull [-] of the ice if they are not given. They are not the defaults of a
# scene. The speeds at full power in docs/validation.md are for these values, except Araon's strength. Larger values
# make ships slower.
FLEXURAL_STRENGTH, FRICTION = 500e3, 0.1
# Time step of the runs in level ice at full power if --step is not given [s]. With a larger one the mean load in level
# ice may be wrong by more than 5 % (docs/validation.md); a smaller one takes more time. The help of --step states it.
STEP = 0.01

# Values of options that are not given and that do not depend on the use of the command: largest error of a mean speed
# as a fraction, number of random fields per point, number of runs at a time. The help of the first two states them.
DEFAULTS = {"error": 0.03, "fields": 2, "jobs": os.cpu_count() or 1}
# Groups of options that are used together, by their names in the parsed arguments.
OF_ICE = {"thickness", "flexural_strength", "friction"}
OF_RUNS = {"step", "out", "jobs"}
OF_FIELDS = {"cover", "floe_size", "fields"}
# Options that each use of the command reads. The keys are used in messages, and use_of returns one of them. An option
# that a use does not read is refused, so that nobody believes it had an effect.
USES = {
    "the speed in level ice": OF_ICE | OF_RUNS | {"error"},
    "--list": OF_ICE,
    "--pack": OF_ICE | OF_RUNS | OF_FIELDS | {"speed"},
    "--level": OF_ICE | OF_RUNS | {"speed"},
    "--channel": OF_ICE | OF_RUNS | OF_FIELDS | {"speed"},
    "--pack --list": OF_FIELDS | {"speed", "thickness"},
    "--level --list": {"speed", "thickness"},
    "--channel --list": set(),
}

# Examples in the help, without the word "polynya", and the text after the options.
EXAMPLES = (
    "performance polaris                       ten thicknesses, on all processors",
    "performance araon --flexural-strength 630e3 --friction 0.1",
    "performance ship.json --thickness 0.4,0.8,1.2 --out runs/our-ship",
    "performance oden --list                   only the formulas, without a run",
    "performance polaris --pack                resistance in pack ice, and its fit as JSON for route planners",
    "performance polaris --channel             in a channel of brash, and minimum power by the ice class rules",
)
REST = """Each thickness is a run in a plate of fast ice, repeated twice as long until the mean speed's standard error
and its change between the halves are below the error asked for, or until it is 20 ship lengths long. Finished runs are
kept, so that a curve that was stopped continues. What a ship's file does not state is estimated where it can be
(polynya ships FILE --for-performance lists it), and a table shows how far the speed moves with each particular, by the
published formulas. Needs Python 3 with numpy, and matplotlib for the figure (./setup.sh python).

With --pack, --level or --channel the ship keeps each speed through pack ice, level ice or a channel of brash ice. The
means of the ice's force over speed, thickness, cover and floe size are a table, and their fit in Colbourne's form (k,
b, n with errors and scatter) is JSON. With --channel the thickness is that of the brash in the middle, its pores
included, and a second table has resistance and minimum power for the Finnish-Swedish ice classes.
"""


def values(one):
    """Returns a reader of a list of numbers, separated by commas, that sorts it and removes repeated ones. `one` is the
    reader of a single number. The reader raises argparse.ArgumentTypeError for a wrong number."""
    return lambda text: sorted(set(numbers(one)(text)))


thicknesses = values(number(1e-3, 20, "m"))  # reads the list of --thickness


def add_coefficients(parser):
    """Adds the options for tables of resistance: --pack, --level or --channel, of which one may be given, and the
    points of the table."""
    which = parser.add_mutually_exclusive_group()
    for name, ice in (("--pack", "pack ice"), ("--level", "level ice"), ("--channel", "a channel of brash ice, 1.5 "
                                                                          "beams wide in fast ice")):
        which.add_argument(name, help=f"Compute the resistance in {ice} at each speed instead", action="store_true")
    meaning = ("Speeds for --pack, --level and --channel [m/s]; 1,2,4 if not given, and 1,2.572,4 in a channel, where "
               "2.572 m/s are 5 knots")
    parser.add("--speed", meaning, type=values(number(0.05, 20, "m/s")), metavar="LIST")
    meaning = "Ice covers for --pack and --channel, as fractions; 0.5,0.7,0.85 and 0.8 if not given"
    parser.add("--cover", meaning, type=values(number(0.05, 0.95)), metavar="LIST")
    meaning = "Floe sizes for --pack and --channel [m]; 20,40 and 2 if not given"
    parser.add("--floe-size", meaning, type=values(number(0.5, 1000, "m")), metavar="LIST")
    meaning = "Number of random ice fields per point of the table; 2 if not given"
    parser.add("--fields", meaning, type=number(1, 1000, kind=int), metavar="N")


# Returns the parser of the command. It checks each option alone; problem_of() checks which may be given together.
def command_line():
    meaning = "Find the speed that a ship can keep in level ice of each thickness"
    parser = Parser("polynya performance", meaning, EXAMPLES, REST)
    meaning = "Name of a preset (polynya ships), or a JSON file with a ship in the form of a scene"
    parser.add("ship", meaning, metavar="SHIP")
    meaning = ("Thicknesses of the ice [m], such as 0.4,0.8,1.2; if not given, ten up to that at which Lindqvist's "
               "formula stops the ship, 0.3,0.5,0.8 with --pack and --level, and 0.6,0.8,1 with --channel")
    parser.add("--thickness", meaning, type=thicknesses, metavar="LIST")
    meaning = f"Flexural strength of the ice [Pa]; {FLEXURAL_STRENGTH:g} if not given"
    parser.add("--flexural-strength", meaning, type=number(1, 1e9, "Pa"), metavar="PA")
    meaning = f"Coefficient of friction of ice on the hull; {FRICTION:g} if not given"
    parser.add("--friction", meaning, type=number(0, 2), metavar="MU")
    meaning = "Largest accepted error of a mean speed, as a fraction of the speed; 0.03 if not given"
    parser.add("--error", meaning, type=number(0, 1, is_open=True), metavar="SHARE")
    meaning = "Time step [s]; 0.01 if not given, or with --pack, --level and --channel the default of a scene"
    parser.add("--step", meaning, type=number(1e-5, 1, "s"), metavar="S")
    meaning = ("Folder for the runs, the table and the figure; runs/performance-SHIP if not given, or with --pack, "
               "--level and --channel runs/resistance-SHIP")
    parser.add("--out", meaning, metavar="DIR")
    meaning = "Number of runs at a time; one per processor if not given"
    parser.add("--jobs", meaning, type=number(1, 1024, kind=int), metavar="N")
    add_coefficients(parser)
    meaning = ("Print only the speeds by the formulas, with --channel the ice class rules, or with --pack and --level "
               "the points of the table, without a run")
    parser.add("--list", meaning, action="store_true")
    return parser


def use_of(arguments):
    """The use of the command that the options ask for: a key of USES. Without --pack, --level, --channel and --list it
    is the first one."""
    regime = next((f"--{name}" for name in ("pack", "level", "channel") if getattr(arguments, name)), "")
    return " ".join(filter(None, [regime, "--list" if arguments.list else ""])) or next(iter(USES))


def problem_of(arguments):
    """Returns a message on the first option, in the order of the alphabet, that is given although the use of the
    command does not read it, with the uses that read it; empty if there is none."""
    use = use_of(arguments)
    for name in sorted(set().union(*USES.values()) - USES[use]):
        if getattr(arguments, name) is not None:
            others = ", ".join(other for other, names in USES.items() if name in names)
            return f"--{name.replace('_', '-')}: {use} does not use it; it is for: {others}"
    return ""


def read_options(words=None):
    """Reads the command line and fills in the values of DEFAULTS that were not given. Ends the command with exit code 2
    and a message if an option is wrong or not used. `words` are those after the command's name; None: sys.argv. Options
    whose default depends on the use stay None."""
    parser = command_line()
    arguments = parser.parse_args(words)
    if problem := problem_of(arguments):
        parser.error(problem)
    for name, value in DEFAULTS.items():
        if getattr(arguments, name) is None:
            setattr(arguments, name, value)
    return arguments
