"""Maps of floes, hulls, tracks, fractures and channels at some times."""
from __future__ import annotations

import dataclasses
import math

import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch

from polynya import scenery as colours
from polynya.errors import FolderError
from polynya.scenery import BROKEN, CAME_UP, FRACTURES, LEAST_PIXELS, UNDER, WHOLE, Scenery, counted, extent_of, path_of

from .page import Page, Sheet
from .subjects import all_labelled

# Number of cusps in a map above which all marks of cusps and of ground ice are smaller (1 pt instead of 1.5 pt), so
# that dense ones do not hide the ice. Larger: marks merge in some maps; smaller: they are hard to see in maps with few.
CROWD = 400
# Largest number of vertices of a map that are drawn as vectors. With more, the ice is a picture of pixels within the
# SVG or PDF, and the smallest floes are squares; otherwise files would be large and slow to show. Larger: larger and
# slower files; smaller: more maps whose ice cannot be enlarged sharply.
MOST_VERTICES = 300_000


@dataclasses.dataclass
class Map:
    """A run at one time, and the title of its map."""

    title: str  #: time, and in figures of several runs the run's name before it
    caption: str  #: line below the title with the numbers of fractures and floes
    scenery: Scenery  #: shapes of the run's floes, hulls and tracks, ready to draw
    frame: object  #: frame of the run
    channel: list  #: polygons of the channel, each a list of rings [m]; empty if there is none
    marks: dict  #: kind ("bend", "split", "grind") -> positions of the fractures until that time, n × 2 [m]


def chosen_times(runs, wanted, count):
    """Times of the maps [s]. These are `wanted`, if it has some. Otherwise, for one run (Labelled): `count` times, but
    at least two, evenly spaced, including the end and, for more than two, the start; those between are whole seconds if
    the run is longer than 30 s. Equal times are given once, so a run without a duration has one. For several runs:
    infinity, which stands for the end of each."""
    if wanted:
        return list(wanted)
    if len(runs) > 1:
        return [math.inf]
    start, end = runs[0].start, runs[0].end
    parts = max(2, count - 1)
    between = [start + (end - start) * part / parts for part in range(1, parts)]
    times = [*([start] if count > 2 else []), *(round(t) if end - start > 30 else t for t in between), end]
    return list(dict.fromkeys(times))


def channels_at(run, time):
    """Polygons of the channels behind the ships at a time [s], as `polynya channel` measures them, each a list of
    rings. Ships whose channel cannot be measured are left out."""
    polygons = []
    for ship in run.scene.get("ships", []):
        try:
            polygons += run.measure_channel(time, ship["name"]).parts.get("channel", [])
        except FolderError:  # a ship that has not moved has no channel
            continue
    return polygons


def map_of(labelled, scenery, time, has_label):
    """Returns the Map of a run, given as Labelled with its Scenery, at a time [s]. A time before or after the run is
    replaced by its start or end. `has_label` adds the run's name to its title."""
    run = labelled.run
    frame = run.frame(min(max(time, run.start_time), run.end_time))
    marks = {kind: scenery.fractures(kind, -math.inf, frame.time)[0] for kind in FRACTURES}
    floats = int(numpy.count_nonzero(~frame.is_under))
    numbers = ((len(marks["bend"]), "cusp"), (len(marks["split"]), "split"), (floats, "floe"))
    caption = ", ".join(counted(*number) for number in numbers)
    events = run.event_columns
    went, up = (int(numpy.count_nonzero((events["t_s"] <= frame.time) & (events["kind"] == kind)))
                for kind in ("submerge", "resurface"))
    if went:
        caption += f"; {counted(went, 'piece')} went under the hull, {up} came up"
    title = f"{labelled.label}, {frame.time:.4g} s" if has_label else f"{frame.time:.4g} s"
    return Map(title, caption, scenery, frame, channels_at(run, frame.time), marks)


def add_path(axes, path, **style):
    """Adds a path without including it in the limits and the layout, which would visit each of its points."""
    if len(path.vertices):
        axes.add_artist(PathPatch(path, joinstyle="round", **style)).set_in_layout(False)


def draw_map(axes, shown, window, page, points_per_metre):
    """Draws a Map in `axes`: water, then ice, ships, and marks on top. `window` is the part of the world that is shown,
    x0, y0, x1, y1 [m]. `points_per_metre` is the scale of the map on paper [pt/m], from which the width of edges and
    the size of the smallest drawn floe follow."""
    scale, scenery, frame = page.style.scale, shown.scenery, shown.frame
    seen = frame.ids[scenery.seen(frame, window)]
    is_huge = scenery.outlines.count(seen) > MOST_VERTICES
    least = LEAST_PIXELS * 72 / (points_per_metre * page.style.dots) if is_huge else 0.0
    edge = min(0.45, max(0.12, 0.2 * points_per_metre)) * scale
    ice = {"edgecolor": colours.EDGE, "linewidth": edge, "rasterized": is_huge}
    axes.set_facecolor(colours.WATER)
    add_path(axes, scenery.ice_at_start(window, least), facecolor=colours.AT_START,
             edgecolor="none", zorder=1, rasterized=is_huge)
    add_path(axes, path_of([ring for rings in shown.channel for ring in rings]),
             facecolor=colours.CHANNEL, edgecolor="none", zorder=2)
    paths = scenery.floes(frame, window, least)
    for kind, order in ((WHOLE, 3), (BROKEN, 3), (CAME_UP, 5)):
        add_path(axes, paths[kind], facecolor=colours.COLOURS[kind], zorder=order, **ice)
    size = (1.0 if len(shown.marks["bend"]) > CROWD else 1.5) * scale
    for kind in ("bend", "grind"):
        axes.plot(*shown.marks[kind].T, linestyle="none", marker="o", markersize=size,
                  markeredgewidth=0, color=colours.MARKS[kind], zorder=4)
    for track in scenery.tracks(frame.time):
        axes.plot(*track.T, color=colours.TRACK, linewidth=0.8 * scale, dashes=(5, 2.5), zorder=6)
    for hulls, colour in zip(scenery.hulls(frame), (colours.SHIP, colours.WALL)):
        add_path(axes, hulls, facecolor=colour, alpha=0.88, edgecolor="white", linewidth=0.5 * scale, zorder=7)
    under = {"facecolor": colours.ICE_UNDER + "40", "edgecolor": colours.ICE_UNDER,
             "linewidth": edge, "linestyle": (0, (3, 2))}
    add_path(axes, paths[UNDER], zorder=8, **under)
    triangle = {"marker": "^", "markersize": 3.6 * scale, "markeredgewidth": 0.4 * scale, "markeredgecolor": "white"}
    axes.plot(*shown.marks["split"].T, linestyle="none", color=colours.MARKS["split"], zorder=9, **triangle)


def legend_of(maps, scale):
    """Legend entries of matplotlib, only for what at least one of the maps shows, in the order of the list. Water is
    always there. `scale` is that of the page's style, for lines and marks."""
    kinds = {int(kind) for shown in maps for kind in shown.scenery.kinds(shown.frame)}
    has = lambda of: any(len(of(shown)) for shown in maps)
    area = lambda colour, words, edge=colours.EDGE: Patch(facecolor=colour, edgecolor=edge,
                                                          linewidth=0.4 * scale, label=words)
    dot = lambda kind, words: Line2D([], [], color=colours.MARKS[kind], linestyle="none",
                                     marker="o", markersize=2.5 * scale, markeredgewidth=0, label=words)
    under = {"facecolor": colours.ICE_UNDER + "40", "edgecolor": colours.ICE_UNDER,
             "linewidth": 0.8 * scale, "linestyle": (0, (3, 2))}
    split = {"marker": "^", "markersize": 4 * scale, "markeredgewidth": 0}
    keys = [
        (WHOLE in kinds, area(colours.ICE, "floe as in the scene")),
        (BROKEN in kinds, area(colours.BROKEN_ICE, "piece of a broken floe")),
        (CAME_UP in kinds, area(colours.RESURFACED_ICE, "piece that came up from under the hull")),
        (True, area(colours.WATER, "water", colours.WATER)),
        (has(lambda s: s.scenery.ice_at_start().vertices),
         area(colours.AT_START, "ice at the start, open now", colours.AT_START)),
        (has(lambda s: s.channel), area(colours.CHANNEL, "channel behind the ship", colours.CHANNEL)),
        (has(lambda s: s.scenery.hulls(s.frame)[0].vertices), area(colours.SHIP, "ship or structure", colours.SHIP)),
        (has(lambda s: s.scenery.hulls(s.frame)[1].vertices), area(colours.WALL, "wall", colours.WALL)),
        (UNDER in kinds, Patch(label="ice under the hull or waiting behind it", **under)),
        (has(lambda s: s.scenery.tracks(s.frame.time)), Line2D([], [], color=colours.TRACK,
                                                               linewidth=0.8 * scale, dashes=(5, 2.5), label="track")),
        (has(lambda s: s.marks["bend"]), dot("bend", "cusp broken by bending")),
        (has(lambda s: s.marks["grind"]), dot("grind", "overlap ground to brash")),
        (has(lambda s: s.marks["split"]), Line2D([], [], color=colours.MARKS["split"],
                                                 linestyle="none", label="floe split", **split)),
    ]
    return [handle for is_there, handle in keys if is_there]


def draw(runs, page=Page(), at=(), window=None):
    """Draws a map of each run at each time of `at` [s], all of the same part of the world and in one scale, and returns
    the matplotlib figure. Without `at`, chosen_times() chooses. `window` is the part of the world to show, x0, y0, x1,
    y1 [m]; without it, all that the maps and the starts of the runs contain is shown. Times outside of a run are
    replaced by its start or end. `runs`, at least one, are runs or Labelled ones. The title is that of the first run if
    it is the only one, and a single map has its time there too. Raises FolderError if a file of a run is damaged."""
    runs = all_labelled(runs)
    times = chosen_times(runs, at, page.style.maps)
    is_alone = len(runs) == 1
    sceneries = [Scenery(run.run) for run in runs]
    maps = [map_of(run, scenery, min(time, run.end), not is_alone)
            for run, scenery in zip(runs, sceneries) for time in times]
    start = [scenery.run.frame(scenery.run.start_time) for scenery in sceneries]
    drawn = [*zip(sceneries, start), *((shown.scenery, shown.frame) for shown in maps)]
    x0, y0, x1, y1 = window or extent_of([points for scenery, frame in drawn for points in scenery.points(frame)])
    title = runs[0].label if is_alone else "Floes and channels"
    if len(maps) == 1:
        title, maps[0].title = f"{runs[0].label}, {maps[0].title.split(', ')[-1]}", ""
    scale = page.style.scale
    with Sheet(page, title, "Fractures are marked where they happened; the ice has moved since.") as sheet:
        columns, width, height = layout(page, len(maps), (x1 - x0), (y1 - y0))
        rows = -(-len(maps) // columns)
        sheet.figure.set_layout_engine("compressed")
        grid = sheet.panels(rows, columns, sharex=True, sharey=True)
        for axes in grid.flat[len(maps) :]:
            axes.remove()
        most_lines = 1
        for i, (axes, shown) in enumerate(zip(grid.flat, maps)):
            draw_map(axes, shown, (x0, y0, x1, y1), page, width / (x1 - x0) * 72 / 25.4)
            axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
            axes.spines[:].set_visible(True)
            axes.locator_params(nbins=max(2, int(width / (16 * scale))), axis="x")
            axes.locator_params(nbins=max(2, int(height / (7 * scale))), axis="y")
            sheet.title_panel(axes, i, len(maps), f"{shown.title}\n{shown.caption}".strip(), width)
            most_lines = max(most_lines, axes.get_title(loc="left").count("\n") + 1)
            is_lowest = i + columns >= len(maps)
            axes.tick_params(labelleft=i % columns == 0, labelbottom=is_lowest)
            axes.set_xlabel("x, m" if is_lowest else "")
            axes.set_ylabel("y, m" if i % columns == 0 else "")
        above = (1.35 * page.style.text * most_lines + 4 * scale) * 25.4 / 72
        room = rows * (height + above + 2 * scale) + 9 * scale
        return sheet.finish(room, legend_of(maps, scale), is_snug=True)


# The numbers in millimetres are the room for labels, gaps, heading and legend. A column has at least 38 mm of the
# page's width. A map that would be too tall for the page is narrower than its column.
def layout(page, count, across, along):
    """Returns the number of columns, and width and height of a map [mm], for `count` maps of a region that is `across`
    wide and `along` high [m]. More columns are chosen if they make the maps more than 2 % wider. Up to one column
    per 85 mm of the page is also chosen if the maps keep more than 45 % of their width. Long flat maps stay below each
    other."""
    scale = page.style.scale
    best = (1, 0.0, 0.0)
    for columns in range(1, min(count, max(1, int(page.width / (38 * scale)))) + 1):
        rows = -(-count // columns)
        width = (page.width - 13 * scale - (columns - 1) * 3 * scale) / columns
        tallest = max(20 * scale, (page.style.tallest - 32 * scale) / rows - 11 * scale)
        width = min(width, tallest * across / along)
        is_flat = along < 0.25 * across and page.width / 2 > 70 * scale
        if count > 1 and columns == 1 and is_flat and width > page.width / 2:
            best = (columns, width, width * along / across)  # long maps are placed below each other
            break
        if width > 1.02 * best[1] or (columns <= max(1, round(page.width / (85 * scale))) and width > 0.45 * best[1]):
            best = (columns, width, width * along / across)
    return best
