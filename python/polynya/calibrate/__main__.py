"""`polynya calibrate SHIP TESTS.csv` (polynya.command starts it)."""
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys

import numpy as np

from ..errors import InputError
from ..program import program
from ..runs_kept import RunFailed, kept_run
from ..study.case import DONE, FAILED, STOPPED
from . import fit, level_tests
from .options import command_line

FINAL_SPEEDS = (0.98, 1.0, 1.02)  # of the runs that a table's row is the mean of


def ship_of(name):
    """What `polynya ships` has of a preset, or of a file's ship; ends as that does where the ship is refused."""
    done = subprocess.run([program(), "ships", name, "--json"], stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != DONE:
        sys.exit(done.returncode)
    found = json.loads(done.stdout)
    if "draught_m" not in found["ship"]["hull"]:
        raise InputError(f"{name}: hull.draught_m: not given; a resistance needs the ice under the hull")
    return found


class Bench:
    """Runs tests at factors, some at a time."""

    def __init__(self, ship, friction, folder, jobs):
        self.ship, self.friction, self.folder, self.jobs = ship, friction, folder, jobs

    def one(self, test, factors, share, submerged):
        """Mean, standard deviation, and of the mean the ice under the hull [kN]; that is as it is given, or found once
        the hull is full."""
        factors, share = [round(float(factor), 6) for factor in factors], round(float(share), 6)
        scene = level_tests.scene(test, self.ship, factors, self.friction, share, is_full=submerged is None)
        name = f"{test.name}-{factors[0]:g}-{factors[1]:g}-{share:g}" + ("" if submerged is None else "-bow")
        contact, under = level_tests.measured(kept_run(program(), self.folder, name, scene), scene)
        total = contact + (under if submerged is None else submerged)
        return total.mean(), max(total.std(ddof=1), 1e-3 * total.mean()), (total - contact).mean()

    def all(self, tests, factors, shares, word, submerged=None):
        """[point, test, 3] of points of factors, each with its share of the speed."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            under = [None] * len(tests) if submerged is None else submerged
            futures = [[pool.submit(self.one, test, f, s, u) for test, u in zip(tests, under)]
                       for f, s in zip(factors, shares)]
            try:
                for number, of_point in enumerate(futures, 1):
                    concurrent.futures.wait(of_point)
                    print(f"{word}: {number} of {len(futures)}", file=sys.stderr, flush=True)
                return np.array([[future.result() for future in of_point] for of_point in futures])
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise


def over_measured(results, tests):
    """Logarithms of mean and standard deviation over those measured."""
    return np.log(results[..., :2] / np.array([[test.mean, test.sd] for test in tests]))


def searched(bench, tests, as_computed, count):
    """What the surface has on the grid of factors: runs about 1, then runs about the first best point. The bow alone is
    run, with the ice under the hull that the runs as computed had."""
    first, under = count // 2, as_computed[:, :, 2].mean(0)
    points, shares = fit.spread(first, np.zeros(2), math.log(2))
    values = over_measured(bench.all(tests, np.exp(points), shares, "about 1", under), tests)
    points = np.vstack([np.zeros((len(FINAL_SPEEDS), 2)), points])
    values = np.concatenate([over_measured(as_computed, tests), values])
    best = fit.GRID[fit.fit(fit.surface(points, values, fit.GRID)).at]
    near, shares = fit.spread(count - first, best, math.log(1.6))
    more = over_measured(bench.all(tests, np.exp(near), shares, "about the best", under), tests)
    points, values = np.vstack([points, near]), np.concatenate([values, more])
    scatter = (values - fit.surface(points, values, points)).std(0)
    return fit.surface(points, values, fit.GRID), scatter


def print_result(rows, found, out_of_sample):
    print(f"{'test':>8}{'h [m]':>7}{'v [m/s]':>9}   "
          f"{'measured':>13}{'as computed':>15}{'calibrated':>15}{'without it':>12}")
    for row in rows:
        pair = lambda key: f"{row[key][0]:.0f} ± {row[key][1]:.0f}"
        print(f"{row['test']:>8}{row['thickness_m']:7g}{row['speed_m_per_s']:9g}   {pair('measured_kN'):>13}"
              f"{pair('as_computed_kN'):>15}{pair('calibrated_kN'):>15}"
              + (f"{row['left_out_mean_over_measured']:12.2f}" if row["is_fitted"] else f"{'predicted':>12}"))
    print("mean ± standard deviation [kN]; without it: mean over measured by the factors of the other tests")
    for k, name in enumerate(("load_factor", "cusp_radius_factor")):
        print(f"{name:<19}{found.factors[k]:6.2f}   {found.low[k]:.2f} to {found.high[k]:.2f} with 68 %")
    if found.is_at_edge:
        print("the best factors are at the edge of what is searched: these tests do not determine them")
    if out_of_sample is not None:
        print(f"error of a mean that was left out: {100 * out_of_sample:.0f} % (root mean square of all tests, one at "
              f"a time)")


def write_ship(ship, found, path):
    """The ship with every default, and its calibration."""
    load, radius = (float(f"{factor:.3g}") for factor in found.factors)
    calibrated = ship | {"calibration": {"load_factor": load, "cusp_radius_factor": radius}}
    path.write_text(json.dumps(calibrated, indent=2) + "\n", encoding="utf-8")


def draw(rows, found, title, path):
    try:
        from . import figure
    except ImportError as error:
        print(f"figure  none: {error}; ./setup.sh python installs what it needs", file=sys.stderr)
        return
    figure.draw(rows, found, title, path)
    print(f"figure  {path}")


def calibrate(arguments, tests, described, folder):
    fitted = [test for test in tests if test.name not in arguments.leave_out]
    bench = Bench(described["ship"], arguments.friction, folder, arguments.jobs)
    half = len(FINAL_SPEEDS)
    as_computed = bench.all(tests, [np.ones(2)] * half, FINAL_SPEEDS, "as computed")
    is_fitted = [test in fitted for test in tests]
    on_grid, scatter = searched(bench, fitted, as_computed[:, is_fitted], arguments.points)
    found = fit.fit(on_grid)
    left_out = fit.leave_one_out(on_grid) if len(fitted) > 1 else []
    out_of_sample = math.sqrt(np.mean([math.log(ratio[0]) ** 2 for _, ratio in left_out])) if left_out else None
    calibrated = bench.all(tests, [found.factors] * half, FINAL_SPEEDS, "calibrated")
    rows = []
    for k, test in enumerate(tests):
        row = {"test": test.name, "thickness_m": test.ice["thickness_m"], "speed_m_per_s": test.speed,
               "is_fitted": is_fitted[k],
               "measured_kN": [test.mean, test.sd], "as_computed_kN": as_computed[:, k, :2].mean(0).tolist(),
               "calibrated_kN": calibrated[:, k, :2].mean(0).tolist(),
               "submerged_kN": float(calibrated[:, k, 2].mean())}
        if left_out and row["is_fitted"]:
            others, ratio = left_out[fitted.index(test)]
            row |= {"left_out_mean_over_measured": float(ratio[0]), "left_out_sd_over_measured": float(ratio[1]),
                    "left_out_factors": others.factors.tolist()}
        elif row["is_fitted"]:
            row["left_out_mean_over_measured"] = math.nan
        rows.append(row)
    print_result(rows, found, out_of_sample)
    record = {"factors": found.factors.tolist(), "low_68": found.low.tolist(), "high_68": found.high.tolist(),
              "is_at_edge": found.is_at_edge, "misfit_over_tolerance": found.misfit, "left_out_error": out_of_sample,
              "run_scatter": scatter.tolist(), "friction": arguments.friction, "tests": rows}
    (folder / "calibration.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    ship = folder / f"{described['name']}-calibrated.json"
    write_ship(described["ship"], found, ship)
    print(f"ship    {ship}\nerrors  {folder / 'calibration.json'}")
    draw(rows, found, described["title"], folder / "calibration.png")


def main():
    arguments = command_line().parse_args()
    tests = level_tests.read_tests(arguments.tests)
    unknown = [name for name in arguments.leave_out if name not in [test.name for test in tests]]
    if unknown:
        raise InputError([f"--leave-out: no test {name} in {arguments.tests}" for name in unknown])
    if len(arguments.leave_out) == len(tests):
        raise InputError("--leave-out: no test is left to fit")
    described = ship_of(arguments.ship)
    folder = pathlib.Path(arguments.out or f"runs/calibrate-{described['name']}")
    folder.mkdir(parents=True, exist_ok=True)
    try:
        calibrate(arguments, tests, described, folder)
    except RunFailed as error:
        print(f"polynya calibrate: {error}", file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        print("polynya calibrate: stopped; the same command goes on with the runs that are left", file=sys.stderr)
        return STOPPED
    return DONE


if __name__ == "__main__":
    from ..command import run

    sys.exit(run("calibrate", main))
