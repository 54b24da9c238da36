"""`polynya study` for the tests."""
import subprocess
import sys


def study(*words, code=0):
    """What it prints, where it ends with that code."""
    command = [sys.executable, "-m", "polynya.command", "study", *map(str, words)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == code, ran.stdout + ran.stderr
    return ran.stdout + ran.stderr
