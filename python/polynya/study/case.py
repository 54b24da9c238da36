"""Runs one case of a study in its own folder, resumes it from a checkpoint, or finds it finished. `study` is a
folder.Study, and `number` that of the case."""
import ctypes
import errno
import fcntl
import json
import os
import select
import shutil
import signal
import subprocess
import time

from .. import files
from ..errors import FolderError
from ..program import program

from . import measures
from .folder import RESULT, RUN, write_atomically

DONE, FAILED, INPUT_OUTPUT, STOPPED = 0, 4, 5, 75  # exit codes of app/command_line/console.hpp
# Value of `stopped_by` in summary.json from the start of a run until it ends in an orderly way. If a run that did not
# crash has ended and still has this value, the machine is the cause, for example a lack of memory, and another try may
# succeed (docs/run-folder.md). It must be equal to the text in io/run/run_writer.cpp.
KILLED = "still running, or killed"
# Signals that mean an error of the program, which would occur again, so that the case counts as failed. Other signals
# come from the machine or a user, and the case is continued by the next call.
CRASHES = (signal.SIGABRT, signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL)
# Largest length of the messages of a failed run that are kept [characters]; of longer ones the end is kept, because it
# says why the run ended. It limits the size of the results of a study in which all cases fail.
KEPT_WORDS = 2000
PR_SET_PDEATHSIG = 1  # first argument of prctl() in die_with_parent(), from <linux/prctl.h>
LIBC = ctypes.CDLL(None)  # the C library, found once before a child needs it


def die_with_parent(number):
    """Asks the kernel to send this process the signal `number` when its parent ends for any reason, even SIGKILL. Call
    it in the child. A failure is ignored."""
    LIBC.prctl(PR_SET_PDEATHSIG, number)


def state_of(folder):
    """Returns the state of the case in a folder, and its result, which is None unless it is finished or failed. The
    state is "finished", "failed", "unfinished" (it was begun, or its result is damaged) or "missing"."""
    if not (folder / RESULT).exists():
        return ("unfinished" if (folder / RUN).exists() else "missing"), None
    try:
        result = files.read_json(folder / RESULT)
    except FolderError:
        return "unfinished", None
    return (result["state"], result) if is_result(result) else ("unfinished", None)


def is_result(result):
    """Returns True if a value that was read from JSON has the members that the result of a case needs: a known state,
    and measures or a message."""
    if not isinstance(result, dict):
        return False
    kinds = {"finished": {"measures": dict}, "failed": {"message": str}}.get(result.get("state"))
    return kinds is not None and all(isinstance(result.get(key), kind) for key, kind in kinds.items())


def run_case(study, number, stop=None, keep=None, retries_failed=True):
    """Runs a case to its end and returns (exit code, message); the message is empty if there is nothing to say. A case
    that failed before runs again if `retries_failed`; otherwise its code is returned. When the file descriptor `stop`
    becomes readable, the run is stopped with a checkpoint. `keep`, "all" or "summary", replaces the study's own
    setting. A finished case returns at once, unless its run folder was removed and `keep` is "all": then it runs again.
    A case that another process runs at the same time is refused with INPUT_OUTPUT. Raises OSError if the folder cannot
    be used."""
    if stop is not None and select.select([stop], [], [], 0)[0]:
        return STOPPED, ""
    folder = study.case_folder(number)
    folder.mkdir(parents=True, exist_ok=True)
    keep = keep or study.plan["keep"]
    lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return INPUT_OUTPUT, f"case {number}: another process runs it"
        state, result = state_of(folder)
        if state == "failed" and not retries_failed:
            return result.get("exit_code", FAILED), f"case {number} has failed before; --retry-failed runs it again"
        if state == "finished" and (keep == "summary" or (folder / RUN).exists()):
            return DONE, ""
        return carry(study, number, folder, lock, stop, keep)
    finally:
        os.close(lock)


def carry(study, number, folder, lock, stop, keep):
    """Runs or resumes the case, then measures it and writes the result (case.json). Returns (exit code, message). A run
    that was stopped or killed leaves no result, so that the next call resumes it; both give STOPPED. An earlier result
    is removed first. With `keep` "summary" the run folder is removed at the end. `lock` is the file descriptor of the
    case's folder, which is locked."""
    run, began = folder / RUN, time.monotonic()
    (folder / RESULT).unlink(missing_ok=True)
    if not is_finished(run):
        code, words = run_program(command_of(study, number, run), lock, stop)
        if code == STOPPED:
            return STOPPED, f"case {number}: stopped; it continues from its checkpoint"
        if -code in CRASHES:
            last = (words.strip() or "no message").splitlines()[-1]
            return failed(study, number, folder, code, f"polynya: crashed by signal {-code}: {last}")
        if code < 0:
            return STOPPED, f"case {number}: killed by signal {-code}; it continues from its newest checkpoint"
        if code != DONE:
            return failed(study, number, folder, code, words)
    try:
        found = measures.measure(run, study.plan["collect"], program())
        summary = files.read_json(run / "summary.json")
        kept = {key: summary[key] for key in ("version", "scene_hash", "warnings", "wall_time_s")}
    except (OSError, ValueError, KeyError) as error:
        return failed(study, number, folder, INPUT_OUTPUT, f"its measures: {error}")
    elapsed = round(time.monotonic() - began, 3)
    result = {"state": "finished", **case_in_words(study, number), "measures": found, **kept, "elapsed_s": elapsed}
    write_atomically(folder / RESULT, json.dumps(result) + "\n")
    if keep == "summary":
        shutil.rmtree(run, ignore_errors=True)
    # Cases are never extended, and thousands of checkpoints need much space.
    for checkpoint in run.glob("checkpoint-*.bin"):
        checkpoint.unlink()
    return DONE, ""


# Returns the members of a result that say which case it is: its number, scene, and values by path.
def case_in_words(study, number):
    scene, values = study.case(number)
    return {"case": number, "scene": scene.stem, "set": values}


def failed(study, number, folder, code, words):
    """Returns (exit code, message) of a failure, given by its exit code and the program's messages `words`. One that
    would occur again is recorded as the case's result, and jobs.run_cases() then runs the case again only with
    --retry-failed. A failure of the machine, such as a full disk or a lack of memory, is not recorded, so that the case
    stays unfinished."""
    words = words.strip()[-KEPT_WORDS:] or without_words(folder, code)
    is_killed = code > 0 and summary_of(folder / RUN).get("stopped_by") == KILLED
    if code == INPUT_OUTPUT or is_killed:
        return code, f"case {number}: {gist(words)}"
    result = {"state": "failed", **case_in_words(study, number), "exit_code": code, "message": words}
    write_atomically(folder / RESULT, json.dumps(result) + "\n")
    return code, f"case {number}: {gist(words)}"


def without_words(folder, code):
    """Describes a run that left no message by its exit code, and by the full disk if there is one: it also prevents the
    run from writing its message."""
    is_full = os.statvfs(folder).f_bavail == 0
    return f"exit code {code}" + (f"; {folder}: {os.strerror(errno.ENOSPC)}" if is_full else "")


def gist(words):
    """Returns the line of a program's messages that says why it ended: its first message with "polynya: ", without that
    prefix, otherwise the first line, which is the first problem of a scene. Messages that nothing was written do not
    count. `words` must not be empty."""
    lines = words.splitlines()
    stops = [line for line in lines if line.startswith("polynya: ") and "nothing was written" not in line]
    return (stops or lines)[0].removeprefix("polynya: ")


def summary_of(run):
    """Returns summary.json of a run as a dict, which is empty if the file cannot be read."""
    try:
        return files.read_json(run / "summary.json")
    except FolderError:
        return {}


# Returns True if the run in a folder has reached its end.
def is_finished(run):
    return summary_of(run).get("finished") is True


# Returns the command that runs a case: it resumes the run in the folder `run` if there is one, otherwise starts it with
# the case's values.
def command_of(study, number, run):
    if (run / "scene.json").exists():
        return [program(), "resume", run, "--no-map", "--progress", "none"]
    scene, values = study.case(number)
    words = [program(), "run", scene, "--out", run, "--overwrite", "--no-map", "--progress", "none"]
    for path, value in values.items():
        words += ["--set", f"{path}={json.dumps(value)}"]
    return words


def run_program(words, lock, stop):
    """Runs a program until it ends, or until `stop` becomes readable: then the program is asked to stop. Returns its
    exit code, which is minus the signal that ended it, and its output on stderr. The program inherits the case's lock,
    so that nobody else runs the case as long as it runs. It stops with a checkpoint if this process is killed. Its
    messages go to messages.txt in the folder of the case, which is removed at the end. Raises OSError if the program
    cannot be started."""

    def in_child():
        die_with_parent(signal.SIGHUP)
        # Background jobs of a shell ignore these signals, and polynya would inherit that and could not be stopped.
        for number in (signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)

    with open(os.path.join(f"/proc/self/fd/{lock}", "messages.txt"), "w+b") as messages:
        child = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=messages,
            start_new_session=True,
            pass_fds=[lock],
            preexec_fn=in_child,
        )
        ended = os.pidfd_open(child.pid)
        try:
            ready, _, _ = select.select([ended] + ([stop] if stop is not None else []), [], [])
            if ended not in ready:
                # SIGTERM is not used: Slurm sends it to every process of a job, and a second one ends polynya at once.
                child.send_signal(signal.SIGINT)
            code = child.wait()
        finally:
            os.close(ended)
        messages.seek(0)
        text = messages.read().decode("utf-8", "replace")
    os.unlink(os.path.join(f"/proc/self/fd/{lock}", "messages.txt"))
    return code, text
