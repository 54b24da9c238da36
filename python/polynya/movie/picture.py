"""Pictures of a film: a map of the ice and the hulls, below it a key, and below that the force of the ice on the ship.

Most time goes into drawing floes. So parts that do not change are drawn once, and on a map that stays in place also the
floes that do not move visibly for a while."""
from __future__ import annotations

import dataclasses
from typing import Optional

import matplotlib
import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch

from polynya import scenery as colours
from polynya.scenery import LEAST_PIXELS, NOTHING, Scenery

from .history import History

# (word in the key, colour) of the kinds of floes, in the order of scenery.COLOURS.
FLOES = tuple(zip(("ice", "broken off", "come up from under a hull", "under a hull"), colours.COLOURS))
# (kind of event, word in the key, marker) of the fractures that are marked.
FRACTURES = (("bend", "cusp bends off", "o"), ("split", "floe splits", "^"), ("grind", "ice grinds", "s"))
# Heights of title, key and force chart in fractions of a picture. The map has the rest, so it becomes lower if they are
# larger; title and key must have room for one line of text (POINTS_PER_HEIGHT).
HEAD, KEY, CHART = 0.07, 0.055, 0.25
# Length of the shorter side of a map that follows a ship, in lengths of the ship. Larger values show more of the
# surroundings, and the ship smaller.
FOLLOWED = 2.0
# Time for which a picture of the resting floes is used [s of the film]. With a longer time this picture is drawn less
# often, but fewer floes rest that long, so that more are drawn in each picture.
RESTING = 1.0
# Largest displacement during that time of a floe that counts as resting [px]. It is also the largest error of its place
# in the film. Larger values draw faster, and resting floes jump visibly.
AT_REST = 0.1
# Time for which the mark of a fracture is shown, while it fades [s of the film]. With a longer one many marks hide the
# ice; with a much shorter one they flash by unseen.
SHOWN = 0.8
# Font size per inch of the picture's height [pt]: 0.0195 of the height. With a larger one, the key may become wider
# than the picture.
POINTS_PER_HEIGHT = 0.0195 * 72


@dataclasses.dataclass(frozen=True)
class Look:
    """Settings of a film."""

    size: tuple = (1280, 720)  #: width and height [px]
    follow: Optional[str] = None  #: ship that the map follows; None: the map shows the whole run
    start: Optional[float] = None  #: start of the force's time axis [s]; None: that of the run
    end: Optional[float] = None  #: end of the force's time axis [s]; None: that of the run
    speed: float = 1.0  #: simulated seconds per second of the film
    is_film: bool = True  #: false: a single picture, which states no speed

    @property
    def dots(self):
        """Dots per inch, which relate font sizes and line widths [pt] to pixels. Texts have the same size in pixels
        with any value; other lines would become thicker with a larger one."""
        return 100


def bar_length(room):
    """Length of the scale bar [m]: the longest of 1, 2, 5 · 10ⁿ metres that is at most `room` [m], which is > 0."""
    power = 10.0 ** numpy.floor(numpy.log10(room))
    return float(max(step * power for step in (1, 2, 5) if step * power <= room))


class Picture:
    """Draws a run (results.run.Run) at one time after another with the settings of a Look. Times may go back, but are
    drawn fastest in order. A map that follows a ship has it in its middle, and is drawn anew at each time, which is
    slower. Raises ValueError if there is no ship, structure or wall to follow with that name."""

    def __init__(self, run, look):
        self.run, self.look = run, look
        self.scenery = Scenery(run)
        if look.follow is not None and look.follow not in run.ship_names:
            raise ValueError(f"there is no ship {look.follow!r}: the run has {', '.join(run.ship_names) or 'none'}")
        self._font = POINTS_PER_HEIGHT * look.size[1] / look.dots
        with matplotlib.rc_context({"font.family": "DejaVu Sans", "font.size": self._font,
                                    "axes.linewidth": 0.05 * self._font}):
            self._lay_out()

    def _lay_out(self):
        """Makes the figure with everything in it, and stores the picture of what does not change. The chart shows the
        ship that the map follows, otherwise the first one. There is none if the run has no ship or no row of
        forces.csv."""
        width, height = self.look.size
        self.figure = Figure(figsize=(width / self.look.dots, height / self.look.dots), dpi=self.look.dots)
        self.canvas = FigureCanvasAgg(self.figure)
        ship = self.look.follow or (self.run.ship_names or [None])[0]
        chart = CHART if ship is not None and len(self.run.force_columns["t_s"]) else 0.0
        self._map = self.figure.add_axes((0, chart + KEY, 1, 1 - HEAD - KEY - chart), facecolor=colours.WATER)
        self._map.set(xticks=(), yticks=())
        for side in self._map.spines.values():
            side.set_visible(False)
        self._set_window()
        self._artists = [*self._make_ice(), *self._make_marks()]
        self._clock = self.figure.text(1 - 0.015, 1 - HEAD / 2, "", ha="right", va="center", animated=True)
        self._head()
        self._draw_key(chart)
        self.history = History(self.run, ship, self.look, self.figure, (0, 0, 1, chart), self._font) if chart else None
        self.canvas.draw()
        self._background = self.canvas.copy_from_bbox(self.figure.bbox)
        self._resting = None
        if self.history:
            self.history.prepare(self.canvas)

    def _head(self):
        """Writes the name of the run, smaller if it would reach the clock."""
        name = self.figure.text(0.015, 1 - HEAD / 2, self.run.name, ha="left", va="center",
                                fontweight="bold", fontsize=1.1 * self._font)
        room = 0.62 * self.look.size[0]
        taken = name.get_window_extent().width
        if taken > room:
            name.set_fontsize(1.1 * self._font * room / taken)

    def _set_window(self):
        """Sets the scale of the map `_metre` [px per m], and half of its width and height `_half` [m]. A map that
        follows no ship shows the whole run, centred, and stays there."""
        box = self._map.get_window_extent()
        if self.look.follow is None:
            x0, y0, x1, y1 = self.scenery.extent
            scale = min(box.width / (x1 - x0), box.height / (y1 - y0))
            self._middle = numpy.array([(x0 + x1) / 2, (y0 + y1) / 2])
        else:
            length = numpy.ptp(self.run.waterlines[self.look.follow], axis=0).max()
            scale = min(box.width, box.height) / (FOLLOWED * length)
        self._half = numpy.array([box.width, box.height]) / scale / 2
        self._metre = scale  # length of a metre on the map [px]
        if self.look.follow is None:
            self._move_to(self._middle)

    def _move_to(self, middle):
        """Moves the map so that its middle is at a position in the world [m]."""
        (x0, y0), (x1, y1) = middle - self._half, middle + self._half
        self._window = (x0, y0, x1, y1)
        self._map.set_xlim(x0, x1)
        self._map.set_ylim(y0, y1)

    def _patch(self, **style):
        """Adds an empty patch with this style to the map and returns it. Each picture sets its path."""
        patch = PathPatch(NOTHING, animated=True, joinstyle="round", **style)
        self._map.add_patch(patch)
        return patch

    def _make_ice(self):
        """Makes the patches of ice, hulls, walls and tracks. Returns those of each picture in the order of drawing: ice
        under hulls is drawn last, over the hulls. The ice at the start is not among them, because it is part of the
        stored picture. Edges are thinner on a map of a smaller scale, so that small floes are not only edges."""
        edge = float(numpy.clip(0.12 * self._metre, 0.06, 1.0)) * self.look.size[1] / 720
        self._at_start = self._patch(facecolor=colours.AT_START, linewidth=0)
        self._floes = [self._patch(facecolor=colour, edgecolor=colours.EDGE, linewidth=edge) for _, colour in FLOES[:3]]
        self._hulls = self._patch(facecolor=colours.SHIP, edgecolor="#ffffff", linewidth=1.2 * edge, alpha=0.88)
        self._walls = self._patch(facecolor=colours.WALL, edgecolor="#ffffff", linewidth=1.2 * edge)
        self._under = self._patch(facecolor=FLOES[3][1], edgecolor="#ffffff", linewidth=edge,
                                  linestyle="--", alpha=0.45)
        self._tracks = LineCollection([], colors=colours.TRACK, linewidths=1.4 * self.look.size[1] / 720,
                                      linestyles="--", animated=True)
        self._map.add_collection(self._tracks)
        self._least = LEAST_PIXELS / self._metre
        return [*self._floes, self._tracks, self._walls, self._hulls, self._under]

    def _make_marks(self):
        """Makes the marks of fractures by kind, and returns them."""
        size = 0.9 * self._font**2
        self._marks = {
            kind: self._map.scatter([], [], s=size * (0.5 if kind == "bend" else 1),
                                    marker=marker, c=colours.MARKS[kind], edgecolors="#ffffff",
                                    linewidths=0.05 * self._font, animated=True)
            for kind, _, marker in FRACTURES
        }
        return list(self._marks.values())

    def _draw_key(self, chart):
        """Draws the scale bar and the meaning of colours and marks in one line, which is at the height `chart`
        (fraction of the picture). The bar takes at most a fifth of the picture's width."""
        axes = self.figure.add_axes((0, chart, 1, KEY))
        axes.set(xlim=(0, self.look.size[0]), ylim=(-1, 1))
        axes.set_axis_off()
        small = 0.85 * self._font
        bar = bar_length(0.2 * self.look.size[0] / self._metre)
        x, gap = 0.015 * self.look.size[0], 0.02 * self.look.size[0]
        axes.plot([x, x + bar * self._metre], [0, 0], color="#000000", linewidth=0.18 * self._font,
                  solid_capstyle="butt")
        x += bar * self._metre + gap / 2
        x = self._word(axes, x, f"{bar:g} m" if bar < 1000 else f"{bar / 1000:g} km", small) + gap
        for word, handle in self._keys():
            axes.add_line(Line2D([x + 0.3 * gap], [0], linestyle="", markersize=0.75 * small, **handle))
            x = self._word(axes, x + 0.8 * gap, word, small) + gap

    def _word(self, axes, x, word, size):
        """Writes a word of the key at x [px] in a font size [pt]. Returns the x at which it ends."""
        text = axes.text(x, 0, word, fontsize=size, va="center_baseline")
        return x + text.get_window_extent().width

    def _keys(self):
        """Yields (word, style of the mark) for the kinds of floes and fractures that occur in the run at any time."""
        births, kinds = self.run.births, set(self.run.event_columns["kind"])
        has = (True, bool((births["generation"] > 0).any()), bool(births["came_up"].any()),
               bool(numpy.isfinite(births["went_under_s"]).any()))
        for (word, colour), is_there in zip(FLOES, has):
            if is_there:
                yield word, {"marker": "s", "color": colour, "markeredgecolor": colours.EDGE,
                             "markeredgewidth": 0.06 * self._font}
        for kind, word, marker in FRACTURES:
            if kind in kinds:
                yield word, {"marker": marker, "color": colours.MARKS[kind], "markeredgewidth": 0}

    def draw(self, time):
        """Returns the picture at a simulated time [s]: rows × columns × 4 bytes (RGBA), the top row first. The next
        call overwrites it, so copy what you keep."""
        frame = self.run.frame(time)
        if self.look.follow is not None:
            names = self.run.ship_names
            self._move_to(frame.ship_motions[names.index(self.look.follow), :2])
        self._lay_ice(frame)
        for patch, path in zip((self._hulls, self._walls), self.scenery.hulls(frame)):
            patch.set_path(path)
        self._tracks.set_segments(self.scenery.tracks(time))
        for kind, marks in self._marks.items():
            self._show_fractures(marks, kind, time)
        self._clock.set_text((f"{self.look.speed:g} × real time     " if self.look.is_film else "") + f"{time:.1f} s")
        self._draw_artists(self._artists)
        self.figure.draw_artist(self._clock)
        pixels = numpy.asarray(self.canvas.buffer_rgba())
        if self.history:
            self.history.draw(pixels, time)
        return pixels

    def _draw_artists(self, artists):
        """Draws artists onto the canvas, except patches without a path."""
        for artist in artists:
            if not (isinstance(artist, PathPatch) and len(artist.get_path().vertices) == 0):
                self._map.draw_artist(artist)

    def _set_floes(self, frame, among):
        """Sets the paths of the floes' patches to those of a frame. `among` is a mask of the floes; None: all."""
        for patch, path in zip((*self._floes, self._under),
                               self.scenery.floes(frame, self._window, self._least, among)):
            patch.set_path(path)

    def _lay_ice(self, frame):
        """Restores the picture of the parts that do not change, and sets the paths of the floes that must be drawn on
        it. In a film whose map stays in place the restored picture contains the resting floes, and only the others are
        left."""
        if self.look.follow is not None or not self.look.is_film:
            self._at_start.set_path(self.scenery.ice_at_start(self._window, self._least))
            self.canvas.restore_region(self._background)
            self._draw_artists([self._at_start])
            return self._set_floes(frame, None)
        if self._resting is None or not self._rest_from <= frame.time <= self._rest_until:
            self._draw_resting(frame)
        self.canvas.restore_region(self._resting_picture)
        return self._set_floes(frame, ~self._resting[frame.ids])

    def _draw_resting(self, frame):
        """Draws the floes that rest from a frame's time on for RESTING: they move by less than AT_REST and neither
        break nor go under a hull. Stores their mask by id and the picture."""
        self._rest_from = frame.time
        self._rest_until = min(frame.time + RESTING * self.look.speed, self.run.end_time)
        births, ids = self.run.births, frame.ids
        later = self.run.motions.floes_at(ids, self._rest_until)[:,
                                                                 :3] - self.run.motions.floes_at(ids, frame.time)[:, :3]
        moved = numpy.hypot(later[:, 0], later[:, 1]) + numpy.abs(later[:, 2]) * self.scenery.outlines.reach(ids)
        rests = self.run.motions.are_steady(ids, frame.time, self._rest_until) & (moved * self._metre < AT_REST)
        rests &= (births["died_s"][ids] > self._rest_until) & (births["went_under_s"][ids] > self._rest_until)
        self._resting = numpy.zeros(len(births["died_s"]), dtype=bool)
        self._resting[ids[rests]] = True
        if len(self._at_start.get_path().vertices) == 0:
            self._at_start.set_path(self.scenery.ice_at_start(self._window, self._least))
        self._set_floes(frame, rests)
        self.canvas.restore_region(self._background)
        self._draw_artists([self._at_start, *self._floes])
        self._resting_picture = self.canvas.copy_from_bbox(self.figure.bbox)

    def _show_fractures(self, marks, kind, time):
        """Sets the marks of the fractures of a kind in the last SHOWN seconds of the film before a time [s], which fade
        with their age to a fifth."""
        stays = SHOWN * self.look.speed
        points, age = self.scenery.fractures(kind, time - stays, time)
        marks.set_offsets(points if len(points) else numpy.empty((0, 2)))
        marks.set_alpha(1 - 0.8 * age / stays if len(points) else None)
