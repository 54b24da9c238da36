"""The runs of a table of resistance: one a point and seed. Finished runs are kept and used again."""
import concurrent.futures
import dataclasses
import itertools
import math
import pathlib

import numpy as np

from ..runs_kept import kept_run
from ..study.measures import rows_by_ship
from . import ice_scenes

FULL = 1.2  # lengths of the way that are left out at its start: the hull is not all in the ice
# What validation.md, "Pack ice", compares with: floes of 15 m, 0.5 m thick, at 1 m/s, covers from 0.3 to 0.9; and
# "A ship in level ice": up to 0.5 m.
VALIDATED = {
    ice_scenes.PACK: {"speed_m_per_s": (1, 1), "thickness_m": (0.5, 0.5), "cover": (0.3, 0.9),
                      "floe_size_m": (15, 15)},
    ice_scenes.LEVEL: {"thickness_m": (0, 0.5)},
    ice_scenes.CHANNEL: None,  # nothing
}


def points_of(speeds, thicknesses, covers, sizes):
    """Every combination."""
    names = ("speed_m_per_s", "thickness_m", "cover", "floe_size_m")
    return [dict(zip(names, values)) for values in itertools.product(speeds, thicknesses, covers, sizes)]


def is_validated(regime, point):
    """Whether the point lies in what the model was compared with."""
    ranges = VALIDATED[regime]
    return ranges is not None and all(low <= point[name] <= high for name, (low, high) in ranges.items())


def measured(folder, ship):
    """Mean resistance of the ice around and under the hull [N], where the hull is in the ice."""
    length = ship["hull"]["length_m"]
    (columns,) = rows_by_ship(pathlib.Path(folder) / "forces.csv").values()
    x, surge, submerged = (np.array(columns[name]) for name in ("x_m", "surge_N", "surge_from_submerged_ice_N"))
    stem = x + 0.5 * length
    is_full = (stem > FULL * length) & (stem < ice_scenes.LENGTHS * length - 0.05 * length)
    return float(-surge[is_full].mean()), float(-submerged[is_full].mean())


class Resistance:
    """The points of one regime, each as runs of some seeds."""

    def __init__(self, regime, ship, ice, folder, program, seeds, step):
        self.regime, self.ship, self.ice, self.seeds, self.step = regime, ship, ice, seeds, step
        self.folder, self.program = pathlib.Path(folder), program

    def run(self, point, seed):
        """Contact and submersion of one run [N]."""
        ice = dataclasses.replace(self.ice, thickness=point["thickness_m"])
        made = ice_scenes.scene(self.regime, self.ship, ice, point, seed, self.step)
        name = "-".join([self.regime, *(f"{value:g}" for value in point.values()), str(seed)])
        return measured(kept_run(self.program, self.folder, name, made), self.ship)

    def row(self, point, runs):
        """A row of the table, of a point's runs."""
        contact, submerged = np.array(runs).T
        sums = contact + submerged
        error = float(sums.std(ddof=1)) / math.sqrt(len(sums)) if len(sums) > 1 else math.nan
        return {**point, "resistance_N": float(sums.mean()), "error_N": error, "contact_N": float(contact.mean()),
                "submerged_N": float(submerged.mean()), "runs": len(sums),
                "is_in_validated_range": is_validated(self.regime, point)}

    def rows(self, points, jobs, report):
        """All rows, in the order of the points; what is done is reported as it comes."""
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
