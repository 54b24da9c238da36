"""`polynya study gather`: writes one table with one row per case, and says which cases are not finished and which
commands repair them."""
import csv
import dataclasses
import json
import os
import sys

from ..errors import FolderError, how_to_get
from ..files import naming, read_cells, read_json, writing
from . import archive
from .case import DONE, FAILED, STOPPED, gist
from .folder import counted, list_of_numbers, write_atomically

TABLE, NETCDF, SUMMARY = "table.csv", "table.nc", "gather.json"  # files in the study's folder
STATES = ("failed", "unfinished", "missing")  # states of case.state_of other than "finished"
MOST_SHOWN = 10  # number of failures whose messages are printed; table.csv shows which other cases failed
# Longest command that is printed, some four lines of a terminal [characters]; gather.json has the whole of a longer
# one.
LONGEST_SHOWN = 380
# Largest number of cases for which a netCDF file is written, because the whole table must fit into the memory. A larger
# number needs more memory; table.csv has no such limit.
MOST_NETCDF = 1_000_000


def gather(study):
    """Writes table.csv, table.nc if xarray and netCDF4 are installed, and gather.json. Returns an exit code: DONE if
    every case is finished, otherwise FAILED if any has failed, otherwise STOPPED. Files of an earlier call are
    replaced, also if cases are missing. What is missing is printed on stderr. Cases are read one after the other:
    table.csv needs little memory, but table.nc as much as the whole table."""
    measures = first_measures(study)
    rest = write_table(study, measures)
    if rest.unknown:  # some cases were run by another version
        measures += rest.unknown
        rest = write_table(study, measures)
    columns = ["case", "state", *parameter_columns(study), *measures]
    finished = study.count - sum(len(numbers) for numbers in rest.by_state.values())
    summary = {
        "cases": study.count,
        "is_complete": finished == study.count,
        "finished": finished,
        **{state: len(numbers) for state, numbers in rest.by_state.items()},
        "parameters": parameter_columns(study),
        "columns": columns,
        "repair": commands(study, rest.by_state),
    }
    write_atomically(study.folder / SUMMARY, json.dumps(summary, indent=1) + "\n")
    partial = "" if summary["is_complete"] else "; PARTIAL"
    counts = f"{counted(study.count, 'case')}, {finished} finished, {len(columns)} columns"
    print(f"table       {study.folder / TABLE}: {counts}{partial}")
    reason = write_netcdf(study, summary)
    print(f"            {study.folder / NETCDF}" if reason is None else f"            no {NETCDF}: {reason}")
    report_rest(study, rest)
    return DONE if summary["is_complete"] else FAILED if rest.by_state["failed"] else STOPPED


# Members of gather.json that read_summary checks, with their types.
KINDS = {"cases": int, "is_complete": bool, "finished": int, "parameters": list, "columns": list}


def read_summary(folder):
    """Reads gather.json of a study's folder, which describes its table. Raises FolderError if it is missing or
    damaged."""
    summary = read_json(folder / SUMMARY)
    wrong = [key for key, kind in KINDS.items() if not isinstance(summary.get(key), kind)]
    names = [] if wrong else [*summary["parameters"], *summary["columns"]]
    if wrong or not all(isinstance(name, str) for name in names):
        what = f'"{wrong[0]}" is missing or of another kind' if wrong else "a name is not a text"
        raise FolderError(f"{folder / SUMMARY}: damaged, {what}: polynya study gather {folder} writes it again")
    return summary


@dataclasses.dataclass
class Rest:
    """Parts that a table lacks: cases that are not finished, and measures that are not in its header."""

    by_state: dict = dataclasses.field(default_factory=lambda: {state: [] for state in STATES})  # state -> cases
    messages: list = dataclasses.field(default_factory=list)  # (number, message) of the first MOST_SHOWN failures
    unknown: list = dataclasses.field(default_factory=list)  # names of measures that the table's header lacks


def parameter_columns(study):
    """Names of the table's columns of parameters: the varied paths, after "scene" if the study has several scenes.
    These columns are filled for all cases, finished or not."""
    many_scenes = len(study.plan["scenes"]) > 1
    return (["scene"] if many_scenes else []) + study.plan["varied"]


def first_measures(study):
    """Names of the measures of the first finished case; empty if none is finished. All cases of a study have the same
    measures, unless another version ran them."""
    for _, state, result in archive.all_states(study):
        if state == "finished":
            return list(result["measures"])
    return []


def write_table(study, measures):
    """Replaces table.csv by a table with these measures and a row for each case, and returns its Rest. A case that is
    not finished has only its number, state and parameters. A measure without a value, or one that another version did
    not have, is an empty cell. The table is replaced at the end, so that an error leaves the earlier one."""
    rest, parameters, known = Rest(), parameter_columns(study), set(measures)
    draft = study.folder / (TABLE + ".tmp")
    with writing(draft, newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "state", *parameters, *measures])
        for (number, state, result), (scene, values) in zip(archive.all_states(study), study.all_cases()):
            found = result["measures"] if state == "finished" else {}
            if state != "finished":
                rest.by_state[state].append(number)
            if state == "failed" and len(rest.messages) < MOST_SHOWN:
                rest.messages.append((number, gist(result["message"])))
            rest.unknown += [name for name in found if name not in known]
            known.update(rest.unknown)
            given = [scene.stem if path == "scene" else cell(values.get(path)) for path in parameters]
            writer.writerow([number, state, *given, *(found.get(name) for name in measures)])
    os.replace(draft, study.folder / TABLE)
    return rest


def cell(value):
    """The value of a parameter as csv writes it: numbers and texts as they are, any other value as JSON (None:
    null)."""
    return value if isinstance(value, (int, float, str)) and not isinstance(value, bool) else json.dumps(value)


def commands(study, by_state):
    """{state: the command that runs the cases in that state}, for the states that have cases. `by_state` is
    Rest.by_state. gather.json has the result as `repair`."""
    run = f"polynya study run {study.folder}"
    found = {}
    for state in ("missing", "unfinished"):
        if by_state[state]:
            found[state] = f"{run} --cases {list_of_numbers(by_state[state])}"
    if by_state["failed"]:
        found["failed"] = f"{run} --retry-failed --cases {list_of_numbers(by_state['failed'])}"
    return found


def report_rest(study, rest):
    """Prints on stderr how many cases are not finished, the first failures, and the commands that repair them."""
    words = {
        "missing": "never started",
        "unfinished": "started and not at an end: to be continued from checkpoints",
        "failed": "ended with a failure",
    }
    for state, command in commands(study, rest.by_state).items():
        numbers = rest.by_state[state]
        print(f"{state:<11} {counted(len(numbers), 'case')}, {words[state]}", file=sys.stderr)
        for number, message in rest.messages if state == "failed" else []:
            print(f"            case {number}: {message}", file=sys.stderr)
        if state == "failed" and len(numbers) > len(rest.messages):
            print(f"            and {len(numbers) - len(rest.messages)} more", file=sys.stderr)
        shown = command if len(command) < LONGEST_SHOWN else command[:LONGEST_SHOWN] + f" …  (whole in {SUMMARY})"
        print(f"            {shown}", file=sys.stderr)


def write_netcdf(study, summary):
    """Writes the table as a netCDF file with the dimension "case", columns of numbers as floats with NaN for no value,
    and others as texts. A column with a single cell that is no number is one of texts. `summary` is the contents of
    gather.json. Returns None, or the reason why there is no file: too many cases, or a package that is not installed.
    An older file is then removed, too. Raises OSError with the path if it cannot be written."""
    path = study.folder / NETCDF
    path.unlink(missing_ok=True)
    if study.count > MOST_NETCDF:
        return f"more than {MOST_NETCDF} cases; table.csv has them"
    try:
        import netCDF4  # xarray uses it
        import numpy
        import xarray
    except ImportError as error:
        return f"{error.name} is not installed ({how_to_get('xarray', 'netcdf4')})"
    variables = {}
    for name, values in read_cells(study.folder / TABLE).items():
        try:
            data = numpy.array([float(value) if value else numpy.nan for value in values])
        except ValueError:
            data = numpy.array(values, dtype=object)
        variables[name] = ("case", data.astype(int) if name == "case" else data)
    attributes = {"study": study.plan["name"], "is_complete": int(summary["is_complete"])}
    with naming(path):
        xarray.Dataset(variables, attrs=attributes).set_coords("case").to_netcdf(path, engine="netcdf4")
    return None
