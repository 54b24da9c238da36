"""`polynya loads`: tables, figures and a page of the peaks of the ice force (polynya.command starts it)."""
import pathlib
import sys

from ..command import fail, run
from ..files import writing

COMMAND = "polynya loads"  # prefix of messages
DONE, USAGE = 0, 2  # exit codes, with the values of app/command_line/console.hpp


def draw(loads, estimates, options, out):
    """Writes the figures that have enough data into the folder `out` and prints their names, in the style and the
    formats of the options. SVG is always among the formats, because the page shows it. `estimates` has
    (Loads, Estimate) by kind of run. Returns (name of the SVG, description) for each figure."""
    from polynya.figures.page import STYLES, Page, save

    from . import pictures

    style, drawn = STYLES[options.style], []
    for name, words, figure in pictures.all_of(loads, estimates, Page(style)):
        if figure is None:
            continue
        for path in save(figure, str(out / f"loads-{name}"), dict.fromkeys([*options.format, "svg"]), style.dots):
            print(path, flush=True)
        drawn.append((f"loads-{name}.svg", words))
    return drawn


def report(options):
    """Gathers the peaks, writes loads-*.csv, the figures and loads.html, and prints the results. Of the options
    (loads/options.py), `folder` is that of a run or a study, `start` the first time that counts [s], `panel` the length
    of the panels by which peaks are counted [m], `least` the threshold of the fits [N], and `half_width` that of the
    intervals for which the record needed is stated, as a fraction of the value. A table without rows is not written,
    and one of an earlier call is removed. Returns an exit code: USAGE if the options do not fit the folder, for example
    a ship that the run does not have. run() reports other errors and gives their exit codes."""
    # These modules need numpy, scipy and matplotlib, which the texts of --help do not.
    from polynya.errors import InputError
    from polynya.study.located_json import StudyError

    from . import estimate, gather, page, tables, words

    try:
        loads = gather(options.folder, options.ship, options.start, options.panel)
    except StudyError:  # the folder is damaged; the message is already complete
        raise
    except InputError as error:
        return fail(COMMAND, error, USAGE)
    out = pathlib.Path(options.out or pathlib.Path(options.folder) / "loads")
    out.mkdir(parents=True, exist_ok=True)
    estimates = tables.estimates_of(loads, options.least)
    answers = list(tables.answers_of(estimates, options))
    written = {"peaks": tables.rows_of(loads.peaks), "panels": estimate.panels(loads),
               "exceedance": tables.exceedance_rows(estimates), "fits": list(tables.fit_rows(estimates)),
               "returns": list(tables.return_rows(answers))}
    for name, rows in written.items():
        if rows:
            tables.write_csv(out / f"loads-{name}.csv", rows)
            print(out / f"loads-{name}.csv", flush=True)
        else:  # an earlier call may have left one
            (out / f"loads-{name}.csv").unlink(missing_ok=True)
    drawn = draw(loads, estimates, options, out)
    shown = [("Fits", list(page.fit_rows(estimates))), ("Panels", written["panels"])]
    made = page.page(loads, estimates, answers, options, shown, drawn)
    with writing(out / "loads.html") as file:
        file.write(made)
    print(out / "loads.html")
    print(*words.lines_of(loads, estimates, answers, options.half_width), sep="\n")
    return DONE


def main(words=None):
    from .options import command_line

    return report(command_line().parse_args(words))


if __name__ == "__main__":
    sys.exit(run("loads", main))
