"""A run of a million floes: start, cost of a second, memory.

Usage: python3 bench/million_floes.py [BINARY] [--floes-km KM] [--until S] [--step S]
       BINARY by default build/release/app/polynya; --floes-km: side of the field, 24 km for 944 547 floes

Log-normal floes (mean of the root of the area 22.5 m, spread 0.3) at 90 % of the area drift in a current sheared by
2e-5 1/s, so that all of them move, and a ship of 95 m goes through them at 2 m/s. Prints the floes, the time to the
first step (reading, the field, covers), the real-time factor after it, the processor's time of all and the most memory.
"""

import argparse
import pathlib
import resource
import tempfile
import time

from measured_run import measured_run

ROOT = pathlib.Path(__file__).resolve().parent.parent


def scene(side, until, step):
    clock = {"until_s": until} if step is None else {"until_s": until, "step_s": step}
    ship = {"ship": "araon", "position_m": [0.25 * side, 0.5 * side], "propulsion": {"constant_speed_m_per_s": 2}}
    field = {"corner_m": [0, 0], "extent_m": side, "concentration": 0.9, "sizes": {"mean_m": 22.5, "spread": 0.3}}
    return {"name": "million-floes", "time": clock, "ships": [ship], "floes": [{"field": field}],
            "water": {"shear": {"rate_per_s": 2e-5, "origin_m": [0, 0.5 * side]}},
            "record": {"frames_interval_s": 1e6, "forces_interval_s": 1}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", default=str(ROOT / "build/release/app/polynya"))
    parser.add_argument("--floes-km", type=float, default=24)
    parser.add_argument("--until", type=float, default=10)
    parser.add_argument("--step", type=float)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        case = scene(1e3 * given.floes_km, given.until, given.step)
        before = time.monotonic()
        _, summary, cost = measured_run(given.binary, name, case, "--no-map")
        taken = time.monotonic() - before
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e6
    simulated, wall = summary["sim_time_s"], summary["wall_time_s"]
    print("| floes | tick, s | shortest step, s | start, s | simulated, s | wall, s | x real time | processor, s "
          "| memory, GB | bends |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    steps = f"{summary['step_s']:g} | {summary['shortest_step_s']:g}"
    counts = summary["counts"]
    print(f"| {counts['floes_initial']} | {steps} | {taken - wall:.1f} | {simulated:g} | {wall:.1f} | "
          f"{simulated / wall:.3g} | {cost:.1f} | {memory:.2f} | {counts['bends']} |")


if __name__ == "__main__":
    main()
