"""Runs the examples of docs/couple.md as they stand there: its commands, and its code in Python. Scripts of examples/
run in their short forms.

    couple.py SOURCE POLYNYA SCRATCH
"""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys

NEEDED = ("numpy", "matplotlib")
OPTIONAL = {"study_by_openturns.py": "openturns", "study_by_optuna.py": "optuna"}
BLOCK = re.compile(r"^```(console|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def missing(command):
    """The package that an example needs and that is not installed; empty if none is."""
    for script, package in OPTIONAL.items():
        if script in command and not importlib.util.find_spec(package):
            return package
    return ""


def run(words, scratch, environment):
    done = subprocess.run(words, cwd=scratch, env=environment, capture_output=True, text=True, check=False)
    print(done.stdout, end="")
    if done.returncode != 0:
        raise SystemExit(f"{words}: exit code {done.returncode}\n{done.stderr}")


def main(source, polynya, scratch):
    if lacking := [name for name in NEEDED if not importlib.util.find_spec(name)]:
        print("skipped:", sys.executable, "has no", ", ".join(lacking))
        return 77
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    for folder in ("examples", "scenes"):
        (scratch / folder).symlink_to(source / folder)
    build = polynya.parent.parent
    environment = {**os.environ, "PATH": f"{polynya.parent}:{os.environ['PATH']}", "POLYNYA_PROGRAM": str(polynya),
                   "PYTHONPATH": str(build / "python")}
    blocks = BLOCK.findall((source / "docs/couple.md").read_text())
    if {kind for kind, _ in blocks} != {"console", "python"}:
        raise SystemExit("docs/couple.md has no example")
    for kind, text in blocks:
        if kind == "python":
            run([sys.executable, "-c", text], scratch, environment)
            continue
        for command in re.findall(r"^\$ (.+)$", text, re.MULTILINE):
            if package := missing(command):
                print(f"not run, {package} is not installed: {command}")
                continue
            command = command.replace("python3", sys.executable)
            print(f"$ {command}", flush=True)
            run(["sh", "-c", command + (" --short" if "examples/" in command else "")], scratch, environment)
    return 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(word).resolve() for word in sys.argv[1:4])))
