"""The command line of `polynya study`: its actions and their options."""
import argparse
import os

PROCESSORS = os.cpu_count() or 1


def positive(kind, words):
    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = 0
        if not value > 0 or value == float("inf"):
            raise argparse.ArgumentTypeError(f"found {text}, allowed: {words}")
        return value

    return read


WHOLE = positive(int, "a whole number > 0")


def add(parser, name, meaning, **more):
    parser.add_argument(name, help=meaning, **more)


def add_action(actions, name, meaning, *examples):
    lines = "\n".join(f"  polynya study {name} {example}" for example in examples)
    parser = actions.add_parser(
        name,
        help=meaning,
        description=f"Examples:\n{lines}\n\n{meaning}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add(parser, "study", "the study's JSON file, or the folder that plan made of it", metavar="STUDY")
    return parser


def add_plan(actions):
    plan = add_action(
        actions,
        "plan",
        "Expand a study into numbered cases, check every one and estimate time and disk.",
        "scenes/studies/pack-ice-loads.json",
        "study.json --out /scratch/loads --chunk 100",
    )
    add(plan, "--out", "the study's folder; studies/<name> if not given", metavar="DIR")
    meaning = "cases of one task, folder and archive; so that there are at most 1000 tasks if not given"
    add(plan, "--chunk", meaning, type=WHOLE, metavar="N")
    meaning = "instead of the study's own; it may grow later"
    add(plan, "--repetitions", meaning, type=WHOLE, metavar="N")
    meaning = "refuse a study of more cases; ten million if not given"
    add(plan, "--most", meaning, type=WHOLE, metavar="N", default=10_000_000)
    meaning = "how long the trial of the first case may take; 20 if not given, 0: no trial"
    add(plan, "--trial-seconds", meaning, type=float, metavar="S", default=20)
    add(plan, "--check-seeds", "check also cases that differ in seeds alone, each in full", action="store_true")
    meaning = "for how many cases at a time the time is estimated; one a processor if not given"
    add(plan, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")


def add_run(actions):
    run = add_action(
        actions,
        "run",
        "Run cases. Finished ones cost nothing; what was stopped or killed continues from its checkpoint.",
        "study.json --jobs 2          plans it first where it is not planned",
        "studies/loads --case 17      one case",
        "studies/loads --cases 3,7-9 --retry-failed",
    )
    which = run.add_mutually_exclusive_group()
    add(which, "--case", "this one, in this process; exit codes as polynya run", type=int, metavar="N")
    add(which, "--cases", "these, as 3,7-9; all if not given", metavar="LIST")
    meaning = "those of this chunk, as a Slurm task does; packs them where the study says archive"
    add(which, "--chunk", meaning, dest="chunk_to_run", type=int, metavar="K")
    meaning = "how many at a time; one a processor if not given"
    add(run, "--jobs", meaning, type=WHOLE, default=PROCESSORS, metavar="N")
    add(run, "--keep", "which records stay, instead of the study's own choice", choices=("all", "summary"))
    add(run, "--retry-failed", "try those again that failed", action="store_true")
    add(run, "--quiet", "do not report how far the study is", action="store_true")


def add_slurm(actions):
    slurm = add_action(
        actions,
        "slurm",
        "Write the sbatch scripts of a study: an array over its chunks, and a job that gathers; submit them.",
        "studies/loads --submit --throttle 50 --time 2:00:00",
        "studies/loads --submit --sbatch=--partition=long",
    )
    add(slurm, "--submit", "submit the array, and the gathering job after it", action="store_true")
    add(slurm, "--throttle", "at most this many tasks at a time", type=WHOLE, metavar="N")
    meaning = "limit of a task; what is not done by then is queued again (1:00:00 if not given)"
    add(slurm, "--time", meaning, default="1:00:00", metavar="H:MM:SS")
    meaning = "checkpoints are written this long before the limit (120 if not given)"
    add(slurm, "--grace", meaning, type=WHOLE, default=120, metavar="S")
    add(slurm, "--memory", "of a processor (500M if not given)", default="500M", metavar="SIZE")
    add(slurm, "--cpus", "of a task; it runs as many cases at a time", type=WHOLE, default=1, metavar="N")
    add(slurm, "--retry-failed", "send chunks with failed cases too, and try those again", action="store_true")
    meaning = "further option of sbatch; may be repeated"
    add(slurm, "--sbatch", meaning, action="append", default=[], metavar="OPTION")


def add_others(actions):
    parallel = add_action(
        actions,
        "parallel",
        "Print the GNU parallel line that runs a study on several machines with a shared folder.",
        "studies/loads --hosts n1,n2 | bash",
    )
    add(parallel, "--hosts", "names as ssh has them; this machine if not given", default="", metavar="LIST")
    meaning = "chunks at a time on each machine; one a processor if not given"
    add(parallel, "--jobs", meaning, default="100%", metavar="N")
    meaning = "Make one table of all cases and list what is missing, failed or unfinished."
    add_action(actions, "gather", meaning, "studies/loads")
    report = add_action(
        actions, "report", "Gather, then make statistics, pictures and an HTML page.", "studies/loads --players none"
    )
    meaning = "make the cases' players; auto: of up to 250 cases"
    add(report, "--players", meaning, choices=("auto", "all", "none"), default="auto")


def command_line():
    parser = argparse.ArgumentParser(prog="polynya study")
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    for add_to in (add_plan, add_run, add_slurm, add_others):
        add_to(actions)
    return parser
