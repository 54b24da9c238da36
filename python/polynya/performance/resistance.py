"""Computes a table of resistance: for each point (a speed, thickness, cover and floe size) the mean over runs with
several seeds. Finished runs are kept in a folder and reused if their scene is the same."""
import concurrent.futures
import dataclasses
import itertools
import math
import pathlib

import numpy as np

from ..runs_kept import kept_run
from ..study.measures import rows_by_ship
from . import ice_scenes

# The resistance counts from the time at which the stem is this far in the ice [ship lengths]. At 1 the hull has just
# entered completely; the other 0.2 are a margin. Larger: less of the course (ice_scenes.LENGTHS) is measured, so that
# the scatter grows. Smaller than 1: the resistance is too small, because part of the hull is in open water.
FULL = 1.2
# Ranges in which docs/validation.md supports the resistance by comparing it with published formulas, by regime and name
# of a point's value (lowest, highest). A name that is missing has no limit. Points outside are marked in tables and
# JSON; they are computed in the same way. Chapter "Pack ice": floes of 15 m, 0.5 m thick, at 1 m/s, covers from 0.3 to
# 0.9. Chapter "A ship in level ice": up to 0.5 m (there only up to 2 m/s, which is not a limit here).
VALIDATED = {
    ice_scenes.PACK: {"speed_m_per_s": (1, 1), "thickness_m": (0.5, 0.5), "cover": (0.3, 0.9),
                      "floe_size_m": (15, 15)},
    ice_scenes.LEVEL: {"thickness_m": (0, 0.5)},
    ice_scenes.CHANNEL: None,  # no point is in the range: the only comparison is with the ice class rules' formula
}


def points_of(speeds, thicknesses, covers, sizes):
    """Returns all combinations of the speeds [m/s], thicknesses [m], covers [-] and floe sizes [m] as points, which are
    dicts. The floe size varies fastest."""
    names = ("speed_m_per_s", "thickness_m", "cover", "floe_size_m")
    return [dict(zip(names, values)) for values in itertools.product(speeds, thicknesses, covers, sizes)]


def is_validated(regime, point):
    """Returns True if the point lies in the range of VALIDATED, limits included."""
    ranges = VALIDATED[regime]
    return ranges is not None and all(low <= point[name] <= high for name, (low, high) in ranges.items())


def measured(folder, ship):
    """Returns two mean resistances of a run [N], positive against the motion: by contacts with ice around the hull, and
    by ice under the hull, which the first does not contain. They are means over the rows of forces.csv in which the
    stem is more than FULL ship lengths behind the edge of the ice (x = 0) and has more than 0.05 ship lengths to its
    end, where ice in front of the stem would break out. NaN if there is no such row."""
    length = ship["hull"]["length_m"]
    (columns,) = rows_by_ship(pathlib.Path(folder) / "forces.csv").values()
    x, surge, submerged = (np.array(columns[name]) for name in ("x_m", "surge_N", "surge_from_submerged_ice_N"))
    stem = x + 0.5 * length
    is_full = (stem > FULL * length) & (stem < ice_scenes.LENGTHS * length - 0.05 * length)
    return float(-surge[is_full].mean()), float(-submerged[is_full].mean())


class Resistance:
    """Computes the rows of a table for one regime: pack ice, level ice or a channel of brash (ice_scenes.py).

    ship: a ship as in a scene. ice: a formulas.Ice, whose thickness is replaced by that of each point. folder: place
    of the runs. program: path of polynya. seeds: number of runs per point, which have the seeds 1, 2 and so on. step:
    time step [s]; None means the default of a scene."""

    def __init__(self, regime, ship, ice, folder, program, seeds, step):
        self.regime, self.ship, self.ice, self.seeds, self.step = regime, ship, ice, seeds, step
        self.folder, self.program = pathlib.Path(folder), program

    def run(self, point, seed):
        """Makes the run of a point with a seed, unless it is kept from before. Its name has six digits of each value:
        points that differ less share a folder, and each run replaces the other's. Returns the resistances by contact
        and by submersion [N]. Raises RunFailed if the run fails."""
        ice = dataclasses.replace(self.ice, thickness=point["thickness_m"])
        made = ice_scenes.scene(self.regime, self.ship, ice, point, seed, self.step)
        name = "-".join([self.regime, *(f"{value:g}" for value in point.values()), str(seed)])
        return measured(kept_run(self.program, self.folder, name, made), self.ship)

    def row(self, point, runs):
        """Returns a row of the table from the pairs (contact, submersion) of a point's runs [N]. Its error is the
        standard error of the mean over the seeds, NaN for a single run."""
        contact, submerged = np.array(runs).T
        sums = contact + submerged
        error = float(sums.std(ddof=1)) / math.sqrt(len(sums)) if len(sums) > 1 else math.nan
        return {**point, "resistance_N": float(sums.mean()), "error_N": error, "contact_N": float(contact.mean()),
                "submerged_N": float(submerged.mean()), "runs": len(sums),
                "is_in_validated_range": is_validated(self.regime, point)}

    def rows(self, points, jobs, report):
        """Makes the runs of all points, `jobs` at a time, and returns the rows in the order of the points. `report` is
        called with the number of finished runs and their total. An error or Ctrl-C cancels the runs that have not
        started, and is raised again when those that have started are over."""
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
