"""Encodes pictures as a film with ffmpeg."""
from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import tempfile

import numpy

MISSING = ("ffmpeg is not installed: ./setup.sh python, or apt-get install ffmpeg "
           "(a picture, --out frame.png, needs none)")
SAMPLES = 8  # number of pictures from which the colours of a GIF are chosen


class FilmError(Exception):
    """A film that could not be written, with the reason."""


def ffmpeg():
    """Returns the path of the program. Raises FilmError if it is missing."""
    found = shutil.which("ffmpeg")
    if found is None:
        raise FilmError(MISSING)
    return found


def input_of(size, rate):
    """Arguments of ffmpeg for pictures of rows × columns × 4 bytes from its stdin."""
    return ["-f", "rawvideo", "-pixel_format", "rgb0", "-video_size", "{}x{}".format(*size),
            "-framerate", f"{rate:g}", "-i", "-"]


def palette(pictures, size, folder):
    """Makes a PNG with the colours of some pictures, which GIFs need."""
    path = os.path.join(folder, "palette.png")
    words = [ffmpeg(), "-v", "error", "-y", *input_of(size, 1), "-vf", "palettegen=stats_mode=full",
             "-frames:v", "1", "-update", "1", path]
    done = subprocess.run(words, input=b"".join(numpy.ascontiguousarray(p).tobytes() for p in pictures),
                          stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise FilmError(f"ffmpeg: {last_line(done.stderr)}")
    return path


def last_line(text):
    lines = text.decode(errors="replace").strip().splitlines()
    return lines[-1] if lines else "it failed without a message"


class Encoder:
    """A film that is being written. It is written under a hidden name and gets its own name when it is complete;
    otherwise nothing of it remains. ffmpeg runs in its own session, so that Ctrl-C reaches only this process."""

    def __init__(self, path, size, rate, samples=()):
        """`samples` are pictures from which the colours of a GIF are chosen."""
        self._path = os.path.realpath(path)
        folder, name = os.path.split(self._path)
        self._draft = os.path.join(folder, f".{name}.{os.getpid()}.part")
        self._scratch = tempfile.TemporaryDirectory(prefix="polynya-movie-")
        self._process = None
        self._errors = open(os.path.join(self._scratch.name, "errors"), "wb+")  # noqa: SIM115, closed in _clean_up
        try:
            self._process = self._started(path, size, rate, samples)
        except BaseException:
            self._clean_up()
            raise

    def _started(self, path, size, rate, samples):
        words = [ffmpeg(), "-v", "error", "-y", *input_of(size, rate)]
        if path.lower().endswith(".gif"):
            colours = palette(samples, size, self._scratch.name)
            words += ["-i", colours, "-filter_complex", "paletteuse=dither=none:diff_mode=rectangle", "-f", "gif"]
        else:
            words += ["-c:v", "libx264", "-preset", "medium", "-crf", "18", "-pix_fmt",
                      "yuv420p", "-movflags", "+faststart", "-f", "mp4"]
        return subprocess.Popen([*words, self._draft], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                stderr=self._errors, start_new_session=True)

    def add(self, pixels):
        """Adds the next picture."""
        try:
            self._process.stdin.write(numpy.ascontiguousarray(pixels))
        except BrokenPipeError:
            self._process.wait()
            raise FilmError(f"ffmpeg: {self._message()}") from None

    def _message(self):
        self._errors.seek(0)
        return last_line(self._errors.read())

    def __enter__(self):
        return self

    def __exit__(self, kind, *error):
        try:
            if kind is None:
                self._finish()
        finally:
            self._clean_up()

    def _clean_up(self):
        if self._process is not None:
            if self._process.poll() is None:
                self._process.kill()
                self._process.wait()
            with contextlib.suppress(OSError):  # ffmpeg may not have read all input
                self._process.stdin.close()
        if os.path.exists(self._draft):
            os.remove(self._draft)
        self._errors.close()
        self._scratch.cleanup()

    def _finish(self):
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        if self._process.wait() != 0:
            raise FilmError(f"ffmpeg: {self._message()}")
        os.replace(self._draft, self._path)
