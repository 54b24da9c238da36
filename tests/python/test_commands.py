"""How commands that are written in Python end, and what a Python without the packages prints."""
import errno
import os
import pathlib
import re
import signal
import subprocess
import sys

import pytest

from program import PROGRAM, started
from polynya import command
from polynya.errors import FolderError, InputError

EXAMPLES = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples").glob("*.py"))
EXAMPLES = [path for path in EXAMPLES if path.name != "find_polynya.py"]
BARE = [sys.executable, "-S"]  # a Python without site-packages


def of_python(*words, **more):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, **more)


def raiser(error):
    def main():
        raise error

    return main


@pytest.mark.parametrize("error, code, message", [
    (InputError(["a.json:1:2: x", "a.json:2:1: y"]), 3, "a.json:1:2: x\na.json:2:1: y\n"),
    (FolderError("r: no run"), 5, "polynya study: r: no run\n"),
    (FileNotFoundError(errno.ENOENT, "No such file", "f"), 5, "polynya study: f: No such file\n"),
    (OSError(errno.ENOMEM, "Cannot allocate memory"), 5, "polynya study: Cannot allocate memory\n"),
    (MemoryError(), 4, "polynya study: out of memory\n"),
    (SystemExit(2), 2, ""),
])
def test_what_ends_a_command_has_its_code_and_message(capsys, error, code, message):
    assert command.run("study", raiser(error)) == code
    assert capsys.readouterr().err == message


def test_a_defect_is_one_line_and_its_traceback_is_in_the_file_named(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert command.run("movie", raiser(KeyError("of\nlines"))) == command.DEFECT == 70
    words = capsys.readouterr().err
    beginning = r"polynya movie: a defect of polynya itself \(KeyError: .*\); its traceback is in "
    found = re.fullmatch(beginning + r"(.*)\n", words)
    assert found and "Traceback" in pathlib.Path(found[1]).read_text()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "none"))
    assert command.run("movie", raiser(KeyError())) == 70 and "could not be written" in capsys.readouterr().err


def test_ctrl_c_ends_a_command_as_it_ends_others():
    main = "lambda: (print('on', flush=True), time.sleep(60))"
    words = [sys.executable, "-c", f"from polynya.command import run; import time; run('study', {main})"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        assert (process.wait(), process.stderr.read()) == (-signal.SIGINT, "")


def test_a_reader_that_goes_away_is_no_failure():
    for words in ("study --help", "figures --help", "loads --help", "movie --help"):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([PROGRAM, *words.split()], stdout=writer, stderr=subprocess.PIPE, check=False)
        os.close(writer)
        assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.parametrize("words", ["figures x", "loads x --out a", "movie x --out a.png", "performance x",
                                   "management x", "database x", "study report x"])
def test_a_missing_package_is_one_line_with_what_to_do(words, tmp_path):
    done = of_python(*BARE, "-m", "polynya.command", *words.split(), cwd=tmp_path)
    assert done.returncode == 5 and done.stderr.count("\n") == 1, done.stderr
    expected = rf"polynya {words.split()[0]}: .*python.* has no (numpy|matplotlib|scipy): .*/setup.sh python"
    assert re.search(expected, done.stderr)


def test_a_virtual_environment_is_told_its_own_pip(tmp_path):
    """Debian's packages cannot be seen from there."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/python3").symlink_to(os.path.realpath(sys.executable))
    (tmp_path / "pyvenv.cfg").write_text(f"home = {os.path.dirname(os.path.realpath(sys.executable))}\n"
                                         "include-system-site-packages = false\n")
    own = str(tmp_path / "bin/python3")
    done = of_python(own, "-m", "polynya.command", "loads", "x", cwd=tmp_path)
    assert done.returncode == 5 and "has no numpy: " in done.stderr
    assert f": {own} -m pip install numpy, or use /usr/bin/python3 (its packages: ./setup.sh python" in done.stderr


@pytest.mark.parametrize("code", ["polynya.Run('x')", "polynya.Study('x')", "polynya.require('numpy')", *EXAMPLES])
def test_a_python_without_numpy_names_itself_and_what_to_do_an_example_in_one_line(code):
    done = of_python(*BARE, *([code] if code in EXAMPLES else ["-c", f"import polynya; {code}"]))
    *before, last = done.stderr.splitlines()
    assert done.returncode == 1 and re.search(r"python\S* \(Python [0-9.]+\) has no numpy: ", last), done.stderr
    assert code not in EXAMPLES or not before


def test_a_module_of_another_python_is_named(tmp_path):
    (tmp_path / "_core.cpython-36-x86_64-linux-gnu.so").touch()
    done = of_python(sys.executable, "-c", f"import polynya; polynya.__path__[1:] = [{str(tmp_path)!r}]; polynya.Scene")
    running = "%d.%d" % sys.version_info[:2]
    message = f"is built for Python 3.6, and this is {running} ({sys.executable})"
    assert message in done.stderr.splitlines()[-1], done.stderr


def test_wrong_words_are_answered_as_by_the_commands_in_c():
    for words, message in (
        ("figures x --load most", 'figures: --load: "most" is not one of: true, mean, max, ships, j-over-tau-c\n'),
        ("figures x --style slide", "; did you mean slides?\n"),
        ("figures x --widnow 0,0,1,1", "figures: not expected: --widnow 0,0,1,1; did you mean --window?\n"),
        ("figures x --window -1,-2,3", "figures: --window: found -1,-2,3, allowed: 4 numbers"),
        ("figures", "figures: RUN is missing: The run folders\n"),
        ("movie x --from", "movie: --from needs a value\n"),
        ("movie x --speed -inf", "movie: --speed: found -inf, allowed: a number > 0\n"),
        ("study", "study: a command is missing\ncommands: plan, run, evaluate, slurm, parallel, gather, report\n"),
        ("study pln x", "study: no such command: pln; did you mean plan?\n"),
        ("study run x --job 2", "; did you mean --jobs?\npolynya study run --help explains its options\n"),
        ("performance araon --friction -1", "performance: --friction: found -1, allowed: a number ≥ 0, ≤ 2\n"),
    ):
        done = started(*words.split())
        assert (done.returncode, done.stdout, message in done.stderr) == (2, "", True), done.stderr


def test_the_manual_page_is_written_without_the_python_of_commands(tmp_path):
    guide = pathlib.Path(command.__file__).with_name("guide.py")
    page, completion = tmp_path / "polynya.1", tmp_path / "polynya.bash"
    words = [sys.executable, guide, PROGRAM, page, completion]
    without = of_python(*words, env={**os.environ, "POLYNYA_PYTHON": "/no/such"})
    assert without.returncode == 0 and "polynya movie \\-\\-help explains its options" in page.read_text()
