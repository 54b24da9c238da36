"""The scene of ShipInIce if no other is given: a ship with rudder and engines that heads into a field of large floes.

The bow of the ship starts 10 m in front of the field, and the ship moves at 4 m/s along the x axis. The field is 500 m
long and 300 m wide, and 35 % of it is covered by floes of some 60 m, 0.5 m thick. Agents that were trained in this
scene are only comparable as long as its values stay the same. Thicker ice, more cover or larger floes make the task
harder."""


def default_scene(seed):
    """Returns the scene as a dict with the keys of docs/scene.md. `seed` selects the random floes of the field; the
    same seed gives the same floes. `until_s` is the time limit of an episode if the environment is given none. The
    environment's `seconds` per action must be a multiple of `step_s`; otherwise its reset() raises ValueError."""
    return {
        "name": "ship-in-ice",
        "seed": seed,
        "time": {"step_s": 0.05, "until_s": 120},
        "ice": {"thickness_m": 0.5},
        "ships": [{
            "name": "ship",
            "hull": {"length_m": 80, "beam_m": 18, "entrance_angle_deg": 27, "stem_angle_deg": 30, "draught_m": 6,
                     "block_coefficient": 0.58},
            "position_m": [-50, 150],
            "speed_m_per_s": 4,
            "propulsion": {"engine": {"power_MW": 10, "propeller_diameter_m": 3.6, "propellers": 2,
                                      "open_water_speed_m_per_s": 7}},
            "steering": {"rudder": {"area_m2": 14}},
        }],
        "floes": [{"field": {"corner_m": [0, 0], "extent_m": [500, 300], "floe_size_m": 60, "size_spread": 0.3,
                             "concentration": 0.35}}],
    }
