"""How many steps of 0.5 s simulated time N environments take a second together, each in a field of 1000 floes, on
threads that release Python's lock: wall time, for N 1, 2, 4 and 8. Of some bursts of steps the quickest counts, since
others may use the machine.

    PYTHONPATH=build/release/python python3 bench/vector_environment.py
"""
import os
import time

import numpy
from python_environment import SCENE

from polynya.environment import ShipsInIce

BURSTS, STEPS = 40, 3


def rate(count, **settings):
    """Steps of all environments in a second."""
    many = ShipsInIce(count, scene=SCENE, **settings)
    many.reset(seed=1)
    actions = numpy.tile((0.5, 0.0), (count, 1))
    quickest = float("inf")
    for _ in range(BURSTS):
        start = time.perf_counter()
        for _ in range(STEPS):
            many.step(actions)
        quickest = min(quickest, time.perf_counter() - start)
    many.close()
    return count * STEPS / quickest


def main():
    print(f"{len(os.sched_getaffinity(0))} processors, load {os.getloadavg()[0]:.1f}")
    print("| N | image of 96 x 96 | 32 nearest floes |")
    print("|---|---|---|")
    for count in (1, 2, 4, 8):
        print(f"| {count} | {rate(count):.0f} | {rate(count, floes=32):.0f} |")


if __name__ == "__main__":
    main()
