#!/usr/bin/env python3
"""Runs random scenes by their seeds and tells which are faulty, and how.

Each scene is validated and run, `polynya inspect --check` judges whether the run is sound, and load_bounds.py whether
its loads and accounts are such as ice can give. A scene that is refused is a fault too: of random_scenes.py, or of the
program. Warnings are none. By law impulse, which crushes nothing, overlaps are noted only.

Usage: sweep.py PROGRAM FIRST LAST [--law crush|impulse] [--jobs N] [--results FILE.jsonl] [--keep DIR] [--timeout S]
                [--short]
Exit code 1 where a scene is faulty.
"""

import argparse
import collections
import concurrent.futures
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import load_bounds
import random_scenes

SHORT = 0.4  # factor on all durations
NOTED = "not sound: overlap not crushed"  # with law impulse this is no fault: rigid impulses crush nothing


def finish(command, timeout_s):
    """Runs a command; its exit code, stdout and stderr. None for the code where it takes too long."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s, check=False)
    except subprocess.TimeoutExpired:
        return None, "", ""
    return done.returncode, done.stdout, done.stderr


def last_line(text, skipped=("warning:", "hint:")):
    """Of a command's messages, less warnings."""
    lines = [line for line in text.strip().splitlines() if not any(word in line for word in skipped)]
    return lines[-1].strip() if lines else ""


def why_it_ended(messages):
    """Of a run that failed: when and by what."""
    stops = [line for line in messages.splitlines() if "stopped at" in line]
    return stops[0].removeprefix("polynya: ") if stops else last_line(messages)


def first_problem(messages):
    """Of `validate`, without the scene's path before it."""
    problems = [line for line in messages.splitlines() if "found" in line]
    return problems[0].split("scene.json:")[-1] if problems else last_line(messages)


def reasons(check):
    """Why a run is not sound, by the members of `inspect --check --json`: (kind, text)."""
    counts = {"not sound: invalid shapes": len(check["invalid"]),
              "not sound: areas on record": check["recorded_area"]["wrong"],
              "not sound: balance of fractures": check["balance"]["wrong"],
              "not sound: pieces overlap": check["overlapping_siblings"],
              "not sound: overlap not crushed": check["uncrushed_pairs"],
              "not sound: work of crushing": len(check["unpaid"]),
              "not sound: not decided": check["undecided"],
              "not sound: last places": len(check["final_places"]["misplaced"])}
    if check["final_places"]["fault"]:
        counts["not sound: last places"] += 1
    found = [(kind, f"{count} of these") for kind, count in counts.items() if count]
    return found or [("not sound: unknown", "inspect --check gives no reason that sweep.py knows")]


def judge_soundness(program, run, timeout_s, result):
    """Takes over the verdict of `inspect --check`."""
    code, out, messages = finish([program, "inspect", str(run), "--check", "--json"], timeout_s)
    if code is None:
        return [("timeout of the check", f"more than {timeout_s:g} s")]
    if code not in (0, 4):
        return [(f"the check ends with exit code {code}", last_line(messages))]
    check = json.loads(out)
    result["moments"], result["shapes"] = check["moments"], check["shapes"]
    if check["is_sound"] != (code == 0):
        return [("the check contradicts its exit code", f"is_sound {check['is_sound']}, exit code {code}")]
    return [] if check["is_sound"] else reasons(check)


def judge_loads(run, result):
    verdict = load_bounds.check_run(run)
    result["checked"] = verdict.checked
    result["loaded"] = verdict.loaded
    result["shares"] = {kind: share for kind, share in verdict.largest.items()}
    return [tuple(line.split(": ", 1)) for line in verdict.lines()]


def faults_of(program, scene, run, timeout_s, result):
    """Validates, runs and judges a scene; its faults as (kind, text). Enters numbers into the result."""
    code, _, messages = finish([program, "validate", str(scene)], timeout_s)
    if code != 0:
        return [("refused by validate" if code == 3 else f"validate ends with {code}", first_problem(messages))]
    begun = time.monotonic()
    code, _, messages = finish([program, "run", str(scene), "--out", str(run), "--no-map", "--progress", "none"],
                               timeout_s)
    result["run_s"] = time.monotonic() - begun
    if code is None:
        return [("timeout", f"more than {timeout_s:g} s")]
    if code != 0:
        return [(f"run ends with {code}", why_it_ended(messages))]
    summary = json.loads((run / "summary.json").read_text())
    result["counts"] = {key: summary["counts"][key] for key in ("floes_initial", "bends", "splits", "ground",
                                                                "crush_contacts", "went_under")}
    result["sim_time_s"], result["time_steps"] = summary["sim_time_s"], summary["time_steps"]
    found = judge_soundness(program, run, timeout_s, result)
    if result["law"] == "impulse":
        result["notes"] = [text for kind, text in found if kind == NOTED]
        found = [(kind, text) for kind, text in found if kind != NOTED]
    return found + judge_loads(run, result)


def try_seed(options, seed):
    """The line of results of a seed. Its scene is kept, where asked for, if it is faulty."""
    result = {"seed": seed, "law": options.law, "is_short": options.short}
    with tempfile.TemporaryDirectory(prefix="polynya-random-") as folder:
        folder = pathlib.Path(folder)
        scene = random_scenes.write(folder / "scene", seed, options.law, SHORT if options.short else 1)
        begun = time.monotonic()
        result["faults"] = faults_of(options.program, scene, folder / "run", options.timeout, result)
        result["all_s"] = time.monotonic() - begun
        if result["faults"] and options.keep:
            kept = pathlib.Path(options.keep) / f"{options.law}-{seed}"
            shutil.copytree(scene.parent, kept, dirs_exist_ok=True)
            (kept / "faults.json").write_text(json.dumps(result, indent=1))
    return result


def summarise(results, seconds):
    """What was run and checked, so that a verdict about nothing is seen; and the faults by kind."""
    checked = collections.Counter()
    loaded = collections.Counter()
    for result in results:
        checked.update(result.get("checked", {}))
        loaded.update(result.get("loaded", {}))
    times = sorted(result["run_s"] for result in results if "run_s" in result) or [0.0]
    kinds = collections.Counter(kind for result in results for kind in {kind for kind, _ in result["faults"]})
    faulty = sum(bool(result["faults"]) for result in results)
    print(f"{len(results)} scenes in {seconds:.0f} s; a run takes {times[len(times) // 2]:.2f} s in the median, "
          f"{times[-1]:.1f} s at most")
    print("checked: " + (", ".join(f"{count} {what}" for what, count in checked.items()) or "nothing")
          + f"; not zero were {loaded['means']} means and {loaded['steps']} steps")
    noted = sum(bool(result.get("notes")) for result in results)
    if noted:
        print(f"noted, and no fault: {noted} scenes with overlaps by law impulse")
    print(f"{faulty} of {len(results)} scenes are faulty" + "".join(f"; {kind}: {count}"
                                                                   for kind, count in kinds.most_common()))
    return faulty


def options_of(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--law", choices=("crush", "impulse"), default="crush")
    parser.add_argument("--jobs", type=int, default=1, help="scenes at once")
    parser.add_argument("--results", help="a file for a line of JSON a seed")
    parser.add_argument("--keep", help="a folder for the scenes that are faulty")
    parser.add_argument("--timeout", type=float, default=600, help="for each command [s]")
    parser.add_argument("--short", action="store_true", help="runs of a tenth of the duration")
    return parser.parse_args(arguments)


def main():
    options = options_of(sys.argv[1:])
    seeds = range(options.first, options.last + 1)
    results, begun = [], time.monotonic()
    lines = open(options.results, "w", encoding="utf-8") if options.results else None
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for result in pool.map(lambda seed: try_seed(options, seed), seeds):
            results.append(result)
            if result["faults"]:
                told = "; ".join(f"{kind}: {text}" for kind, text in result["faults"])
                print(f"seed {result['seed']} {options.law}: {told}", flush=True)
            if lines:
                print(json.dumps(result), file=lines, flush=True)
    is_faulty = summarise(results, time.monotonic() - begun) > 0
    if not any(result.get("checked", {}).get("records") for result in results):
        print("nothing was checked")
        is_faulty = True
    sys.exit(is_faulty)


if __name__ == "__main__":
    main()
