"""Figures of loads by place, for print."""
from __future__ import annotations

import numpy
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from polynya.figures.page import Page, Sheet

from . import estimate, rules

BLACK, RED, BLUE, GREEN, PURPLE = "#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7"  # [Okabe2008]
ENDS = {"bend": (BLUE, "o"), "split": (RED, "^"), "tilt": (GREEN, "s"), "slip": ("#888888", ".")}
MOST_POINTS = 5000  # of a scatter: the largest
BINS = 400  # of time in a raster
HEIGHT = 70  # of a figure's panels [mm]


def exceedance(loads, page=Page(), least=None):
    """Peaks exceeded per hour, with their band, and the fitted tail."""
    columns = estimate.exceedance(loads)
    force = columns["force_N"] / 1e6
    if len(force) < 2:
        return None
    caption = f"{len(force)} peaks of {loads.ship} in {loads.hours:.4g} h" + (f", {loads.kilometres:.4g} km"
                                                                              if loads.kilometres > 1e-6 else "")
    with Sheet(page, "Peaks exceeded", caption + "; band: 95 %") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        axes.fill_between(force, columns["per_hour_low"], columns["per_hour_high"], color=BLUE, alpha=0.25, linewidth=0)
        axes.plot(force, columns["per_hour"], color=BLACK, drawstyle="steps-pre")
        handles = [Line2D([], [], color=BLACK, label="peaks")]
        above = estimate.tail(loads, least)
        fit = next((fit for of, _, fit in estimate.fits(loads, least) if of == "tail"), None)
        if fit:
            x = numpy.linspace(0, 1.3 * above.excesses.max(), 200)
            shape = fit.parameters["shape"].value
            axes.plot((above.least + x) / 1e6, above.rate * fit.exceedance(x), color=RED, linestyle="--")
            handles.append(Line2D([], [], color=RED, linestyle="--",
                                  label=f"Weibull above {above.least / 1e6:.3g} MN, shape {shape:.2f} (exponential: "
                                  f"1)"))
        axes.set(yscale="log", xlabel="force of a peak, MN", ylabel="exceeded, per hour",
                 ylim=(0.3 * columns["per_hour"][0], None))
        if loads.kilometres > 1e-6:
            per = loads.hours / loads.kilometres
            other = axes.secondary_yaxis("right", functions=(lambda rate: rate * per, lambda rate: rate / per))
            other.set_ylabel("exceeded, per km")
            other.tick_params(labelsize=page.style.small)
        return sheet.finish(HEIGHT * page.style.scale, handles)


def maxima(loads, page=Page()):
    """The largest peaks on Gumbel's paper, beside both fits."""
    found = estimate.maxima(loads)
    fits = [fit for of, _, fit in estimate.fits(loads) if of == "maxima"]
    if not fits:
        return None
    values = numpy.sort(found.values)
    reduced = lambda below: -numpy.log(-numpy.log(below))
    with Sheet(page, "Largest peaks", f"{len(values)}, each {found.words} of {found.hours * 3600:.4g} s; straight: "
               f"Gumbel") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        axes.plot(values / 1e6, reduced(numpy.arange(1, len(values) + 1) / (len(values) + 1)),
                  ".", color=BLACK, markersize=3)
        x = numpy.linspace(0.8 * values[0], 1.1 * values[-1], 200)
        handles = []
        for fit, colour, dash in zip(fits, (BLUE, RED), ("-", "--")):
            below = numpy.clip(1 - fit.exceedance(x), 1e-12, 1 - 1e-12)
            axes.plot(x / 1e6, reduced(below), color=colour, linestyle=dash)
            handles.append(Line2D([], [], color=colour, linestyle=dash,
                                  label=f"{fit.name.capitalize()}: KS p {fit.ks_p:.2g}, AD p {fit.ad_p:.2g}"))
        axes.set(xlabel="largest peak, MN", ylabel="−ln(−ln(share below))",
                 ylim=(-2.2, reduced(len(values) / (len(values) + 1)) + 0.8))
        return sheet.finish(HEIGHT * page.style.scale, handles)


def pressure_area(loads, page=Page()):
    """Nominal pressure of each peak over its area, beside the rules."""
    area = loads.peaks["width_m"] * loads.peaks["height_m"]
    order = numpy.argsort(loads.forces)[::-1][:MOST_POINTS]
    if len(order) < 2:
        return None
    x = numpy.geomspace(max(1e-3, area[area > 0].min()), max(100.0, area.max()), 200)
    with Sheet(page, "Pressure and area", "Nominal: force along the normal by width and height; rules: from "
               "memory") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        handles = []
        for end, (colour, marker) in ENDS.items():
            chosen = order[loads.peaks["ended_by"][order] == end]
            if len(chosen):
                axes.plot(area[chosen], loads.peaks["pressure_Pa"][chosen] / 1e6,
                          marker, color=colour, markersize=2.5, markeredgewidth=0, alpha=0.6)
                handles.append(Line2D([], [], color=colour, marker=marker, linestyle="", label=f"ended by {end}"))
        curves = [("ISO 19906, local", rules.iso_local_pressure(x), BLACK, "-")]
        curves += [(f"Polar Class {name[2:]}", rules.polar_class_pressure(x, name), PURPLE, dash)
                   for name, dash in (("PC1", "--"), ("PC4", "-."), ("PC7", ":"))]
        for words, y, colour, dash in curves:
            axes.plot(x, y / 1e6, color=colour, linestyle=dash)
            handles.append(Line2D([], [], color=colour, linestyle=dash, label=words))
        axes.set(xscale="log", yscale="log", xlabel="area, m²", ylabel="pressure, MPa")
        axes.set_ylim(bottom=max(1e-3, numpy.quantile(loads.peaks["pressure_Pa"][order], 0.01) / 2e6))
        return sheet.finish(HEIGHT * page.style.scale, handles)


def along(loads, page=Page()):
    """Loads of panels along the waterline."""
    rows = estimate.panels(loads)
    if not rows:
        return None
    middle = [(row["from_m"] + row["to_m"]) / 2 for row in rows]
    largest = [max(row["largest_peak_N"], row.get("largest_N", 0)) / 1e6 for row in rows]
    with Sheet(page, "Along the waterline", f"Panels of {loads.panel_m:g} m of {loads.ship}, from the stem; to port "
               f"positive") as sheet:
        top, low = sheet.panels(2, 1, sharex=True)[:, 0]
        top.bar(middle, largest, width=0.9 * loads.panel_m, color=BLUE)
        if loads.panels:
            top.bar(middle, [row.get("mean_N", 0) / 1e6 for row in rows], width=0.9 * loads.panel_m, color=BLACK)
        low.bar(middle, [row["peaks"] / loads.hours for row in rows], width=0.9 * loads.panel_m, color=RED)
        height = 1.3 * HEIGHT * page.style.scale
        sheet.label_y(top, "largest force, MN" + (" (black: mean)" if loads.panels else ""), height / 2)
        sheet.label_y(low, "peaks per hour", height / 2)
        low.set_xlabel("arc length from the stem, m")
        return sheet.finish(height)


def unrolled(loads, page=Page()):
    """Place by time, of the first case: the outline unrolled from the stem, coloured by the largest force in each panel
    and
    time; by peaks alone where panels are not recorded."""
    case = loads.cases[0]
    source = loads.panels if loads.panels else loads.peaks
    chosen = source["case"] == case.number
    times = source["t_s"][chosen]
    if not len(times):
        return None
    force = source["force_max_N" if loads.panels else "force_N"][chosen]
    columns = source["panel"][chosen] if loads.panels else loads.panel_of(source["arc_m"][chosen])
    low, high = columns.min() - 1, columns.max() + 1
    begin, end = case.start_s, case.start_s + 3600 * case.hours
    raster = numpy.zeros((high - low + 1, BINS))
    at = numpy.clip(((times - begin) / (end - begin) * BINS).astype(int), 0, BINS - 1)
    numpy.maximum.at(raster, (columns - low, at), force / 1e6)
    what = "largest step" if loads.panels else "largest peak"
    with Sheet(page, "Place by time", f"The waterline of {loads.ship} unrolled from the stem; {what} of each panel of "
               f"{loads.panel_m:g} m") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        most = raster.max()
        picture = axes.imshow(numpy.ma.masked_less_equal(raster, 0), origin="lower",
                              aspect="auto", interpolation="nearest", cmap="viridis_r",
                              norm=LogNorm(most / 1000, most),
                              extent=(begin, end, low * loads.panel_m, (high + 1) * loads.panel_m))
        axes.axhline(0, color=BLACK, linewidth=0.5)
        axes.set(xlabel="time, s", ylabel="arc length from the stem, m; to port positive")
        bar = sheet.figure.colorbar(picture, ax=axes, pad=0.02, use_gridspec=False)
        bar.ax.set_title("MN", fontsize=page.style.small)
        bar.ax.tick_params(which="both", labelsize=page.style.small)
        return sheet.finish(1.2 * HEIGHT * page.style.scale)


def polar(loads, page=Page()):
    """Of a structure: loads by the direction in which a panel lies."""
    rows = estimate.panels(loads) if loads.is_fixed else []
    if not rows:
        return None
    from .gather import facing
    angle = facing(loads, numpy.array([row["panel"] for row in rows]))
    width = 2 * numpy.pi * loads.panel_m / loads.waterline.length
    with Sheet(page, "By direction", f"Panels of {loads.panel_m:g} m of {loads.ship}; 0°: ahead of it, "
               f"counter-clockwise") as sheet:
        left, right = sheet.panels(1, 2, subplot_kw={"projection": "polar"})[0]
        left.bar(angle, [max(row["largest_peak_N"], row.get("largest_N", 0)) / 1e6 for row in rows],
                 width=0.9 * width, color=BLUE)
        right.bar(angle, [row["peaks"] / loads.hours for row in rows], width=0.9 * width, color=RED)
        for axes in (left, right):
            axes.yaxis.set_major_locator(MaxNLocator(3))
            axes.grid(linewidth=0.4)
        sheet.title_panel(left, 0, 2, "largest force, MN", page.width / 2.5)
        sheet.title_panel(right, 1, 2, "peaks per hour", page.width / 2.5)
        return sheet.finish(HEIGHT * page.style.scale)


def all_of(loads, page=Page(), least=None):
    """(name, what it shows, figure or None) of each."""
    yield "exceedance", "Peaks exceeded per hour and per kilometre", exceedance(loads, page, least)
    yield "maxima", "Largest peaks on Gumbel's paper", maxima(loads, page)
    yield "pressure-area", "Pressure over area, beside rules", pressure_area(loads, page)
    yield "along", "Panels along the waterline", along(loads, page)
    yield "unrolled", "The waterline unrolled, by time", unrolled(loads, page)
    yield "polar", "By direction", polar(loads, page)
