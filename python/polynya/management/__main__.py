"""`polynya management FOLDER …`: measures the effect of ice management in runs, or ranks the patterns of a study
(polynya.command starts it)."""
import contextlib
import csv
import dataclasses
import json
import pathlib
import sys


from ..errors import InputError
from ..files import writing
from ..naming import names_of_folders
from ..results.run import Run
from ..study import folder as folders
from ..study.gather import gather
from . import cautions, study, words
from .gates import Passage, distribution, gates_of, passages
from .measures import effort, measures_of, rows_of
from .options import command_line

DONE = 0  # exit code, also with warnings; errors are exceptions, for which polynya.command chooses the code


@dataclasses.dataclass
class Case:
    """A run, and the ice that passed its gates."""

    name: str  # the run's name in tables and figures
    run: Run
    gates: object  # gates.Gates
    before: Passage  # ice that passed the upstream gate
    after: Passage  # ice that passed the gate at the body
    measures: dict  # name -> value, or None (measures.measures_of)

    @property
    def intervals(self):
        """Number of rows of forces.csv of the body after the start of the gates, at least 1: the divisor of fractions
        of time."""
        return max(1, len(rows_of(self.run, self.gates.body, self.gates.start)["t_s"]))


def given_by(arguments):
    """The options for the gates that are given, with the names of a study's collect.management; empty if none is
    given."""
    named = {"body": arguments.body, "upstream_m": arguments.upstream, "near_m": arguments.near,
             "width_m": arguments.width,
             "size_m": arguments.size, "from_s": arguments.start}
    return {key: value for key, value in named.items() if value is not None}


def case_of(folder, name, given):
    """Reads and measures the run in a folder, and returns a Case. Raises FolderError if the run cannot be read or is
    not finished, and InputError if the gates do not fit it."""
    run = Run(folder, pandas=False)
    gates = gates_of(run, given)
    return Case(name, run, gates, *passages(run, gates), measures_of(run, given))


def labels_of(arguments):
    """A name for each folder: the names of --label, otherwise the parts in which the folders' paths differ. Raises
    InputError if the numbers of names and folders differ."""
    if arguments.label and len(arguments.label) != len(arguments.folders):
        raise InputError(f"--label: found {len(arguments.label)} names, allowed: one for each of the "
                         f"{len(arguments.folders)} folders", 2)
    return arguments.label or names_of_folders(arguments.folders)


def shown(value):
    """A measure with four digits, or a dash for None."""
    return "-" if value is None else f"{value:.4g}"


# Prints the warnings of each case (cautions.of_measures) on stdout.
def print_cautions(cases):
    for case in cases:
        for sentence in cautions.of_measures(case.measures, case.gates.body):
            print(f"WARNING: {case.name}: {sentence}")


def print_cases(cases):
    """Prints warnings, a table with a row per measure and a column per run, the effort of the icebreakers, and the
    gates. The names of measures are shown without "management_"."""
    print_cautions(cases)
    names = list(cases[0].measures)
    width = max(map(len, names)) - len("management_")
    columns = [max(12, len(case.name)) for case in cases]
    print(" " * width + "".join(f"  {case.name:>{column}}" for case, column in zip(cases, columns)))
    for name in names:
        print(f"{name.removeprefix('management_'):{width}}"
              + "".join(f"  {shown(case.measures.get(name)):>{column}}" for case, column in zip(cases, columns)))
    for case in cases:
        for ship, of in effort(case.run, case.gates.start).items():
            print(f"{case.name}: {ship} went {of['distance_m'] / 1e3:.2f} km; its engine delivered "
                  f"{of['energy_J'] / 1e9:.3g} GJ")
        gates = case.gates
        print(f"{case.name}: gates {gates.width:g} m wide, {gates.upstream:g} and {gates.near:g} m upstream of "
              f"{gates.body}; hits are of floes from {gates.size:g} m on")
    if len(cases) > 1:
        print("One run a column: no interval. A study over seeds says what is more than chance (docs/management.md).")


def write_tables(cases, folder):
    """Writes management.csv, with a row of measures per run, and management-sizes.csv, with the floes that passed each
    gate by their size √area, in classes of which empty ones are left out. Both files replace earlier ones, and their
    names are printed. A measure that is None is an empty cell."""
    with writing(folder / "management.csv", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["run", *cases[0].measures])
        for case in cases:
            writer.writerow([case.name, *("" if value is None else value for value in case.measures.values())])
    with writing(folder / "management-sizes.csv", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["run", "gate", "from_m", "to_m", "floes", "area_m2"])
        for case in cases:
            for gate, passage in (("upstream", case.before), ("at_body", case.after)):
                edges, numbers, areas = distribution(passage)
                for low, high, number, area in zip(edges, edges[1:], numbers, areas):
                    if number:
                        writer.writerow([case.name, gate, f"{low:.4g}", f"{high:.4g}", number, f"{area:.6g}"])
    print(f"tables  {folder / 'management.csv'}, {folder / 'management-sizes.csv'}")


def draw(arguments, out, figures_of):
    """Writes the pictures that figures_of(page) yields as (name, figure) into the folder `out`, and prints their names.
    A figure that is None is left out; its files of an earlier call stay. Without matplotlib it prints a line that says
    so on stderr, which is no error."""
    try:
        from ..figures.page import STYLES, Page, save
    except ImportError as error:
        print(f"figure  none: {error}; ./setup.sh python installs what it needs", file=sys.stderr)
        return
    style = STYLES[arguments.style]
    for name, figure in figures_of(Page(style)):
        if figure is not None:
            for path in save(figure, str(out / name), arguments.format, style.dots):
                print(f"figure  {path}")


def report_study(arguments, out):
    """Gathers the study, then prints and writes the results of `polynya management STUDY`. With --json it only prints.
    Returns DONE even if cases are missing; the results then rest on the finished ones."""
    with contextlib.redirect_stdout(sys.stderr):  # stdout is for the results only
        gather(folders.open_study(arguments.folders[0]))
    found = study.read(arguments.folders[0])
    if arguments.json:
        print(study.in_json(found))
        return DONE
    print(*words.lines_of(found), sep="\n")
    out.mkdir(parents=True, exist_ok=True)
    words.write_ranking(found, out / "management-ranking.csv")
    words.write_means(found, out / "management.csv")
    print(f"tables  {out / 'management-ranking.csv'}, {out / 'management.csv'}")

    def figures_of(page):
        from . import study_figure

        yield "management-ranking", study_figure.draw_ranking(found, page)
        yield "management", study_figure.draw_study(found, page)

    draw(arguments, out, figures_of)
    return DONE


def report_runs(arguments, out):
    """Prints and writes the results of `polynya management RUN …`. With --json it only prints {name: measures}. Returns
    DONE."""
    given, names = given_by(arguments), labels_of(arguments)
    cases = [case_of(folder, name, given) for folder, name in zip(arguments.folders, names)]
    if arguments.json:
        print(json.dumps({case.name: case.measures for case in cases}, indent=2))
        return DONE
    print_cases(cases)
    out.mkdir(parents=True, exist_ok=True)
    write_tables(cases, out)

    def figures_of(page):
        from . import figure

        yield "management", figure.draw_runs(cases, page)

    draw(arguments, out, figures_of)
    return DONE


def main():
    """Runs the command. A folder with plan.json is a study; a study must be the only folder and takes no gates, because
    its cases were measured with those of its collect.management. Raises InputError with code 2 otherwise. Tables and
    figures go to --out, by default the first folder."""
    arguments = command_line().parse_args()
    out = pathlib.Path(arguments.out or arguments.folders[0])
    studies = [folder for folder in arguments.folders if (pathlib.Path(folder) / folders.PLAN).is_file()]
    if not studies:
        return report_runs(arguments, out)
    if len(arguments.folders) > 1 or given_by(arguments) or arguments.label:
        raise InputError("of a study the gates are those of its collect.management: one folder, and neither gates nor "
                         "labels", 2)
    return report_study(arguments, out)


if __name__ == "__main__":
    sys.exit(main())
