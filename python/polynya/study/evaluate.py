"""`polynya study evaluate`: runs the cases of a design, a CSV file with one row per case, and writes their measures. It
is made for programs that choose the next cases from the measures of the previous ones, such as optimisers."""
import argparse
import hashlib
import pathlib
import shutil

from ..files import read_text, writing
from . import gather, jobs, plan
from .case import DONE, INPUT_OUTPUT
from .definition import read_definition


def folder_of(options, definition):
    """Returns the folder for the cases as a Path: `options.folder`, or a folder below studies/ of the current folder,
    named by a hash of the texts of the study and of the design. With the same texts finished cases are reused; other
    texts have another folder. The scenes are not part of the hash: if one was changed after cases had ended, planning
    refuses the folder. Raises FolderError if a file cannot be read."""
    if options.folder:
        return pathlib.Path(options.folder)
    digest = hashlib.sha256((read_text(options.study) + "\0" + read_text(options.design)).encode()).hexdigest()
    return pathlib.Path("studies") / f"{definition.name}-{digest[:12]}"


def evaluate(options):
    """Plans, runs and gathers a design, and copies the table to the file `options.measures`, which is replaced. There
    is no trial, and at most as many cases as `polynya study plan` allows by default. A case that has failed before is
    not run again. Returns the exit code of gather, DONE only if every case is finished, or INPUT_OUTPUT if a worker
    process was killed. The table is written in all these cases; rows of cases that are not finished have no measures.
    Raises StudyError, and writes no table, if the study cannot be planned."""
    folder = folder_of(options, read_definition(options.study, options.design))
    planning = argparse.Namespace(out=folder, chunk=None, repetitions=None, most=10_000_000, trial_seconds=0,
                                  check_seeds=False, jobs=options.jobs, design=options.design)
    study = plan.plan_study(options.study, planning)
    ran = jobs.run_cases(study, range(study.count), options.jobs, keep=None, retries_failed=False,
                         is_quiet=options.quiet)
    gathered = gather.gather(study)
    code = INPUT_OUTPUT if ran == INPUT_OUTPUT else gathered
    with open(study.folder / gather.TABLE, encoding="utf-8", newline="") as table, writing(options.measures,
                                                                                          newline="") as out:
        shutil.copyfileobj(table, out)
    if not options.quiet and code == DONE:
        print(f"measures    {options.measures}")
    return code
