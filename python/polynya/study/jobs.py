"""Runs many cases on this machine in worker processes of concurrent.futures, each with one run at a time, and shows
their progress (`polynya study run`)."""
import concurrent.futures
import multiprocessing
import os
import signal

from . import archive
from .case import DONE, FAILED, INPUT_OUTPUT, STOPPED, die_with_parent, run_case, state_of
from .folder import RUN
from .stop import SIGNALS, Stop
from .table import Counts, Display

# State of a worker process, set once by begin_worker, so that it is not sent with each case: the study (folder.Study),
# and the file descriptor that becomes readable when the command is to stop. Both stay None in the parent process.
STUDY, STOP = None, None


def begin_worker(study, stop):
    """Prepares a new worker process. It keeps only the reading end of the stop, and ignores the signals by which the
    parent is stopped: a terminal sends them to all its processes, but the run shall stop by `stop`, with a checkpoint.
    A signal that was ignored already stays ignored."""
    global STUDY, STOP
    die_with_parent(signal.SIGKILL)  # otherwise it would wait for work forever; its run then stops with a checkpoint
    STUDY, STOP = study, stop.reader
    os.close(stop.writer)
    for number in SIGNALS:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda *_: None)  # SIG_IGN cannot be used, because polynya would inherit it


def run_in_worker(number, keep):
    """Runs a case in a worker process and returns (exit code, message); the message is empty if there is nothing to
    say. `keep` is that of run_case. An OSError, such as a full disk, is the result INPUT_OUTPUT with its message; other
    exceptions are raised again in the parent process and end the command."""
    try:
        return run_case(STUDY, number, STOP, keep)
    except OSError as error:  # after a full disk, the other cases continue or fail in the same way
        return INPUT_OUTPUT, f"case {number}: {error}"


def exit_code(counts):
    """Exit code of a command that runs many cases: STOPPED if any was stopped, otherwise FAILED if any failed, also in
    an earlier command or with another code than FAILED, otherwise DONE."""
    return STOPPED if counts.stopped else FAILED if counts.failed else DONE


def run_cases(study, numbers, jobs, *, keep=None, retries_failed=False, is_quiet=False):
    """Runs those of the cases `numbers` that have not finished, `jobs` at a time, and returns exit_code(). Failed cases
    run again only with `retries_failed`; otherwise they still count as failed. `keep`, "all" or "summary", replaces the
    study's setting; None leaves it. A signal stops the runs with checkpoints. If a worker process was killed, the
    result is INPUT_OUTPUT, with a message; its case continues from its checkpoint when the command runs again."""
    counts, table, waiting = Counts(len(numbers)), Display(is_quiet), []
    for number, state in states_of(study, numbers, keep):
        counts.done += state == "finished"
        if state == "failed" and not retries_failed:
            counts.failed += 1
        elif state != "finished":
            waiting.append(number)
    counts.before = counts.done + counts.failed
    if waiting:
        stop = Stop()
        stop.raise_on_signals()
        try:
            run_waiting(study, waiting, jobs, keep, stop, counts, table)
        except concurrent.futures.process.BrokenProcessPool:
            table.message(
                "polynya study: a worker process was killed; start the command again, its case continues from its "
                "checkpoint"
            )
            return INPUT_OUTPUT
    table.show(counts, at_once=True)
    return exit_code(counts)


def states_of(study, numbers, keep):
    """Yields (number, state) of some cases, including packed ones. The states are those of case.state_of(). A finished
    case whose run folder was removed counts as missing with `keep` "all", so that it runs again, unless it is packed:
    archive.unpack_to_run() unpacks such cases before. Archives are read once if the numbers are in order. Raises
    StudyError if one is damaged."""
    packed_chunk, packed = None, []
    for number in numbers:
        chunk = number // study.chunk_size
        if chunk != packed_chunk:
            packed_chunk = chunk
            packed = archive.results_of(study, chunk) if study.archive(chunk).exists() else []
        if packed:
            yield number, packed[number - chunk * study.chunk_size]["state"]
            continue
        state, _ = state_of(study.case_folder(number))
        is_thinned = state == "finished" and keep == "all" and not (study.case_folder(number) / RUN).exists()
        yield number, "missing" if is_thinned else state


def run_waiting(study, waiting, jobs, keep, stop, counts, table):
    """Runs the waiting cases, counts how they end and updates the table, until all have ended or the stop is raised.
    Cases that have not begun by then are not counted, but the stop counts as one stopped case even if no case was
    running. Up to twice as many cases as there are workers are handed to the pool. Raises BrokenProcessPool if a worker
    is killed."""
    context = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(min(jobs, len(waiting)), context, begin_worker, (study, stop)) as pool:
        left, running = iter(waiting), {}
        while True:
            # Some cases are queued, so that no worker has to wait.
            while len(running) < 2 * jobs and not stop.is_raised:
                number = next(left, None)
                if number is None:
                    break
                running[pool.submit(run_in_worker, number, keep)] = number
            if not running:
                break
            counts.running = sorted(running.values())[:jobs]
            table.show(counts)
            # 0.2 s: the table is live, and a stop is seen, also while no case ends. A shorter time costs work.
            ended, _ = concurrent.futures.wait(running, 0.2, concurrent.futures.FIRST_COMPLETED)
            for future in ended:
                del running[future]
                count_end(counts, table, *future.result())
            if stop.is_raised:
                for future in list(running):
                    if future.cancel():
                        del running[future]
        counts.running = []
        counts.stopped = max(counts.stopped, int(stop.is_raised))


def count_end(counts, table, code, message):
    """Counts a case by its exit code and shows its message. Every code except DONE and STOPPED counts as failed."""
    if message:
        table.message(message)
    if code == DONE:
        counts.done += 1
    elif code == STOPPED:
        counts.stopped += 1
    else:
        counts.failed += 1
