"""The command `polynya study ACTION …` (polynya.command starts it). Each function of an action takes the options of
options.py and returns the exit code.

Modules that only one action needs are imported by that action. This halves the start-up time and the memory of a case.
"""
import pathlib
import sys

from .. import command
from ..program import program
from .case import DONE, run_case
from .folder import PLAN, counted, numbers_of_list, open_study, planned_folder
from .located_json import StudyError
from .options import PROCESSORS, command_line
from .stop import Stop


# Action `run`: runs the cases that --chunk, --case or --cases name, or all, and plans the study first if it has no
# plan. If the study sets `archive`, packed chunks with cases that must run again are unpacked before, and chunks are
# packed afterwards, except with --case, so that the case's folder can be looked at. A chunk or case that does not exist
# is an error of usage (StudyError with code 2). Of the options, parsing allows only one of --chunk, --case and --cases.
# Returns DONE if all of these cases are finished, otherwise the code of run_cases() or run_one().
def run(options):
    study = planned(options)
    if options.chunk_to_run is not None:
        if not 0 <= options.chunk_to_run < study.chunks:
            raise StudyError(f"there is no chunk {options.chunk_to_run}; the study has 0 to {study.chunks - 1}", 2)
        numbers = study.cases_of(options.chunk_to_run)
    elif options.case is not None:
        if not 0 <= options.case < study.count:
            raise StudyError(f"there is no case {options.case}; the study has 0 to {study.count - 1}", 2)
        numbers = range(options.case, options.case + 1)
    else:
        numbers = numbers_of_list(options.cases, study.count, "case") if options.cases else range(study.count)
    if study.plan["archive"]:
        from . import archive

        archive.unpack_to_run(study, numbers, options.keep, options.retry_failed)
    if options.case is not None:
        return run_one(study, options)
    code = run_cases(study, numbers, options)
    if study.plan["archive"]:
        for chunk in archive.chunks_of(study, numbers):
            archive.pack(study, chunk)
    if options.chunk_to_run is None and not options.quiet:
        print(f"table       polynya study gather {study.folder}", file=sys.stderr)
    return code


# Runs cases in worker processes, --jobs at a time. Returns an exit code (jobs.run_cases): DONE if all are finished.
def run_cases(study, numbers, options):
    from . import jobs

    return jobs.run_cases(
        study, numbers, options.jobs, keep=options.keep, retries_failed=options.retry_failed, is_quiet=options.quiet
    )


# Runs the case --case in this process and returns the exit code of `polynya run`. For a case in a
# packed chunk this is the code of its result, because run() has unpacked the chunk before if the case must run again.
# run_case() decides whether a case runs that has ended before.
def run_one(study, options):
    number = options.case
    chunk = number // study.chunk_size
    if study.archive(chunk).exists():
        from . import archive

        result = archive.results_of(study, chunk)[number - chunk * study.chunk_size]
        return result.get("exit_code", DONE)
    stop = Stop()
    stop.raise_on_signals()
    code, message = run_case(study, number, stop.reader, options.keep, options.retry_failed)
    if message:
        print(f"polynya study: {message}", file=sys.stderr)
    if code == DONE and not options.quiet:
        print(f"case {number}: finished, {study.case_folder(number)}")
    return code


def planned(options):
    """Returns the planned study of a folder or of a study's file. A file that is not planned yet is planned with the
    defaults of `plan`, but without the trial run. Raises StudyError if the file has changed what the cases set or
    collect since it was planned, or if there is neither a file nor a planned study."""
    given = pathlib.Path(options.study)
    if not given.is_file():
        return open_study(given)
    from . import plan

    if (planned_folder(given) / PLAN).exists():
        study = open_study(given)
        plan.refuse_changed_file(given, study)
        return study
    defaults = command_line().parse_args(["plan", options.study, "--trial-seconds", "0"])
    return plan.plan_study(given, defaults)


# Action `plan`: writes the plan of a study and prints its folder, its size and the commands that run it. No case is
# run, except a short trial run unless --trial-seconds is 0.
def make_plan(options):
    from . import plan

    study = plan.plan_study(options.study, options)
    folder = study.folder
    print(f"study       {folder}: {counted(study.count, 'case')} in {counted(study.chunks, 'chunk')}")
    print(f"run it      polynya study run {folder} --jobs {PROCESSORS}, or polynya study slurm {folder} --submit")
    return DONE


# Action `slurm`: writes the scripts, and submits them with --submit. Says so, with code DONE too, if every case has
# ended and there is nothing to submit.
def send(options):
    from . import slurm

    study = open_study(options.study)
    array, gathering, tasks = slurm.write_scripts(study, options)
    if not tasks:
        print(f"{study.folder}: every case has ended; polynya study gather {study.folder}")
        return DONE
    print(f"scripts     {array}, {gathering}: {counted(tasks, 'task')}")
    if options.submit:
        slurm.submit(array, gathering)
    else:
        print(f"submit      polynya study slurm {study.folder} --submit")
    return DONE


# Action `parallel`: prints a command for GNU parallel, which a shell can run, on stdout. If every case has ended,
# stdout stays empty and stderr says so, so that a shell runs nothing.
def spread(options):
    from . import slurm

    study = open_study(options.study)
    chunks, line = slurm.parallel_line(study, [host for host in options.hosts.split(",") if host], options.jobs)
    if chunks:
        print(line)
    else:
        print(f"{study.folder}: every case has ended; polynya study gather {study.folder}", file=sys.stderr)
    return DONE


# Action `gather`: writes the table of all cases. Returns DONE only if every case is finished.
def gather(options):
    from . import gather as gathering

    return gathering.gather(open_study(options.study))


# Action `evaluate`: plans, runs and gathers the points of a design, for a program that optimises (evaluate.py).
def evaluate(options):
    from . import evaluate as evaluation

    return evaluation.evaluate(options)


# Action `report`: gathers the study, and writes its page with tables and pictures. Returns the code of gather.
def report(options):
    from . import report as made

    return made.report(open_study(options.study), options.players)


# Runs an action and returns its exit code. `words` are the arguments; by default the arguments of the process. A
# StudyError is printed by command.run() with its own exit code; one with code 3 gets a line with the number of
# problems. If the program polynya is missing, a message says so, with code 5; other errors are raised again.
def main(words=None):
    options = command_line().parse_args(words)
    actions = {
        "plan": make_plan,
        "run": run,
        "slurm": send,
        "parallel": spread,
        "report": report,
        "gather": gather,
        "evaluate": evaluate,
    }
    try:
        return actions[options.action](options)
    except StudyError as error:
        if error.code == 3:
            error.problems.append(f"polynya study: {counted(len(error.problems), 'problem')}; nothing was planned")
        raise
    except FileNotFoundError as error:
        if error.filename != program():
            raise
        return command.fail("polynya study", f"{program()} is not there; start studies by `polynya study`")


if __name__ == "__main__":
    sys.exit(command.run("study", main))
