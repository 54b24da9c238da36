"""What a notebook shows for a scene, a simulation, a run or a study: a map of ice and hulls with a few lines of text,
or the first rows of a study's table. Simulation.plot, which polynya/__init__.py adds to the class, is also here.

The functions html_of_… are the classes' `_repr_html_`."""
from __future__ import annotations

import base64
import html
import io

import numpy

# Largest number of floes for which a scene or a simulation is shown with a map; runs have one up to three times as many
# floes, with those that broke. Above it a notebook shows only the text, because drawing would take too long. With a
# larger value a cell with such a scene takes longer.
MOST_FLOES = 100_000
# Number of rows of a study's table that are shown. More rows make the cell of a notebook higher; the text below states
# how many are left out.
MOST_ROWS = 20


def floes_by_kind(simulation):
    """Floes of a simulation at the present time as one path for each kind in the world [m], in the order of
    Scenery.floes(): whole, broken, came up, under a hull. A kind without floes has an empty path. The path of floes
    that came up from under a hull is empty: they are with the broken ones, because Simulation.floes does not tell them
    apart."""
    from . import scenery
    floes = simulation.floes
    rings = numpy.split(floes.world_vertices, floes.ring_offsets[1:-1]) if len(floes) else []
    broken = numpy.where(floes.generations > 0, scenery.BROKEN, scenery.WHOLE)
    kinds = numpy.where(floes.is_under, scenery.UNDER, broken)
    of_ring = numpy.repeat(kinds, numpy.diff(floes.floe_offsets))
    return [scenery.path_of([ring for ring, its in zip(rings, of_ring) if its == kind]) for kind in range(4)]


def hulls_of(simulation):
    """Outlines of a simulation's ships and structures at the present time as one path, and of its walls as another, in
    the world [m]. Without such bodies a path is empty."""
    from .results.hulls import waterline
    from .scenery import path_of, turned
    scene = simulation.scene.resolved
    hulls, walls = [], []
    for kind, rings in (("ships", hulls), ("structures", hulls), ("walls", walls)):
        for body in scene.get(kind, []):
            now, outline = simulation.ships[body["name"]], waterline(body)
            rings.append(turned(outline, numpy.tile([*now.position, now.heading], (len(outline), 1))))
    return path_of(hulls), path_of(walls)


def draw(axes, floes, hulls, tracks=()):
    """Draws paths in the world [m] from above, in equal scale along both axes, which it fits to them. `floes` has a
    path for each kind of floe, `hulls` those of ships and of walls, `tracks` arrays of n × 2 [m]. Ice under hulls is
    drawn over them, half transparent. Returns the axes."""
    from matplotlib.patches import PathPatch

    from . import scenery
    style = lambda colour, edge, width: {"facecolor": colour, "edgecolor": edge, "linewidth": width}
    shown = [(path, style(colour, scenery.EDGE, 0.3)) for path, colour in zip(floes, scenery.COLOURS)]
    shown += [(path, style(colour, "white", 0.4)) for path, colour in zip(hulls, (scenery.SHIP, scenery.WALL))]
    axes.set_facecolor(scenery.WATER)
    for order, (path, its) in enumerate(shown):
        is_under = order == scenery.UNDER  # ice under hulls is drawn over them
        alpha = 0.5 if is_under else 0.9 if order > scenery.UNDER else None
        if len(path.vertices):
            axes.add_artist(PathPatch(path, zorder=2 + order + 2 * is_under, alpha=alpha, **its))
    for track in tracks:
        axes.plot(*track.T, color=scenery.TRACK, linewidth=0.8, zorder=9)
    x0, y0, x1, y1 = scenery.extent_of([path.vertices for path, _ in shown] + list(tracks))
    axes.set(aspect="equal", xlim=(x0, x1), ylim=(y0, y1), xlabel="x [m]", ylabel="y [m]")
    return axes


def plot(self, axes=None):
    """plot(axes=None)

    Draws ice and hulls at the present time from above, with matplotlib, into these axes or into those of a new figure.
    Returns the axes. Coordinates are in the world [m]. Raises ImportError if matplotlib is missing. All floes are
    drawn, however many there are."""
    if axes is None:
        from matplotlib import pyplot
        axes = pyplot.figure(figsize=(7, 4.5), layout="constrained").add_subplot()
    axes.set_title(f"{self.scene.name}, {self.time:.6g} s", fontsize="medium")
    return draw(axes, floes_by_kind(self), hulls_of(self))


def image(fill):
    """An HTML element with a PNG of axes, which the function `fill(axes)` draws; "" if matplotlib is missing. Errors of
    `fill` are raised again."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    figure = Figure(figsize=(7, 4.5), layout="constrained", dpi=110)
    fill(figure.add_subplot())
    png = io.BytesIO()
    figure.savefig(png, format="png", bbox_inches="tight")
    return f'<img alt="map" src="data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}">'


def page(title, rows, picture=""):
    """HTML with a title, a picture, and a table of the rows (name, value), without those whose value is None or "". All
    texts are escaped, except `picture`, which is HTML."""
    left = "style='text-align:left'"
    cells = "".join(f"<tr><th {left}>{html.escape(name)}</th><td {left}>{html.escape(str(value))}</td></tr>"
                    for name, value in rows if value not in (None, ""))
    return f"<div><b>{html.escape(title)}</b>{picture and '<br>' + picture}<table>{cells}</table></div>"


def html_of_simulation(self):
    """The simulation at the present time, with the map unless it has more than MOST_FLOES floes."""
    picture = image(lambda axes: plot(self, axes)) if len(self.floes) <= MOST_FLOES else ""
    return page(f"{self.scene.name}, {self.time:.6g} s", contents_of(self), picture)


def contents_of(simulation):
    """Rows (name, value) with the present number of floes and the names of the bodies."""
    names = ", ".join(ship.name for ship in simulation.ships)
    return [("floes", len(simulation.floes)), ("ships, structures, walls", names)]


def html_of_scene(self):
    """The scene at its start, with its warnings and hints; for a wrong scene only its problems, errors or not. It makes
    a simulation for the map, which takes time in a scene with many floes."""
    from . import Simulation
    problems = [("", problem) for problem in self.validate()]
    if any(problem.severity == "error" for _, problem in problems):
        return page("a scene that is wrong", problems)
    simulation = Simulation(self)
    until = f"{self.resolved['time']['until_s']:g} s"
    rows = [("until", until), *contents_of(simulation), ("hash", self.hash), *problems]
    picture = image(lambda axes: plot(simulation, axes)) if len(simulation.floes) <= MOST_FLOES else ""
    return page(f"{self.name}, at the start", rows, picture)


def html_of_run(self):
    """The run at its end, with tracks, numbers of fractures, largest surge forces of the ice by ship, those that are
    not 0, and warnings. Numbers that summary.json lacks are shown as None, because also an unfinished run has a
    page."""
    def fill(axes):
        from .scenery import Scenery
        scenery, frame = Scenery(self), self.frame(self.end_time)
        draw(axes, scenery.floes(frame), scenery.hulls(frame), scenery.tracks(frame.time))
        axes.set_title(f"{self.end_time:.6g} s", fontsize="medium")

    counts = self.summary.get("counts", {})
    peaks = {peak["ship"]: peak.get("surge_N", {}).get("value", 0) for peak in self.summary.get("peaks", [])}
    state = "finished" if self.is_finished else f"stopped by {self.summary.get('stopped_by', '?')}"
    forces = ", ".join(f"{name} {1e-3 * value:.4g} kN" for name, value in peaks.items() if value)
    rows = [("folder", self.folder), ("state", state), ("simulated", f"{self.end_time:.6g} s"),
            ("floes", f"{counts.get('floes_initial')} → {counts.get('floes_final')}"),
            ("fractures", f"{counts.get('bends')} cusps by bending, {counts.get('splits')} splits"),
            ("largest surge force of the ice", forces),
            *(("note", warning) for warning in self.summary.get("warnings", []))]
    return page(self.name, rows, image(fill) if len(self.births["floe_id"]) <= 3 * MOST_FLOES else "")


def html_of_study(self):
    """The first MOST_ROWS cases of a study: the number of the case, the parameters and the first six measures, because
    more columns would not fit. Reads the table once."""
    table = self.table
    names = list(table.columns if hasattr(table, "columns") else table.dtype.names)
    columns = [names[0], *self.parameters, *[name for name in self.measures if name in names][:6]]
    head = "".join(f"<th>{html.escape(name)}</th>" for name in columns)
    shown = min(len(table), MOST_ROWS)
    values = [[value_of(list(table[name])[row]) for name in columns] for row in range(shown)]
    body = "".join("<tr>" + "".join(f"<td>{html.escape(value)}</td>" for value in row) + "</tr>" for row in values)
    left = f"<p>{len(table) - shown} more cases, {len(names)} columns in all: .table</p>"
    title = f"<b>{html.escape(self.name)}</b>: {self.summary['finished']} of {self.summary['cases']} cases"
    return f"<div>{title}<table><tr>{head}</tr>{body}</table>{left}</div>"


def value_of(value):
    """A cell of the table as text, floats with five significant digits (NaN as nan)."""
    return f"{value:.5g}" if isinstance(value, float) else str(value)
