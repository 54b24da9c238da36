"""A ship under full power in level ice: the scene for one thickness, the mean speed and forces of its run, and a test
of whether the speed is steady."""
import math
import pathlib

import numpy as np

from ..study.measures import rows_by_ship

# Number of equal parts of the measured distance. The standard error of the mean speed is estimated from the
# differences between the mean speeds of the parts. More parts: they are shorter and depend on each other, so that the
# error is too small; fewer parts: the error itself is uncertain.
BLOCKS = 6
# Keys of a ship file that are left out of the scene, because the ship sails straight along the x axis. A ship with
# steering has another pilot instead, which holds its heading.
OF_THE_START = ("pilot", "sway_speed_m_per_s", "yaw_rate_deg_per_s")
# Settings of the scene's `fracture`. The plate represents endless ice, which does not split as a floe does. Broken
# pieces do not surface again, because that would be behind the stern, where they do not load the ship.
ENDLESS = {"splitting": {"model": "none"}, "resurface": {"enabled": False}}
# Standard deviation of the flexural strength between bending events, divided by its mean [-]. Measured beams at one
# place scatter as much (recall). Without scatter, cusps of thick ice form regular patterns that can stop a ship. A
# larger value makes forces and speeds scatter more, so that runs must be longer.
STRENGTH_SPREAD = 0.2


def ice_keys(ice):
    """Returns the member `ice` of a scene, by key, for a formulas.Ice, both in SI units. The density of the water is
    left to its default."""
    return {
        "thickness_m": ice.thickness,
        "flexural_strength_Pa": ice.flexural_strength,
        "friction": ice.friction,
        "density_kg_per_m3": ice.density,
        "youngs_modulus_Pa": ice.young,
        "poisson_ratio": ice.poisson,
    }


def scene(ship, ice, speed, lengths, step):
    """Returns the scene of a run, as a dict. The ship starts at `speed` [m/s] with its stem 2 m in front of a plate of
    fast ice, which is `lengths` + 1 ship lengths long and 5 beams wide. The run lasts as long as the ship would need
    for the plate at that speed, so a ship that slows down does not reach its end. `ship` is a ship as in a scene, `ice`
    a formulas.Ice and `step` the time step [s]. A longer plate makes the mean speed more certain and the run longer."""
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
    """The mean motion of a run of scene(), read from forces.csv in `folder`. `way` is the length of the plate [m].

    Only rows count in which the ship has sailed at least 2.2 ship lengths, so that the whole hull is in the ice, and in
    which its stem is at least 0.1 ship lengths before the end of the plate. Members:

    speed, error: mean speed over ground and its standard error [m/s], both 0 for a stuck ship or too few rows.
    contact, submerged: mean braking force by contacts with ice, and by ice under the hull [N]; positive if it brakes.
    way: distance that the ship has sailed, up to 0.1 ship lengths before the end of the plate [m].
    is_stuck: true if the mean speed in the last quarter of the time was below 0.05 m/s.
    is_steady: false if fewer than 4 BLOCKS rows count, too few for a mean speed. Then, and if the ship is stuck, the
    forces are the means over the last quarter of the time.
    drift: magnitude of the change of the mean speed from the first to the second half of the distance, divided by the
    mean speed [-]; missing for a ship without a mean speed."""

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
        edges = np.linspace(x[0], x[-1], BLOCKS + 1)  # ends of parts of equal distance
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
        """Returns True if the speed is steady enough, so that the run need not be repeated on a longer course. The
        standard error must be at most the fraction `share` of the mean speed, and half of the change between the two
        halves of the distance at most `share` of it plus one standard error. A stuck ship is steady, and one with too
        few rows is not. A smaller `share` makes more runs be repeated."""
        if self.is_stuck:
            return True
        return (
            self.is_steady
            and self.error <= share * self.speed
            and self.drift <= 2 * share + 2 * self.error / self.speed
        )
