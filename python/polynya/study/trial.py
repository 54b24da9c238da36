"""Estimates the wall time, disk space and memory of a study from a trial of its first case. All cases are assumed to
need as much as the first one."""
import os
import resource
import sys
import threading
import time

from ..files import read_json
from .case import DONE, STOPPED, run_case, state_of, summary_of
from .folder import RUN, write_plan


def estimate(study, seconds, jobs):
    """Runs the first case for at most `seconds` of wall time, prints an estimate for all cases with `jobs` at a time,
    and stores that of one case in the plan. The case keeps its result or its checkpoint, so the work is not lost. There
    is no trial if the first case has been started before, and no estimate if it fails or computes nothing in that time;
    none of this is an error, but the last two are reported on stderr. The memory is that of the largest program that
    this process has run; it is not extrapolated."""
    if state_of(study.case_folder(0))[0] != "missing":
        return
    reader, writer = os.pipe()
    timer = threading.Timer(seconds, os.write, (writer, b"stop"))
    timer.start()
    began = time.monotonic()
    try:
        code, message = run_case(study, 0, reader)
    finally:
        timer.cancel()
        timer.join()
        os.close(reader)
        os.close(writer)
    elapsed = time.monotonic() - began
    if message and code != STOPPED:
        print(f"polynya study: the trial: {message}", file=sys.stderr)
    if code not in (DONE, STOPPED):
        return
    folder = study.case_folder(0)
    part = part_done(folder, state_of(folder)[0])
    if part <= 0:
        print(f"polynya study: the trial did not come far enough in {seconds:g} s for an estimate", file=sys.stderr)
        return
    found = {
        "case_s": elapsed / part,
        "case_bytes": round(size_of(folder) / part),
        "case_memory_bytes": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024,
    }
    study.plan["estimate"] = found
    write_plan(study.folder, study.plan)
    extrapolated = f", extrapolated from {100 * part:.2g} % of it" if part < 1 else ""
    each, memory = found["case_bytes"], in_bytes(found["case_memory_bytes"])
    print(f"a case      {in_time(found['case_s'])}, {in_bytes(each)}, {memory} of memory{extrapolated}")
    total, chunk = found["case_s"] * study.count / jobs, found["case_s"] * study.chunk_size
    print(f"all {study.count:<7} {in_time(total)} with --jobs {jobs}, {in_bytes(each * study.count)} on disk")
    if study.chunk_size > 1:
        print(f"a chunk     {in_time(chunk)}: {study.chunk_size} cases")


def part_done(folder, state):
    """Fraction of the simulated time of the case in `folder` that has been computed [-]: 1 if its `state` is
    "finished", 0 if its summary has no time. Time and space are extrapolated by it, as if every simulated second cost
    the same. Runs whose floes break more and more are therefore estimated too low."""
    if state == "finished":
        return 1.0
    done = summary_of(folder / RUN).get("sim_time_s", 0)
    return done / read_json(folder / RUN / "scene.json")["time"]["until_s"] if done > 0 else 0.0


def size_of(folder):
    """Space of a folder on the disk, with whole blocks [bytes]. Checkpoints do not count, because a finished case has
    none."""
    return sum(
        entry.stat().st_blocks * 512
        for entry in [folder, *folder.rglob("*")]
        if not entry.name.startswith("checkpoint-")
    )


def in_time(seconds):
    """A duration, given in seconds, in the largest unit of which it has at least two: 110 s, 3.5 min, otherwise in
    seconds."""
    for unit, size in (("days", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.2g} s"


def in_bytes(count):
    """A number of bytes with a decimal prefix up to TB: 1 kB is 1000 B."""
    for unit in ("B", "kB", "MB", "GB", "TB"):
        if count < 1000 or unit == "TB":
            return f"{count:.3g} {unit}"
        count /= 1000
