"""Builds the unit's library for Windows and runs the master in C on it under wine.

    windows_test.py POLYNYA MASTER SCRATCH SOURCE

Ends with 77 (skipped) where mingw-w64 or wine is missing: ./setup.sh windows installs them.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from unpacked import unpack

COMPILER = "x86_64-w64-mingw32-gcc-posix"
PROGRAM, MASTER, SCRATCH, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
HERE = pathlib.Path(__file__).resolve().parent
LIBRARY = SOURCE / "build/windows/cosim_unit/polynya.dll"
PICTURE = 8 * 601  # bytes of one of course.c: the values of 600 variables and a hash


def environment():
    """Without the flags of the native compiler, and with a folder of wine's own."""
    mine = {name: value for name, value in os.environ.items() if name not in ("CFLAGS", "CXXFLAGS", "LDFLAGS")}
    return mine | {"WINEPREFIX": str(SCRATCH / "wine"), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}


def run(*words, **more):
    return subprocess.run([str(word) for word in words], env=environment(), check=True, **more)


def windows_path(path):
    return f"Z:{path}"


def wine(*words):
    """Runs the master for Windows, and raises an error with its messages if it fails. A path of this machine is one of
    drive Z.
    """
    words = [windows_path(word) if isinstance(word, pathlib.Path) else word for word in words]
    done = subprocess.run(["wine", str(SCRATCH / "master.exe"), *words], env=environment(), capture_output=True,
                          text=True, check=False)
    if done.returncode != 0 or not done.stdout.endswith(": 0 failures\n"):
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        run("cmake", "--preset", "windows", cwd=SOURCE, stdout=subprocess.DEVNULL)
        run("cmake", "--build", "--preset", "windows", cwd=SOURCE)
        sources = sorted((HERE / "master").glob("*.c"))
        run(COMPILER, "-std=gnu11", "-Wall", "-Wextra", "-Werror", "-O1", "-static", f"-I{SOURCE}", *sources, "-o",
            SCRATCH / "master.exe")
        cls.first, cls.second = (
            unpack(PROGRAM, HERE / "coupled.json", SCRATCH / f"{name} unit", "--win64", LIBRARY, *more)
            for name, more in (("first", ()), ("second", ("--set", "ice.thickness_m=0.8"))))

    def test_the_master_finds_no_failure(self):
        for check in ("calls", "values", "steps", "log", "rollback"):
            wine(check, self.first)
        wine("two", self.first, self.second)

    def test_a_course_is_that_of_linux_to_the_bit_and_goes_on_from_a_state_of_linux(self):
        linux, windows, later = (SCRATCH / name for name in ("linux.course", "windows.course", "later.course"))
        run(MASTER, "course", self.first, linux)
        wine("course", self.first, windows)
        course = linux.read_bytes()
        self.assertEqual(len(course), 120 * PICTURE)
        self.assertNotEqual(course[:PICTURE], course[PICTURE:2 * PICTURE])
        self.assertEqual(course, windows.read_bytes())
        state = linux.with_suffix(".course.state")
        wine("course", self.first, later, state)
        self.assertEqual(course[60 * PICTURE:], later.read_bytes()[60 * PICTURE:])
        run(MASTER, "course", self.first, later, windows.with_suffix(".course.state"))
        self.assertEqual(course[60 * PICTURE:], later.read_bytes()[60 * PICTURE:])

    def test_it_shows_the_functions_of_the_standard_alone_and_needs_windows_alone(self):
        shown = run("x86_64-w64-mingw32-objdump", "-p", LIBRARY, capture_output=True, text=True).stdout
        functions = set(re.findall(r"FUNCTION\([\w *]+, (fmi2\w+),", (SOURCE / "cosim/fmi2.h").read_text()))
        table = shown[shown.index("[Ordinal/Name Pointer] Table"):]
        self.assertEqual(set(re.findall(r"^\s*\[\s*\d+\] (\S+)$", table, re.MULTILINE)), functions)
        self.assertEqual(set(re.findall(r"DLL Name: (\S+)", shown)), {"KERNEL32.dll", "msvcrt.dll"})
        self.assertNotIn(f"{SOURCE}/".encode(), LIBRARY.read_bytes())


if __name__ == "__main__":
    for name in (COMPILER, "wine"):
        if shutil.which(name) is None:
            print(f"skipped: there is no {name} (./setup.sh windows)")
            sys.exit(77)
    SCRATCH.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
