"""`polynya study gather`: one table of all cases, a row each, and what is missing."""
import csv
import io
import json
import sys

from . import archive
from .case import DONE, FAILED, STOPPED
from .folder import counted, list_of_numbers, write_atomically

TABLE, NETCDF, SUMMARY = "table.csv", "table.nc", "gather.json"
STATES = ("finished", "failed", "unfinished", "missing")
MOST_SHOWN = 10


def gather(study):
    """Writes table.csv, table.nc where xarray and netCDF4 are, and gather.json. Returns an exit code: DONE where every
    case is finished."""
    results = {}
    states = []
    for number, state, result in archive.all_states(study):
        states.append(state)
        if result is not None:
            results[number] = result
    columns, rows = table_of(study, states, results)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([["" if value is None else value for value in row] for row in rows])
    write_atomically(study.folder / TABLE, text.getvalue())
    by_state = {state: [number for number, s in enumerate(states) if s == state] for state in STATES}
    summary = {
        "cases": study.count,
        "is_complete": len(by_state["finished"]) == study.count,
        **{state: len(numbers) for state, numbers in by_state.items()},
        "parameters": parameter_columns(study),
        "columns": columns,
        "repair": {state: command for state, command in commands(study, by_state).items()},
    }
    write_atomically(study.folder / SUMMARY, json.dumps(summary, indent=1) + "\n")
    print(
        f"table       {study.folder / TABLE}: {study.count} cases, {len(by_state['finished'])} finished, {len(columns)} columns"
        + ("" if summary["is_complete"] else "; PARTIAL")
    )
    reason = write_netcdf(study, columns, rows, summary)
    print(f"            {study.folder / NETCDF}" if reason is None else f"            no {NETCDF}: {reason}")
    report_rest(study, by_state, results)
    return DONE if summary["is_complete"] else FAILED if by_state["failed"] else STOPPED


def parameter_columns(study):
    many_scenes = len(study.plan["scenes"]) > 1
    return (["scene"] if many_scenes else []) + study.plan["varied"]


def table_of(study, states, results):
    """The header and a row for each case. A case without a result has its parameters, its state and nothing else."""
    measures = []
    for result in results.values():
        known = set(measures)
        measures += [name for name in result.get("measures", {}) if name not in known]
    parameters = parameter_columns(study)
    rows = []
    for number, (scene, values) in enumerate(study.all_cases()):
        found = results.get(number, {}).get("measures", {})
        parts = [scene.stem if path == "scene" else cell(values.get(path)) for path in parameters]
        rows.append([number, states[number], *parts, *(found.get(name) for name in measures)])
    return ["case", "state", *parameters, *measures], rows


def cell(value):
    return value if isinstance(value, (int, float, str)) and not isinstance(value, bool) else json.dumps(value)


def commands(study, by_state):
    """The command that repairs each kind of what is not finished."""
    run = f"polynya study run {study.folder}"
    found = {}
    for state in ("missing", "unfinished"):
        if by_state[state]:
            found[state] = f"{run} --cases {list_of_numbers(by_state[state])}"
    if by_state["failed"]:
        found["failed"] = f"{run} --retry-failed --cases {list_of_numbers(by_state['failed'])}"
    return found


def report_rest(study, by_state, results):
    for state, command in commands(study, by_state).items():
        numbers = by_state[state]
        words = {
            "missing": "never started",
            "unfinished": "started and not at an end: to be continued from checkpoints",
            "failed": "ended with a failure",
        }[state]
        print(f"{state:<11} {counted(len(numbers), 'case')}, {words}", file=sys.stderr)
        if state == "failed":
            for number in numbers[:MOST_SHOWN]:
                print(f"            case {number}: {results[number]['message'].splitlines()[-1]}", file=sys.stderr)
            if len(numbers) > MOST_SHOWN:
                print(f"            and {len(numbers) - MOST_SHOWN} more; {study.folder / SUMMARY}", file=sys.stderr)
        print(
            f"            {command if len(command) < 400 else command[:380] + ' …  (whole in ' + SUMMARY + ')'}",
            file=sys.stderr,
        )


def write_netcdf(study, columns, rows, summary):
    """The same as a netCDF file over the dimension \"case\". Returns why there is none, or nothing."""
    path = study.folder / NETCDF
    path.unlink(missing_ok=True)
    try:
        import netCDF4  # noqa: F401  (the engine)
        import numpy
        import xarray
    except ImportError as error:
        return f"{error.name} is not installed (apt-get install python3-xarray python3-netcdf4)"
    variables = {}
    for name, values in zip(columns, zip(*rows)):
        is_text = any(isinstance(value, str) for value in values)
        data = (
            ["" if v is None else str(v) for v in values]
            if is_text
            else [float("nan") if v is None else v for v in values]
        )
        variables[name] = ("case", numpy.array(data, dtype=object if is_text else None))
    data = xarray.Dataset(
        variables, attrs={"study": study.plan["name"], "is_complete": int(summary["is_complete"])}
    ).set_coords("case")
    data.to_netcdf(path, engine="netcdf4")
    return None
