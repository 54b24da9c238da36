"""Mean loads of a ship in level ice by thickness and speed, at the default step and at a quarter of its finest step.

Usage: python3 tools/step_cliff.py [BINARY] [--way M] [--ways H] [--levels N] [--only THICKNESS,SPEED]
       BINARY by default build/release/app/polynya; --way, --ways: of the ship in the ice, at least so many metres and
       so many thicknesses, since cusps grow with these; --levels: time.levels

A ship of 80 m by 20 m at constant speed in fast ice that does not split. The run beside it has one step for all, a
quarter of the shortest that the first one took. The mean is that of the surge by contact from the time its bow is
in the ice. The standard error is that of 16 parts of the way. A row whose two means differ by more than 5 % is marked.
"""

import argparse
import math
import pathlib
import statistics
import tempfile

from study import measured_run, rows_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
THICKNESSES = (0.05, 0.3, 2)  # [m]
SPEEDS = (0.25, 1.5, 8)  # [m/s]
STEP = 0.005  # the default [s]
BOW = 22  # the way after which the bow is in the ice [m]
PARTS = 16
ALLOWED = 0.05


def scene(thickness, speed, step, levels, way):
    ship = {"hull": {"length_m": 80, "beam_m": 20, "entrance_angle_deg": 25, "stem_angle_deg": 28, "draught_m": 6},
            "mass_kg": 6e6, "moment_of_inertia_kg_m2": 2.5e9, "position_m": [-41, 0],
            "propulsion": {"constant_speed_m_per_s": speed}}
    steps = round((way + BOW) / speed / step)
    time = {"step_s": step, "until_s": steps * step}
    if levels is not None:
        time["levels"] = levels
    plate = {"rectangle": {"corner_m": [0, -60], "size_m": [way + 100, 120]}, "fast_ice": True}
    return {"name": "step-cliff", "time": time, "ice": {"thickness_m": thickness}, "ships": [ship], "floes": [plate],
            "fracture": {"splitting": {"model": "none"}, "cusp_fate": "under_hull"},
            "record": {"frames_interval_s": 1e6, "forces_interval_s": max(step, round(1 / speed / step) * step)}}


def measure(binary, folder, case):
    """Mean surge and its standard error [N], the summary and the processor's time [s]."""
    run, summary, cost = measured_run(binary, folder, case, "--no-map")
    speed = case["ships"][0]["propulsion"]["constant_speed_m_per_s"]
    surge = [-float(row["surge_N"]) for row in rows_of(run, "forces.csv") if float(row["t_s"]) * speed > BOW + 1]
    size = len(surge) // PARTS
    parts = [statistics.fmean(surge[i * size:(i + 1) * size]) for i in range(PARTS)]
    return statistics.fmean(surge), statistics.stdev(parts) / math.sqrt(PARTS), summary, cost


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", default=str(ROOT / "build/release/app/polynya"))
    parser.add_argument("--way", type=float, default=40)
    parser.add_argument("--ways", type=float, default=800)
    parser.add_argument("--levels", type=int)
    parser.add_argument("--only")
    given = parser.parse_args()
    cases = [(h, v) for h in THICKNESSES for v in SPEEDS]
    if given.only:
        cases = [tuple(float(x) for x in given.only.split(","))]
    print("| thickness, m | speed, m/s | mean, kN | at a quarter, kN | differs, % | s.e., % | bends | s of a core |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for thickness, speed in cases:
            way = max(given.way, given.ways * thickness)

            def run(step, levels):
                return measure(given.binary, name, scene(thickness, speed, step, levels, way))

            mean, error, summary, cost = run(STEP, given.levels)
            finest = min(level["step_s"] for level in summary["levels"])
            fine, fine_error, fine_summary, fine_cost = run(finest / 4, 0)
            off = mean / fine - 1
            both = math.hypot(error, fine_error) / fine
            bends = f"{summary['counts']['bends']} / {fine_summary['counts']['bends']}"
            print(f"| {thickness:g} | {speed:g} | {mean / 1e3:.4g} | {fine / 1e3:.4g} | "
                  f"{'**' if abs(off) > ALLOWED else ''}{100 * off:+.1f}{'**' if abs(off) > ALLOWED else ''} | "
                  f"{100 * both:.1f} | {bends} | {cost:.1f} / {fine_cost:.1f} |", flush=True)


if __name__ == "__main__":
    main()
