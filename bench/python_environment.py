"""How many steps of .5 s simulated time an environment takes a second, in a field of 1000 floes, and what the image
takes of it.

    PYTHONPATH=build/release/python python3 bench/python_environment.py
"""
import time

from polynya.environment import ShipInIce

SCENE = {
    "name": "a thousand floes",
    "time": {"step_s": 0.02, "until_s": 400},
    "ice": {"thickness_m": 0.4},
    "ships": [{
        "name": "icebreaker",
        "hull": {"length_m": 100, "beam_m": 20, "entrance_angle_deg": 27, "draught_m": 6, "block_coefficient": 0.58},
        "position_m": [-52, 250], "speed_m_per_s": 4,
        "propulsion": {"engine": {"power_MW": 12, "propeller_diameter_m": 4, "propellers": 2,
                                  "open_water_speed_m_per_s": 8}},
        "steering": {"rudder": {"area_m2": 12}},
    }],
    "floes": [{"field": {"corner_m": [0, 0], "extent_m": [1000, 500], "floe_size_m": 17,
                         "size_spread": 0.25, "concentration": 0.6}}],
}
STEPS = 200


def seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def main():
    environment = ShipInIce(SCENE)
    rates = []
    for seed in (1, 2, 3):
        environment.reset(seed=seed)
        floes = len(environment.simulation.floes)
        taken = seconds(lambda: [environment.step((0.5, 0.0)) for _ in range(STEPS)])
        image = seconds(lambda: [environment.simulation.occupancy() for _ in range(STEPS)])
        x = environment.simulation.ships[0].position[0]
        rates.append(STEPS / taken)
        print(f"seed {seed}: {floes} floes, {STEPS / taken:.0f} steps a second over {x + 52:.0f} m; an image "
              f"{1e3 * image / STEPS:.2f} ms, "
              f"{100 * image / taken:.0f} % of the time")
    print(f"{min(rates):.0f} to {max(rates):.0f} steps of 0.5 s a second")


if __name__ == "__main__":
    main()
