"""`polynya` for the tests, what it writes, and ships that break ice."""
import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import traceback

from polynya import command

PROGRAM = os.environ["POLYNYA_PROGRAM"]
SCENES = pathlib.Path(os.environ["POLYNYA_SCENES"])
BREAKER = {"name": "breaker", "hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30},
           "mass_kg": 4e6, "moment_of_inertia_kg_m2": 9e8,
           "position_m": [-31, 0], "speed_m_per_s": 3, "propulsion": {"constant_speed_m_per_s": 3}}
ICE = {
    "name": "from-python",
    "time": {"step_s": 0.01, "until_s": 12},
    "record": {"forces_interval_s": 0.1, "frames_interval_s": 4},
    "ships": [BREAKER],
    "fracture": {"cusp_fate": "float"},
    "floes": [{"rectangle": {"corner_m": [0, -40], "size_m": [120, 80]}}],
}
# A small ship with ice that goes under it.
TUG = {**BREAKER, "hull": {"length_m": 30, "beam_m": 12, "entrance_angle_deg": 30, "draught_m": 4,
                           "stem_angle_deg": 25},
       "mass_kg": 2e6, "moment_of_inertia_kg_m2": 2e8, "position_m": [-16, 1]}


OF_PYTHON = {"figures", "loads", "management", "movie", "performance", "study"}


def started(*words, **more):
    """What a command gave, whatever its exit code: the program, and of it a Python, in new processes."""
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False, **more)


def become_command(words, streams, cwd, env, timeout):
    """The rest of a forked process, as the program starts polynya.command; `timeout` is an alarm's [s]."""
    code = command.DEFECT
    try:
        for number, stream in enumerate(streams, start=1):
            os.dup2(stream.fileno(), number)
        sys.stderr = open(2, "w", buffering=1, closefd=False)
        if env is not None:
            os.environ.clear()
            os.environ.update(env)
        os.chdir(cwd or ".")
        tempfile.tempdir = None
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(timeout)
        sys.argv = ["polynya", *words]
        code = command.main()
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(code)


def ended(*words, cwd=None, env=None, timeout=600):
    """What a command gave, whatever its exit code. One that is written in Python is run by a copy of this process,
    which has numpy and matplotlib imported already; `started` has the program start it."""
    words = list(map(str, words))
    if words[0] not in OF_PYTHON:
        return started(*words, cwd=cwd, env=env, timeout=timeout)
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        child = os.fork()
        if child == 0:
            become_command(words, (out, err), cwd, env, timeout)
        _, status = os.waitpid(child, 0)
        written = []
        for stream in (out, err):
            stream.seek(0)
            written.append(stream.read())
    return subprocess.CompletedProcess(words, os.waitstatus_to_exitcode(status), *written)


def succeeded(*words, **more):
    done = ended(*words, **more)
    assert done.returncode == 0, done.stderr
    return done


def run_of(home, name, scene):
    """The folder of a run of that scene, without its map."""
    (home / f"{name}.json").write_text(json.dumps({"name": name, **scene}))
    succeeded("run", f"{name}.json", "--out", name, "--no-map", cwd=home)
    return home / name


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


WRONG = ["null", "true", '"x"', '""', '"\\u0000"', "[]", "{}", "[null]", '{"a": [{}]}', "-1", "0", "1.5", "-1e308"]
WRONG += ["1e308", "1e-320", "1e999", "NaN", "-Infinity", "1" * 400, '"' + "y" * 5000 + '"', "[" * 90 + "]" * 90]


def mutated(dice, value):
    """The text of a JSON value with one thing changed: a value, a key, or the text itself."""
    value = json.loads(json.dumps(value))
    kind = dice.choice(["value", "value", "value", "drop", "rename", "cut", "comma", "twice"])
    parents, parent = [value], value
    while isinstance(parent, (dict, list)) and parent:
        parents.append(parent)
        parent = parent[dice.choice(list(parent) if isinstance(parent, dict) else range(len(parent)))]
    parent = dice.choice(parents)
    key = dice.choice(list(parent) if isinstance(parent, dict) else range(len(parent)))
    if kind == "drop":
        del parent[key]
    elif kind == "rename" and isinstance(parent, dict):
        parent[key[:-1] + dice.choice("xyz_ü/~")] = parent.pop(key)
    elif kind == "value":
        parent[key] = "@"
    text = json.dumps(value, indent=dice.choice([None, 1])).replace('"@"', dice.choice(WRONG))
    if kind == "cut":
        return text[: dice.randrange(len(text))]
    if kind in ("comma", "twice"):
        at = dice.choice([match.end() for match in re.finditer("[{]" if kind == "twice" else "[][{},]", text)])
        return text[:at] + (", " if kind == "comma" else '"count": 1, "count": 2, ') + text[at:]
    return text
