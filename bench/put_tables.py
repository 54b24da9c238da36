"""Puts tables between the markers of a Markdown page: <!-- NAME --> … <!-- /NAME -->.

Usage: put_tables.py PAGE NAME=FILE...   a .csv becomes a table; an empty FILE: the machine and the date.
"""

import csv
import datetime
import os
import pathlib
import platform
import re
import subprocess
import sys


def machine() -> str:
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    load = os.getloadavg()
    return (
        f"{cpu.group(1) if cpu else platform.machine()}, {os.cpu_count()} cores, load {load[0]:.1f} at the end; "
        f"commit {commit}, {datetime.date.today()}."
    )


def rounded(cell: str) -> str:
    try:
        return f"{float(cell):.4g}"
    except ValueError:
        return cell


def table_of(path: str) -> str:
    if not path:
        return machine()
    text = pathlib.Path(path).read_text()
    if not path.endswith(".csv"):
        return text.strip()
    rows = list(csv.reader(line for line in text.splitlines() if line.strip()))
    if rows[0][0] == "name":  # Google Benchmark's
        rows = [["benchmark", "time", "unit"]] + [[r[0], r[2], r[4]] for r in rows[1:]]
    lines = ["| " + " | ".join(rows[0]) + " |", "|" + "---|" * len(rows[0])]
    lines += ["| " + " | ".join(rounded(cell) for cell in row) + " |" for row in rows[1:]]
    return "\n".join(lines)


def main() -> None:
    page = pathlib.Path(sys.argv[1])
    text = page.read_text()
    for argument in sys.argv[2:]:
        name, _, path = argument.partition("=")
        begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
        before, found, rest = text.partition(begin)
        _, closed, after = rest.partition(end)
        if not found or not closed:
            sys.exit(f"{page}: no markers {begin} … {end}")
        text = f"{before}{begin}\n{table_of(path)}\n{end}{after}"
    page.write_text(text)


main()
