#!/usr/bin/env python3
"""Plants errors in the sources, one at a time, and tells which of them no test of their room finds.

Errors are drawn at random by a seed from all code of geometry, dynamics, fracture and simulation: signs, factors,
bounds and comparisons. A list is a file of JSON lines beside this script, an error each: where it is, the line as it is
and as it is planted, and what is known of it: "found by" a test, "survives", "equivalent" with the reason why nothing
can find it, or "stale" where the source has changed since. seed-1.ndjson and seed-2.ndjson were drawn at commit
b8fd7019, seed-3.ndjson at 00b66873 without a look at the tests. Where a survivor led to a new test, the list names
that test.

Usage: planted_errors.py draw SEED COUNT LIST      writes a new list
       planted_errors.py check LIST                names the errors whose lines are not in the sources any more
       planted_errors.py run LIST [--from N] [--to N] [--again] [--lock FILE] [--timeout S]
                                                   plants, builds and tests those that have no result yet
Plant errors in a worktree of their own: a source is changed while its error is tried, and restored after it. The build
is that of the preset dev; --lock is a file for `flock` around each build.
Exit code 1 where an error survives that is not argued to be equivalent.
"""

import argparse
import json
import pathlib
import random
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("geometry", "dynamics", "fracture", "simulation")
UNKNOWN, FOUND, SURVIVES, EQUIVALENT, STALE = "not run", "found by", "survives", "equivalent", "stale"

NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\.\d+|\d+)(?![\w.])")
# An operator between two operands, with its spaces; `<` and `>` of templates have none.
OPERATOR = re.compile(r"(?<=[\w)\]]) (\+|-|<|>|<=|>=) (?=[\w(!*&-])")
COMPOUND = re.compile(r"(?<=[\w)\]]) (\+=|-=) ")
BOUND = re.compile(r"\bstd::(min|max)\b")
SWAPPED = {"+": ("-", "sign"), "-": ("+", "sign"), "+=": ("-=", "sign"), "-=": ("+=", "sign"),
           "<": ("<=", "comparison"), "<=": ("<", "comparison"), ">": (">=", "comparison"), ">=": (">", "comparison"),
           "min": ("max", "bound"), "max": ("min", "bound")}
REVERSED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
# Lines without code, or whose numbers count existing things.
SKIPPED = re.compile(r"^\s*(#|//|/\*|\*|namespace|using|template|static_assert|friend|enum|case|struct|class|inline "
                     r"constexpr std::(int|uint))|assert\(|reserve\(|std::get<|fmt::|\.fail\(|require\(")


def code_of(line):
    """A line without its comment and its texts, in their places."""
    without_texts = re.sub(r'"(?:[^"\\]|\\.)*"', lambda text: '"' + " " * (len(text.group()) - 2) + '"', line)
    return without_texts.split("//")[0]


def sites_of(line):
    """The errors that can be planted in a line: (kind, the line with one of them)."""
    code = code_of(line)
    if SKIPPED.search(code):
        return
    for found in [*OPERATOR.finditer(code), *COMPOUND.finditer(code), *BOUND.finditer(code)]:
        begin, end = found.span(1)
        planted, kind = SWAPPED[found.group(1)]
        yield kind, line[:begin] + planted + line[end:]
        if found.group(1) in REVERSED:
            yield kind, line[:begin] + REVERSED[found.group(1)] + line[end:]
    for found in NUMBER.finditer(code):
        text = found.group(1)
        if "." not in text and "e" not in text:
            continue  # whole numbers are indices and counts more often than factors
        begin, end = found.span(1)
        value = float(text)
        for planted in ((2 * value, value / 2) if value else (0.1,)):
            yield "factor", line[:begin] + repr(planted) + line[end:]


def sources(root):
    return sorted(path for room in ROOMS for ending in ("*.cpp", "*.hpp") for path in (root / room).rglob(ending))


def all_errors(root):
    """Every error that can be planted."""
    for path in sources(root):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for kind, planted in sites_of(line):
                yield {"file": str(path.relative_to(root)), "line": number, "kind": kind, "was": line,
                       "planted": planted}


def drawn(root, seed, count):
    """So many errors, or as many as there are, no two in one line; kinds take turns."""
    dice = random.Random(seed)
    by_kind = {}
    for error in all_errors(root):
        by_kind.setdefault(error["kind"], []).append(error)
    for kind in sorted(by_kind):
        dice.shuffle(by_kind[kind])
    chosen, lines = [], set()
    while len(chosen) < count and any(by_kind.values()):
        for kind in sorted(by_kind):
            error = next((e for e in iter(lambda: by_kind[kind].pop() if by_kind[kind] else None, None)
                          if (e["file"], e["was"]) not in lines), None)
            if error and len(chosen) < count:
                lines.add((error["file"], error["was"]))
                chosen.append({"number": len(chosen) + 1, **error, "result": UNKNOWN})
    return chosen


def read_list(path):
    return [json.loads(line) for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines() if line.strip()]


def write_list(path, errors):
    text = "".join(json.dumps(error, ensure_ascii=False) + "\n" for error in errors)
    pathlib.Path(path).write_text(text, encoding="utf-8")


def place_of(error, root):
    """The index of an error's line in its source now, the nearest to where it was; None where it is gone."""
    path = root / error["file"]
    if not path.exists():
        return None
    lines = path.read_text(encoding="utf-8").splitlines()
    places = [i for i, line in enumerate(lines) if line == error["was"]]
    return min(places, key=lambda i: abs(i + 1 - error["line"]), default=None)


class Planted:
    """A source with an error in it; the source as it was afterwards."""

    def __init__(self, error, root):
        self.path = root / error["file"]
        self.text = self.path.read_text(encoding="utf-8")
        self.place, self.planted = place_of(error, root), error["planted"]

    def __enter__(self):
        lines = self.text.splitlines(keepends=True)
        lines[self.place] = self.planted + "\n"
        self.path.write_text("".join(lines), encoding="utf-8")

    def __exit__(self, *_):
        self.path.write_text(self.text, encoding="utf-8")


def tests_of(error, root):
    """The targets of an error's room, by what includes it: its own tests, those of the rooms above, then whole runs."""
    room = error["file"].split("/")[0]
    above = {"geometry": ["geometry", "dynamics"], "dynamics": ["dynamics", "simulation"],
             "fracture": ["fracture", "simulation"], "simulation": ["simulation"]}
    return [f"polynya_tests_{name}" for name in [*above[room], "golden"]]


def build(target, options):
    command = ["cmake", "--build", "--preset", "dev", "--target", target]
    if options.lock:
        command = ["flock", options.lock, *command]
    return subprocess.run(["nice", *command], cwd=ROOT, capture_output=True, text=True, check=False)


def first_failure(target, options):
    """The first test of a target that fails; "" where none does."""
    program = ROOT / "build/dev/tests" / target.removeprefix("polynya_tests_") / target
    try:
        done = subprocess.run(["nice", str(program), "--gtest_brief=1", "--gtest_fail_fast"], cwd=program.parent,
                              capture_output=True, text=True, check=False, timeout=options.timeout)
    except subprocess.TimeoutExpired:
        return "more time than it may take"
    if done.returncode == 0:
        return ""
    failed = re.search(r"\[  FAILED  \] ([\w/.]+)", done.stdout)
    return failed.group(1) if failed else f"the end of {target} by {done.returncode}"


def try_out(error, options):
    """Plants an error, builds and tests; enters the result."""
    if place_of(error, ROOT) is None:
        error["result"] = STALE
        return
    with Planted(error, ROOT):
        error["result"] = SURVIVES
        for target in tests_of(error, ROOT):
            built = build(target, options)
            failure = "the compiler" if built.returncode else first_failure(target, options)
            if failure:
                error["result"] = FOUND
                error["by"] = failure
                break


def run(options):
    errors = read_list(options.list)
    for error in errors:
        is_open = error["result"] == UNKNOWN or (options.again and error["result"] == SURVIVES)
        if not is_open or not options.first <= error["number"] <= options.last:
            continue
        try_out(error, options)
        write_list(options.list, errors)
        print(f"{error['number']}: {error['file']}:{error['line']}: {error['result']} {error.get('by', '')}",
              flush=True)
    return errors


def report(errors):
    counts = {}
    for error in errors:
        counts[error["result"]] = counts.get(error["result"], 0) + 1
    print(", ".join(f"{count} {result}" for result, count in sorted(counts.items())))
    for error in errors:
        if error["result"] == SURVIVES:
            print(f"survives: {error['file']}:{error['line']}: {error['was'].strip()} -> {error['planted'].strip()}")
    return any(error["result"] == SURVIVES for error in errors)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    draw = commands.add_parser("draw")
    draw.add_argument("seed", type=int)
    draw.add_argument("count", type=int)
    for name in ("check", "run"):
        commands.add_parser(name)
    for command in commands.choices.values():
        command.add_argument("list")
    commands.choices["run"].add_argument("--from", dest="first", type=int, default=1)
    commands.choices["run"].add_argument("--to", dest="last", type=int, default=10**9)
    commands.choices["run"].add_argument("--again", action="store_true", help="survivors once more")
    commands.choices["run"].add_argument("--lock", help="a file for flock around each build")
    commands.choices["run"].add_argument("--timeout", type=float, default=1800, help="for the tests of a room [s]")
    options = parser.parse_args()
    if options.command == "draw":
        write_list(options.list, drawn(ROOT, options.seed, options.count))
        return
    if options.command == "check":
        stale = [error for error in read_list(options.list) if place_of(error, ROOT) is None]
        for error in stale:
            print(f"{error['number']}: not in {error['file']} any more: {error['was'].strip()}")
        print(f"{len(stale)} of {len(read_list(options.list))} are stale")
        return
    sys.exit(report(run(options)))


if __name__ == "__main__":
    main()
