"""Starts a command that is written in Python: `python3 -m polynya.command NAME WORDS`
(app/command_line/python.cpp does).

How a command may end is decided here, once for all of them: by the exit codes of
app/command_line/console.hpp, with messages in sentences. A traceback goes into a file.
"""
import importlib
import io
import os
import signal
import sys
import warnings

# Exit codes with the values of console.hpp. Here FAILED means that memory ran out; INPUT_OUTPUT covers files, streams
# and missing packages; DEFECT is an error of Polynya; CLOSED_PIPE means that the reader of the output has ended.
# Scripts rely on them.
FAILED, INPUT_OUTPUT, DEFECT, CLOSED_PIPE = 4, 5, 70, 141


class Stdout(io.FileIO):
    """stdout whose errors name it, for example on a full disk or if the reader has ended."""

    def write(self, data):
        try:
            return super().write(data)
        except OSError as error:
            error.filename = "stdout"
            raise


def open_streams():
    """Replaces stdout by one whose errors name it. Both streams accept any file name in any locale, as in the commands
    in C++."""
    buffer = io.BufferedWriter(Stdout(1, "w", closefd=False))
    sys.stdout = io.TextIOWrapper(buffer, "utf-8", "surrogateescape", line_buffering=os.isatty(1))
    sys.stderr.reconfigure(encoding="utf-8", errors="surrogateescape")


def run(name, main):
    """Runs the main() of a command and writes what it printed. Returns an exit code: that of main(), or that of
    end_of() for whatever main() raises. If the output cannot be written, the code is not 0. After SIGINT this does not
    return."""
    try:
        code = main()
    except BaseException as error:
        code = end_of(name, error)
    try:
        sys.stdout.flush()
    except OSError as error:
        code = code or end_of(name, error)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # the remaining text is lost without another message
    return code


def fail(name, message, code=INPUT_OUTPUT):
    """Prints a message on stderr, after the name of the command ("polynya loads"). Returns the exit code."""
    report(f"{name}: {message}")
    return code


def report(message):
    """Prints a message on stderr, if stderr can still be written."""
    try:
        print(message, file=sys.stderr, flush=True)
    except OSError:
        pass


def end_of(name, error):
    """Prints the message for an exception that ended a command. Returns the exit code. An InputError has its own code
    and states its places itself. A SystemExit must have a number or nothing; a text in it would be lost, with code 0. A
    KeyboardInterrupt ends the process by SIGINT. Exceptions that are not named here are defects. `name` is that of the
    command without "polynya"."""
    from .errors import FolderError, InputError, missing_package

    command = f"polynya {name}"
    if isinstance(error, SystemExit):
        return error.code if isinstance(error.code, int) else 0
    # Use the default action of the signal, so that a shell sees what ended the process.
    if isinstance(error, KeyboardInterrupt):
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
    if isinstance(error, InputError):
        report(error)
        return error.code
    if isinstance(error, FolderError):
        return fail(command, error)
    if isinstance(error, ImportError) and missing_package(error):
        return fail(command, missing_package(error))
    if isinstance(error, MemoryError):
        return fail(command, "out of memory", FAILED)
    if isinstance(error, BrokenPipeError):  # the reader of stdout or stderr has ended
        return CLOSED_PIPE
    if isinstance(error, OSError) and error.filename == "stdout":
        return fail("polynya", f"stdout: {error.strerror}")
    if isinstance(error, OSError):
        place = f"{os.fsdecode(error.filename)}: " if isinstance(error.filename, (str, bytes)) else ""
        return fail(command, f"{place}{error.strerror or error}")
    return fail(command, defect(name, error), DEFECT)


def defect(name, error):
    """Returns a message of one line about an error of the program, after writing its traceback to a new file in the
    folder for temporary files. The message names the file, or says why it could not be written."""
    import tempfile
    import traceback

    gist = " ".join(f"{type(error).__name__}: {error}".split())[:200]
    words = f"a defect of polynya itself ({gist})"
    try:
        with tempfile.NamedTemporaryFile(
            "w", prefix=f"polynya-{name}-", suffix=".txt", delete=False, encoding="utf-8", errors="backslashreplace"
        ) as file:
            file.write(f"{sys.argv}\nPython {sys.version}, {sys.executable}\n\n")
            file.write("".join(traceback.format_exception(error)))
        return f"{words}; its traceback is in {file.name}"
    except OSError as fault:
        return f"{words}; its traceback could not be written: {fault.strerror}"


# Runs the command that the first word names, with the other words, and returns its exit code. The module of the command
# is imported within run(), so that a missing package is reported as an error and not as a traceback.
def main():
    open_streams()
    if not sys.warnoptions:  # warnings of libraries are for developers, who use python3 -W default
        warnings.simplefilter("ignore")
    name, *words = sys.argv[1:]
    sys.argv = [f"polynya {name}", *words]
    module = "polynya.figures.database" if name == "database" else f"polynya.{name}.__main__"
    return run(name, lambda: importlib.import_module(module).main())


if __name__ == "__main__":
    sys.exit(main())
