"""What the scripts of pages share: studies that are run, and tables of a page that are printed, written or compared.

A table of a page stands between <!-- table: NAME --> and <!-- /table -->, and is made by a function of the page's
script. Not a program.
"""
import argparse
import concurrent.futures
import dataclasses
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import typing

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path.insert(0, str(ROOT / "python"))
import polynya  # noqa: E402
from polynya import formulas  # noqa: E402
from polynya.runs_kept import kept_run  # noqa: E402

REFERENCE = formulas.Hull(120, 24, 6, math.radians(30), math.radians(27))  # the ship `polynya ships reference`
NUMBER = re.compile(r"[-+−]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")
WITH_ERROR = re.compile(rf"({NUMBER.pattern})( ± )({NUMBER.pattern})")


class Runs:
    """Runs studies in a folder of their own."""

    def __init__(self, program, folder, jobs):
        self.program, self.folder, self.jobs = str(pathlib.Path(program).resolve()), pathlib.Path(folder), jobs
        self.gathered = {}
        os.environ["POLYNYA_PROGRAM"] = self.program  # the package has it check a run's files

    def call(self, *words, **options):
        return subprocess.run([self.program, *map(str, words)], check=True, cwd=ROOT, text=True, **options)

    def study(self, definition):
        """The study of a definition's file, run and gathered."""
        name = pathlib.Path(definition).stem
        folder = self.folder / name
        if name in self.gathered:
            return self.gathered[name]
        print(f"{name} ...", file=sys.stderr, flush=True)
        self.call("study", "plan", HERE / definition, "--out", folder, stdout=subprocess.DEVNULL)
        self.call("study", "run", folder, "--jobs", self.jobs, "--quiet", stdout=subprocess.DEVNULL)
        self.call("study", "gather", folder, stdout=subprocess.DEVNULL)
        self.gathered[name] = polynya.Study(folder, pandas=False)
        return self.gathered[name]

    def scenes(self, name, scenes):
        """{key: the run of its scene}, of a bench that makes its scenes itself."""
        folder = self.folder / name
        folder.mkdir(parents=True, exist_ok=True)
        print(f"{name} ...", file=sys.stderr, flush=True)

        def run(item):
            key, scene = item
            path = kept_run(self.program, folder, "-".join(map(str, key)), scene, has_map=False)
            return key, polynya.Run(path, pandas=False)
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return dict(pool.map(run, scenes.items()))


def slant_of(number):
    """Of the edge of one of many plates, 2 to 6 degrees, spread evenly over any first ones [rad]."""
    return 0.03 + 0.07 * (0.61803 * number % 1)


def slanted_ice(slant, end):
    """A plate of fast ice, 200 m wide, from x = 0 to `end` [m]; its edge has that slant."""
    return {"polygon": {"outer_m": [[-100 * slant, -100], [end, -100], [end, 100], [100 * slant, 100]]},
            "fast_ice": True}


def events_of(run):
    """The lines of its events.ndjson."""
    with open(run.folder / "events.ndjson", encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def groups(study, *names):
    """{values of these columns: numbers of the cases that have them}, in the order of the cases."""
    found = {}
    for case, key in enumerate(zip(*(study.table[name] for name in names))):
        found.setdefault(key if len(names) > 1 else key[0], []).append(case)
    return found


def mean_and_error(values):
    """The mean, and its standard error."""
    values = [float(value) for value in values]
    mean = math.fsum(values) / len(values)
    spread = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1))
    return mean, spread / math.sqrt(len(values))


@dataclasses.dataclass(frozen=True)
class Table:
    """A table as a page has it; its cells are texts. Numbers without ± may differ by `within` of their size."""

    head: typing.Sequence[str]
    rows: typing.Sequence[typing.Sequence[str]]
    within: float = 0.02

    def __str__(self):
        lines = [self.head, ["---"] * len(self.head), *self.rows]
        drawn = lambda cell: "---" if cell == "---" else f" {cell} " if cell else "  "
        return "".join("|" + "|".join(map(drawn, line)) + "|\n" for line in lines)


def of_markdown(text):
    """Head and rows of a table."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return cells[0], cells[2:]


def value_of(text):
    return float(text.replace("−", "-"))


def unit_of(text):
    """What the last digit of a number stands for."""
    digits = re.search(r"\.(\d*)", text)
    return 10.0 ** -len(digits[1]) if digits else 1.0


def agree(old, new, within):
    """Whether two cells state the same: numbers with ± within three standard errors of their difference, others within
    a share of their size, both besides their last digit; words exactly."""
    with_error_old, with_error_new = WITH_ERROR.findall(old), WITH_ERROR.findall(new)
    for (a, _, error_a), (b, _, error_b) in zip(with_error_old, with_error_new):
        allowed = 3 * math.hypot(value_of(error_a) + unit_of(error_a) / 2, value_of(error_b) + unit_of(error_b) / 2)
        if abs(value_of(a) - value_of(b)) > allowed + unit_of(a):
            return False
    rest_old, rest_new = WITH_ERROR.sub("", old), WITH_ERROR.sub("", new)
    if len(with_error_old) != len(with_error_new) or NUMBER.sub("", rest_old) != NUMBER.sub("", rest_new):
        return False
    numbers_old, numbers_new = NUMBER.findall(rest_old), NUMBER.findall(rest_new)
    if len(numbers_old) != len(numbers_new):
        return False
    pairs = [(value_of(a), value_of(b), unit_of(a)) for a, b in zip(numbers_old, numbers_new)]
    return all(abs(a - b) <= within * max(abs(a), abs(b)) + 1.01 * unit for a, b, unit in pairs)


def differences(name, text, table):
    """Lines that say in which cells the page's text differs from a table."""
    head, rows = of_markdown(text)
    if head != list(table.head) or len(rows) != len(table.rows):
        yield f"{name}: the page has another head or another number of rows"
        return
    for number, (old_row, new_row) in enumerate(zip(rows, table.rows), 1):
        for title, old, new in zip(head, old_row, new_row):
            if not agree(old, new, table.within):
                yield f"{name}, row {number} ({new_row[0]}), {title}: the page has {old}, found {new}"


def between(name):
    return re.compile(rf"(<!-- table: {re.escape(name)} -->\n)(.*?)(<!-- /table -->)", re.DOTALL)


def run_page(page, tables, description):
    """The command line of a page's script. `tables`: {name: a function of Runs that returns a Table}."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="*", metavar="TABLE", help=f"of {', '.join(tables)}; all if none is named")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--write", action="store_true", help="put the tables into the page")
    how.add_argument("--check", action="store_true", help="compare the page's tables; 1 if one differs")
    parser.add_argument("--polynya", default=ROOT / "build/release/app/polynya", metavar="PROGRAM")
    parser.add_argument("--work", default=ROOT / "build/studies", metavar="DIR",
                        help="of the studies; finished runs in it are used again")
    parser.add_argument("--fresh", action="store_true", help="remove that folder first")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    unknown = set(arguments.tables) - set(tables)
    if unknown:
        parser.error(f"no table {', '.join(sorted(unknown))}")
    if not pathlib.Path(arguments.polynya).exists():
        print(f"skipped: {arguments.polynya} is not there: ./quickstart builds it", file=sys.stderr)
        return 77
    if arguments.fresh:
        shutil.rmtree(arguments.work, ignore_errors=True)
    runs = Runs(arguments.polynya, arguments.work, arguments.jobs)
    path, found = ROOT / page, []
    for name in arguments.tables or tables:
        table = tables[name](runs)
        print(f"{name}\n\n{table}", flush=True)
        text = path.read_text(encoding="utf-8")
        in_page = between(name).search(text)
        if not in_page:
            found.append(f"{name}: {page} has no such table")
        elif arguments.write:
            path.write_text(text[:in_page.start(2)] + str(table) + text[in_page.end(2):], encoding="utf-8")
        elif arguments.check:
            found += differences(name, in_page[2], table)
    print("\n".join(found) if found else "each table is in the page" if arguments.check else "", file=sys.stderr)
    return 1 if found else 0
