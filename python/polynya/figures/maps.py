"""Floes, hulls, tracks, fractures and channels from above, at some times."""
from __future__ import annotations

import dataclasses
import math

import numpy
from matplotlib.collections import PathCollection

from polynya.errors import FolderError

from . import map_legend as legend
from .map_extent import extent_of
from .map_paths import path_of
from .page import Page, Sheet
from .subjects import all_labelled

CROWD = 400  # cusps, from which on their marks are smaller
MOST_VERTICES = 300_000  # drawn as vectors; more become dots


@dataclasses.dataclass
class Scenery:
    """A run at a time: polygons as lists of rings, and what stands above its map."""

    title: str
    caption: str
    time: float
    at_start: list
    as_in_scene: list
    broken: list
    came_up: list
    under: list
    hulls: list
    walls: list
    tracks: list
    channel: list
    marks: dict  #: points of fractures by kind

    def pieces(self):
        """Points of all that sets the extent of a map."""
        rings = [rings[0] for of in (self.at_start, self.as_in_scene, self.broken, self.came_up) for rings in of]
        return [*rings, *self.hulls, *self.walls, *self.tracks]


def chosen_times(runs, wanted, count):
    """One run: as many, evenly, the end among them, and the start where there are more than two. Several: their ends. Of the times drawn, rounded
    to seconds where that changes little."""
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
    """Open water along the track of each ship; none where none can be measured."""
    polygons = []
    for ship in run.scene.get("ships", []):
        try:
            polygons += run.measure_channel(time, ship["name"]).parts.get("open water", [])
        except FolderError:  # a ship that has not moved has no channel
            continue
    return polygons


def counted(count, noun):
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def scenery_of(labelled, time, has_label):
    run = labelled.run
    time = min(max(time, run.start_time), run.end_time)
    frame = run.frame(time)
    rings, births = frame.rings, run.births
    ids = numpy.flatnonzero((births["born_s"] <= time) & (time < births["died_s"]))
    generation, came_up, under = births["generation"][ids], births["came_up"][ids], frame.is_under
    of = lambda mask: [rings[i] for i in numpy.flatnonzero(mask)]
    events = run.event_columns
    is_past = events["t_s"] <= time
    points = numpy.column_stack((events["x_m"], events["y_m"]))
    marks = {kind: points[is_past & (events["kind"] == kind)] for kind in ("bend", "split", "grind")}
    past = [*run.times[run.times < time], time]
    tracks = numpy.array([run.motions.ships_at(t)[:, :2] for t in past]) if len(run.times) else numpy.empty((0, 0, 2))
    walls = run.wall_names
    floats = int(numpy.count_nonzero(~under))
    caption = f"{counted(len(marks['bend']), 'cusp')}, {counted(len(marks['split']), 'split')}, {counted(floats, 'floe')}"
    went, up = (int(numpy.count_nonzero(is_past & (events["kind"] == kind))) for kind in ("submerge", "resurface"))
    if went:
        caption += f"; {counted(went, 'piece')} went under the hull, {up} came up"
    return Scenery(
        title=f"{labelled.label}, {time:.4g} s" if has_label else f"{time:.4g} s",
        caption=caption,
        time=time,
        at_start=run.frame(run.start_time).rings if len(run.times) else [],
        as_in_scene=of(~under & (generation == 0)),
        broken=of(~under & (generation > 0) & ~came_up),
        came_up=of(~under & (generation > 0) & came_up),
        under=of(under),
        hulls=[hull for name, hull in frame.hulls.items() if name not in walls],
        walls=[hull for name, hull in frame.hulls.items() if name in walls],
        tracks=[
            track for name, track in zip(run.ship_names, numpy.swapaxes(tracks, 0, 1)) if name not in walls and numpy.ptp(track, axis=0).max() > 0
        ],
        channel=channels_at(run, time),
        marks=marks,
    )


def add_polygons(axes, polygons, window, **style):
    """Those that reach into the window."""
    low, high = numpy.array(window[:2]), numpy.array(window[2:])
    seen = [rings for rings in polygons if (rings[0].max(axis=0) > low).all() and (rings[0].min(axis=0) < high).all()]
    if seen:
        is_huge = sum(len(ring) for rings in seen for ring in rings) > MOST_VERTICES
        axes.add_collection(PathCollection([path_of(rings) for rings in seen], rasterized=is_huge, **style), autolim=False)


def draw_map(axes, scenery, window, page, points_per_metre):
    """Water, then ice, ships, and marks on top."""
    scale = page.style.scale
    edge = min(0.45, max(0.12, 0.2 * points_per_metre)) * scale
    ice = {"edgecolors": legend.EDGE, "linewidths": edge, "joinstyle": "round"}
    axes.set_facecolor(legend.WATER)
    add_polygons(axes, scenery.at_start, window, facecolors=legend.AT_START, edgecolors="none", zorder=1)
    add_polygons(axes, scenery.channel, window, facecolors=legend.CHANNEL, edgecolors="none", zorder=2)
    add_polygons(axes, scenery.as_in_scene, window, facecolors=legend.ICE, zorder=3, **ice)
    add_polygons(axes, scenery.broken, window, facecolors=legend.BROKEN, zorder=3, **ice)
    size = (1.0 if len(scenery.marks["bend"]) > CROWD else 1.5) * scale
    for kind in ("bend", "grind"):
        axes.plot(*scenery.marks[kind].T, linestyle="none", marker="o", markersize=size, markeredgewidth=0, color=legend.MARKS[kind], zorder=4)
    add_polygons(axes, scenery.came_up, window, facecolors=legend.CAME_UP, zorder=5, **ice)
    for track in scenery.tracks:
        axes.plot(*track.T, color=legend.TRACK, linewidth=0.8 * scale, dashes=(5, 2.5), zorder=6)
    for hulls, colour in ((scenery.walls, legend.WALL), (scenery.hulls, legend.SHIP)):
        add_polygons(axes, [[hull] for hull in hulls], window, facecolors=colour, alpha=0.88, edgecolors="white", linewidths=0.5 * scale, zorder=7)
    under = {"facecolors": legend.UNDER + "40", "edgecolors": legend.UNDER, "linewidths": edge, "linestyles": (0, (3, 2))}
    add_polygons(axes, scenery.under, window, zorder=8, **under)
    triangle = {"marker": "^", "markersize": 3.6 * scale, "markeredgewidth": 0.4 * scale, "markeredgecolor": "white"}
    axes.plot(*scenery.marks["split"].T, linestyle="none", color=legend.MARKS["split"], zorder=9, **triangle)


def draw(runs, page=Page(), at=(), window=None):
    """A map of each run at each time of `at` [s] (chosen_times), all of one scale; of x0, y0, x1, y1 [m] where a window is given."""
    runs = all_labelled(runs)
    times = chosen_times(runs, at, page.style.maps)
    is_alone = len(runs) == 1
    sceneries = [scenery_of(run, min(time, run.end), not is_alone) for run in runs for time in times]
    x0, y0, x1, y1 = window or extent_of([piece for scenery in sceneries for piece in scenery.pieces()])
    title = runs[0].label if is_alone else "Floes and channels"
    if len(sceneries) == 1:
        title, sceneries[0].title = f"{runs[0].label}, {sceneries[0].title.split(', ')[-1]}", ""
    scale = page.style.scale
    with Sheet(page, title, "Fractures are marked where they happened; the ice has moved since.") as sheet:
        columns, width, height = layout(page, len(sceneries), (x1 - x0), (y1 - y0))
        rows = -(-len(sceneries) // columns)
        sheet.figure.set_layout_engine("compressed")
        grid = sheet.panels(rows, columns, sharex=True, sharey=True)
        for axes in grid.flat[len(sceneries) :]:
            axes.remove()
        most_lines = 1
        for i, (axes, scenery) in enumerate(zip(grid.flat, sceneries)):
            draw_map(axes, scenery, (x0, y0, x1, y1), page, width / (x1 - x0) * 72 / 25.4)
            axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
            axes.spines[:].set_visible(True)
            axes.locator_params(nbins=max(2, int(width / (16 * scale))), axis="x")
            axes.locator_params(nbins=max(2, int(height / (7 * scale))), axis="y")
            sheet.title_panel(axes, i, len(sceneries), f"{scenery.title}\n{scenery.caption}".strip(), width)
            most_lines = max(most_lines, axes.get_title(loc="left").count("\n") + 1)
            is_lowest = i + columns >= len(sceneries)
            axes.tick_params(labelleft=i % columns == 0, labelbottom=is_lowest)
            axes.set_xlabel("x, m" if is_lowest else "")
            axes.set_ylabel("y, m" if i % columns == 0 else "")
        above = (1.35 * page.style.text * most_lines + 4 * scale) * 25.4 / 72
        room = rows * (height + above + 2 * scale) + 9 * scale
        return sheet.finish(room, legend.entries(sceneries, scale), is_snug=True)


def layout(page, count, across, along):
    """Columns, and the width and height of a map [mm]: the columns on which maps are largest, if the page is tall enough."""
    scale = page.style.scale
    best = (1, 0.0, 0.0)
    for columns in range(1, min(count, max(1, int(page.width / (38 * scale)))) + 1):
        rows = -(-count // columns)
        width = (page.width - 13 * scale - (columns - 1) * 3 * scale) / columns
        tallest = max(20 * scale, (page.style.tallest - 32 * scale) / rows - 11 * scale)
        width = min(width, tallest * across / along)
        if count > 1 and columns == 1 and along < 0.25 * across and page.width / 2 > 70 * scale and width > page.width / 2:
            best = (columns, width, width * along / across)  # long maps stand below each other
            break
        if width > 1.02 * best[1] or (columns <= max(1, round(page.width / (85 * scale))) and width > 0.45 * best[1]):
            best = (columns, width, width * along / across)
    return best
