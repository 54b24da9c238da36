"""`polynya figures`: draws figures of runs into files (polynya.command starts it). matplotlib and numpy are imported
only when they are needed, so that --help works without them."""
import os
import sys
import time

from ..command import fail, run

COMMAND = "polynya figures"  # prefix of messages
DONE, USAGE = 0, 2  # exit codes, with the values of app/command_line/console.hpp


# Prints a note about something that is left out or incomplete on stderr. The exit code does not depend on it.
def note(words):
    print(f"note: {words}", file=sys.stderr)


def problem_of(options, runs):
    """Returns a message about the first option that does not apply to these runs; None if all apply. `runs` are
    results.Run objects. The times of --at must lie within the first run; a map of another run that is shorter shows its
    end. Every run with ships or structures must have the load of --load."""
    from . import loads

    first = runs[0]
    for time in options.at:
        if not first.start_time <= time <= first.end_time:
            return f"--at {time:g}: the run goes from {first.start_time:g} to {first.end_time:g} s"
    if options.label and len(options.label) != len(runs):
        return f"--label: {len(options.label)} names for {len(runs)} runs"
    if options.window:
        x0, y0, x1, y1 = options.window
        if x0 >= x1 or y0 >= y1:
            return f"--window {x0:g},{y0:g},{x1:g},{y1:g}: x0 must be below x1, and y0 below y1"
    for run in runs:
        if run.ship_names and not loads.chosen(run, options.load):
            return loads.why_not(run, options.load)
    return None


def pages(options, runs):
    """Yields (name, figure or None, reason if there is none) for each requested figure, in the order of --only, each
    drawn when it is asked for. `runs` are Labelled runs, and STYLES has the width and other sizes of --style."""
    from . import energy, loads, maps, motion, sizes
    from .page import STYLES, Page

    page = Page(STYLES[options.style], options.width_mm, options.title)
    drawn = {
        "floes": (lambda: maps.draw(runs, page, options.at, options.window), ""),
        "loads": (lambda: loads.draw(runs, page, options.load), "there is no ship and no structure, or no time passes"),
        "motion": (lambda: motion.draw(runs, page), "there is no ship and no structure, or no time passes"),
        "sizes": (lambda: sizes.draw(runs, page), "no floe floats then"),
        "energy": (lambda: energy.draw(runs, page), "there is no energy in summary.json"),
    }
    start = time.monotonic()
    for number, name in enumerate(options.only, 1):
        draw, why = drawn[name]
        # On a terminal progress is shown at once, because one figure of a large run takes long; otherwise after ten
        # seconds.
        if sys.stderr.isatty() or time.monotonic() - start > 10:
            print(f"drawing figure {number} of {len(options.only)}: {name}", file=sys.stderr, flush=True)
        yield name, draw(), why


def draw(options):
    """Draws the requested figures, and prints their paths. A figure that these runs cannot have is left out with a
    note, and the exit code is still 0; its files of an earlier call stay. Returns USAGE, with a message, if an option
    does not apply. Raises FolderError if a run cannot be read or has no frames; command.run() reports it."""
    from polynya.errors import FolderError
    from polynya.results.run import Run

    from .page import STYLES, save
    from .subjects import labelled

    try:
        runs = [Run(folder, unfinished=True, pandas=False, shapely=False) for folder in options.runs]
        for run in runs:
            if len(run.times) == 0:
                raise FolderError(f"{run.folder}: it has no frames")
            if not run.is_finished:
                note(f"{run.folder} is not finished; the figures end at {run.end_time:g} s")
        problem = problem_of(options, runs)
        labels = options.label or [None] * len(runs)
        if problem:
            return fail(COMMAND, problem, USAGE)
        shown = [labelled(run, label, options.start, options.end) for run, label in zip(runs, labels)]
    except FolderError:
        raise
    except ValueError as error:
        return fail(COMMAND, error, USAGE)
    folder = options.out or options.runs[0]
    os.makedirs(folder, exist_ok=True)
    for name, figure, why in pages(options, shown):
        if figure is None:
            note(f"{why}; figure-{name} is left out")
            continue
        for path in save(figure, os.path.join(folder, f"figure-{name}"), options.format, STYLES[options.style].dots):
            print(path, flush=True)
    return DONE


# Runs the command with these words, by default those of the process, and returns its exit code.
def main(words=None):
    from .options import command_line

    return draw(command_line().parse_args(words))


if __name__ == "__main__":
    sys.exit(run("figures", main))
