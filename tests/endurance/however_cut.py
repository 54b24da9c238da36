#!/usr/bin/env python3
"""Runs scenes in many ways that may not matter, and tells where the bytes of the run folder differ.

Each scene is run at once on one thread. Then it is run again on 2, 3 and 8 threads; with ends at instants that are no
multiples of anything, each followed by `polynya resume --until`; and with kills at random moments, each followed by
`polynya resume`. All files of the folder must be the same, but for summary.json, which has the time that the run took,
for checkpoints, which stand where a run was cut, and for checksums.txt, which has the checksums of both.

Usage: however_cut.py PROGRAM [--scenes FIRST:LAST] [--shipped] [--jobs N] [--results FILE.jsonl]
  --scenes   seeds of random_scenes.py, for half of their time
  --shipped  all scenes in scenes/, for as long as tests/golden/goldens.txt has them
Exit code 1 where a run differs.
"""

import argparse
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time

import random_scenes

ROOT = pathlib.Path(__file__).resolve().parents[2]
DURATION = 0.5  # factor on the duration of random scenes, less than 1 to save time [-]
CUTS = 5
KILLS = 5
THREADS = (2, 3, 8)
QUIET = ("--no-map", "--progress", "none")


def finished(*command):
    """Runs a command that must succeed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(str(word) for word in command)}: exit {done.returncode}: {done.stderr[-300:]}")


def compared_files(run):
    """The files of a run that may not depend on how it was cut, by name."""
    return {file.name: file for file in run.iterdir()
            if file.name not in ("summary.json", "checksums.txt", ".polynya") and
            not file.name.startswith("checkpoint-")}


def difference(expected, run):
    """Returns the names of the files that differ or are in one of two runs only."""
    one, other = compared_files(expected), compared_files(run)
    if not (run / "checksums.txt").exists():
        return ["checksums.txt"]  # a finished run has it, whatever it says of the files that are not compared
    return sorted(name for name in one.keys() | other.keys()
                  if name not in one or name not in other or one[name].read_bytes() != other[name].read_bytes())


def run_in_pieces(program, scene, until, run, dice):
    """Ends and resumes a run at random instants."""
    instants = sorted(dice.uniform(0, until) for _ in range(CUTS))
    finished(program, "run", scene, "--until", repr(instants[0]), "--out", run, "--threads", 1, *QUIET)
    for instant in [*instants[1:], until]:
        finished(program, "resume", run, "--until", repr(instant), "--threads", dice.choice((1, 2)), *QUIET)


def run_with_kills(program, scene, until, run, dice, seconds):
    """Kills a run at random moments and resumes it. Returns how often it was killed before its end."""
    kills = 0
    begin = [program, "run", scene, "--until", repr(until), "--out", run]
    command = begin
    for _ in range(KILLS):
        child = subprocess.Popen([*map(str, command), "--checkpoint-every-wall", "0.05", "--threads", "1", *QUIET],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            if child.wait(timeout=dice.uniform(0.02, 0.02 + 0.6 * seconds)) == 0:
                return kills
        except subprocess.TimeoutExpired:
            child.kill()
            kills += 1
        child.wait()
        has_begun = any(run.glob("checkpoint-*")) if run.exists() else False
        command = [program, "resume", run] if has_begun else [*begin, "--overwrite"]
    finished(*command, "--threads", 1, *QUIET)
    return kills


def try_scene(program, name, scene, until):
    """Runs a scene in all ways. Returns a row: its name and which way differs in which files."""
    dice = random.Random(name)
    row = {"scene": name, "until_s": until, "differs": []}
    with tempfile.TemporaryDirectory(prefix="polynya-cut-") as folder:
        folder = pathlib.Path(folder)
        begun = time.monotonic()
        finished(program, "run", scene, "--until", repr(until), "--out", folder / "whole", "--threads", 1, *QUIET)
        seconds = time.monotonic() - begun
        for threads in THREADS:
            finished(program, "run", scene, "--until", repr(until), "--out", folder / f"{threads} threads", "--threads",
                     threads, *QUIET)
        run_in_pieces(program, scene, until, folder / "pieces", dice)
        row["kills"] = run_with_kills(program, scene, until, folder / "killed", dice, seconds)
        for way in [*(f"{threads} threads" for threads in THREADS), "pieces", "killed"]:
            if found := difference(folder / "whole", folder / way):
                row["differs"].append([way, found])
    return row


def shipped_scenes():
    for line in (ROOT / "tests/golden/goldens.txt").read_text(encoding="utf-8").splitlines():
        name, until = line.split()[:2]
        yield name, ROOT / "scenes" / f"{name}.json", float(until)


def random_ones(first, last, folder):
    for seed in range(first, last + 1):
        scene = random_scenes.write(pathlib.Path(folder) / str(seed), seed, "crush")
        until = json.loads(scene.read_text(encoding="utf-8"))["time"]["until_s"]
        yield f"random {seed}", scene, DURATION * until


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scenes", metavar="FIRST:LAST")
    parser.add_argument("--shipped", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--results", type=pathlib.Path)
    return parser.parse_args()


def main():
    given = options()
    with tempfile.TemporaryDirectory(prefix="polynya-scenes-") as folder:
        trials = list(shipped_scenes()) if given.shipped else []
        if given.scenes:
            first, last = map(int, given.scenes.split(":"))
            trials += random_ones(first, last, folder)
        rows = []
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            for row in pool.map(lambda trial: try_scene(given.program, *trial), trials):
                rows.append(row)
                if given.results:
                    with given.results.open("a", encoding="utf-8") as file:
                        file.write(json.dumps(row) + "\n")
                if row["differs"]:
                    print(f"{row['scene']}: {row['differs']}", flush=True)
    differing = sum(bool(row["differs"]) for row in rows)
    print(f"{len(rows)} scenes, each on 1, {', '.join(map(str, THREADS))} threads, in {CUTS + 1} pieces and with "
          f"{sum(row['kills'] for row in rows)} kills in all: {differing} differ")
    return 1 if differing or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
