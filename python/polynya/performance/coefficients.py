"""`polynya performance SHIP --pack`, --level and --channel: a table of the resistance of a ship that keeps its speed,
and a formula fitted to it (colbourne.py) as JSON for route planners."""
import json
import math
import os
import sys

from ..files import writing
from ..program import program
from ..runs_kept import RunFailed
from . import colbourne, ice_scenes, rules
from .resistance import VALIDATED, Resistance, points_of
from .tables import write_table

# Values of the table by regime if the options do not give others: covers [-], floe or piece sizes [m], speeds [m/s] and
# thicknesses [m]. Every combination is a point. Level ice is one plate, so its cover is 1 and its size 0 (none). In a
# channel 2.572 m/s are 5 knots and the thicknesses belong to the ice classes, for which rules.py needs these points.
# More values need more runs (points times fields) and determine the fit better; the help of the options states these
# values.
COVERS = {ice_scenes.PACK: (0.5, 0.7, 0.85), ice_scenes.LEVEL: (1.0,), ice_scenes.CHANNEL: (0.8,)}
SIZES = {ice_scenes.PACK: (20.0, 40.0), ice_scenes.LEVEL: (0.0,), ice_scenes.CHANNEL: (2.0,)}
SPEEDS = {ice_scenes.PACK: (1.0, 2.0, 4.0), ice_scenes.LEVEL: (1.0, 2.0, 4.0), ice_scenes.CHANNEL: (1.0, 2.572, 4.0)}
THICKNESSES = {ice_scenes.PACK: (0.3, 0.5, 0.8), ice_scenes.LEVEL: (0.3, 0.5, 0.8),
               ice_scenes.CHANNEL: (0.6, 0.8, 1.0)}
# Sentence by regime on what the model was compared with, for `not_supported` of the JSON file. It must be changed with
# docs/validation.md and resistance.VALIDATED.
NOTHING = {
    ice_scenes.CHANNEL: "Compared with the ice class rules' formula alone (docs/brash.md), not with measurements.",
    ice_scenes.PACK: "Compared with published curves only for floes of 15 m, 0.5 m thick, at 1 m/s, covers 0.3 to "
                     "0.9 (docs/validation.md, \"Pack ice\"): between Colbourne's slender and blunt ships from cover "
                     "0.5 on.",
    ice_scenes.LEVEL: "Compared with published formulas in ice up to 0.5 m thick and up to 2 m/s, and with ten tests "
                      "of one ship, of which the means miss some (docs/validation.md, \"A ship in level ice\" and \"A "
                      "ship that was measured\").",
}


def regime_of(arguments):
    """Returns the regime that the options --pack, --level or --channel request, or None without such an option: then
    the speed in level ice is computed instead."""
    return next((name for name in (ice_scenes.PACK, ice_scenes.LEVEL, ice_scenes.CHANNEL) if getattr(arguments, name)),
                None)


# Returns the points of the table, as resistance.points_of() does, from the options, or for those not given from the
# values above. Level ice ignores cover and floe size.
def wanted_points(regime, arguments):
    if regime == ice_scenes.LEVEL:
        covers, sizes = COVERS[regime], SIZES[regime]
    else:
        covers, sizes = arguments.cover or COVERS[regime], arguments.floe_size or SIZES[regime]
    return points_of(arguments.speed or SPEEDS[regime], arguments.thickness or THICKNESSES[regime], covers, sizes)


def print_points(points, seeds):
    """Prints the points and the number of runs that the table would need with so many seeds per point, for --list."""
    print(f"{'V [m/s]':>8}{'h [m]':>8}{'C':>7}{'floes [m]':>11}")
    for point in points:
        print(f"{point['speed_m_per_s']:8g}{point['thickness_m']:8g}{point['cover']:7g}{point['floe_size_m']:11g}")
    print(f"{len(points)} points, {len(points) * seeds} runs")


# Prints the rows of Resistance.rows() with `fit_N`, the resistance by the fit, and the meaning of their marks. An error
# that is not known, because there is one field per point, is printed as nan.
def print_table(rows):
    print(f"{'V [m/s]':>8}{'h [m]':>8}{'C':>7}{'floes [m]':>11}{'R [kN]':>10}{'± fields':>10}{'contact':>10}"
          f"{'under hull':>12}{'fit [kN]':>10}")
    for row in rows:
        mark = "" if row["is_in_validated_range"] else "*"
        error = "-" if math.isnan(row["error_N"]) else f"{row['error_N'] / 1e3:.1f}"
        print(f"{row['speed_m_per_s']:8g}{row['thickness_m']:8g}{row['cover']:7g}{row['floe_size_m']:11g}"
              f"{row['resistance_N'] / 1e3:10.1f}{error:>10}{row['contact_N'] / 1e3:10.1f}"
              f"{row['submerged_N'] / 1e3:12.1f}{row['fit_N'] / 1e3:10.1f} {mark}".rstrip())
    print("± fields: standard error of the mean over random fields, not the model's error")
    if any(not row["is_in_validated_range"] for row in rows):
        print("*: outside of what the model was compared with")


def described(name, found, ice, fitted, rows):
    """Returns the contents of the JSON file for other programs: the fit `fitted` (a colbourne.Fit), the ship and ice
    for which it holds, its range, and what it does not support. `name` is the regime, `found` the ship as `polynya
    ships --json --for-performance` describes it, `ice` a formulas.Ice, and `rows` those of the table, also the ones
    without a resistance. `n` and `n_error` are null if all points have the same cover. The keys are part of the format
    that route planners read."""
    ranges = {key: [min(row[key] for row in rows), max(row[key] for row in rows)]
              for key in ("speed_m_per_s", "thickness_m", "cover", "floe_size_m")}
    return {
        "ship": found["name"], "title": found["title"], "ice": name, "form": colbourne.FORM,
        "k": fitted.k, "k_error": fitted.k_error, "b": fitted.b, "b_error": fitted.b_error,
        "n": fitted.n, "n_error": fitted.n_error, "scatter_factor": fitted.scatter, "points": fitted.points,
        "points_without_resistance": sum(row["resistance_N"] <= 0 for row in rows),
        "beam_m": found["ship"]["hull"]["beam_m"], "ice_density_kg_per_m3": ice.density,
        "flexural_strength_Pa": ice.flexural_strength, "friction": ice.friction,
        "range": ranges, "validated_range": VALIDATED[name],
        "not_supported": [
            "Outside of range the fit extrapolates.", NOTHING[name],
            "The scatter is that of the points about the fit; the model's own error is not in it.",
            "Open-water resistance is not in it.",
        ],
    }


# Shows the number of finished runs on stderr; on a terminal the line is overwritten.
def report_progress(done, total):
    print(f"{done} of {total} runs", end="\r" if sys.stderr.isatty() and done < total else "\n", file=sys.stderr)


# Writes the table as CSV and the fit as JSON into `folder`; both files are named by the regime, such as pack.json, and
# replace those of an earlier call. Prints their names. Raises OSError if one cannot be written.
def write_files(folder, name, rows, found, ice, fitted):
    write_table(os.path.join(folder, f"{name}.csv"), rows)
    path = os.path.join(folder, f"{name}.json")
    with writing(path) as file:
        json.dump(described(name, found, ice, fitted, rows), file, indent=2)
        file.write("\n")
    print(f"fit     {path}")


def main(arguments, found, ice, fail, codes):
    """Makes the table for the requested regime and returns an exit code. `found` is as in described(), `ice` a
    formulas.Ice without thickness. `fail(code, message)` prints a message and returns the code. `codes` are the exit
    codes done, failed and stopped. Level ice has one run per point, because it has no random field of floes. Points
    whose resistance is not positive are left out of the fit, which uses logarithms. If a run fails, nothing is
    written, but finished runs are kept for the next call. If the points do not determine the fit, the table is written
    without it."""
    done, failed, stopped = codes
    name = regime_of(arguments)
    if arguments.list and name == ice_scenes.CHANNEL:
        rules.print_table(rules.rows(found["ship"], []), found["ship"])
        return done
    points, seeds = wanted_points(name, arguments), 1 if name == ice_scenes.LEVEL else arguments.fields
    if arguments.list:
        print_points(points, seeds)
        return done
    folder = arguments.out or os.path.join("runs", f"resistance-{found['name']}")
    os.makedirs(folder, exist_ok=True)
    runs = Resistance(name, found["ship"], ice, folder, program(), seeds, arguments.step)
    beam = found["ship"]["hull"]["beam_m"]
    try:
        rows = runs.rows(points, arguments.jobs, report_progress)
        with_resistance = [row for row in rows if row["resistance_N"] > 0]
        fitted = colbourne.fit(with_resistance, [row["resistance_N"] for row in with_resistance], beam, ice.density)
    except RunFailed as error:
        return fail(failed, error)
    except colbourne.NotEnough as error:
        write_table(os.path.join(folder, f"{name}.csv"), rows)
        return fail(failed, error)
    except KeyboardInterrupt:
        return fail(stopped, "stopped; the same command goes on with the runs that are left")
    for row in rows:
        row["fit_N"] = fitted.resistance(row, beam, ice.density)
    print_table(rows)
    of_cover = "" if fitted.n is None else f", n = {fitted.n:.2f} ± {fitted.n_error:.2f}"
    print(f"{colbourne.FORM}: k = {fitted.k:.3g} ± {fitted.k_error:.2g}, b = {fitted.b:.2f} ± {fitted.b_error:.2f}"
          f"{of_cover}; a point lies within a factor of {fitted.scatter:.2f} (one standard deviation)")
    if math.isclose(arguments.fields, 1) and name != ice_scenes.LEVEL:
        print("Each point is a run in one field of ice, so the errors of the means are not known: --fields 4")
    write_files(folder, name, rows, found, ice, fitted)
    if name == ice_scenes.CHANNEL:
        asked = rules.rows(found["ship"], rows)
        rules.print_table(asked, found["ship"])
        write_table(os.path.join(folder, "ice-class.csv"), asked)
    return done
