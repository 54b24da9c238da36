"""`polynya performance SHIP` (polynya.command starts it): the speed of a ship in level ice over the thickness. With
--pack, --level or --channel coefficients.py makes a table of its resistance instead."""
import concurrent.futures
import json
import math
import os
import subprocess
import sys

from .. import formulas
from ..formulas import KNOT, hull_of
from ..program import program
from ..runs_kept import RunFailed
from ..study.case import DONE, FAILED, STOPPED
from . import coefficients, sensitivity
from .curve import BEYOND, THICKER, Curve, formula_words, mark_of
from .options import FLEXURAL_STRENGTH, FRICTION, STEP, read_options
from .tables import write_table

INPUT_OUTPUT = 5  # exit code of app/command_line/console.hpp


# Prints a message on stderr and returns the exit code `code`.
def fail(code, message):
    print(f"polynya performance: {message}", file=sys.stderr)
    return code


def ship_of(name):
    """Reads a preset or a ship file by `polynya ships` and returns the dict that --json --for-performance prints: its
    name and title, the ship with all defaults, its engine, reported speeds, and the source of each particular. If the
    ship is refused, this ends the command with the exit code of `polynya ships`, which prints the reason on stderr.
    Raises OSError if the program cannot be started."""
    words = [program(), "ships", name, "--json", "--for-performance"]
    done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != DONE:
        sys.exit(done.returncode)
    return json.loads(done.stdout)


def ten_thicknesses(curve):
    """Ten thicknesses [m], evenly spaced up to at most that at which Lindqvist's formula gives 0.2 m/s, searched
    between 0.05 and 5 m. The spacing is a multiple of 0.05 m, so the last one may be well below that limit; it is at
    least 0.05 m, so for a weak ship the last ones may be above."""
    thin, thick = 0.05, 5.0
    while thick - thin > 0.01:
        middle = 0.5 * (thin + thick)
        thin, thick = (middle, thick) if curve.formula_speeds(middle)["lindqvist"] > 0.2 else (thin, middle)
    step = max(0.05, math.floor(thin / 10 * 20) / 20)
    return [round(step * (i + 1), 3) for i in range(10)]


def print_table(rows):
    """Prints the rows of a curve (Curve.point) and the meaning of their marks. "stops": the ice stopped the ship. "not
    steady": even in the longest run the mean speed is less certain than --error asks for."""
    print(
        f"{'h [m]':>7} {'v [m/s]':>10}{'± scatter':>10}{'[kn]':>8}   {'contact [kN]':>13}{'under hull':>12}   "
        f"{'Lindqvist':>10}{'Riska':>8}{'Spencer-Jones':>15}"
    )
    for row in rows:
        note = "  stops" if row["is_stuck"] else "" if row["is_steady"] else "  not steady"
        print(
            f"{row['thickness_m']:7g}{mark_of(row):<2}{row['speed_m_per_s']:9.2f}{row['error_m_per_s']:10.2f}"
            f"{row['speed_m_per_s'] / KNOT:8.1f}   {row['contact_kN']:13.0f}{row['submerged_kN']:12.0f}   "
            f"{row['lindqvist_m_per_s']:10.2f}{row['riska_m_per_s']:8.2f}{row['spencer_jones_m_per_s']:15.2f}{note}"
        )
    print("±: standard error of the run's own mean speed [m/s], its statistical scatter alone, not the model's error")
    if words := formula_words(rows):
        print(f"{words} for ice under the hull, not mechanics (formula_share; docs/ships.md)")
    if any(not row["is_in_validated_range"] for row in rows):
        print(f"*: {THICKER}: the ship may go much too fast (docs/validation.md, \"A ship in level ice\")")
    for sign, words in BEYOND.items():
        beyond = [f"{row['thickness_m']:g} m" for row in rows if row["beyond_formulas"] == sign]
        if beyond:
            print(f"!: {words}, in {', '.join(beyond)}: no published formula supports that speed")


def print_sensitivity(found, curve, thicknesses, arguments):
    """Prints how much the mean speed by the published formulas changes with each particular of ship and ice, with a
    mark at those that nobody stated, and below it how estimated particulars were estimated. `found` is from ship_of().
    Returns the table for all `thicknesses` [m]. Needs no run."""
    is_given = {"flexural_strength": arguments.flexural_strength is not None,
                "friction": arguments.friction is not None}
    of = (curve.hull, curve.engine, curve.ice)
    rows = sensitivity.table(sensitivity.particulars(curve.ship, *of, found["from"], is_given), thicknesses, *of)
    sensitivity.print_table(rows, thicknesses)
    for path, words in found["estimated"].items():
        print(f"{path}: {words}")
    return rows


def report_progress(done, total, row):
    """Shows on stderr that `done` of `total` thicknesses have ended, `row` being the last: a bar that is overwritten on
    a terminal, otherwise a line for each report."""
    last = f"{row['thickness_m']:g} m at {row['speed_m_per_s']:.2f} m/s"
    if sys.stderr.isatty():
        filled = 30 * done // total
        bar = "#" * filled + "." * (30 - filled)
        end = "\n" if done == total else ""
        print(f"\r[{bar}] {done} of {total}  {last:<24}", end=end, file=sys.stderr, flush=True)
    else:
        print(f"{done} of {total}: {last}", file=sys.stderr, flush=True)


def run_all(curve, wanted, jobs):
    """Runs all thicknesses, `jobs` at a time, and reports progress. Thick ice, in which ships are slow and runs long,
    is started first. `wanted` are thicknesses [m]. Returns the rows, thinnest ice first. An error cancels the
    thicknesses that have not started, waits for those that run, and is raised again."""
    rows = {}
    with concurrent.futures.ThreadPoolExecutor(max(1, jobs)) as pool:
        futures = {pool.submit(curve.point, h): h for h in sorted(wanted, reverse=True)}
        try:
            for future in concurrent.futures.as_completed(futures):
                row = future.result()
                rows[futures[future]] = row
                report_progress(len(rows), len(futures), row)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return [rows[h] for h in sorted(rows)]


# Prints the speeds by the published formulas at the thicknesses `wanted` [m], for --list; 0: the ice stops the ship.
def print_formulas(curve, wanted):
    print(f"{'h [m]':>7}{'Lindqvist':>11}{'Riska':>8}{'Spencer-Jones':>15}   speeds [m/s]")
    for h in wanted:
        speeds = curve.formula_speeds(h)
        print(f"{h:7g}{speeds['lindqvist']:11.2f}{speeds['riska']:8.2f}{speeds['spencer_jones']:15.2f}")


def draw_figure(path, rows, found, ice, curve):
    """Draws the picture of the rows into the file `path` and prints its name. Without matplotlib a line on stderr says
    so, and the exit code of the command stays 0."""
    try:
        from . import figure
    except ImportError as error:
        print(f"figure  none: {error}; ./setup.sh python installs what it needs", file=sys.stderr)
        return
    title = [f"{found['title']}: level ice, full power",
             f"σf {ice.flexural_strength / 1e3:g} kPa, μ {ice.friction:g}"]
    figure.draw(rows, "\n".join(title), found["reported"], path, figure.formula_rows(curve, rows))
    print(f"figure  {path}")


# Carries out the command and returns its exit code: 0, 4 if a run failed, 5 if the program polynya is missing or a file
# cannot be written, and 75 if it was stopped; wrong options end it with 2. Tables are written after all runs have
# ended.
def main():
    arguments = read_options()
    try:
        found = ship_of(arguments.ship)
    except OSError as error:
        return fail(INPUT_OUTPUT, error)
    ice = formulas.Ice(  # ice of each thickness in turn
        thickness=0,
        flexural_strength=FLEXURAL_STRENGTH if arguments.flexural_strength is None else arguments.flexural_strength,
        friction=FRICTION if arguments.friction is None else arguments.friction,
    )
    if coefficients.regime_of(arguments):
        return coefficients.main(arguments, found, ice, fail, (DONE, FAILED, STOPPED))
    folder = arguments.out or os.path.join("runs", f"performance-{found['name']}")
    ship, reported = found["ship"], found["reported"]
    curve = Curve(ship, hull_of(ship), found["engine"], ice, folder, program(), arguments.error,
                  arguments.step or STEP)
    wanted = arguments.thickness or ten_thicknesses(curve)
    if arguments.list:
        print_formulas(curve, wanted)
        print_sensitivity(found, curve, wanted, arguments)
        return DONE
    os.makedirs(folder, exist_ok=True)
    try:
        rows = run_all(curve, wanted, arguments.jobs)
    except RunFailed as error:
        return fail(FAILED, error)
    except KeyboardInterrupt:
        return fail(STOPPED, "stopped; the same command goes on with the runs that are left")
    print_table(rows)
    for point in reported:
        print(
            f"design point, at least: {point['thickness_m']:g} m at {point['speed_m_per_s']:.2f} m/s "
            f"({point['speed_m_per_s'] / KNOT:.1f} kn), {point['source']}"
        )
    moves = print_sensitivity(found, curve, wanted, arguments)
    print()
    write_table(os.path.join(folder, "performance.csv"), rows)
    write_table(os.path.join(folder, "sensitivity.csv"), sensitivity.as_rows(moves, wanted))
    draw_figure(os.path.join(folder, "performance.png"), rows, found, ice, curve)
    return DONE


if __name__ == "__main__":
    from ..command import run

    sys.exit(run("performance", main))
