"""The command line of `polynya study`: its actions and their options."""
import os

from ..arguments import WHOLE, Parser, choice, number

PROCESSORS = os.cpu_count() or 1
EXAMPLES = (
    "study plan scenes/studies/pack-ice-loads.json   expand, check and estimate",
    "study run studies/pack-ice-loads --jobs 2       all cases on this machine; resumes what stopped",
    "study slurm studies/pack-ice-loads --submit     all cases as one Slurm job array",
    "study gather studies/pack-ice-loads             one table of all cases",
    "study report studies/pack-ice-loads             statistics, pictures and a page",
)
REST = """polynya study plan --help, and so on, explains each one's options. Studies need Python 3, report also numpy,
scipy and matplotlib (./setup.sh python).

Exit codes: 0 all cases finished, 2 usage, 3 study or scene invalid, 4 cases failed, 5 input/output, 75 cases are
unfinished or were stopped.
"""


def add(parser, name, meaning, **more):
    parser.add_argument(name, help=meaning[0].upper() + meaning[1:], **more)


def add_action(actions, name, meaning, *examples):
    parser = actions.add_parser(name, meaning=meaning, examples=[f"study {name} {example}" for example in examples])
    add(parser, "study", "the study's JSON file, or the folder that plan made of it", metavar="STUDY")
    return parser


def add_plan(actions):
    plan = add_action(
        actions,
        "plan",
        "Expand a study into numbered cases, check every one and estimate time and disk",
        "scenes/studies/pack-ice-loads.json",
        "study.json --out /scratch/loads --chunk 100",
    )
    add(plan, "--out", "the study's folder; studies/<name> if not given", metavar="DIR")
    add(plan, "--design", "a CSV file with a row a case, instead of the study's own design", metavar="FILE")
    meaning = "cases of one task, folder and archive; so that there are at most 1000 tasks if not given"
    add(plan, "--chunk", meaning, type=WHOLE, metavar="N")
    meaning = "instead of the study's own; it may grow later"
    add(plan, "--repetitions", meaning, type=WHOLE, metavar="N")
    meaning = "refuse a study of more cases; ten million if not given"
    add(plan, "--most", meaning, type=WHOLE, metavar="N", default=10_000_000)
    meaning = "how long the trial of the first case may take; 20 if not given, 0: no trial"
    add(plan, "--trial-seconds", meaning, type=number(0, unit="s"), metavar="S", default=20)
    add(plan, "--check-seeds", "check also cases that differ in seeds alone, each in full", action="store_true")
    meaning = "for how many cases at a time the time is estimated; one a processor if not given"
    add(plan, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")


def add_evaluate(actions):
    evaluate = add_action(
        actions,
        "evaluate",
        "Run the cases of a design, a CSV file with a row a case, and write their measures as CSV",
        "study.json design.csv measures.csv --jobs 2",
    )
    add(evaluate, "design", "a line of scene paths, and a line of values a case", metavar="DESIGN.csv")
    add(evaluate, "measures", "what is written: a line a case, in the order of the design", metavar="MEASURES.csv")
    meaning = "where the cases run; studies/<name>-<of the design> if not given"
    add(evaluate, "--folder", meaning, metavar="DIR")
    meaning = "how many at a time; one a processor if not given"
    add(evaluate, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")
    add(evaluate, "--quiet", "do not report how far the study is", action="store_true")


def add_run(actions):
    run = add_action(
        actions,
        "run",
        "Run cases. Finished ones cost nothing; what was stopped or killed continues from its checkpoint",
        "study.json --jobs 2          plans it first where it is not planned",
        "studies/loads --case 17      one case",
        "studies/loads --cases 3,7-9 --retry-failed",
    )
    which = run.add_mutually_exclusive_group()
    add(which, "--case", "this one, in this process; exit codes as polynya run", type=number(0, kind=int), metavar="N")
    add(which, "--cases", "these, as 3,7-9; all if not given", metavar="LIST")
    meaning = "those of this chunk, as a Slurm task does; packs them where the study says archive"
    add(which, "--chunk", meaning, dest="chunk_to_run", type=number(0, kind=int), metavar="K")
    meaning = "how many at a time; one a processor if not given"
    add(run, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")
    meaning = "which records stay, instead of the study's own choice"
    add(run, "--keep", meaning, type=choice(("all", "summary")), metavar="all|summary")
    add(run, "--retry-failed", "try those again that failed", action="store_true")
    add(run, "--quiet", "do not report how far the study is", action="store_true")


def add_slurm(actions):
    slurm = add_action(
        actions,
        "slurm",
        "Write the sbatch scripts of a study: an array over its chunks, and a job that gathers; submit them",
        "studies/loads --submit --throttle 50 --time 2:00:00",
        "studies/loads --submit --sbatch=--partition=long",
    )
    add(slurm, "--submit", "submit the array, and the gathering job after it", action="store_true")
    add(slurm, "--throttle", "at most this many tasks at a time", type=WHOLE, metavar="N")
    meaning = "limit of a task; what is not done by then is queued again (1:00:00 if not given)"
    add(slurm, "--time", meaning, default="1:00:00", metavar="H:MM:SS")
    meaning = "checkpoints are written this long before the limit (120 if not given)"
    add(slurm, "--grace", meaning, type=WHOLE, default=120, metavar="S")
    meaning = "of a processor, of the gathering job too; 0: all of a node (500M, and 2G to gather, if not given)"
    add(slurm, "--memory", meaning, metavar="SIZE")
    add(slurm, "--cpus", "of a task; it runs as many cases at a time", type=WHOLE, default=1, metavar="N")
    add(slurm, "--retry-failed", "send chunks with failed cases too, and try those again", action="store_true")
    meaning = "further option of sbatch; may be repeated"
    add(slurm, "--sbatch", meaning, action="append", default=[], metavar="OPTION")


def add_others(actions):
    parallel = add_action(
        actions,
        "parallel",
        "Print the GNU parallel line that runs a study on several machines with a shared folder",
        "studies/loads --hosts n1,n2 | bash",
    )
    add(parallel, "--hosts", "names as ssh has them; this machine if not given", default="", metavar="LIST")
    meaning = "chunks at a time on each machine; one a processor if not given"
    add(parallel, "--jobs", meaning, default="100%", metavar="N")
    meaning = "Make one table of all cases and list what is missing, failed or unfinished"
    add_action(actions, "gather", meaning, "studies/loads")
    report = add_action(
        actions, "report", "Gather, then make statistics, pictures and an HTML page", "studies/loads --players none"
    )
    meaning = "make the cases' players; auto: of up to 250 cases"
    add(report, "--players", meaning, type=choice(("auto", "all", "none")), default="auto", metavar="auto|all|none")


def command_line():
    parser = Parser("polynya study", "Plan, run and gather many runs of one scene", EXAMPLES, REST)
    actions = parser.add_actions()
    for add_to in (add_plan, add_run, add_evaluate, add_slurm, add_others):
        add_to(actions)
    return parser
