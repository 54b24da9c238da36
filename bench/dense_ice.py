"""Real-time factors in dense ice, and what two threads give beside what the machine gives to two processes.

Usage: python3 bench/dense_ice.py [BINARY...] [--only CASE...] [--until S] [--threads]
       BINARY by default build/release/app/polynya; of several, each case is run by all, one after the other

Without --threads: each case once on one thread. `factor` is the simulated time over the program's own wall time,
`by processor` that over the processor's time, start-up and all, which a busy machine disturbs less. `unconverged` is
the share of steps whose contacts are not solved to the tolerance.

With --threads: cylinder-shear (400 s) and pack-power-law, one after the other: one process on one thread, one on two,
and two processes on one thread each, side by side. Two threads cannot give more than two processes that share nothing:
`machine` is twice the wall time of one process over that of the two side by side.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import tempfile

from measured_run import measured_run

ROOT = pathlib.Path(__file__).resolve().parent.parent
DENSE = ["pack-power-law", "pressure", "level-brash"]
THREADED = {"cylinder-shear": 400, "pack-power-law": 0}


def scene_of(name, until):
    """A shipped scene, or a file, without its comments; until: instead of its own end [s]."""
    file = pathlib.Path(name) if name.endswith(".json") else ROOT / "scenes" / f"{name}.json"
    scene = json.loads(re.sub(r"(^|\s)//.*", "", file.read_text(encoding="utf-8")))
    if until:
        scene["time"]["until_s"] = until
    return scene


def run(binary, scene, threads=1):
    with tempfile.TemporaryDirectory() as folder:
        _, summary, used = measured_run(binary, folder, scene, "--no-map", "--threads", str(threads))
    return summary, used


def print_factors(binaries, cases, until):
    print("| case | binary | steps | factor | by processor | unconverged |\n|---|---|---|---|---|---|")
    for case in cases:
        for binary in binaries:
            summary, used = run(binary, scene_of(case, until))
            share = summary["counts"]["unconverged_steps"] / max(1, summary["steps"])
            print(f"| {pathlib.Path(case).stem} | {binary} | {summary['steps']} | {summary['real_time_factor']:.1f} | "
                  f"{summary['sim_time_s'] / used:.1f} | {share:.2%} |", flush=True)


def print_threads(binary, cases, until):
    print("| case | one thread, s | two threads, s | two processes, s | threads | machine |\n|---|---|---|---|---|---|")
    for case in cases:
        scene = scene_of(case, until or THREADED.get(case, 0))
        alone, two = (run(binary, scene, threads)[0]["wall_time_s"] for threads in (1, 2))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            side_by_side = max(pool.map(lambda _: run(binary, scene)[0]["wall_time_s"], range(2)))
        print(f"| {case} | {alone:.1f} | {two:.1f} | {side_by_side:.1f} | {alone / two:.2f} | "
              f"{2 * alone / side_by_side:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binaries", nargs="*", default=[str(ROOT / "build/release/app/polynya")])
    parser.add_argument("--only", nargs="+")
    parser.add_argument("--until", type=float, default=0)
    parser.add_argument("--threads", action="store_true")
    arguments = parser.parse_args()
    if arguments.threads:
        print_threads(arguments.binaries[0], arguments.only or THREADED, arguments.until)
    else:
        print_factors(arguments.binaries, arguments.only or DENSE, arguments.until)


if __name__ == "__main__":
    main()
