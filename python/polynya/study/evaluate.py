"""`polynya study evaluate`: computes the measures of a design's cases, for programs that choose further cases from
them."""
import argparse
import hashlib
import pathlib
import shutil

from ..files import read_text, writing
from . import gather, jobs, plan
from .case import DONE
from .definition import read_definition


def folder_of(options, definition):
    """Folder for the cases. The same design finds its cases again; another design has another folder."""
    if options.folder:
        return pathlib.Path(options.folder)
    digest = hashlib.sha256((read_text(options.study) + "\0" + read_text(options.design)).encode()).hexdigest()
    return pathlib.Path("studies") / f"{definition.name}-{digest[:12]}"


def evaluate(options):
    """Plans, runs and gathers a design, and writes the table to the requested file. Returns the exit code of gather."""
    folder = folder_of(options, read_definition(options.study, options.design))
    planning = argparse.Namespace(out=folder, chunk=None, repetitions=None, most=10_000_000, trial_seconds=0,
                                  check_seeds=False, jobs=options.jobs, design=options.design)
    study = plan.plan_study(options.study, planning)
    jobs.run_cases(study, range(study.count), options.jobs, keep=None, retries_failed=False, is_quiet=options.quiet)
    code = gather.gather(study)
    with open(study.folder / gather.TABLE, encoding="utf-8", newline="") as table, writing(options.measures,
                                                                                          newline="") as out:
        shutil.copyfileobj(table, out)
    if not options.quiet and code == DONE:
        print(f"measures    {options.measures}")
    return code
