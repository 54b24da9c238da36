"""Draws slices of an icebreaking database for `polynya database show --svg DIR` (polynya.command starts it). The
program writes the curves of the figures to slices.json in DIR (analysis/database_slices.hpp), which is kept."""
import itertools
import json
import os
import sys

# Colour and dashes of the published formulas, by the `source` of a curve. They are the last curves of a figure.
FORMS = {"Nevel": ("#000000", "--"), "Kashtelyan": ("#777777", ":")}
# Colours of the curves of the database: first the load itself, then the same load with other wedge angles, or speeds.
# After the last colour the first one follows again.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#aa4499")


def draw(figure, title, caption):
    """Draws a figure of the file of slices: the force that breaks a wedge of ice, and the radius of the cusp. Returns
    the matplotlib figure. A curve is faint where its point is outside the range of the database or of the formula.
    Panels are 58 mm high on a page of the default style."""
    import numpy
    from matplotlib.lines import Line2D

    from .page import Page, Sheet, set_log

    page = Page()
    with Sheet(page, title, caption) as sheet:
        force, radius = sheet.panels(1, 2).flat
        height = page.row_height(1, 58)
        handles = []
        for curve, colour in zip(figure["curves"], itertools.cycle(COLOURS)):
            colour, dash = FORMS.get(curve["source"], (colour, "-"))
            is_in_range = numpy.array(curve["is_in_range"], dtype=bool)
            for axes, key, unit in ((force, "vertical_force_N", 1e3), (radius, "cusp_radius_m", 1)):
                values = numpy.array(curve[key]) / unit
                axes.plot(figure["x"], values, color=colour, linestyle=dash, alpha=0.3)
                axes.plot(figure["x"], numpy.where(is_in_range, values, numpy.nan), color=colour, linestyle=dash)
            handles.append(Line2D([], [], color=colour, linestyle=dash, label=curve["name"]))
        panels = (
            (force, "force that breaks the wedge", "vertical force, kN", True),
            (radius, "radius of the cusp", "radius, m", figure["is_radius_log"]),
        )
        for i, (axes, title_of_panel, words, is_log) in enumerate(panels):
            axes.set_xlabel(figure["x_label"])
            if figure["is_x_log"]:
                set_log(axes.xaxis, figure["x"][0], figure["x"][-1])
            if is_log:
                set_log(axes.yaxis, *axes.dataLim.intervaly)
            axes.set_xlim(figure["x"][0], figure["x"][-1])
            if not is_log:
                axes.set_ylim(0, None)
            sheet.title_panel(axes, i, 2, title_of_panel, page.width)
            sheet.label_y(axes, words, height)
        return sheet.finish(height, handles)


def main():
    """Draws each figure of the file of slices that the command line names, as an SVG in the folder of that file. Prints
    the path of each SVG and returns the exit code 0."""
    from .page import save

    slices = sys.argv[1]
    folder = os.path.dirname(slices)
    with open(slices, encoding="utf-8") as file:
        given = json.load(file)
    for figure in given["figures"]:
        for path in save(draw(figure, given["title"], given["caption"]), os.path.join(folder, figure["name"]), ["svg"]):
            print(f"picture         {path}", flush=True)
    return 0
