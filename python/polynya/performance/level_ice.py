"""A ship under full power in level ice: the scene of one thickness, and whether its speed is steady."""
import math
import pathlib

import numpy as np

from ..study.measures import rows_by_ship

BLOCKS = 6  # of the measured way
# What a ship file may have of its own start and pilot gives way to the course: full ahead along the x axis.
OF_THE_START = ("pilot", "sway_speed_m_per_s", "yaw_rate_deg_per_s")
# A plate without end does not split; what comes up behind the stern does not load the ship.
ENDLESS = {"splitting": {"model": "none"}, "resurface": {"enabled": False}}
# Deviation of the flexural strength of beams at one place over their mean (recall). Without it cusps of thick ice
# settle into patterns that can hold a ship.
STRENGTH_SPREAD = 0.2


def ice_keys(ice):
    """A scene's ice."""
    return {
        "thickness_m": ice.thickness,
        "flexural_strength_Pa": ice.flexural_strength,
        "friction": ice.friction,
        "density_kg_per_m3": ice.density,
        "youngs_modulus_Pa": ice.young,
        "poisson_ratio": ice.poisson,
    }


def scene(ship, ice, speed, lengths, step):
    """The ship at speed [m/s] 2 m before a plate of fast ice, on a course of so many of its own lengths."""
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
    """A run's mean speed over ground, where the hull is full of ice and its stem within a plate as long as the way [m],
    its error [m/s], and what braked it [N]."""

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
        edges = np.linspace(x[0], x[-1], BLOCKS + 1)  # blocks of equal way
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
        """Whether the mean's standard error, and half of the change between the halves, are below that share of it."""
        if self.is_stuck:
            return True
        return (
            self.is_steady
            and self.error <= share * self.speed
            and self.drift <= 2 * share + 2 * self.error / self.speed
        )
