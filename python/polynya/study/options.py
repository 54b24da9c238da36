"""The command line of `polynya study`: its actions and their options. Each option is checked alone here; __main__.py
and the modules of the actions check them against the study."""
import os

from ..arguments import WHOLE, Parser, choice, number

PROCESSORS = os.cpu_count() or 1  # default number of cases that run at a time
# Lines of --help, each with the arguments of a command and its effect. Parser puts "polynya" in front.
EXAMPLES = (
    "study plan scenes/studies/pack-ice-loads.json   expand, check and estimate",
    "study run studies/pack-ice-loads --jobs 2       all cases on this machine; resumes what stopped",
    "study slurm studies/pack-ice-loads --submit     all cases as one Slurm job array",
    "study gather studies/pack-ice-loads             one table of all cases",
    "study report studies/pack-ice-loads             statistics, pictures and a page",
)
# Text that --help prints after the options.
REST = """polynya study plan --help, and so on, explains each one's options. Studies need Python 3; report also needs
numpy, scipy and matplotlib (./setup.sh python).

Exit codes: 0 all cases finished, 2 usage, 3 study or scene invalid, 4 cases failed, 5 input/output, 75 cases are
unfinished or were stopped.
"""


def add(parser, name, meaning, **more):
    """Adds an option, or a positional argument, with its meaning for --help, whose first letter is made a capital.
    `more` are arguments of add_argument()."""
    parser.add_argument(name, help=meaning[0].upper() + meaning[1:], **more)


def add_action(actions, name, meaning, *examples):
    """Adds an action, such as plan, with its argument STUDY and examples without "polynya study" and its own name.
    Returns its parser."""
    parser = actions.add_parser(name, meaning=meaning, examples=[f"study {name} {example}" for example in examples])
    add(parser, "study", "JSON file of the study, or the folder that plan made from it", metavar="STUDY")
    return parser


# The functions below add one action each, and add_others() the rest. `actions` is the result of Parser.add_actions().
def add_plan(actions):
    plan = add_action(
        actions,
        "plan",
        "Expand a study into numbered cases, check every one and estimate time and disk",
        "scenes/studies/pack-ice-loads.json",
        "study.json --out /scratch/loads --chunk 100",
    )
    add(plan, "--out", "folder for the study; studies/<name> if not given", metavar="DIR")
    add(plan, "--design", "CSV file with one row per case, instead of the study's own design", metavar="FILE")
    meaning = "number of cases per task, folder and archive; if not given, such that there are at most 1000 tasks"
    add(plan, "--chunk", meaning, type=WHOLE, metavar="N")
    meaning = "number of repetitions, instead of the study's own; it may grow later"
    add(plan, "--repetitions", meaning, type=WHOLE, metavar="N")
    meaning = "refuse a study with more cases than this; ten million if not given"
    add(plan, "--most", meaning, type=WHOLE, metavar="N", default=10_000_000)
    meaning = "longest duration of the trial of the first case [s]; 20 if not given, 0: no trial"
    add(plan, "--trial-seconds", meaning, type=number(0, unit="s"), metavar="S", default=20)
    add(plan, "--check-seeds", "also check each case that differs from others only in its seeds", action="store_true")
    meaning = "number of cases at a time for which the time is estimated; one per processor if not given"
    add(plan, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")


def add_evaluate(actions):
    evaluate = add_action(
        actions,
        "evaluate",
        "Run the cases of a design, a CSV file with one row per case, and write their measures as CSV",
        "study.json design.csv measures.csv --jobs 2",
    )
    meaning = "CSV file: a line with paths of the scene, then one line of values per case"
    add(evaluate, "design", meaning, metavar="DESIGN.csv")
    meaning = "CSV file to write, with one line per case in the order of the design"
    add(evaluate, "measures", meaning, metavar="MEASURES.csv")
    meaning = "folder for the cases; studies/<name>-<hash of the design> if not given"
    add(evaluate, "--folder", meaning, metavar="DIR")
    meaning = "number of cases at a time; one per processor if not given"
    add(evaluate, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")
    add(evaluate, "--quiet", "do not show progress", action="store_true")


def add_run(actions):
    run = add_action(
        actions,
        "run",
        "Run cases. Finished cases are skipped; cases that were stopped or killed continue from their checkpoints",
        "study.json --jobs 2          plans the study first if it is not planned",
        "studies/loads --case 17      one case",
        "studies/loads --cases 3,7-9 --retry-failed",
    )
    which = run.add_mutually_exclusive_group()
    meaning = "run only this case, in this process, with the exit codes of polynya run"
    add(which, "--case", meaning, type=number(0, kind=int), metavar="N")
    add(which, "--cases", "run only these cases, such as 3,7-9; all if not given", metavar="LIST")
    meaning = "run only the cases of this chunk, as a Slurm task does, and pack them if the study sets archive"
    add(which, "--chunk", meaning, dest="chunk_to_run", type=number(0, kind=int), metavar="K")
    meaning = "number of cases at a time; one per processor if not given"
    add(run, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")
    meaning = "which records of cases are kept, instead of the study's setting"
    add(run, "--keep", meaning, type=choice(("all", "summary")), metavar="all|summary")
    add(run, "--retry-failed", "run failed cases again", action="store_true")
    add(run, "--quiet", "do not show progress", action="store_true")


def add_slurm(actions):
    slurm = add_action(
        actions,
        "slurm",
        "Write the Slurm scripts of a study, a job array over its chunks and a job that gathers, and submit them",
        "studies/loads --submit --throttle 50 --time 2:00:00",
        "studies/loads --submit --sbatch=--partition=long",
    )
    meaning = "submit the array, and the gathering job after it; if not given, only write the scripts"
    add(slurm, "--submit", meaning, action="store_true")
    add(slurm, "--throttle", "largest number of tasks at a time", type=WHOLE, metavar="N")
    meaning = "time limit of a task; unfinished cases are queued again (1:00:00 if not given)"
    add(slurm, "--time", meaning, default="1:00:00", metavar="H:MM:SS")
    meaning = "time before the limit at which checkpoints are written [s] (120 if not given)"
    add(slurm, "--grace", meaning, type=WHOLE, default=120, metavar="S")
    meaning = "memory per processor, also of the gathering job; 0: all of a node (500M, and 2G to gather, if not given)"
    add(slurm, "--memory", meaning, metavar="SIZE")
    meaning = "number of processors of a task, which runs as many cases at a time"
    add(slurm, "--cpus", meaning, type=WHOLE, default=1, metavar="N")
    add(slurm, "--retry-failed", "also submit chunks with failed cases, and run those again", action="store_true")
    meaning = "another option of sbatch; may be repeated"
    add(slurm, "--sbatch", meaning, action="append", default=[], metavar="OPTION")


def add_others(actions):
    parallel = add_action(
        actions,
        "parallel",
        "Print a GNU parallel command that runs a study on several machines with a shared folder",
        "studies/loads --hosts n1,n2 | bash",
    )
    add(parallel, "--hosts", "names of the machines for ssh; this machine if not given", default="", metavar="LIST")
    meaning = "number of chunks at a time on each machine; one per processor if not given"
    add(parallel, "--jobs", meaning, default="100%", metavar="N")
    meaning = "Make one table of all cases, and list missing, failed and unfinished ones"
    add_action(actions, "gather", meaning, "studies/loads")
    report = add_action(
        actions, "report", "Gather, then make statistics, pictures and an HTML page", "studies/loads --players none"
    )
    meaning = "make the players of the cases; auto: if there are at most 250"
    add(report, "--players", meaning, type=choice(("auto", "all", "none")), default="auto", metavar="auto|all|none")


def command_line():
    """Returns the parser of the command with all its actions; `action` of the parsed options names the chosen one."""
    parser = Parser("polynya study", "Plan, run and gather many runs of one scene", EXAMPLES, REST)
    actions = parser.add_actions()
    for add_to in (add_plan, add_run, add_evaluate, add_slurm, add_others):
        add_to(actions)
    return parser
