"""Encodes pictures as a film, MP4 or GIF, with the program ffmpeg."""
from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import tempfile

import numpy

# Message if ffmpeg is not installed. A single picture is written without it.
MISSING = ("ffmpeg is not installed: ./setup.sh python, or apt-get install ffmpeg "
           "(a picture, --out frame.png, needs none)")
# Number of pictures, spread over the film, from which the 256 colours of a GIF are chosen. More: rare colours are kept,
# but each of these pictures is drawn once more before the film begins, and all are in the memory at the same time.
SAMPLES = 8


class FilmError(Exception):
    """Raised if a film cannot be written: ffmpeg is missing, or failed with the message in the text."""


def ffmpeg():
    """Returns the path of ffmpeg on the search path. Raises FilmError if it is missing."""
    found = shutil.which("ffmpeg")
    if found is None:
        raise FilmError(MISSING)
    return found


def input_of(size, rate):
    """Returns the arguments with which ffmpeg reads uncompressed pictures from its stdin: rows × columns × 4 bytes, of
    which the fourth is ignored. `size` is width and height [px], `rate` the number of pictures per second."""
    return ["-f", "rawvideo", "-pixel_format", "rgb0", "-video_size", "{}x{}".format(*size),
            "-framerate", f"{rate:g}", "-i", "-"]


def palette(pictures, size, folder):
    """Writes palette.png with the colours of a GIF into the folder and returns its path. The colours are chosen from
    `pictures`, arrays of rows × columns × 4 bytes, of which there must be at least one; `size` is their width and
    height [px]. Raises FilmError if ffmpeg is missing or fails."""
    path = os.path.join(folder, "palette.png")
    words = [ffmpeg(), "-v", "error", "-y", *input_of(size, 1), "-vf", "palettegen=stats_mode=full",
             "-frames:v", "1", "-update", "1", path]
    done = subprocess.run(words, input=b"".join(numpy.ascontiguousarray(p).tobytes() for p in pictures),
                          stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise FilmError(f"ffmpeg: {last_line(done.stderr)}")
    return path


# Returns the last line of ffmpeg's messages (bytes), which states the reason of a failure; without one a sentence that
# there is none.
def last_line(text):
    lines = text.decode(errors="replace").strip().splitlines()
    return lines[-1] if lines else "it failed without a message"


class Encoder:
    """A film while it is written, to be used in a `with` statement. It is written under a hidden name in the same
    folder and gets its own name at the end of the statement. After an exception nothing of it remains, and a file that
    had the name before is unchanged. ffmpeg runs in its own session, so that Ctrl-C reaches only this process, which
    removes the draft. Raises FilmError if ffmpeg is missing or fails, also if that is noticed only at the end of the
    statement. If the path is a link, the file to which it leads is replaced."""

    def __init__(self, path, size, rate, samples=()):
        """Starts ffmpeg. The suffix of `path` decides the format: GIF for .gif, otherwise MP4. `size` is width and
        height of the pictures [px], `rate` their number per second of the film. `samples` are pictures from which the
        colours of a GIF are chosen, at least one; an MP4 needs none."""
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

    # Starts ffmpeg and returns its process. An MP4 has nearly no visible loss (crf 18; larger values give smaller files
    # of less quality) and its index at the start, so that a browser can play it while it loads. A GIF has no dithering,
    # which would make it larger.
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
        """Adds the next picture, an array of rows × columns × 4 bytes (red, green, blue, and one that is ignored) of
        the film's size. Raises FilmError if ffmpeg has ended."""
        try:
            self._process.stdin.write(numpy.ascontiguousarray(pixels))
        except BrokenPipeError:
            self._process.wait()
            raise FilmError(f"ffmpeg: {self._message()}") from None

    # Returns the reason that ffmpeg stated for a failure.
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

    # Ends ffmpeg if it still runs, and removes the draft and the temporary files. After _finish() there is no draft.
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

    # Waits until ffmpeg has written the film, and gives the film its name. Raises FilmError if ffmpeg failed.
    def _finish(self):
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        if self._process.wait() != 0:
            raise FilmError(f"ffmpeg: {self._message()}")
        os.replace(self._draft, self._path)
