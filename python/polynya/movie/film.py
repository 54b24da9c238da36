"""Makes a film of a run, picture by picture."""
from __future__ import annotations

import dataclasses
import os

import numpy

from polynya.files import naming

from .encoder import SAMPLES, Encoder
from .picture import Picture

WANTED = 30.0  # approximate duration of a film whose speed is not given [s]
RATES = {".mp4": 25.0, ".gif": 12.5}  # pictures per second
SUFFIXES = (*RATES, ".png")


def chosen_speed(seconds):
    """Simulated seconds per second of the film, one of 1, 2, 5 · 10ⁿ, for which the film takes about half a minute."""
    wanted = max(seconds, 1e-9) / WANTED
    power = 10.0 ** numpy.floor(numpy.log10(wanted))
    return float(min((step * power for step in (1, 2, 5, 10)), key=lambda speed: abs(numpy.log(speed / wanted))))


def chosen_times(run, start=None, end=None, speed=None, rate=RATES[".mp4"]):
    """Times of the pictures [s], from `start` to `end` of the run."""
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
    """Writes a film of a run at some times [s] as MP4 or GIF, or the first picture as PNG. The file is written
    completely or not at all. `progress` is called with the number of completed pictures and their total. Raises
    FilmError."""
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in SUFFIXES:
        raise ValueError(f"{path}: a film's name ends in {', '.join(SUFFIXES)}")
    picture = Picture(run, dataclasses.replace(look, start=look.start if look.start is not None else float(times[0]),
                                               end=look.end if look.end is not None else float(times[-1])))
    if suffix == ".png":
        write_png(picture.draw(float(times[0])), path)
        return
    samples = times[numpy.linspace(0, len(times) - 1, SAMPLES).astype(int)] if suffix == ".gif" else ()
    with Encoder(path, look.size, RATES[suffix], [picture.draw(float(time)).copy() for time in samples]) as encoder:
        for done, time in enumerate(times, 1):
            encoder.add(picture.draw(float(time)))
            if done % 200 == 0:
                picture.scenery.forget(float(time))
            if progress:
                progress(done, len(times))


def write_png(pixels, path):
    """Writes a PNG, completely or not at all."""
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
