"""What a call of step() from Python costs beside the step: steps one by one, and as many in one call.

    PYTHONPATH=build/release/python python3 bench/python_overhead.py
"""
import time

import polynya

SHIP = {"hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30}, "mass_kg": 4e6,
        "moment_of_inertia_kg_m2": 9e8,
        "propulsion": {"constant_speed_m_per_s": 1}}
SCENE = {"time": {"step_s": 0.01, "until_s": 1e6}, "record": {"forces_interval_s": 1000}, "ships": [SHIP]}
STEPS = 20_000


def seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def one_by_one(simulation):
    for _ in range(STEPS):
        simulation.step()


def main():
    simulation = polynya.Simulation(SCENE)
    simulation.step(STEPS)
    pairs = [(seconds(lambda: one_by_one(simulation)), seconds(lambda: simulation.step(STEPS))) for _ in range(15)]
    single, together = (1e6 / STEPS * min(column) for column in zip(*pairs))
    print(f"step() {single:.2f} us, of which the step itself {together:.2f} us: {single - together:.2f} us a call "
          f"(least of 15)")


if __name__ == "__main__":
    main()
