"""Scripts for clusters: a Slurm job array over a study's chunks, and the command line for GNU parallel. `study` is a
folder.Study."""
import pathlib
import re
import shlex
import shutil
import subprocess

from ..program import program
from .archive import failed_in
from .case import DONE, state_of
from .folder import list_of_numbers, write_atomically
from .located_json import StudyError

# Script of the array, array.sbatch. Output is appended, because a task that is queued again has the same file. Code 75
# is that of `polynya study run` for cases that are unfinished: only if it comes after USR1, the task queues itself
# again, so that a stop by the user remains one.
SCRIPT = """#!/bin/bash
# One task runs one chunk of the study's cases. Made by `polynya study slurm`.
#SBATCH --job-name={name}
#SBATCH --array={array}
#SBATCH --time={time}
#SBATCH --mem-per-cpu={memory}
#SBATCH --cpus-per-task={cpus}
#SBATCH --output={folder}/slurm/%A_%a.txt
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --signal=B:USR1@{grace}
{more}
# USR1 comes {grace} s before the time limit: the cases write checkpoints and the task queues again to continue. What a
# node failure or a kill interrupts is queued again by --requeue, or by submitting again; finished cases cost nothing.
is_late= runner=
trap 'is_late=1; kill -TERM $runner' USR1
trap 'kill -TERM $runner' TERM
{program} study run {folder} --chunk "$SLURM_ARRAY_TASK_ID" --jobs {cpus} --quiet{retry} &
runner=$!
wait $runner; code=$?
while kill -0 $runner 2>/dev/null; do wait $runner; code=$?; done
if [ -n "$is_late" ] && [ $code = 75 ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}"
fi
exit $code
"""
# Script of the job that gathers, gather.sbatch. It has one hour and one processor, whatever --time and --cpus say;
# options of --sbatch apply to both scripts.
GATHER = """#!/bin/bash
# Gathers the study once no task of its array is left. Made by `polynya study slurm`.
#SBATCH --job-name={name}-gather
#SBATCH --time=1:00:00
#SBATCH --mem-per-cpu={gather_memory}
#SBATCH --output={folder}/slurm/gather_%j.txt
{more}
exec {program} study gather {folder}
"""


def chunks_to_run(study, retries_failed=False):
    """Numbers of the chunks with a case that has not ended, or whose archive must still be packed. With
    `retries_failed`, failed cases count as not ended, also those of packed chunks, which their tasks unpack."""
    ended = {"finished"} if retries_failed else {"finished", "failed"}
    chunks = []
    for chunk in range(study.chunks):
        if study.archive(chunk).exists():
            if retries_failed and failed_in(study, chunk):
                chunks.append(chunk)
            continue
        if study.plan["archive"] or any(state_of(study.case_folder(n))[0] not in ended for n in study.cases_of(chunk)):
            chunks.append(chunk)
    return chunks


def write_scripts(study, options):
    """Writes array.sbatch and gather.sbatch in the study's folder `slurm`, in place of earlier ones. `options` are
    those of `polynya study slurm`. Returns their paths and the number of tasks, or (None, None, 0) if no chunk has a
    case to run; earlier scripts then stay. Raises StudyError (code 2) if a path has a blank."""
    chunks = chunks_to_run(study, options.retry_failed)
    if not chunks:
        return None, None, 0
    for name in (study.folder, pathlib.Path(program())):
        if re.search(r"\s", str(name.absolute())):
            raise StudyError(f'{name.absolute()}: a blank in its name, which Slurm\'s scripts do not take', 2)
    array = list_of_numbers(chunks) + (f"%{options.throttle}" if options.throttle else "")
    values = {
        "name": study.plan["name"],
        "array": array,
        "time": options.time,
        "memory": options.memory or "500M",
        "gather_memory": options.memory or "2G",
        "cpus": options.cpus,
        "folder": study.folder.absolute(),
        "grace": options.grace,
        "program": program_path(),
        "retry": " --retry-failed" if options.retry_failed else "",
        "more": "\n".join(f"#SBATCH {line}" for line in options.sbatch),
    }
    folder = study.folder / "slurm"
    folder.mkdir(exist_ok=True)
    scripts = folder / "array.sbatch", folder / "gather.sbatch"
    for path, text in zip(scripts, (SCRIPT, GATHER)):
        write_atomically(path, text.format(**values))
    return *scripts, len(chunks)


def program_path():
    """Absolute path of the program polynya. Every machine of the cluster must find it there. If the program is not on
    the search path, its name is taken as relative to the working folder, and whether it is there is not checked."""
    found = shutil.which(program())
    return pathlib.Path(found or program()).absolute()


def submit(array, gather):
    """Submits both jobs, given by the paths of their scripts, and prints their ids. The gathering job waits until no
    task is left, however the tasks end. Raises StudyError (code 5) if sbatch refuses one. If it is the second, the
    first is submitted already, and the error says how to submit the second."""
    job = sbatch([array])
    print(f"submitted   job {job}", flush=True)
    words = [f"--dependency=afterany:{job}", str(gather)]
    try:
        print(f"            job {sbatch(words)}, to gather after it")
    except StudyError as error:
        left = f"sbatch {shlex.join(words)}"
        error.problems.append(f"job {job} runs the cases; what gathers after it is still to submit: {left}")
        raise


def sbatch(words):
    """Submits a script with the command sbatch; `words` are its arguments. Returns the number of the job as a text.
    Raises StudyError (code 5) if sbatch is missing or refuses."""
    if not shutil.which("sbatch"):
        raise StudyError(
            "sbatch is not there: submit on a machine of the cluster, or ./setup.sh slurm for one on this machine", 5
        )
    printed = subprocess.run(["sbatch", "--parsable", *words], capture_output=True, text=True, check=False)
    if printed.returncode != DONE:
        hint = ""
        if "array" in printed.stderr.lower():
            hint = "; where the array is larger than the cluster's MaxArraySize, plan again with a larger --chunk"
        raise StudyError(f"sbatch: {printed.stderr.strip()}{hint}", 5)
    return printed.stdout.strip().split(";")[0]


def parallel_line(study, hosts, jobs):
    """The chunks with cases to run, and the command line of GNU parallel that runs them, `jobs` chunks at a time on
    each of these hosts, or on this machine if there are none; "100%" is one per processor. Each chunk itself runs as
    many cases at a time as its host has processors. Failed cases do not run again. Without chunks the command line has
    no meaning; the caller does not print it."""
    chunks = chunks_to_run(study)
    login = f"--sshlogin {shlex.quote(','.join(hosts))} " if hosts else ""
    command = (
        f"{shlex.quote(str(program_path()))} study run {shlex.quote(str(study.folder.absolute()))} --quiet --chunk {{}}"
    )
    return chunks, (
        f"parallel {login}--jobs {jobs} --workdir / --joblog "
        f"{shlex.quote(str((study.folder / 'parallel.log').absolute()))} "
        f"{command} ::: {' '.join(brace(chunks))}"
    )


def brace(chunks):
    """Numbers in the form that bash expands, with {0..23} for consecutive ones."""
    for part in list_of_numbers(chunks).split(","):
        low, dash, high = part.partition("-")
        yield f"{{{low}..{high}}}" if dash else low
