"""Runs and studies read back: every number is the file's, and where floes and ships are is what `polynya export`
writes."""
import json
import pathlib
import shutil

import numpy
import pytest

import polynya
from program import TUG, ended, lines, rows, succeeded
from polynya.results import hulls
from polynya.results.motions import placed

UNTIL = 20
SCENE = {
    "name": "read-back",
    "time": {"step_s": 0.01, "until_s": UNTIL},
    "record": {"forces_interval_s": 0.1, "frames_interval_s": 0.5, "contacts": "all"},
    "ships": [TUG],
    "structures": [{"name": "pile", "radius_m": 5, "position_m": [75, 30]}],
    "water": {"drift_m_per_s": [0.1, 0.3]},
    "ice": {"thickness_m": 0.5},
    "floes": [{"rectangle": {"corner_m": [0, -30], "size_m": [40, 60]}},
              {"rectangle": {"corner_m": [42, 0], "size_m": 5}},
              {"polygon": {"outer_m": [[62, -9], [80, -9], [80, 9], [62, 9]],
                           "holes_m": [[[68, -3], [68, 3], [74, 3], [74, -3]]]}},
              {"rectangle": {"corner_m": [100, 40], "size_m": 5}, "crushed_overlaps": True},
              {"rectangle": {"corner_m": [104, 40], "size_m": 5}, "crushed_overlaps": True}],
}
STUDY = {"name": "thicknesses", "scene": "scene.json", "grid": {"ice.thickness_m": [0.4, 0.8]},
         "set": {"time.until_s": 2}, "keep": "all"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    home = tmp_path_factory.mktemp("results")
    (home / "scene.json").write_text(json.dumps(SCENE))
    succeeded("run", "scene.json", "--out", "run", "--no-map", cwd=home)
    return home / "run"


@pytest.fixture
def copy(folder, tmp_path):
    return pathlib.Path(shutil.copytree(folder, tmp_path / "copy"))


@pytest.fixture(params=[False, True], ids=["numpy", "pandas"])
def run(request, folder):
    if request.param:
        pytest.importorskip("pandas")
    return polynya.Run(folder, pandas=request.param)


def columns_of(table):
    names = table.columns if hasattr(table, "columns") else table.dtype.names
    return {name: numpy.asarray(table[name]) for name in names}


@pytest.mark.parametrize("name", ["forces", "contacts", "peaks", "crushed", "states"])
def test_every_number_of_a_table_is_the_files(run, folder, name):
    written = rows(folder / f"{'contacts' if name == 'peaks' else name}.csv")
    if name in ("contacts", "peaks"):
        written = sorted((row for row in written if bool(row["ended_by"]) == (name == "peaks")),
                         key=lambda row: float(row["t_s"]))
    assert written
    columns = columns_of(getattr(run, name))
    assert list(columns) == list(written[0])
    for column, values in columns.items():
        assert len(values) == len(written)
        for value, row in zip(values.tolist(), written):
            text = row[column]
            if isinstance(value, str) or text:
                assert value == (text if isinstance(value, str) else float(text))
            else:  # no floe; no place on a waterline
                assert numpy.isnan(value) if isinstance(value, float) else value == -1


def test_a_mooring_that_broke_is_a_row_without_a_floe(copy):
    broken = {"t_s": 3.5, "kind": "mooring_break", "ship": "breaker", "point_m": [1.5, -2],
              "force_N": 1.25e5, "break_load_N": 1.2e5, "offset_m": [12.5, -0.5]}
    with open(copy / "events.ndjson", "a") as file:
        file.write(json.dumps(broken) + "\n")
    run = polynya.Run(copy, pandas=False)
    row = run.events[-1]
    wanted = {"t_s": 3.5, "kind": "mooring_break", "ship": "breaker", "floe": -1, "children": (), "force_N": 1.25e5,
              "break_load_N": 1.2e5, "offset_along_m": 12.5, "offset_across_m": -0.5}
    assert {name: row[name] for name in wanted} == wanted
    assert not numpy.isfinite(run.events[0]["offset_along_m"])
    assert len(run.floes) == len(lines(copy / "floes.ndjson"))


def test_events_have_all_that_their_lines_have(run, folder):
    columns, written = columns_of(run.events), lines(folder / "events.ndjson")
    assert {"bend", "submerge"} <= set(columns["kind"])
    for i, event in enumerate(written):
        row = {name: values[i] for name, values in columns.items()}
        assert all(row[name] == event[name] for name in ("t_s", "kind", "ship", "floe"))
        assert row["parent"] == (-1 if event["parent"] is None else event["parent"])
        assert row["children"] == tuple(event["children"])
        assert [row["x_m"], row["y_m"]] == event["point_m"] and [row["normal_x"], row["normal_y"]] == event["normal"]
        assert all(row["criterion" if name == "kind" else name] == value for name, value in event["criterion"].items())
        assert ("load_N" in event["criterion"]) == bool(numpy.isfinite(row["load_N"]))


@pytest.mark.parametrize("time", [0, 1.3, 8, 13.7, UNTIL])
def test_floes_and_ships_are_where_the_program_puts_them(folder, tmp_path, time):
    succeeded("export", folder, "--geojson", tmp_path, "--metres", "--at", time, cwd=tmp_path)
    frame = polynya.Run(folder, pandas=False, shapely=False).frame(time)
    ids, found = frame.floes["floe_id"].tolist(), dict(zip(frame.floes["floe_id"].tolist(), frame.polygons))
    layers = {}
    for layer in ("floes", "under-hull"):
        for feature in json.loads((tmp_path / f"{layer}.geojson").read_text())["features"]:
            layers[feature["properties"]["floe_id"]] = layer, feature
    assert sorted(layers) == ids
    for i, floe in enumerate(ids):
        layer, feature = layers[floe]
        assert frame.floes["is_under"][i] == (layer == "under-hull")
        assert frame.floes["area_m2"][i] == feature["properties"]["area_m2"]
        assert found[floe]["type"] == feature["geometry"]["type"] == "Polygon"
        for ring, written in zip(found[floe]["coordinates"], feature["geometry"]["coordinates"], strict=True):
            numpy.testing.assert_allclose(ring, written, rtol=0, atol=2e-6)
    hulls = {f["properties"]["ship"]: f["geometry"]["coordinates"][0]
             for f in json.loads((tmp_path / "ships.geojson").read_text())["features"]}
    assert list(frame.hulls) == ["breaker", "pile"] == frame.ships["ship"].tolist()
    for name, ring in frame.hulls.items():
        assert {tuple(p) for p in numpy.round(ring, 3)} == {tuple(p) for p in numpy.round(hulls[name], 3)}


def test_a_walls_face_stands_between_its_ends_and_its_body_behind():
    wall = {"name": "west", "from_m": [0, 10], "to_m": [0, -10], "depth_m": 5}
    x, y, heading = hulls.first_motion(wall)[:3]
    corners = placed(hulls.waterline(wall), x, y, heading)
    numpy.testing.assert_allclose(corners, [[0, -10], [0, 10], [-5, 10], [-5, -10]], atol=1e-12)


def test_some_ice_is_under_a_hull_and_some_has_holes(folder):
    run = polynya.Run(folder, pandas=False)
    assert any(frame.is_under.any() for frame in run.frames)
    assert any(len(rings) == 2 for rings in run.frames[0].rings)
    assert [frame.time for frame in run.frames] == run.times.tolist() == [row["t_s"] for row in run.states]
    births = lines(folder / "floes.ndjson")
    assert [floe["area_m2"] for floe in births] == run.floes["area_m2"].tolist()
    parents = [-1 if floe["parent_id"] is None else floe["parent_id"] for floe in births]
    assert run.floes["parent_id"].tolist() == parents


def test_floes_are_shapely_polygons_where_it_is_installed(folder):
    pytest.importorskip("shapely")
    frame = polynya.Run(folder).frame(13.7)
    for polygon, area in zip(frame.polygons, numpy.asarray(frame.floes["area_m2"])):
        assert polygon.is_valid and polygon.area == pytest.approx(area, rel=1e-9)


def test_a_channel_is_that_of_the_command(copy):
    with pytest.raises(polynya.FolderError, match="polynya channel"):
        polynya.Run(copy).channel
    measured = polynya.Run(copy, pandas=False).measure_channel()
    assert not (copy / "channel.csv").exists()
    succeeded("channel", copy, cwd=copy)
    run = polynya.Run(copy, pandas=False)
    assert columns_of(run.channel).keys() == columns_of(measured.stations).keys()
    written = [float(row["width_m"]) for row in rows(copy / "channel.csv")]
    assert run.channel["width_m"].tolist() == written == measured.stations["width_m"].tolist()
    assert set(measured.parts) >= {"open water", "swept band"}
    with pytest.raises(polynya.FolderError, match="no ship"):
        run.measure_channel(ship="nobody")


def test_what_is_no_run_is_refused_with_what_it_is(tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "file").write_text("")
    for name, words in (("nowhere", "does not exist"), ("empty", "has no scene.json"), ("file", "is a file")):
        with pytest.raises(polynya.NotARunError, match=f"not a run folder: .*{name} {words}"):
            polynya.Run(tmp_path / name)
    with pytest.raises(polynya.NotAStudyError, match="has no plan.json"):
        polynya.Study(tmp_path / "empty")


def change(path, **members):
    path.write_text(json.dumps({**json.loads(path.read_text()), **members}))


def test_an_unfinished_run_is_read_where_that_is_wanted(copy):
    change(copy / "summary.json", finished=False, stopped_by="SIGINT")
    with pytest.raises(polynya.UnfinishedError, match=r"stopped by SIGINT\): polynya resume"):
        polynya.Run(copy)
    with open(copy / "forces.csv", "a") as file:
        file.write("99,brea")
    frames = (copy / "frames.bin").read_bytes()
    (copy / "frames.bin").write_bytes(frames[:-10])
    run = polynya.Run(copy, unfinished=True, pandas=False)
    assert not run.is_finished and len(run.forces) == len(rows(copy / "forces.csv")) - 1
    assert run.end_time < UNTIL
    with pytest.raises(ValueError, match="the run goes from 0 to"):
        run.frame(UNTIL)


def test_other_versions_are_named(copy):
    (copy / "crushed.csv").unlink()
    change(copy / "summary.json", folder_version=2)
    run = polynya.Run(copy)
    assert len(run.forces) > 0
    with pytest.raises(polynya.VersionError, match="version 2 and before did not record it"):
        run.crushed
    change(copy / "summary.json", folder_version=7)
    with pytest.raises(polynya.VersionError, match="a run folder of version 7; this polynya reads 1 to 6"):
        polynya.Run(copy)


@pytest.mark.parametrize("file, old, new, words", [
    ("floes.ndjson", '"ring_m":[[0,-30],', '"ring_m":[[1e999,0],', "floes.ndjson:1: not JSON"),
    ("forces.csv", "breaker,", "breaker,none", 'forces.csv:2: "none.*" is not a number'),
    ("forces.csv", "t_s,ship", "t_S,ship", "forces.csv:1: columns of another version"),
    ("forces.csv", ",breaker,", ",\x8f,", 'forces.csv:2: .* is no ship, structure or wall'),
    ("frames.bin", "PLYNYFRM", "PLYNYXXX", "frames.bin: not a file of frames"),
    ("events.ndjson", '{"t_s"', '"t_s"', "events.ndjson:1: not JSON"),
    ("scene.json", '"until_s": 20', '"until_s": "x"', r"scene.json:\d+:\d+: time.until_s: found "),
    ("summary.json", '"steps": ', '"steps": "x", "then": ', r'summary.json:\d+:\d+: steps: found "x", allowed: a num'),
])
def test_a_damaged_file_is_named(copy, file, old, new, words):
    data = (copy / file).read_bytes()
    assert old.encode() in data
    (copy / file).write_bytes(data.replace(old.encode(), new.encode('latin-1'), 1))
    with pytest.raises(polynya.FolderError, match=words):
        polynya.Run(copy)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    home = tmp_path_factory.mktemp("study")
    (home / "scene.json").write_text(json.dumps(SCENE))
    (home / "study.json").write_text(json.dumps(STUDY))
    succeeded("study", "plan", "study.json", "--trial-seconds", "0", cwd=home)
    with pytest.raises(polynya.FolderError, match="polynya study gather"):
        polynya.Study(home / "studies/thicknesses")
    succeeded("study", "run", "studies/thicknesses", "--jobs", "1", "--quiet", cwd=home)
    succeeded("study", "gather", "studies/thicknesses", cwd=home)
    return home / "studies/thicknesses"


@pytest.mark.parametrize("pandas", [False, True])
def test_a_studys_table_is_the_files(study, pandas):
    if pandas:
        pytest.importorskip("pandas")
    found = polynya.Study(study, pandas=pandas)
    assert (found.name, found.parameters) == ("thicknesses", ["ice.thickness_m", "seed"])
    columns, written = columns_of(found.table), rows(study / "table.csv")
    assert list(columns) == list(written[0]) == ["case", "state", *found.parameters, *found.measures]
    for name, values in columns.items():
        for value, row in zip(values.tolist(), written):
            if isinstance(value, str):
                assert value == row[name]
            else:
                assert str(value) == "nan" and row[name] == "" or value == float(row[name])
    assert "2 of 2 cases" in found._repr_html_() and "ice.thickness_m" in found._repr_html_()
    assert found.run(1).end_time == 2
    with pytest.raises(IndexError, match="0 to 1"):
        found.run(2)


def test_a_partial_study_is_read_where_that_is_wanted(study, tmp_path):
    copied = pathlib.Path(shutil.copytree(study, tmp_path / "study"))
    (copied / "cases/000001/case.json").unlink()
    ended("study", "gather", copied)
    with pytest.raises(polynya.UnfinishedError, match="1 of 2 cases"):
        polynya.Study(copied)
    found = polynya.Study(copied, unfinished=True, pandas=False)
    assert found.table["state"].tolist() == ["finished", "unfinished"]
    shutil.rmtree(copied / "cases/000001/run")
    with pytest.raises(polynya.FolderError, match="case 1 is missing"):
        found.run(1)


def test_what_is_wanted_and_not_installed_is_named(folder, monkeypatch):
    import sys
    monkeypatch.setitem(sys.modules, "pandas", None)
    monkeypatch.setitem(sys.modules, "shapely.geometry", None)
    assert polynya.Run(folder).forces.dtype.names[:2] == ("t_s", "ship")
    assert polynya.Run(folder).frame(0).polygons[0]["type"] == "Polygon"
    with pytest.raises(ImportError, match="apt-get install python3-pandas"):
        polynya.Run(folder, pandas=True).forces
    with pytest.raises(ImportError, match="apt-get install python3-shapely"):
        polynya.Run(folder, shapely=True).frame(0).polygons


@pytest.mark.parametrize("documented", [polynya.Run, polynya.Study])
def test_the_classes_are_documented(documented):
    members = {name: value for name, value in vars(documented).items()
               if not name.startswith("_") and callable(getattr(value, "fget", value))}
    assert documented.__doc__ and len(members) >= 5 and all(value.__doc__ for value in members.values())
