"""Colours of maps: light ice on mid water, apart in greyscale; marks in the Okabe–Ito palette [Okabe2008]. As views/map/map_marks.hpp."""
from __future__ import annotations

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

WATER = "#8fb8d0"
AT_START = "#a9cadd"
CHANNEL = "#5e93b5"
ICE = "#ffffff"
BROKEN = "#fbeec2"
CAME_UP = "#f0c987"
UNDER = "#56b4e9"
EDGE = "#3d5261"
SHIP = "#2b2b2b"
WALL = "#8a8a8a"
TRACK = "#d55e00"
MARKS = {"bend": "#0072b2", "split": "#d55e00", "grind": "#7a5c2e"}


def entries(sceneries, scale):
    """The keys of what some maps show."""
    has = lambda of: any(len(of(scenery)) for scenery in sceneries)
    area = lambda colour, words, edge=EDGE: Patch(facecolor=colour, edgecolor=edge, linewidth=0.4 * scale, label=words)
    dot = lambda kind, words: Line2D([], [], color=MARKS[kind], linestyle="none", marker="o", markersize=2.5 * scale, markeredgewidth=0, label=words)
    keys = [
        (has(lambda s: s.as_in_scene), area(ICE, "floe as in the scene")),
        (has(lambda s: s.broken), area(BROKEN, "piece of a broken floe")),
        (has(lambda s: s.came_up), area(CAME_UP, "piece that came up from under the hull")),
        (True, area(WATER, "water", WATER)),
        (has(lambda s: s.at_start), area(AT_START, "ice at the start, open now", AT_START)),
        (has(lambda s: s.channel), area(CHANNEL, "channel behind the ship", CHANNEL)),
        (has(lambda s: s.hulls), area(SHIP, "ship or structure", SHIP)),
        (has(lambda s: s.walls), area(WALL, "wall", WALL)),
        (has(lambda s: s.under), Patch(facecolor=UNDER + "40", edgecolor=UNDER, linewidth=0.8 * scale, linestyle=(0, (3, 2)), label="ice under the hull or waiting behind it")),
        (has(lambda s: s.tracks), Line2D([], [], color=TRACK, linewidth=0.8 * scale, dashes=(5, 2.5), label="track")),
        (has(lambda s: s.marks["bend"]), dot("bend", "cusp broken by bending")),
        (has(lambda s: s.marks["grind"]), dot("grind", "overlap ground to brash")),
        (has(lambda s: s.marks["split"]), Line2D([], [], color=MARKS["split"], linestyle="none", marker="^", markersize=4 * scale, markeredgewidth=0, label="floe split")),
    ]
    return [handle for is_there, handle in keys if is_there]
