"""`polynya management FOLDER …` (polynya.command starts it)."""
import csv
import dataclasses
import json
import pathlib
import sys


from ..errors import InputError
from ..results.run import Run
from ..study import folder as folders
from . import study
from .gates import Passage, distribution, gates_of, passages
from .measures import effort, measures_of, rows_of
from .options import command_line

DONE = 0


@dataclasses.dataclass
class Case:
    """A run with what passed its gates."""

    name: str
    run: Run
    gates: object
    before: Passage
    after: Passage
    measures: dict

    @property
    def intervals(self):
        """Rows of forces.csv that count."""
        return max(1, len(rows_of(self.run, self.gates.body, self.gates.start)["t_s"]))


def given_by(arguments):
    named = {"body": arguments.body, "upstream_m": arguments.upstream, "near_m": arguments.near,
             "width_m": arguments.width,
             "size_m": arguments.size, "from_s": arguments.start}
    return {key: value for key, value in named.items() if value is not None}


def case_of(folder, given):
    run = Run(folder, pandas=False)
    gates = gates_of(run, given)
    return Case(pathlib.Path(folder).resolve().name, run, gates, *passages(run, gates), measures_of(run, given))


def shown(value):
    return "-" if value is None else f"{value:.4g}"


def print_cases(cases):
    names = list(cases[0].measures)
    width = max(map(len, names)) - len("management_")
    print(" " * width + "".join(f"  {case.name[-20:]:>20}" for case in cases))
    for name in names:
        print(f"{name.removeprefix('management_'):{width}}"
              + "".join(f"  {shown(case.measures.get(name)):>20}" for case in cases))
    for case in cases:
        for ship, of in effort(case.run, case.gates.start).items():
            print(f"{case.name}: {ship} went {of['distance_m'] / 1e3:.2f} km; its engine delivered "
                  f"{of['energy_J'] / 1e9:.3g} GJ")
        gates = case.gates
        print(f"{case.name}: gates {gates.width:g} m wide, {gates.upstream:g} and {gates.near:g} m upstream of "
              f"{gates.body}; hits are of floes from {gates.size:g} m on")


def write_tables(cases, folder):
    with open(folder / "management.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["run", *cases[0].measures])
        for case in cases:
            writer.writerow([case.name, *("" if value is None else value for value in case.measures.values())])
    with open(folder / "management-sizes.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["run", "gate", "from_m", "to_m", "floes", "area_m2"])
        for case in cases:
            for gate, passage in (("upstream", case.before), ("at_body", case.after)):
                edges, numbers, areas = distribution(passage)
                for low, high, number, area in zip(edges, edges[1:], numbers, areas):
                    if number:
                        writer.writerow([case.name, gate, f"{low:.4g}", f"{high:.4g}", number, f"{area:.6g}"])
    print(f"tables  {folder / 'management.csv'}, {folder / 'management-sizes.csv'}")


def draw(make, path):
    """The picture, where matplotlib is there."""
    try:
        from . import figure
    except ImportError as error:
        print(f"figure  none: {error}; ./setup.sh python installs what it needs", file=sys.stderr)
        return
    make(figure, path)
    print(f"figure  {path}")


def main():
    arguments = command_line().parse_args()
    given = given_by(arguments)
    out = pathlib.Path(arguments.out or arguments.folders[0])
    if (pathlib.Path(arguments.folders[0]) / folders.PLAN).is_file():
        if len(arguments.folders) > 1 or given:
            raise InputError("of a study the gates are those of its collect.management: one folder, and no gates")
        return study.report(arguments.folders[0], out, arguments.json, draw)
    cases = [case_of(folder, given) for folder in arguments.folders]
    if arguments.json:
        print(json.dumps({case.name: case.measures for case in cases}, indent=2))
        return DONE
    print_cases(cases)
    out.mkdir(parents=True, exist_ok=True)
    write_tables(cases, out)
    draw(lambda figure, path: figure.draw_runs(cases, path), out / "management.png")
    return DONE


if __name__ == "__main__":
    sys.exit(main())
