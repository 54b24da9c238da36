"""Views of scenes, simulations, runs and studies in a notebook: a map of ice and hulls, with a few lines of text."""
from __future__ import annotations

import base64
import html
import io

import numpy

MOST_FLOES = 100_000  # largest number of floes on a map
MOST_ROWS = 20  # largest number of rows of a study's table


def floes_by_kind(simulation):
    """Floes as one path for each kind, like Scenery.floes() for a run."""
    from . import scenery
    floes = simulation.floes
    rings = numpy.split(floes.world_vertices, floes.ring_offsets[1:-1]) if len(floes) else []
    broken = numpy.where(floes.generations > 0, scenery.BROKEN, scenery.WHOLE)
    kinds = numpy.where(floes.is_under, scenery.UNDER, broken)
    of_ring = numpy.repeat(kinds, numpy.diff(floes.floe_offsets))
    return [scenery.path_of([ring for ring, its in zip(rings, of_ring) if its == kind]) for kind in range(4)]


def hulls_of(simulation):
    """Ships and structures as one path, walls as another."""
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
    """Draws paths from above, in equal scale along both axes."""
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
    Returns the axes."""
    if axes is None:
        from matplotlib import pyplot
        axes = pyplot.figure(figsize=(7, 4.5), layout="constrained").add_subplot()
    axes.set_title(f"{self.scene.name}, {self.time:.6g} s", fontsize="medium")
    return draw(axes, floes_by_kind(self), hulls_of(self))


def image(fill):
    """A PNG of axes that `fill` draws, as an HTML element; none if matplotlib is missing."""
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
    left = "style='text-align:left'"
    cells = "".join(f"<tr><th {left}>{html.escape(name)}</th><td {left}>{html.escape(str(value))}</td></tr>"
                    for name, value in rows if value not in (None, ""))
    return f"<div><b>{html.escape(title)}</b>{picture and '<br>' + picture}<table>{cells}</table></div>"


def html_of_simulation(self):
    picture = image(lambda axes: plot(self, axes)) if len(self.floes) <= MOST_FLOES else ""
    return page(f"{self.scene.name}, {self.time:.6g} s", contents_of(self), picture)


def contents_of(simulation):
    names = ", ".join(ship.name for ship in simulation.ships)
    return [("floes", len(simulation.floes)), ("ships, structures, walls", names)]


def html_of_scene(self):
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
    return f"{value:.5g}" if isinstance(value, float) else str(value)
