"""A ship under full power in level ice: the scene for one thickness, and a test of whether its speed is steady."""
import math
import pathlib

import numpy as np

from ..study.measures import rows_by_ship

BLOCKS = 6  # number of parts of the measured distance, from whose differences the error is estimated
# Keys of a ship file that are replaced, because the ship sails full ahead along the x axis.
OF_THE_START = ("pilot", "sway_speed_m_per_s", "yaw_rate_deg_per_s")
# An endless plate does not split, and pieces that surface behind the stern do not load the ship.
ENDLESS = {"splitting": {"model": "none"}, "resurface": {"enabled": False}}
# Standard deviation of the flexural strength of beams at one place, divided by their mean (recall). Without scatter,
# cusps of thick ice form regular patterns that can stop a ship.
STRENGTH_SPREAD = 0.2


def ice_keys(ice):
    """The ice of a scene."""
    return {
        "thickness_m": ice.thickness,
        "flexural_strength_Pa": ice.flexural_strength,
        "friction": ice.friction,
        "density_kg_per_m3": ice.density,
        "youngs_modulus_Pa": ice.young,
        "poisson_ratio": ice.poisson,
    }


def scene(ship, ice, speed, lengths, step):
    """The scene: the ship at `speed` [m/s] 2 m in front of a plate of fast ice, on a course of `lengths` ship
    lengths."""
    hull = ship["hull"]
    length, width = hull["length_m"], 5 * hull["beam_m"]
    way = (lengths + 1) * length
    start = {"name": "ship", "position_m": [-0.5 * length - 2, 0], "heading_deg": 0, "speed_m_per_s": speed}
    if "steering" in ship:
        start["pilot"] = {"hold_heading": {"heading_deg": 0, "lever": 1}}
    return {
        "name": f"level-{ice.thickness:g}",
        "time": {"step_s": step, "until_s": math.ceil(way / speed)},
        "ice": ice_keys(ice),
        "fracture": ENDLESS | {"bending": {"strength_spread": STRENGTH_SPREAD}},
        "ships": [{key: value for key, value in ship.items() if key not in OF_THE_START} | start],
        "floes": [
            {"rectangle": {"corner_m": [0, -0.5 * width], "size_m": [way, width]}, "fast_ice": True}
        ],
        "record": {"forces_interval_s": 0.5, "frames_interval_s": max(60, way / speed / 20), "contacts": "none"},
    }


class Measured:
    """Mean speed over ground of a run [m/s], its error [m/s], and the mean braking forces [N]. Only the distance on
    which the whole hull is in the ice and the stem within the plate counts."""

    def __init__(self, folder, ship, way=math.inf):
        length = ship["hull"]["length_m"]
        (columns,) = rows_by_ship(pathlib.Path(folder) / "forces.csv").values()
        names = ("t_s", "x_m", "surge_N", "surge_from_submerged_ice_N")
        time, x, surge, submerged = (np.array(columns[name]) for name in names)
        is_in_ice = x + 0.5 * length < way - 0.1 * length
        time, x, surge, submerged = (values[is_in_ice] for values in (time, x, surge, submerged))
        self.way = x[-1] - x[0]
        self.is_stuck = x[-1] - x[np.searchsorted(time, 0.75 * time[-1])] < 0.05 * 0.25 * time[-1]
        is_full = x - x[0] > 2.2 * length
        if self.is_stuck or np.count_nonzero(is_full) < 4 * BLOCKS:
            self.speed, self.error, self.is_steady = 0.0, 0.0, self.is_stuck
            tail = time > 0.75 * time[-1]
            self.contact = -np.mean(surge[tail])
            self.submerged = -np.mean(submerged[tail])
            return
        time, x = time[is_full], x[is_full]
        edges = np.linspace(x[0], x[-1], BLOCKS + 1)  # parts of equal distance
        at = np.interp(edges, x, time)
        speeds = np.diff(edges) / np.diff(at)
        self.speed = (x[-1] - x[0]) / (time[-1] - time[0])
        self.error = np.std(speeds, ddof=1) / math.sqrt(BLOCKS)
        half = BLOCKS // 2
        trend = abs(np.mean(speeds[half:]) - np.mean(speeds[:half]))
        self.drift = trend / self.speed
        self.contact = -np.mean(surge[is_full])
        self.submerged = -np.mean(submerged[is_full])
        self.is_steady = True

    def is_within(self, share):
        """Returns True if the standard error of the mean, and half of the change between the halves, are below this
        fraction of it."""
        if self.is_stuck:
            return True
        return (
            self.is_steady
            and self.error <= share * self.speed
            and self.drift <= 2 * share + 2 * self.error / self.speed
        )
