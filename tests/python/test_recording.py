"""Run folders that a Simulation leaves, beside those of the program; what notebooks show."""
import json
import os

import pytest

import polynya
from program import BREAKER, succeeded

SCENE = {
    "name": "recorded", "time": {"step_s": 0.01, "until_s": 20}, "record": {"frames_interval_s": 0.5},
    "ships": [{**BREAKER, "hull": {**BREAKER["hull"], "draught_m": 4}}],
    "floes": [{"rectangle": {"corner_m": [0.5, -40], "size_m": [120, 80]}}],
}
FILES = ["scene.json", "forces.csv", "events.ndjson", "floes.ndjson", "frames.bin",
         "contacts.csv", "crushed.csv", "states.csv",
         "final.geojson", "final.svg", "summary.json"]


def run_program(*words):
    succeeded(*words, env={**os.environ, "PATH": "/"})  # without rsvg-convert, which takes seconds


def without_wall_time(text):
    return [line for line in text.split(b"\n") if b"wall_time_s" not in line and b"real_time_factor" not in line]


def expect_same(one, other):
    for name in FILES:
        assert without_wall_time((one / name).read_bytes()) == without_wall_time((other / name).read_bytes()), name
    names = lambda folder: sorted(path.name for path in folder.iterdir())
    assert names(one) == names(other)


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "/")
    file = tmp_path / "scene.json"
    file.write_text(json.dumps(SCENE))
    return file


def test_a_recorded_simulation_leaves_the_folder_of_the_program(scene, tmp_path):
    run_program("run", scene, "--out", tmp_path / "whole", "--until", 4.3)
    simulation = polynya.Simulation(scene)
    with simulation.record(tmp_path / "mine") as recording:
        simulation.run(until=1)
        simulation.run(until=4.3)
    expect_same(tmp_path / "whole", tmp_path / "mine")
    assert recording.run.end_time == 4.3
    simulation.step(10)  # which nothing records
    expect_same(tmp_path / "whole", tmp_path / "mine")
    run_program("run", scene, "--out", tmp_path / "whole", "--until", 6, "--overwrite")
    run_program("resume", tmp_path / "mine", "--until", 6)
    expect_same(tmp_path / "whole", tmp_path / "mine")


def test_an_exception_leaves_a_run_that_is_resumed(scene, tmp_path):
    run_program("run", scene, "--out", tmp_path / "whole", "--until", 4)
    simulation = polynya.Simulation({**SCENE, "time": {**SCENE["time"], "until_s": 4}})
    with pytest.raises(KeyError):
        with simulation.record(tmp_path / "mine"):
            simulation.run(until=2)
            raise KeyError("mine")
    with pytest.raises(polynya.UnfinishedError, match="KeyError"):
        polynya.Run(tmp_path / "mine")
    run_program("resume", tmp_path / "mine")
    expect_same(tmp_path / "whole", tmp_path / "mine")


def test_what_cannot_be_recorded_is_refused(scene, tmp_path):
    (tmp_path / "foreign").mkdir()
    (tmp_path / "foreign" / "thesis.tex").write_text("years of work")
    simulation = polynya.Simulation(scene)
    with pytest.raises(polynya.FolderError, match="not a run folder"):
        simulation.record(tmp_path / "foreign", overwrite=True)
    recording = simulation.record(tmp_path / "mine", map=False)
    with pytest.raises(RuntimeError, match="recorded already"):
        simulation.record(tmp_path / "other")
    recording.close()
    recording.close()
    with pytest.raises(polynya.UnfinishedError, match="before the first step"):
        polynya.Run(tmp_path / "mine")
    run_program("resume", tmp_path / "mine", "--until", 1)
    assert polynya.Run(tmp_path / "mine").end_time == 1
    simulation.step()
    with pytest.raises(RuntimeError, match="before the first step"):
        simulation.record(tmp_path / "other")


def test_scenes_simulations_and_runs_show_a_map(scene, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    simulation = polynya.Simulation(scene)
    with simulation.record(tmp_path / "mine", map=False) as recording:
        simulation.run(until=3)
    for shown in (polynya.Scene(scene), simulation, recording.run):
        text = shown._repr_html_()
        assert "recorded" in text and 'src="data:image/png;base64,iVBOR' in text
    assert "3 s" in recording.run._repr_html_() and "cusps" in recording.run._repr_html_()
    figure = matplotlib.figure.Figure()
    axes = simulation.plot(figure.add_subplot())
    (x0, x1), patches = axes.get_xlim(), len(axes.artists) + len(axes.patches)
    assert x0 < -50 and x1 > 120 and patches >= 3, "a plate, its pieces and a ship"
    wrong = polynya.Scene({**SCENE, "tiem": {}})._repr_html_()
    assert "tiem" in wrong and "img" not in wrong
