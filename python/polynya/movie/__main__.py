"""The command `polynya movie`, which makes a film of a run, or one picture of it (polynya.command starts it)."""
import argparse
import os
import signal
import sys
import time

from ..arguments import Parser, number
from ..command import INPUT_OUTPUT, run
from ..command import fail as fail_command

DONE, USAGE = 0, 2  # exit codes of app/command_line/console.hpp
# Examples and closing text of the command's help.
EXAMPLES = (
    "movie runs/sawamura2017-fig4b --out voyage.mp4",
    "movie runs/sawamura2017-fig4b --out voyage.gif --size 800x450 --from 100 --to 300 --speed 20",
    "movie runs/sawamura2017-fig4b --out voyage.mp4 --follow icebreaker",
    "movie runs/sawamura2017-fig4b --out frame.png --from 330          one picture, without ffmpeg",
)
REST = """Needs Python 3 with numpy and matplotlib, and ffmpeg (./setup.sh python). A film that is stopped
leaves no file.
Exit codes: 0 done, 2 usage, 5 input/output, or numpy, matplotlib or ffmpeg is missing.
"""


class Stopped(Exception):
    """Raised when a signal stops the command. `number` is that of the signal; the text is its name."""

    def __init__(self, number):
        super().__init__(signal.Signals(number).name)
        self.number = number


def size(text):
    """Reads width and height of a picture [px] from a text such as 1280x720. Both must be even, because MP4 requires
    it, and from 320 to 7680. Below 320 the text, of 0.02 of the height, could not be read; 7680 is the width of 8K, and
    a larger picture would mostly take time and memory. Raises ArgumentTypeError with what is allowed."""
    parts = text.lower().split("x")
    values = [int(part) for part in parts if part.isdigit()]
    if len(parts) != 2 or len(values) != 2 or not all(320 <= value <= 7680 and value % 2 == 0 for value in values):
        raise argparse.ArgumentTypeError(f"found {text}, allowed: WIDTHxHEIGHT, even numbers from 320 to 7680 pixels, "
                                         f"as 1280x720")
    return tuple(values)


# Returns a file name unchanged if its suffix is .mp4, .gif or .png, in small or capital letters; otherwise raises
# ArgumentTypeError.
def film_name(text):
    from .film import SUFFIXES

    if os.path.splitext(text)[1].lower() not in SUFFIXES:
        raise argparse.ArgumentTypeError(f"found {text}, allowed: a name that ends in {', '.join(SUFFIXES)}")
    return text


# Returns the parser of the command's options. Times are in simulated seconds, from the start of the simulation.
def command_line():
    seconds = number(0, unit="s")
    parser = Parser("polynya movie", "Make a film of a run: the ice, and the force on the ship", EXAMPLES, REST)
    meaning = "The run folder; a run that is not finished is shown up to its last frame"
    parser.add("run", meaning, metavar="RUN")
    meaning = "File for the film, .mp4 or .gif, or .png for one picture at --from; voyage.mp4 if not given"
    parser.add("--out", meaning, type=film_name, default="voyage.mp4", metavar="FILE")
    meaning = "Simulated time at which the film begins [s]; the start of the run if not given"
    parser.add("--from", meaning, dest="start", type=seconds, metavar="S")
    meaning = "Simulated time at which the film ends [s]; the end of the run if not given"
    parser.add("--to", meaning, dest="end", type=seconds, metavar="S")
    meaning = "Simulated seconds per second of the film; if not given, such that the film takes about half a minute"
    parser.add("--speed", meaning, type=number(0, is_open=True), metavar="X")
    meaning = "Size of the pictures [px]; 1280x720 if not given"
    parser.add("--size", meaning, type=size, default=(1280, 720), metavar="WxH")
    meaning = "Name of the ship that the map follows; if not given, the map shows the whole run"
    parser.add("--follow", meaning, metavar="SHIP")
    return parser


# Prints a message with the command's name on stderr, and returns the code.
def fail(code, message):
    return fail_command("polynya movie", message, code)


class Progress:
    """Shows progress on stderr: one line on a terminal, which is overwritten, otherwise a line every ten seconds. It is
    called with the number of completed pictures, at least 1, and their total. The remaining time is at the mean rate so
    far."""

    def __init__(self):
        self._start = self._shown = time.monotonic()
        # Time between two reports [s]. Smaller: the terminal flickers, or a log has more lines.
        self._least = 0.1 if sys.stderr.isatty() else 10.0

    def __call__(self, done, count):
        now = time.monotonic()
        is_last = done == count and sys.stderr.isatty()
        if now - self._shown < self._least and not is_last:
            return
        self._shown = now
        left = (now - self._start) / done * (count - done)
        words = f"picture {done} of {count}, {left:.0f} s left"
        if sys.stderr.isatty():
            print(f"\r{words:<48}", end="\n" if is_last else "", file=sys.stderr, flush=True)
        else:
            print(words, file=sys.stderr, flush=True)


# Makes the film, or one picture if the name ends in .png, prints summary() and returns an exit code: USAGE for times
# outside of the run or an unknown ship, INPUT_OUTPUT if the folder of the film does not exist or the run has no frames.
# A picture shows the run at --from (its start if that is not given); --to is ignored, and its curves show the whole
# run. An existing file is replaced. Raises FolderError if the run cannot be read, and FilmError if ffmpeg is missing or
# fails.
def make(options):
    from polynya.errors import FolderError
    from polynya.results.run import Run

    from . import encoder, film, picture

    suffix = os.path.splitext(options.out)[1].lower()
    if suffix != ".png":
        encoder.ffmpeg()  # this fails before the run is read if ffmpeg is missing
    if not os.path.isdir(os.path.dirname(os.path.abspath(options.out))):
        return fail(INPUT_OUTPUT, f"{options.out}: its folder does not exist")
    run = Run(options.run, unfinished=True, pandas=False, shapely=False)
    if len(run.times) == 0:
        return fail(INPUT_OUTPUT, f"{options.run}: the run has no frames")
    try:
        start = run.start_time if options.start is None else options.start
        end = run.end_time if options.end is None else options.end
        if suffix == ".png":
            options.end, end = None, run.end_time
        rate = film.RATES.get(suffix, 1.0)
        speed = options.speed or film.chosen_speed(end - start)
        is_instant = suffix == ".png" and start == run.end_time
        times = [start] if is_instant else film.chosen_times(run, start, end, speed, rate)
        look = picture.Look(size=options.size, follow=options.follow, speed=speed, is_film=suffix != ".png",
                            start=run.start_time if suffix == ".png" else None,
                            end=run.end_time if suffix == ".png" else None)
        film.write(run, options.out, times, look, Progress())
    except FolderError:
        raise
    except ValueError as error:
        return fail(USAGE, error)
    print(summary(options.out, times, rate, speed))
    return DONE


# Returns the line that the command prints at its end. `path` is the written file, `times` are the times of the pictures
# [s], `rate` their number per second of the film, and `speed` the simulated seconds per second of the film.
def summary(path, times, rate, speed):
    megabytes = f"{os.path.getsize(path) / 1e6:.2g} MB"
    if len(times) == 1 or path.lower().endswith(".png"):
        return f"{path}  {megabytes}, the run at {times[0]:g} s"
    return (f"{path}  {megabytes}, {len(times)} pictures, {len(times) / rate:.3g} s from {times[0]:g} to "
            f"{times[-1]:g} s, {speed:g} x real time")


# Handler of signals: ends the work by an exception, so that the draft of the film is removed on the way.
def stop(number, _):
    raise Stopped(number)


# Runs the command and returns its exit code. After a signal the draft of the film is removed, a message is printed, and
# then the signal ends the process, so there is no exit code.
def main():
    options = command_line().parse_args()
    for number_of_signal in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number_of_signal, stop)
    try:
        from . import encoder

        try:
            return make(options)
        except encoder.FilmError as error:
            return fail(INPUT_OUTPUT, error)
    except Stopped as stopped:  # use the default action of the signal, so that a shell sees what ended the process
        fail(DONE, f"stopped by {stopped}; no film was written")
        signal.signal(stopped.number, signal.SIG_DFL)
        os.kill(os.getpid(), stopped.number)


if __name__ == "__main__":
    sys.exit(run("movie", main))
