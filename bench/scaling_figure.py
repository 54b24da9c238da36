#!/usr/bin/env python3
"""Draws what polynya_bench_scaling measured: bench/scaling_figure.py scaling.csv docs/images/performance-scaling.svg"""
import csv
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "python"))
from matplotlib.lines import Line2D  # noqa: E402

from polynya.figures.page import Page, Sheet, save, set_log  # noqa: E402

PANELS = {  # by sweep: title, label of the abscissa
    "floes": ("same voyage, more floes", "floes in the field"),
    "awake": ("sheared, 80 % cover", "floes, all awake"),
    "contacts": ("2000 floes, 50 to 90 %", "touching pairs"),
    "vertices": ("one plate being broken", "vertices of the plate"),
    "threads": ("10 000 floes, all awake", "threads"),
}
CURVES = (("mean_us", "mean", {"color": "#0072b2"}), ("median_us", "median", {"color": "#d55e00", "linestyle": "--"}))


def draw(rows):
    page = Page()
    caption = "Mean wall time of a step over a run, one thread but for the last panel. Commands: bench/performance.sh."
    with Sheet(page, "Cost of a step", caption) as sheet:
        grid = sheet.panels(2, 3)
        for i, (axes, (sweep, (title, label))) in enumerate(zip(grid.flat, PANELS.items())):
            mine = [row for row in rows if row["sweep"] == sweep]
            for column, _, style in CURVES:
                axes.plot([float(row["x"]) for row in mine], [float(row[column]) for row in mine], marker=".", **style)
            axes.set_xlabel(label)
            set_log(axes.xaxis, *axes.dataLim.intervalx)
            set_log(axes.yaxis, *axes.dataLim.intervaly)
            axes.grid(which="major", color="#dddddd", linewidth=0.5)
            sheet.title_panel(axes, i, len(PANELS), title, page.width / 3 - 6)
            if i % 3 == 0:
                sheet.label_y(axes, "step, µs", 50)
        grid.flat[-1].remove()
        return sheet.finish(2 * 52, [Line2D([], [], label=words, **style) for _, words, style in CURVES])


with open(sys.argv[1], encoding="utf-8", newline="") as file:
    stem, suffix = os.path.splitext(sys.argv[2])
    list(save(draw(list(csv.DictReader(file))), stem, [suffix[1:]]))
