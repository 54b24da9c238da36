"""A figure of the sources and sinks of the energy of each run, from `energy` of summary.json (docs/run-folder.md)."""
from __future__ import annotations

from matplotlib.patches import Patch

from .loads import prefixed
from .page import POINT, Page, Sheet, in_words, plain
from .subjects import all_labelled, colour_of

# Keys of `energy` without their ending _J, and the words of the figure: the sources, then the sinks, in the order in
# which the figure shows them. Sources and sinks have the same sum, because "imbalance" is the difference of the others.
# A key without words here is shown with its own name as a sink.
SOURCES = {"initial": "motion at the start", "thrust": "thrust and holding", "current": "current",
           "wind": "wind", "walls": "loads of walls", "initial_stored": "in moorings at the start",
           "mooring_ground": "moorings: work of the ground", "mooring_separation": "moorings: overlaps pushed apart",
           "imbalance": "imbalance"}
SINKS = {
    "kinetic": "motion at the end",
    "stored": "in moorings at the end",
    "mooring_damping": "moorings: damping",
    "mooring_breaking": "moorings: lost by breaking",
    "drag": "water drag",
    "friction": "friction",
    "crushing": "crushing",
    "restitution": "collisions",
    "bending": "motion of broken cusps",
    "splitting": "motion of splinters",
    "grinding": "motion of ground ice",
    "submersion": "motion of ice going under",
    "submerged_ice": "ice under hulls",
    "rest": "floes put to rest",
}


def terms_of(runs):
    """Returns the sources and the sinks of some runs in order, each as (name, a value [J] per run, None if the run does
    not have the term). A term that is neither in SOURCES nor in SINKS is a sink with its key as its name. `turnover_J`
    is left out, because it is the scale of the imbalance and no term. Both lists are empty if no run has energies."""
    energies = [run.run.summary.get("energy") or {} for run in runs]
    keys = dict.fromkeys(key[:-2] for energy in energies for key in energy if key.endswith("_J")
                         and key != "turnover_J")
    sinks = [key for key in SINKS if key in keys] + [key for key in keys if key not in SOURCES and key not in SINKS]
    named = {**SOURCES, **SINKS}
    of = lambda key: (named.get(key, key.replace("_", " ")), [energy.get(f"{key}_J") for energy in energies])
    return [of(key) for key in SOURCES if key in keys], [of(key) for key in sinks]


def draw(runs, page=Page()):
    """Draws two panels of bars, sources above sinks, with a bar for each run, and returns the matplotlib figure, or
    None if no run has energies. Terms that are 0 or missing in every run are named in a note instead."""
    runs = all_labelled(runs)
    sources, sinks = terms_of(runs)
    if not sources and not sinks:
        return None
    values = [value or 0 for _, terms in (*sources, *sinks) for value in terms]
    factor, prefix = prefixed(max(map(abs, values)))
    absent = [words for words, terms in (*sources, *sinks) if not any(terms)]
    panels = [[term for term in terms if term[0] not in absent] for terms in (sources, sinks)]
    style, scale = page.style, page.style.scale
    bar = 1.25 * style.small * POINT  # the height of a bar and the gap to the next of its term [mm]
    pitch = bar * len(runs) + 1.6 * scale
    heights = [max(1, len(terms)) * pitch for terms in panels]
    with Sheet(page, "Energy", "Over the whole run; the sources' sum is that of the sinks.") as sheet:
        grid = sheet.panels(2, 1, sharex=True, gridspec_kw={"height_ratios": heights})[:, 0]
        numbers = []
        for i, (axes, terms, title) in enumerate(zip(grid, panels, ("sources", "sinks"))):
            numbers += draw_bars(axes, terms, factor, bar, pitch, page)
            sheet.title_panel(axes, i, 2, title, page.width)
        grid[0].tick_params(labelbottom=False)
        grid[1].set_xlabel(f"energy, {prefix}J")
        handles = [Patch(color=colour_of(i), label=plain(run.label))
                   for i, run in enumerate(runs)] if len(runs) > 1 else []
        notes = [f"Nothing in {'any run' if len(runs) > 1 else 'this run'}: {', '.join(absent)}."] if absent else []
        figure = sheet.finish(sum(heights) + 18 * scale, handles, notes)
        make_room(figure, grid[1], numbers)
        return figure


def draw_bars(axes, terms, factor, bar, pitch, page):
    """Draws the bars of a panel in `axes`, and returns the texts of their numbers. `terms` are those of terms_of(); a
    value that is None has no bar. Values are in joules, and their scale in units of `factor` joules. `bar` is the
    height of a bar with its gap and `pitch` the distance of terms, both in millimetres, as is the vertical axis, so
    that bars of both panels are equally high. The number of a negative bar is to the right of zero."""
    numbers = []
    for k, (_, values) in enumerate(terms):
        for i, value in enumerate(values):
            if value is None:
                continue
            y = k * pitch + i * bar
            axes.barh(y, value / factor, 0.82 * bar, align="edge", color=colour_of(i), linewidth=0)
            numbers.append(axes.annotate(
                in_words(value / factor), (max(0, value / factor), y + 0.41 * bar),
                (2 * page.style.scale, 0), textcoords="offset points",
                va="center_baseline", ha="left", fontsize=page.style.small, annotation_clip=False, in_layout=False))
    axes.set_yticks([k * pitch + 0.5 * bar * len(values) for k, (_, values) in enumerate(terms)],
                    [words for words, _ in terms])
    gap = pitch - bar * len(values) if terms else pitch
    axes.set_ylim(max(1, len(terms)) * pitch - 0.4 * gap, -0.6 * gap)
    axes.tick_params(axis="y", length=0, labelsize=page.style.text)
    axes.axvline(0, color="#000000", linewidth=0.6 * page.style.scale)
    axes.grid(axis="x", color="#dddddd", linewidth=0.4 * page.style.scale)
    axes.set_axisbelow(True)
    axes.spines["left"].set_visible(False)
    return numbers


def make_room(figure, axes, numbers):
    """Widens the scale of the horizontal axis until no number at a bar extends beyond the right end of `axes`. Widening
    also moves the numbers, so it takes up to six passes; after these a number may still extend beyond the end."""
    for _ in range(6):
        right = axes.get_window_extent().x1
        over = max((n.get_window_extent(figure.canvas.get_renderer()).x1 - right for n in numbers), default=0)
        if over <= 0:
            return
        low, high = axes.get_xlim()
        axes.set_xlim(low, high + 1.3 * (high - low) * over / axes.get_window_extent().width)
        figure.draw_without_rendering()
