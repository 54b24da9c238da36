"""Runs of a table of resistance, one for each point and seed. Finished runs are kept and reused."""
import concurrent.futures
import dataclasses
import itertools
import math
import pathlib

import numpy as np

from ..runs_kept import kept_run
from ..study.measures import rows_by_ship
from . import ice_scenes

# Lengths of the ship at the start of the way that do not count, because the hull is not yet completely in the ice.
FULL = 1.2
# Ranges that docs/validation.md compares with measurements. "Pack ice": floes of 15 m, 0.5 m thick, at 1 m/s, covers
# from 0.3 to 0.9. "A ship in level ice": up to 0.5 m.
VALIDATED = {
    ice_scenes.PACK: {"speed_m_per_s": (1, 1), "thickness_m": (0.5, 0.5), "cover": (0.3, 0.9),
                      "floe_size_m": (15, 15)},
    ice_scenes.LEVEL: {"thickness_m": (0, 0.5)},
    ice_scenes.CHANNEL: None,  # no comparison
}


def points_of(speeds, thicknesses, covers, sizes):
    """All combinations of the values."""
    names = ("speed_m_per_s", "thickness_m", "cover", "floe_size_m")
    return [dict(zip(names, values)) for values in itertools.product(speeds, thicknesses, covers, sizes)]


def is_validated(regime, point):
    """Returns True if the point lies in the range that was compared with measurements."""
    ranges = VALIDATED[regime]
    return ranges is not None and all(low <= point[name] <= high for name, (low, high) in ranges.items())


def measured(folder, ship):
    """Mean resistance by ice around and under the hull [N], over the time in which the hull is in the ice."""
    length = ship["hull"]["length_m"]
    (columns,) = rows_by_ship(pathlib.Path(folder) / "forces.csv").values()
    x, surge, submerged = (np.array(columns[name]) for name in ("x_m", "surge_N", "surge_from_submerged_ice_N"))
    stem = x + 0.5 * length
    is_full = (stem > FULL * length) & (stem < ice_scenes.LENGTHS * length - 0.05 * length)
    return float(-surge[is_full].mean()), float(-submerged[is_full].mean())


class Resistance:
    """The points of one regime, each computed by runs with several seeds."""

    def __init__(self, regime, ship, ice, folder, program, seeds, step):
        self.regime, self.ship, self.ice, self.seeds, self.step = regime, ship, ice, seeds, step
        self.folder, self.program = pathlib.Path(folder), program

    def run(self, point, seed):
        """Resistance by contact and by submersion of one run [N]."""
        ice = dataclasses.replace(self.ice, thickness=point["thickness_m"])
        made = ice_scenes.scene(self.regime, self.ship, ice, point, seed, self.step)
        name = "-".join([self.regime, *(f"{value:g}" for value in point.values()), str(seed)])
        return measured(kept_run(self.program, self.folder, name, made), self.ship)

    def row(self, point, runs):
        """A row of the table from the runs of a point."""
        contact, submerged = np.array(runs).T
        sums = contact + submerged
        error = float(sums.std(ddof=1)) / math.sqrt(len(sums)) if len(sums) > 1 else math.nan
        return {**point, "resistance_N": float(sums.mean()), "error_N": error, "contact_N": float(contact.mean()),
                "submerged_N": float(submerged.mean()), "runs": len(sums),
                "is_in_validated_range": is_validated(self.regime, point)}

    def rows(self, points, jobs, report):
        """Returns all rows in the order of the points, and reports progress."""
        wanted = [(i, seed) for i in range(len(points)) for seed in range(1, self.seeds + 1)]
        found = {}
        with concurrent.futures.ThreadPoolExecutor(max(1, jobs)) as pool:
            futures = {pool.submit(self.run, points[i], seed): (i, seed) for i, seed in wanted}
            try:
                for future in concurrent.futures.as_completed(futures):
                    found[futures[future]] = future.result()
                    report(len(found), len(futures))
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        return [self.row(point, [found[i, seed] for seed in range(1, self.seeds + 1)])
                for i, point in enumerate(points)]
