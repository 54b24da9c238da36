"""Runs a check of the master in C on units made of coupled.json.

    master_test.py POLYNYA MASTER SCRATCH CHECK

The master runs without any variable of this environment, in another folder, and the units lie in a folder whose name
has a blank: they bring all that they need.
"""
import pathlib
import subprocess
import sys

from unpacked import unpack

SCENE = pathlib.Path(__file__).with_name("coupled.json")


def main(program, master, scratch, check):
    scratch = pathlib.Path(scratch).resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    units = [unpack(program, SCENE, scratch / "first unit")]
    if check == "two":
        units.append(unpack(program, SCENE, scratch / "second unit", "--set", "ice.thickness_m=0.8"))
    done = subprocess.run([pathlib.Path(master).resolve(), check, *units], cwd="/", env={}, check=False)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
