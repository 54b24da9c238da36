"""Makes a film of a run, picture by picture."""
from __future__ import annotations

import dataclasses
import os

import numpy

from polynya.files import naming

from .encoder import SAMPLES, Encoder
from .picture import Picture

# Approximate duration of a film whose speed is not given [s]. A larger value makes films that show the run more slowly,
# and that take more time and space for more pictures.
WANTED = 30.0
# Pictures per second of the film. GIFs have half as many, because each picture takes more space in them.
RATES = {".mp4": 25.0, ".gif": 12.5}
# Endings of file names: .mp4 and .gif for films, .png for a single picture.
SUFFIXES = (*RATES, ".png")


def chosen_speed(seconds):
    """Simulated seconds per second of the film for a run of `seconds` [s], so that the film takes about WANTED. It is
    one of 1, 2, 5 · 10ⁿ, that nearest in ratio, so the film takes between 19 and 47 s."""
    wanted = max(seconds, 1e-9) / WANTED
    power = 10.0 ** numpy.floor(numpy.log10(wanted))
    return float(min((step * power for step in (1, 2, 5, 10)), key=lambda speed: abs(numpy.log(speed / wanted))))


def chosen_times(run, start=None, end=None, speed=None, rate=RATES[".mp4"]):
    """Times of the pictures [s], evenly from `start` to `end` of the run, both included. `start` and `end` are
    simulated times [s]; without them the whole run is shown. `speed` (> 0) is simulated seconds per second of the film,
    and `rate` pictures per second of the film. write() has the rates of RATES, so a GIF for which this rate is not that
    of GIFs plays at another speed. There are at least two pictures; their number is rounded, so the speed of short
    films deviates a little. Raises ValueError if a time lies outside of the run or `start` is not before `end`."""
    start = run.start_time if start is None else start
    end = run.end_time if end is None else end
    for name, time in (("from", start), ("to", end)):
        if not run.start_time <= time <= run.end_time:
            raise ValueError(f"{name} {time:g} s: the run goes from {run.start_time:g} to {run.end_time:g} s")
    if start >= end:
        raise ValueError(f"from {start:g} s to {end:g} s: the film would have no length")
    speed = chosen_speed(end - start) if speed is None else speed
    count = max(2, int(round((end - start) / speed * rate)) + 1)
    return numpy.linspace(start, end, count)


def write(run, path, times, look, progress=None):
    """Writes a film of a run at some times [s] as MP4 or GIF, or only the picture at the first time as PNG; the ending
    of `path` decides. The file is written completely or not at all. `look` has the settings of the picture; if it
    states no start or end of the axis of time, these are the first and the last time. `progress` is called after each
    picture of a film with the number of completed pictures and their total. Raises ValueError for another ending,
    FilmError if ffmpeg is missing or fails, and OSError if the file cannot be written."""
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in SUFFIXES:
        raise ValueError(f"{path}: a film's name ends in {', '.join(SUFFIXES)}")
    picture = Picture(run, dataclasses.replace(look, start=look.start if look.start is not None else float(times[0]),
                                               end=look.end if look.end is not None else float(times[-1])))
    if suffix == ".png":
        write_png(picture.draw(float(times[0])), path)
        return
    # A GIF has one palette, which is chosen from pictures that are spread evenly over the film. They are copied,
    # because each draw() overwrites the picture before.
    samples = times[numpy.linspace(0, len(times) - 1, SAMPLES).astype(int)] if suffix == ".gif" else ()
    with Encoder(path, look.size, RATES[suffix], [picture.draw(float(time)).copy() for time in samples]) as encoder:
        for done, time in enumerate(times, 1):
            encoder.add(picture.draw(float(time)))
            if done % 200 == 0:  # limits the memory for shapes of floes that broke; often would cost time
                picture.scenery.forget(float(time))
            if progress:
                progress(done, len(times))


def write_png(pixels, path):
    """Writes rows × columns × 4 bytes (RGBA) as a PNG, completely or not at all. If `path` is a link, the file to which
    it leads is replaced. Raises OSError with a file name if that fails."""
    from matplotlib import image

    path = os.path.realpath(path)
    draft = os.path.join(os.path.dirname(path), f".{os.path.basename(path)}.{os.getpid()}.part")
    try:
        with naming(path):
            image.imsave(draft, pixels, format="png")
            os.replace(draft, path)
    finally:
        if os.path.exists(draft):
            os.remove(draft)
