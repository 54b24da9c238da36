"""`polynya movie` (app/movie.cpp starts it)."""
import argparse
import math
import os
import signal
import sys
import time

DONE, USAGE, INPUT_OUTPUT = 0, 2, 5
EXAMPLES = """Examples:
  polynya movie runs/sawamura2017-fig4b --out voyage.mp4
  polynya movie runs/sawamura2017-fig4b --out voyage.gif --size 800x450 --from 100 --to 300 --speed 20
  polynya movie runs/sawamura2017-fig4b --out voyage.mp4 --follow icebreaker
  polynya movie runs/sawamura2017-fig4b --out frame.png --from 330          one picture, without ffmpeg
"""
MEANING = """Makes a film of a run: the ice, the ships and where it breaks, and below it the force on a ship."""


class Stopped(Exception):
    """By a signal."""

    def __init__(self, number):
        super().__init__(signal.Signals(number).name)
        self.number = number


def number(least, is_above, unit):
    def parsed(text):
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or value < least or (is_above and value == least):
            raise argparse.ArgumentTypeError(f"found {text}, allowed: {'>' if is_above else '≥'} {least:g} {unit}")
        return value

    return parsed


def size(text):
    """Width and height of a picture [px]; halves of both must be whole, as MP4 needs it."""
    parts = text.lower().split("x")
    values = [int(part) for part in parts if part.isdigit()]
    if len(parts) != 2 or len(values) != 2 or not all(320 <= value <= 7680 and value % 2 == 0 for value in values):
        raise argparse.ArgumentTypeError(f"found {text}, allowed: WIDTHxHEIGHT, even numbers from 320 to 7680 pixels, as 1280x720")
    return tuple(values)


def film_name(text):
    from .film import SUFFIXES

    if os.path.splitext(text)[1].lower() not in SUFFIXES:
        raise argparse.ArgumentTypeError(f"found {text}, allowed: a name that ends in {', '.join(SUFFIXES)}")
    return text


def command_line():
    parser = argparse.ArgumentParser(prog="polynya movie", formatter_class=argparse.RawDescriptionHelpFormatter,
                                     description=EXAMPLES + "\n" + MEANING)
    parser.add_argument("run", metavar="RUN", help="the run folder; a run that is not finished is shown as far as it got")
    parser.add_argument("--out", type=film_name, default="voyage.mp4", metavar="FILE",
                        help="the film: .mp4, .gif, or .png, the picture at --from (voyage.mp4 if not given)")
    parser.add_argument("--from", dest="start", type=number(0, False, "s"), metavar="S", help="in simulated time; the run's start if not given")
    parser.add_argument("--to", dest="end", type=number(0, False, "s"), metavar="S", help="likewise; the run's end if not given")
    parser.add_argument("--speed", type=number(0, True, "s a second"), metavar="X",
                        help="simulated seconds a second of the film; one for about half a minute if not given")
    parser.add_argument("--size", type=size, default=(1280, 720), metavar="WxH", help="in pixels (1280x720 if not given)")
    parser.add_argument("--follow", metavar="SHIP", help="the ship that the map goes with, by its name; all of the run if not given")
    return parser


def fail(code, message):
    print(f"polynya movie: {message}", file=sys.stderr)
    return code


class Progress:
    """How far a film is, on stderr: one line on a terminal, which is written over, else a line every ten seconds."""

    def __init__(self):
        self._start = self._shown = time.monotonic()
        self._least = 0.1 if sys.stderr.isatty() else 10.0  # between two reports [s]

    def __call__(self, done, count):
        now = time.monotonic()
        is_last = done == count and sys.stderr.isatty()
        if now - self._shown < self._least and not is_last:
            return
        self._shown = now
        left = (now - self._start) / done * (count - done)
        words = f"picture {done} of {count}, {left:.0f} s left"
        print(f"\r{words:<48}" + ("\n" if is_last else "") if sys.stderr.isatty() else words, end="" if sys.stderr.isatty() else "\n",
              file=sys.stderr, flush=True)


def make(options):
    from polynya.errors import FolderError
    from polynya.results.run import Run

    from . import encoder, film, picture

    suffix = os.path.splitext(options.out)[1].lower()
    if suffix != ".png":
        encoder.ffmpeg()  # before the run is read
    if not os.path.isdir(os.path.dirname(os.path.abspath(options.out))):
        return fail(INPUT_OUTPUT, f"{options.out}: its folder does not exist")
    try:
        run = Run(options.run, unfinished=True, pandas=False, shapely=False)
        if len(run.times) == 0:
            return fail(INPUT_OUTPUT, f"{options.run}: the run has no frames")
    except FolderError as error:
        return fail(INPUT_OUTPUT, error)
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
    except FolderError as error:
        return fail(INPUT_OUTPUT, error)
    except ValueError as error:
        return fail(USAGE, error)
    print(summary(options.out, times, rate, speed))
    return DONE


def summary(path, times, rate, speed):
    megabytes = f"{os.path.getsize(path) / 1e6:.2g} MB"
    if len(times) == 1 or path.lower().endswith(".png"):
        return f"{path}  {megabytes}, the run at {times[0]:g} s"
    return f"{path}  {megabytes}, {len(times)} pictures, {len(times) / rate:.3g} s from {times[0]:g} to {times[-1]:g} s, {speed:g} x real time"


def stop(number, _):
    raise Stopped(number)


def main():
    options = command_line().parse_args()
    for number_of_signal in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number_of_signal, stop)
    try:
        from . import encoder
        return make_and_report(options, encoder.FilmError)
    except ImportError as error:
        return fail(INPUT_OUTPUT, f"{error}; films need numpy and matplotlib: ./setup.sh python")
    except Stopped as stopped:  # by default's action, so that a shell sees what ended it
        fail(DONE, f"stopped by {stopped}; no film was written")
        signal.signal(stopped.number, signal.SIG_DFL)
        os.kill(os.getpid(), stopped.number)


def make_and_report(options, film_error):
    try:
        return make(options)
    except (film_error, OSError) as error:
        return fail(INPUT_OUTPUT, error)


if __name__ == "__main__":
    sys.exit(main())
