"""Films of runs: what they show, and that a stopped one leaves nothing."""
import json
import os
import signal
import shutil
import subprocess
import time

import numpy
import pytest

import polynya
from program import ICE, PROGRAM, ended, run_of
from polynya import scenery
from polynya.movie import film, history, picture
from polynya.movie.__main__ import size

needs_ffmpeg = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is missing (./setup.sh python)")
SCENE = {**ICE, "record": {"forces_interval_s": 0.1, "frames_interval_s": 2},
         "floes": [*ICE["floes"], {"rectangle": {"corner_m": [-60, 30], "size_m": [20, 10]}}]}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return run_of(tmp_path_factory.mktemp("run"), "film", SCENE)


@pytest.fixture(scope="module")
def run(folder):
    return polynya.Run(folder, pandas=False)


def movie(*words, **environment):
    return ended("movie", *words, env={**os.environ, **environment})


def area_of(path):
    """Of a compound path's closed rings [m²]."""
    starts = [*numpy.flatnonzero(path.codes == path.MOVETO), len(path.codes)]
    total = 0.0
    for first, after in zip(starts, starts[1:]):
        x, y = (path.vertices[first : after - 1] - path.vertices[first]).T
        total += 0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
    return total


@pytest.mark.parametrize("time", [0, 3.3, 11.7, 12])
def test_a_picture_shows_all_ice_of_its_time(run, time):
    drawn = scenery.Scenery(run)
    frame = run.frame(time)
    paths = drawn.floes(frame)
    areas, under = run.births["area_m2"][frame.ids], frame.is_under
    assert sum(area_of(path) for path in paths) == pytest.approx(areas.sum(), rel=1e-9)
    assert area_of(paths[scenery.UNDER]) == pytest.approx(areas[under].sum(), abs=1e-9)
    whole = run.births["generation"][frame.ids] == 0
    assert area_of(paths[scenery.WHOLE]) == pytest.approx(areas[whole & ~under].sum(), abs=1e-6)
    everything = numpy.concatenate([path.vertices for path in paths])
    x0, y0, x1, y1 = drawn.extent
    assert ((everything > (x0, y0)) & (everything < (x1, y1))).all()


def test_floes_and_ships_are_drawn_where_they_are(run):
    drawn, frame = picture.Picture(run, picture.Look(size=(640, 360))), run.frame(9.0)
    pixels = drawn.draw(9.0)
    stern = frame.ship_motions[0, :2] - (25, 0)
    assert colour_at(drawn, pixels, *stern).max() < 90, "the hull is dark"
    floe = frame.rings[int(numpy.flatnonzero(frame.ids == 1)[0])][0].mean(axis=0)
    assert colour_at(drawn, pixels, *floe).min() == 255, "a floe that nothing broke is white"
    assert colour_at(drawn, pixels, -55, -30).tolist() == [0x8F, 0xB8, 0xD0], "water"


def test_a_map_that_follows_a_ship_has_it_in_its_middle(run):
    look = picture.Look(size=(640, 360), follow="breaker")
    drawn = picture.Picture(run, look)
    for time in (1.0, 9.0):
        pixels = drawn.draw(time)
        x, y = drawn._map.transAxes.transform((0.5, 0.5))
        assert pixels[len(pixels) - 1 - int(y), int(x), :3].max() < 90
    with pytest.raises(ValueError, match="no ship 'sailor': the run has breaker"):
        picture.Picture(run, picture.Look(follow="sailor"))


def test_the_force_is_pale_where_it_is_still_to_come(run):
    drawn = picture.Picture(run, picture.Look(size=(640, 360), start=0, end=12))
    box = drawn.history.axes.get_window_extent()
    across = slice(int(box.x0) + 4, int(box.x1) - 4)
    rows = slice(360 - int(box.y1), 360 - int(box.y0) - 2)

    def darkest(time):
        return drawn.draw(time)[rows, across, :3].max(axis=2).min(axis=0)

    at_start, at_end = darkest(0.0), darkest(12.0)
    assert at_start[20:].min() >= 255 * (1 - history.PALE) - 1
    assert at_end[:-20].min() < 160  # a pale line is at 216, a full one darker by its width in pixels


def test_thinned_curves_keep_their_peaks():
    times = numpy.arange(10_000) * 0.1
    values = numpy.sin(times)
    values[4321], values[77] = 9.0, -8.0
    at, thin = history.thinned(times, values, 300)
    assert len(at) <= 600 and (numpy.diff(at) > 0).all()
    assert thin.max() == 9.0 and thin.min() == -8.0 and at[thin.argmax()] == times[4321]


def test_times_and_speeds(run):
    assert [film.chosen_speed(seconds) for seconds in (550, 30, 4000, 3)] == [20, 1, 100, 0.1]
    times = film.chosen_times(run, 2, 6, speed=2, rate=25)
    assert len(times) == 51 and (times[0], times[-1]) == (2, 6)
    for wrong in ({"start": -1}, {"end": 13}, {"start": 5, "end": 5}):
        with pytest.raises(ValueError):
            film.chosen_times(run, **wrong)
    assert size("1280x720") == (1280, 720)
    for wrong in ("1280", "1281x720", "10x10", "axb", "1280x720x3"):
        with pytest.raises(Exception, match="allowed: WIDTHxHEIGHT"):
            size(wrong)


@needs_ffmpeg
@pytest.mark.parametrize("suffix, pictures", [("mp4", 26), ("gif", 13)])
def test_a_film_has_its_size_and_length(folder, tmp_path, suffix, pictures):
    out = tmp_path / f"film.{suffix}"
    done = movie(folder, "--out", out, "--from", 4, "--to", 8, "--speed", 4, "--size", "320x320")
    assert done.returncode == 0, done.stderr
    assert f"{pictures} pictures" in done.stdout or f"{pictures + 1} pictures" in done.stdout
    probed = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                             "stream=width,height,nb_read_frames", "-of", "json", out],
                            check=True, capture_output=True, text=True)
    stream = json.loads(probed.stdout)["streams"][0]
    assert (stream["width"], stream["height"]) == (320, 320)
    assert pictures <= int(stream["nb_read_frames"]) <= pictures + 1
    assert os.listdir(tmp_path) == [out.name]


@needs_ffmpeg
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stopped_film_leaves_no_file(folder, tmp_path, number):
    words = [PROGRAM, "movie", str(folder), "--out", str(tmp_path / "film.mp4"), "--speed", "0.01"]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None and not os.listdir(tmp_path):
            time.sleep(0.02)
        assert all(name.startswith(".") for name in os.listdir(tmp_path))
        process.send_signal(number)
        _, errors = process.communicate(timeout=120)
    assert process.returncode == -number
    assert "no film was written" in errors and "Traceback" not in errors
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("suffix", ["mp4", "gif"])
def test_a_film_that_ffmpeg_cannot_write_leaves_the_old_one(folder, tmp_path, suffix):
    for name in ("bin", "scratch"):
        (tmp_path / name).mkdir()
    fake = tmp_path / "bin" / "ffmpeg"
    fake.write_text("#!/bin/sh\ncat >/dev/null\necho 'No space left on device' >&2\nexit 1\n")
    fake.chmod(0o755)
    out = tmp_path / f"film.{suffix}"
    out.write_text("old")
    done = movie(folder, "--out", out, "--to", 1, "--speed", 1,
                 PATH=f"{fake.parent}:{os.environ['PATH']}", TMPDIR=str(tmp_path / "scratch"))
    assert (done.returncode, out.read_text()) == (5, "old")
    assert "No space left on device" in done.stderr and "ignored" not in done.stderr
    assert sorted(os.listdir(tmp_path)) == ["bin", out.name, "scratch"]
    assert os.listdir(tmp_path / "scratch") == []


def test_wrong_words_are_answered(folder, tmp_path):
    for words, code, message in (
        ((folder, "--out", tmp_path / "film.avi"), 2, ".mp4, .gif, .png"),
        ((folder, "--out", tmp_path / "a.png", "--from", 13), 2, "the run goes from 0 to 12 s"),
        ((folder, "--out", tmp_path / "a.png", "--speed", 0), 2, "allowed: a number > 0"),
        ((folder, "--out", tmp_path / "a.png", "--follow", "sailor"), 2, "the run has breaker"),
        ((tmp_path, "--out", tmp_path / "a.png"), 5, "not a run folder"),
        ((folder, "--out", tmp_path / "none" / "a.png"), 5, "its folder does not exist"),
    ):
        done = movie(*words)
        assert (done.returncode, message in done.stderr, "Traceback" in done.stderr) == (code, True, False), done.stderr
    assert os.listdir(tmp_path) == []


def test_without_ffmpeg_the_message_names_what_to_install_and_a_picture_needs_none(folder, tmp_path):
    done = movie(folder, "--out", tmp_path / "film.mp4", PATH=str(tmp_path))
    assert done.returncode == 5 and "apt-get install ffmpeg" in done.stderr
    done = movie(folder, "--out", tmp_path / "frame.png", "--from", 12, PATH=str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "frame.png").read_bytes()[:4] == b"\x89PNG"


def test_a_film_of_a_run_without_a_ship_has_no_chart(tmp_path):
    alone = run_of(tmp_path, "alone", {"time": {"step_s": 0.1, "until_s": 1}, "floes": SCENE["floes"]})
    drawn = picture.Picture(polynya.Run(alone), picture.Look(size=(320, 320)))
    assert drawn.history is None and drawn.draw(0.5).shape == (320, 320, 4)


def colour_at(drawn, pixels, x, y):
    """Of a picture at a point of the world."""
    across, up = drawn._map.transData.transform((x, y))
    return pixels[len(pixels) - 1 - int(up), int(across), :3].astype(int)


def test_walls_are_grey_and_make_no_tracks(tmp_path):
    walls = [{"from_m": [150, -60], "to_m": [150, 60], "pressure": {"line_load_N_per_m": 1e4}}]
    walled = run_of(tmp_path, "walled", {**SCENE, "time": {"step_s": 0.02, "until_s": 1}, "walls": walls})
    drawn = picture.Picture(polynya.Run(walled, pandas=False), picture.Look(size=(640, 360)))
    assert colour_at(drawn, drawn.draw(1.0), 155, 0).tolist() == [0x8A] * 3
    assert len(drawn.scenery.tracks(1.0)) == 1


def test_a_run_that_is_not_finished_is_shown_as_far_as_it_got(folder, tmp_path):
    shutil.copytree(folder, tmp_path / "run")
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    (tmp_path / "run" / "summary.json").write_text(json.dumps({**summary, "finished": False, "stopped_by": "SIGTERM"}))
    done = movie(tmp_path / "run", "--out", tmp_path / "a.png", "--from", 12)
    assert done.returncode == 0 and "the run at 12 s" in done.stdout, done.stderr


def test_only_what_is_in_the_picture_is_drawn_and_small_floes_are_squares_of_their_area(run):
    drawn, frame = scenery.Scenery(run), run.frame(9.0)
    near = run.frame(9.0).rings[int(numpy.flatnonzero(frame.ids == 1)[0])][0]  # of the floe that nothing broke
    window = (*(near.min(axis=0) + 1), *(near.max(axis=0) - 1))
    assert sum(len(path.vertices) for path in drawn.floes(frame, window)) == len(near) + 1
    squares = drawn.floes(frame, least=1e6)
    assert sum(len(path.vertices) for path in squares) == 5 * len(frame.ids)
    assert sum(area_of(path) for path in squares) == pytest.approx(run.births["area_m2"][frame.ids].sum(), rel=1e-9)


def test_a_film_that_keeps_the_floes_at_rest_shows_what_a_picture_by_itself_shows(run):
    films, alone = (picture.Picture(run, picture.Look(size=(640, 360), speed=2, start=0, end=12, is_film=is_film))
                    for is_film in (True, False))
    map_rows = slice(int(360 * picture.HEAD) + 1, int(360 * (1 - picture.CHART)))
    rested = 0
    for time in numpy.linspace(0, 12, 49):
        kept = films.draw(float(time))[map_rows].astype(int).copy()
        whole = alone.draw(float(time))[map_rows].astype(int)
        different = (numpy.abs(kept - whole).max(axis=2) > 60).sum()
        rested += int(films._resting.sum())
        assert different <= 40, f"{different} pixels at {time} s"
    assert rested > 40


def test_how_far_a_long_film_is_is_printed_where_there_is_no_terminal(capsys, monkeypatch):
    from polynya.movie import __main__ as command

    now = iter((0.0, 4.0, 11.0, 12.0))
    monkeypatch.setattr(command.time, "monotonic", lambda: next(now))
    progress = command.Progress()
    for done in (1, 2, 3):
        progress(done, 8)
    assert capsys.readouterr().err == "picture 2 of 8, 33 s left\n"
