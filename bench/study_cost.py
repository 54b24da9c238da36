#!/usr/bin/env python3
"""What a case of a study costs beside its simulation, and how well two jobs share two processors (docs/studies.md).

    bench/study_cost.py [--polynya build/release/app/polynya] [start | disk | calls | gather | efficiency]...

Everything if nothing is named. `efficiency` means something only while the machine does nothing else; `calls` needs
strace.
"""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLATE = ROOT / "scenes/level-plate.json"
VOYAGE = ROOT / "scenes/sawamura2017-fig4b.json"
PACK = ROOT / "scenes/studies/pack-ice.json"
THIN = {"record.frames_interval_s": 1e6, "record.contacts": "none", "record.forces_interval_s": 1}


class Bench:
    def __init__(self, polynya, work):
        self.polynya, self.work = str(polynya), work

    def run(self, *words, **options):
        return subprocess.run(
            [self.polynya, *map(str, words)], cwd=self.work, check=True, capture_output=True, **options
        )

    def timed(self, *words):
        """Elapsed time and processors' time [s]."""
        began, used = time.perf_counter(), os.times()
        self.run(*words)
        now = os.times()
        processors = now.children_user + now.children_system - used.children_user - used.children_system
        return time.perf_counter() - began, processors

    def plan(self, name, scene, *options, **keys):
        (self.work / f"{name}.json").write_text(json.dumps({"scene": str(scene), **keys}))
        self.run("study", "plan", f"{name}.json", "--trial-seconds", 0, *options)
        return self.work / "studies" / name


def start(bench):
    """Time of what surrounds a simulation: of the clock, and of processors, which a busy machine changes less."""
    step = ["--set", "time.until_s=0.01", "--overwrite"]
    plain = [bench.timed("run", PLATE, *step, "--no-map") for _ in range(15)]
    drawn = [bench.timed("run", PLATE, *step) for _ in range(9)]
    bench.plan("start", PLATE, set={"time.until_s": 0.01}, repetitions=60)
    alone = [bench.timed("study", "run", "studies/start", "--case", n) for n in range(10)]
    again = [bench.timed("study", "run", "studies/start", "--case", n) for n in range(10)]
    rest = [tuple(seconds / 50 for seconds in bench.timed("study", "run", "studies/start", "--jobs", 1))]
    for what, seconds in (
        ("polynya run of one step, with --no-map", plain),
        ("the same with its map", drawn),
        ("study run --case N of one step", alone),
        ("study run --case N of a finished case", again),
        ("study run --jobs 1, for each case of one step", rest),
    ):
        elapsed, used = (1000 * statistics.median(column) for column in zip(*seconds))
        print(f"start       {elapsed:7.1f} ms  {used:7.1f} ms of processors  {what}")


def size_of(path):
    entries = [path, *path.rglob("*")]
    return sum(e.stat().st_blocks * 512 for e in entries), len(entries)


def disk(bench):
    """Space of a case by what is kept of it."""
    for name, keys in (
        ("all", {}),
        ("thinned", {"set": THIN}),
        ("summary", {"keep": "summary"}),
        ("packed-all", {"archive": True}),
        ("packed-thinned", {"archive": True, "set": THIN}),
        ("packed-summary", {"archive": True, "keep": "summary"}),
    ):
        folder = bench.plan("disk-" + name, PACK, "--chunk", 4, repetitions=4, **keys)
        bench.run("study", "run", folder, "--jobs", 2)
        size, files = size_of(folder / "cases")
        print(f"disk        {size / 4 / 1000:7.1f} kB {files / 4:5.1f} files and folders  {name}")


def calls(bench):
    """System calls on the file system for one case."""
    for name, keys in (("all", {}), ("summary", {"keep": "summary"})):
        bench.plan("calls-" + name, PACK, repetitions=1, set={"time.until_s": 30}, **keys)
        log = bench.work / "strace.txt"
        subprocess.run(
            [
                "strace",
                "-f",
                "-qq",
                "-o",
                log,
                "-e",
                "trace=file,fsync,fdatasync,write",
                bench.polynya,
                "study",
                "run",
                f"studies/calls-{name}",
                "--case",
                "0",
            ],
            cwd=bench.work,
            check=True,
            capture_output=True,
        )
        lines = [line for line in log.read_text(errors="replace").splitlines() if "= -1" not in line]
        in_case = [line for line in lines if "cases/" in line or "messages.txt" in line]
        found = {
            "created": sum("O_CREAT" in line for line in in_case),
            "renamed": sum("rename" in line for line in in_case),
            "removed": sum(bool(re.search(r"unlink|rmdir", line)) for line in in_case),
            "synced": sum(bool(re.search(r"f(data)?sync\(", line)) for line in lines),
            "opened elsewhere": sum("openat(" in line and line not in in_case for line in lines),
        }
        print(f"calls       {', '.join(f'{count} {what}' for what, count in found.items())}  {name}")


def gather(bench):
    """Time to gather 10 000 cases."""
    sys.path.insert(0, str(ROOT / "python"))
    from polynya.study.folder import RESULT, open_study

    for name, chunk in (("loose", 1), ("chunked", 100)):
        folder = bench.plan(
            "gather-" + name, PLATE, "--chunk", chunk, set={"time.until_s": 5}, repetitions=10000, keep="summary"
        )
        bench.run("study", "run", folder, "--case", 0)
        study = open_study(folder)
        text = (study.case_folder(0) / RESULT).read_text()
        for number in range(1, study.count):
            study.case_folder(number).mkdir(parents=True)
            (study.case_folder(number) / RESULT).write_text(text)
        print(f"gather      {bench.timed('study', 'gather', folder)[0]:7.2f} s   10 000 cases, {chunk} in a folder")


def efficiency(bench):
    """One job's time over twice that of two."""
    seconds = {}
    for jobs in (1, 2):
        folder = bench.plan(f"efficiency-{jobs}", VOYAGE, repetitions=10, set={"time.until_s": 800})
        seconds[jobs] = bench.timed("study", "run", folder, "--jobs", jobs)[0]
    print(
        f"efficiency  {seconds[1] / (2 * seconds[2]):7.3f}     10 cases of {seconds[1] / 10:.2f} s: {seconds[1]:.1f} s "
        f"by one job, {seconds[2]:.1f} s by two"
    )


def main():
    parts = {"start": start, "disk": disk, "calls": calls, "gather": gather, "efficiency": efficiency}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--polynya", type=pathlib.Path, default=ROOT / "build/release/app/polynya")
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(parts))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        bench = Bench(options.polynya.absolute(), pathlib.Path(work))
        for name in options.parts or parts:
            parts[name](bench)


if __name__ == "__main__":
    main()
