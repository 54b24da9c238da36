"""The figure `sizes`: number of floes of at least each size, and their fraction of the ice, at the start and at the end
of each run."""
from __future__ import annotations

import numpy
from matplotlib.lines import Line2D

from .page import Page, Sheet, plain, set_log
from .subjects import all_labelled, colour_of


def sizes_at(run, time):
    """Returns three arrays for the floes that float at a time [s], in ascending order of size: the size √area [m], the
    number of floes of at least that size, and their percentage of the area of all floating floes. Pieces under hulls
    are left out, and so are floes whose recorded area is 0. The arrays are empty if no floe floats."""
    births = run.births
    is_afloat = (births["born_s"] <= time) & (time < births["died_s"]) & (time < births["went_under_s"])
    areas = numpy.sort(births["area_m2"][is_afloat])
    areas = areas[areas > 0]
    below = numpy.concatenate([[0.0], numpy.cumsum(areas)[:-1]])
    return numpy.sqrt(areas), numpy.arange(len(areas), 0, -1), 100 * (1 - below / areas.sum()) if len(areas) else areas


# Draws both panels, with a colour for each run; its start is dashed and its end is solid. `runs` are runs, or Labelled
# ones with their own names and range of times; of these the first and the last time are drawn. A run without a floe at
# a time has no curve for it, but a legend entry. Returns the figure, or None if no floe floats at any of these times.
# The panels are beside each other if each can be 70 mm wide (times the style's scale), otherwise below each other.
def draw(runs, page=Page()):
    runs = all_labelled(runs)
    with Sheet(page, "Floe sizes", f"{', '.join(run.label for run in runs)}; size is the root of the area.") as sheet:
        columns = page.columns_for(2, least=70)
        counts, shares = sheet.panels(2 // columns, columns).flat
        height = page.row_height(2 // columns, 46)
        handles, everything = [], []
        for i, run in enumerate(runs):
            for time, dash in ((run.start, "--"), (run.end, "-")):
                sizes, number, share = sizes_at(run.run, time)
                style = {"color": colour_of(i), "linestyle": dash}
                everything.append(sizes)
                for axes, values in ((counts, number), (shares, share)):
                    axes.step(numpy.append(sizes, sizes[-1:]), numpy.append(values, [0] * min(1, len(sizes))),
                              where="pre", **style)
                handles.append(Line2D([], [], label=f"{plain(run.label)} at {time:g} s", **style))
        everything = numpy.concatenate(everything)
        if len(everything) == 0:
            return None
        for i, (axes, words) in enumerate(((counts, "floes at least as large"), (shares, "their share of the ice, %"))):
            set_log(axes.xaxis, everything.min(), everything.max())
            axes.set(xlim=(0.8 * everything.min(), 1.25 * everything.max()), xlabel="floe size, m")
            sheet.label_y(axes, words, height)
            sheet.title_panel(axes, i, 2, "", page.width)
        set_log(counts.yaxis, 1, counts.get_ylim()[1])
        counts.set_ylim(0.8, None)
        shares.set_ylim(0, 100)
        return sheet.finish(2 // columns * (height + 6 * page.style.scale), handles)
