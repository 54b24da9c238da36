"""Figures for print: what they show is what the files have, words have their sizes and none is clipped or covers
another."""
import functools
import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess

import matplotlib.text
import numpy
import pytest

import polynya
from program import PROGRAM, TUG, ended, run_of, started, succeeded
from polynya import scenery
from polynya.figures import database, energy, loads, maps, motion, page, sizes
from polynya.figures.subjects import labelled

SCENE = {"time": {"step_s": 0.01, "until_s": 12}, "record": {"forces_interval_s": 0.1, "frames_interval_s": 4},
         "floes": [{"rectangle": {"corner_m": [0, -30], "size_m": [40, 60]}},
                   {"rectangle": {"corner_m": [42, -1], "size_m": 5}}]}
SCENES = {
    "alone": {"ships": [TUG], "fracture": {"splitting": {"model": "michel"}}},
    "another-scene-of-a-long-name": {"ships": [TUG], "ice": {"thickness_m": 0.7}},
    "three": {"ships": [{**TUG, "name": "north"}, {**TUG, "name": "south", "position_m": [-16, -17]}],
              "structures": [{"name": "pile", "radius_m": 5, "position_m": [60, 40]}]},
    "no-ship": {"floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 10}, "velocity_m_per_s": [1, 0]},
                          {"rectangle": {"corner_m": [12, 0], "size_m": 10}}]},
}
DRAW = {"floes": maps.draw, "loads": loads.draw, "motion": motion.draw, "sizes": sizes.draw, "energy": energy.draw}


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    home = tmp_path_factory.mktemp("figures")
    for name, scene in SCENES.items():
        run_of(home, name, {**SCENE, **scene})
    return home


@pytest.fixture(scope="module")
def runs(home):
    return {name: polynya.Run(home / name, pandas=False, shapely=False) for name in SCENES}


@pytest.fixture(scope="module")
def drawn(runs):
    """A figure of some runs on the page by default, which no test changes: each is drawn once."""
    return functools.cache(lambda kind, *names, **more: DRAW[kind]([runs[name] for name in names], **more))


def words_drawn(figure):
    """(words, size [pt], box [px]) of all that a figure writes."""
    found, draw = {}, matplotlib.text.Text.draw

    def record(text, renderer, *more):
        if text.get_visible() and text.get_text().strip():
            found[id(text)] = text.get_text(), text.get_fontsize(), text.get_window_extent(renderer)
        return draw(text, renderer, *more)

    matplotlib.text.Text.draw = record
    try:
        figure.draw_without_rendering()
    finally:
        matplotlib.text.Text.draw = draw
    return list(found.values())


def plain(words):
    return re.sub(r"\s+", " ", words.replace(r"\$", "$"))


@pytest.mark.parametrize("style, width, names", [
    ("one-column", None, ["three", "alone"]), ("two-columns", None, ["alone"]),
    ("two-columns", 60, ["alone", "another-scene-of-a-long-name"]),
    ("slides", None, ["alone", "another-scene-of-a-long-name"])])
def test_words_have_their_sizes_and_are_neither_clipped_nor_covered(runs, style, width, names):
    of, sheet = page.STYLES[style], page.Page(page.STYLES[style], width)
    for name, draw in DRAW.items():
        figure = draw([runs[run] for run in names], sheet)
        words = words_drawn(figure)
        assert len(words) > 5
        wide, high = figure.get_size_inches() * figure.dpi
        assert wide / figure.dpi * 25.4 == pytest.approx(width or of.width)
        for text, size, box in words:
            assert of.small <= size <= of.title, (name, text)
            assert style == "slides" or 7 <= size <= 9
            assert box.x0 >= 0 and box.y0 >= 0 and box.x1 <= wide and box.y1 <= high, (name, text)
        for (text, _, a), (other, _, b) in itertools.combinations(words, 2):
            assert min(a.x1, b.x1) - max(a.x0, b.x0) <= 1 or min(a.y1, b.y1) - max(a.y0, b.y0) <= 1, (name, text, other)


def panel_titles(figure):
    return [plain(axes.get_title(loc="left")) for axes in figure.axes]


def test_panels_have_letters_where_there_are_several(drawn):
    assert panel_titles(drawn("loads", "three", choice="max")) == [
        "(a) three, north", "(b) three, south", "(c) three, pile", *(f"({letter})" for letter in "defghi")]
    assert [title[:4] for title in panel_titles(drawn("floes", "alone"))] == ["(a) ", "(b) ", "(c) ", "(d) "]
    assert not panel_titles(drawn("floes", "alone", at=(0,)))[0].startswith("(")
    figure = drawn("loads", "three", "alone")  # ships of several runs stand in rows
    assert len(figure.axes) == 12 and [title for title in panel_titles(figure) if len(title) > 4] == [
        "(a) three, north", "(b) three, south", "(g) three, pile", "(h) alone"]
    assert page.letters(25) + page.letters(26) + page.letters(27) == "zaaab"


def stairs_of(axes):
    """Of each load in a panel, the one behind first, its largest and its least value."""
    found = []
    for patch in axes.patches:
        high, _, low = patch.get_data()
        found.append((high.max(), numpy.min(low)))
    return found


@pytest.mark.parametrize("choice, middles", [("true", ["_max", ""]), ("mean", [""]),
                                             ("max", ["_max"]), ("j-over-tau-c", ["_j_over_tau_c"])])
def test_loads_are_those_of_the_file_to_the_peak(runs, drawn, choice, middles):
    run = runs["alone"]
    figure = drawn("loads", "alone", choice=choice)
    forces = [run.forces[f"{component}{middle}_{unit}"] for component, unit in loads.COMPONENTS for middle in middles]
    factors = {"N": 1, "kN": 1e3, "MN": 1e6, "GN": 1e9}
    shown = [value for axes in figure.axes for value in stairs_of(axes)]
    scale = [factors[re.search(r"[kMG]?N", axes.get_ylabel())[0]] for axes in figure.axes for _ in middles]
    for column, (high, low), factor in zip(forces, shown, scale, strict=True):
        assert high * factor == pytest.approx(max(0, column.max()))
        assert low * factor == pytest.approx(min(0, column.min()))
        assert max(-low, high) < 1000 or factor == 1e9
    bends = numpy.count_nonzero((run.events["kind"] == "bend") & (run.events["ship"] == "breaker"))
    assert bends > 3
    for axes in figure.axes:
        assert bends in [len(collection.get_segments()) for collection in axes.collections]


def test_every_ship_and_structure_has_its_own_loads_in_one_scale(runs, drawn):
    run = runs["three"]
    figure = drawn("loads", "three", choice="max")
    for i, ship in enumerate(run.ship_names):
        column = run.forces["surge_max_N"][run.forces["ship"] == ship]
        unit = {"k": 1e3, "M": 1e6}[figure.axes[0].get_ylabel()[7]]
        assert stairs_of(figure.axes[i])[0][1] * unit == pytest.approx(min(0, column.min()))
        assert figure.axes[i].get_ylim() == figure.axes[0].get_ylim()
    assert loads.draw([run], choice="ships") is not None and loads.chosen(runs["alone"], "ships") == []


def test_the_papers_force_is_shown_only_where_it_splits(home, runs):
    run = polynya.Run(home / "alone")
    run.scene["fracture"]["splitting"]["model"] = "lefm"
    assert loads.chosen(run, "j-over-tau-c") == []
    assert "fracture.splitting.model michel" in loads.why_not(run, "j-over-tau-c")
    assert len(loads.chosen(run, "true")) == 2


def test_an_envelope_loses_no_peak():
    times = numpy.arange(1, 1001) * 0.1
    values = numpy.zeros(1000)
    values[[3, 500, 501, 999]] = 7, -4, 9, numpy.nan
    edges, low, high = loads.envelope(times, values, 0, 100, 50)
    assert (high.max(), low.min(), high[0], len(edges)) == (9, -4, 7, 51)
    assert numpy.count_nonzero(high) == 2 and numpy.count_nonzero(low) == 1


def test_a_window_of_time_ends_the_scale_and_what_is_drawn(runs):
    run = labelled(runs["alone"], None, 3, 8)
    figure = loads.draw([run], choice="max")
    for axes in (*figure.axes, *motion.draw([run]).axes):
        assert axes.get_xlim() == (3, 8)
    forces = runs["alone"].forces
    within = forces["surge_max_N"][(forces["t_s"] >= 3) & (forces["t_s"] <= 8)]
    least = stairs_of(figure.axes[0])[0][1] * 1e3
    assert least == pytest.approx(within.min(), rel=1e-9) or within.min() < -1e6
    assert [title[4:8].split()[0] for title in panel_titles(maps.draw([run]))] == ["3", "4.66", "6.33", "8"]


def test_speed_heading_and_course_are_those_of_the_file(runs):
    run = runs["three"]
    speed, turn = motion.draw([run]).axes
    assert len(speed.lines) == 2, "the pile does not move"
    for line, ship in zip(speed.lines, ("north", "south")):
        assert line.get_ydata().tolist() == run.forces["speed_m_per_s"][run.forces["ship"] == ship].tolist()
    course = motion.course_of(numpy.array([-1.0, 0.001, 0]), numpy.array([0.1, 0, 1]), numpy.array([-181.0, 0, 450]))
    assert course[[0, 2]] == pytest.approx([-185.71059, 450], abs=1e-4) and numpy.isnan(course[1])


def test_sizes_count_the_floes_that_float(runs):
    run = runs["alone"]
    assert sizes.sizes_at(run, 0)[0].tolist() == pytest.approx([5, numpy.sqrt(2400)])
    size, number, share = sizes.sizes_at(run, 12)
    afloat = (run.floes["died_s"] > 12) & (run.floes["went_under_s"] > 12)
    assert size.tolist() == numpy.sqrt(numpy.sort(run.floes["area_m2"][afloat])).tolist()
    assert (number[0], share[0]) == (len(size), 100) and (numpy.diff(share) < 0).all()
    assert sizes.draw([run]).axes[1].get_ylim() == (0, 100)


def test_energy_keeps_sources_and_sinks_apart_and_loses_none(home):
    run = polynya.Run(home / "alone")
    given = {"initial_J": 5e6, "thrust_J": 0, "imbalance_J": 2e-9, "kinetic_J": 3e6,
             "drag_J": 1e6, "restitution_J": -1e5, "of_tomorrow_J": 1.1e6, "turnover_J": 9e6}
    run.summary = {**run.summary, "energy": given}
    figure = energy.draw([run])
    words = [[label.get_text() for label in axes.get_yticklabels()] for axes in figure.axes]
    assert words == [["motion at the start", "imbalance"],
                     ["motion at the end", "water drag", "collisions", "of tomorrow"]]
    widths = [[patch.get_width() for patch in axes.patches] for axes in figure.axes]
    assert widths == [[5, pytest.approx(2e-15)], [3, 1, pytest.approx(-0.1), pytest.approx(1.1)]]
    assert "Nothing in this run: thrust and holding." in [text.get_text() for text in figure.texts]
    run.summary = {}
    assert energy.draw([run]) is None


def rings_of(axes, colour):
    """Closed rings in areas of that colour; no floe here has a hole."""
    wanted = matplotlib.colors.to_rgb(colour)
    return sum(int((patch.get_path().codes == patch.get_path().MOVETO).sum()) for patch in axes.patches
               if patch.get_facecolor()[:3] == wanted)


def test_a_map_shows_the_floes_of_its_time_and_what_went_under(runs, drawn):
    run = runs["alone"]
    figure = maps.draw([run], at=[0, 8])
    before, after = figure.axes
    frame = run.frame(8)
    floating = [rings for rings, under in zip(frame.rings, frame.is_under) if not under]
    assert sum(rings_of(after, colour) for colour in scenery.COLOURS[:3]) == len(floating)
    assert rings_of(before, scenery.ICE) == 2
    assert rings_of(after, scenery.ICE_UNDER) == numpy.count_nonzero(frame.is_under) > 0
    cusps = numpy.count_nonzero((run.events["kind"] == "bend") & (run.events["t_s"] <= 8))
    went = numpy.count_nonzero((run.events["kind"] == "submerge") & (run.events["t_s"] <= 8))
    assert re.search(rf"{cusps} cusps, 1 split, {len(floating)} floes; {went} pieces? went under the hull",
                     panel_titles(figure)[1]) or cusps == 1
    keys = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "ice under the hull or waiting behind it" in keys and "floe as in the scene" in keys
    legend = drawn("floes", "alone", at=(0,)).legends[0]
    assert "ice under the hull or waiting behind it" not in [text.get_text() for text in legend.get_texts()]


def test_a_window_shows_its_part_of_the_world(runs, drawn):
    whole = drawn("floes", "alone", at=(0,))
    part = maps.draw([runs["alone"]], at=[0], window=(41, -3, 61, 7))
    assert (part.axes[0].get_xlim(), part.axes[0].get_ylim()) == ((41, 61), (-3, 7))
    assert rings_of(whole.axes[0], scenery.ICE) == 2 and rings_of(part.axes[0], scenery.ICE) == 1
    box = part.axes[0].get_window_extent()
    assert box.width / box.height == pytest.approx(2, rel=1e-3), "one scale for both axes"


def test_title_and_labels_are_those_given(runs):
    given = [labelled(runs["alone"], "10 m, $5 and $6"), labelled(runs["another-scene-of-a-long-name"], "20 m")]
    for draw in (maps.draw, loads.draw, energy.draw):
        words = [plain(text) for text, _, _ in words_drawn(draw(given, page.Page(title="A title of mine")))]
        assert "A title of mine" in words and any("10 m, $5 and $6" in text for text in words)
        assert not any("alone" in text or "another" in text for text in words)
    assert 9 not in [size for _, size, _ in words_drawn(energy.draw(given, page.Page(title="")))]


def test_long_words_break_where_they_may(runs):
    with page.Sheet(page.Page()) as sheet:
        lines = sheet.wrapped("a-scene-of-a_long-name and words", 8, 20)
        assert len(lines) > 2 and "".join(lines).replace(" ", "") == "a-scene-of-a_long-nameandwords"
        assert all(sheet.width_of(line, 8) <= 20 for line in lines) and lines[0].endswith(("-", "_"))
        assert "".join(sheet.wrapped("x" * 60, 8, 20)) == "x" * 60


def figures(home, *words):
    return ended("figures", *words, cwd=home)


def test_the_command_writes_every_format_and_the_same_bytes_again(home):
    done = figures(home, "alone", "--out", "one", "--only", "sizes,energy")
    assert (done.returncode, done.stderr) == (0, "")
    names = [f"figure-{name}.{suffix}" for name in ("sizes", "energy") for suffix in ("svg", "png", "pdf")]
    assert done.stdout.split() == [f"one/{name}" for name in names]
    assert sorted(os.listdir(home / "one")) == sorted(names)
    assert started("figures", "alone", "--out", "two", "--only", "energy", cwd=home).returncode == 0
    for name in names:
        data = (home / "one" / name).read_bytes()
        assert data[:4] == {"svg": b"<?xm", "png": b"\x89PNG", "pdf": b"%PDF"}[name[-3:]]
        assert "energy" not in name or data == (home / "two" / name).read_bytes()
    width = re.search(r'width="([\d.]+)pt"', (home / "one/figure-sizes.svg").read_text())
    assert float(width[1]) == pytest.approx(170 / 25.4 * 72, abs=1e-3)


def test_a_run_without_ships_has_the_figures_that_it_can_have(home):
    done = figures(home, "no-ship", "--format", "svg")
    assert done.returncode == 0 and done.stderr.count("there is no ship and no structure, or no time passes; "
                                                      "figure-") == 2
    assert done.stdout.split() == [f"no-ship/figure-{name}.svg" for name in ("floes", "sizes", "energy")]


@pytest.mark.parametrize("words, code, message", [
    (["alone", "--at", "70"], 2, "--at 70: the run goes from 0 to 12 s"),
    (["alone", "--from", "8", "--until", "3"], 2, "--from 8 is not before --until 3"),
    (["alone", "--until", "30"], 2, "--until 30: alone goes from 0 to 12 s"),
    (["alone", "--window", "0,0,0,5"], 2, "x0 must be below x1"),
    (["alone", "--label", "a,b"], 2, "--label: 2 names for 1 runs"),
    (["alone", "--load", "ships"], 2, "--load ships: alone has one ship and no structure"),
    (["alone", "--style", "poster"], 2, '--style: "poster" is not one of: one-column, two-columns, slides'),
    (["nowhere"], 5, "not a run folder: nowhere does not exist"),
    (["alone", "--out", "alone.json"], 5, "alone.json: File exists"),
])
def test_what_is_wrong_is_named(home, words, code, message):
    done = figures(home, *words)
    assert done.returncode == code and message in done.stderr and done.stdout == ""


def test_the_slices_of_a_database_are_drawn_faint_out_of_their_range(tmp_path):
    done = succeeded("database", "show", "--svg", "plots", cwd=tmp_path)
    assert done.stdout.endswith("".join(f"picture         plots/{name}.svg\n"
                                        for name in ("speed", "wedge-angle", "thickness")))
    given = json.loads((tmp_path / "plots/slices.json").read_text())
    drawn = database.draw(given["figures"][0], given["title"], given["caption"])
    for axes, key, unit in zip(drawn.axes, ("vertical_force_N", "cusp_radius_m"), (1e3, 1)):
        for curve, faint, sure in zip(given["figures"][0]["curves"], axes.lines[::2], axes.lines[1::2], strict=True):
            assert faint.get_ydata() * unit == pytest.approx(curve[key]) and faint.get_alpha() < 1
            assert numpy.isfinite(sure.get_ydata()).tolist() == [flag == 1 for flag in curve["is_in_range"]]
    assert len({line.get_color() for line in drawn.axes[0].lines}) == len(given["figures"][0]["curves"]) == 5


def test_an_unfinished_and_a_damaged_run(home, tmp_path):
    folder = pathlib.Path(shutil.copytree(home / "alone", tmp_path / "run"))
    summary = json.loads((folder / "summary.json").read_text())
    (folder / "summary.json").write_text(json.dumps({**summary, "finished": False}))
    (folder / "figure-sizes.svg").symlink_to(tmp_path / "mine")
    (tmp_path / "mine").write_text("mine")
    done = figures(tmp_path, "run", "--only", "sizes", "--format", "svg")
    assert done.returncode == 0 and "run is not finished; the figures end at 12 s" in done.stderr
    assert (tmp_path / "mine").read_text() == "mine", "a link in a run folder is replaced, not followed"
    floes = (folder / "floes.ndjson").read_text()
    for ring in ("[]", "[[0,0]]", "[[0,0],[1,0],[1,1e999]]", '"x"'):
        (folder / "floes.ndjson").write_text(re.sub(r'"ring_m":.*?\]\]', f'"ring_m":{ring}', floes, count=1))
        assert figures(tmp_path, folder, "--only", "floes", "--format", "svg").returncode == 5


def test_text_that_a_full_disk_refuses_does_not_end_in_zero(home):
    with open("/dev/full", "w") as full:
        done = subprocess.run([PROGRAM, "figures", "alone", "--only", "energy"],
                              cwd=home, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 5 and "polynya: stdout: No space left on device" in done.stderr
