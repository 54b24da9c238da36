"""The figures of `polynya loads`: exceedance of peaks with the fitted tail, pressure over area, and loads by place.
`loads` is a gather.Loads, `found` an estimate.Estimate, `fit` an estimate.Fit and `tail` an extremes.Tail. A function
that draws a figure returns None if there is nothing to draw."""
from __future__ import annotations

import numpy
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from polynya.figures.page import Page, Sheet, set_log

from . import estimate, rules, words

# Colours that colour-blind readers can tell apart.
BLACK, RED, BLUE, GREEN, PURPLE = "#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7"  # [Okabe2008]
# Colours of kinds of runs, the one with the largest peak first; further kinds are grey and share one legend entry.
KINDS = (BLACK, RED, BLUE, GREEN, PURPLE, "#e69f00")
# Colour and marker of a peak by what ended its contact: `ended_by` of contacts.csv (docs/run-folder.md). Peaks with
# another value are not drawn. Later ones cover earlier ones.
ENDS = {"bend": (BLUE, "o"), "split": (RED, "^"), "tilt": (GREEN, "s"), "slip": ("#888888", ".")}
# Largest number of points of the plot of pressure over area. Of more peaks, those with the largest force are drawn, and
# a note states the number of the others. More points: larger files, which take longer to draw.
MOST_POINTS = 5000
BINS = 400  # number of time intervals of the raster of unrolled(); more: finer in time, but hard to see in print
REFUTED = {"color": "#777777", "linestyle": ":"}  # line style of refuted fits
# Largest force on the axis of exceedance(), as a multiple of the largest peak. An interval of a fit may reach much
# farther; it then leaves the figure, so that the peaks remain legible. A larger value shows more of the fit and
# compresses the peaks.
WIDEST = 5
HEIGHT = 70  # height of the panels of most figures on paper [mm], for a page style of scale 1


def curve_of(tail, lowest):
    """Returns the curve of a tail as four arrays: 60 rates from slightly less than that of the threshold down to
    `lowest` [1/h], and the return value at each rate with the lower and upper end of its interval [MN]."""
    rates = numpy.geomspace(max(lowest, 1e-12), 0.95 * tail.rate.value, 60)[::-1]
    levels = [tail.level(1 / rate) for rate in rates]
    return rates, *(numpy.array([getattr(level, end) for level in levels]) / 1e6 for end in ("value", "low", "high"))


def draw_fits(axes, found, lowest):
    """Draws the fit in use with its interval, and all other fits, which are refuted, as grey dots, down to the rate
    `lowest` [1/h]. Returns the legend entries and the largest upper end of the interval [MN], 0 if no fit is in use."""
    handles, reach = [], 0.0
    refuted = [fit for fit in found.fits if fit is not found.used]
    for fit in refuted:
        rates, middle, _, _ = curve_of(fit.tail, lowest)
        axes.plot(middle, rates, **REFUTED)
    if refuted:
        words_of_all = "refuted fit" if len(refuted) == 1 else f"{len(refuted)} refuted fits"
        handles.append(Line2D([], [], label=f"{words_of_all} above {forces_of(refuted)}: {why_of(refuted)}", **REFUTED))
    if found.used:
        tail = found.used.tail
        rates, middle, low, high = curve_of(tail, lowest)
        axes.fill_betweenx(rates, low, high, color=RED, alpha=0.15, linewidth=0)
        axes.plot(middle, rates, color=RED, linestyle="--")
        label = f"fit above {forces_of([found.used])}, shape {words.shape(tail.shape.value)}, with its 90 % interval"
        handles.append(Line2D([], [], color=RED, linestyle="--", label=label))
        reach = high.max()
    return handles, reach


def why_of(fits):
    """Describes in a few words for the legend what refutes fits: the largest p value of those that a test refutes, and
    the largest shape of those whose tail is too heavy."""
    tested = [min(fit.goodness_p, fit.events.counts_p, fit.events.sizes_p) for fit in fits if list(fit.refuting_tests)]
    heavy = [fit.tail.shape.value for fit in fits if fit.is_heavy]
    found = [f"p {max(tested):.2g}" + (" at most" if len(tested) > 1 else "")] if tested else []
    return ", ".join(found + ([f"shape up to {words.shape(max(heavy))}"] if heavy else []))


def forces_of(fits):
    """Returns the range of the thresholds of fits, of which there is at least one, in ascending order, in words; a
    single force if they are equal in words."""
    found = [words.force(fit.tail.threshold) for fit in fits]
    return " to ".join(dict.fromkeys((found[0], found[-1])))


def draw_kind(axes, loads, found, lowest):
    """Draws the peaks of one kind of runs with their confidence band, and the fits of their tail. `lowest` is the
    lowest rate of the fits [1/h]. Returns the same as draw_fits()."""
    columns = estimate.exceedance(loads)
    force = columns["force_N"] / 1e6
    axes.fill_between(force, columns["per_hour_low"], columns["per_hour_high"], color=BLUE, alpha=0.25, linewidth=0)
    axes.plot(force, columns["per_hour"], color=BLACK, drawstyle="steps-pre")
    handles = [Line2D([], [], color=BLACK, label="peaks seen, with their 90 % band")]
    of_fits, reach = draw_fits(axes, found, lowest)
    return handles + of_fits, reach


def draw_kinds(axes, estimates):
    """Draws the peaks of each kind of runs. The six kinds with the largest peaks have colours, the others are grey.
    Returns the legend entries. `estimates` has (Loads, Estimate) by kind. A kind with fewer than two peaks is not
    drawn."""
    drawn = {kind: estimate.exceedance(of) for kind, (of, _) in estimates.items() if len(of.forces) > 1}
    largest = sorted(drawn, key=lambda kind: -drawn[kind]["force_N"][0])
    handles = []
    for kind in reversed(largest):
        at = largest.index(kind)
        is_named = at < len(KINDS)
        style = {"color": KINDS[at], "linewidth": 1.0} if is_named else {"color": "#bbbbbb", "linewidth": 0.5}
        axes.plot(drawn[kind]["force_N"] / 1e6, drawn[kind]["per_hour"], drawstyle="steps-pre", **style)
        if is_named:
            handles.append(Line2D([], [], label=kind, **style))
    rest = len(largest) - len(KINDS)
    others = [Line2D([], [], color="#bbbbbb", linewidth=0.5, label=f"{rest} more kinds")] if rest > 0 else []
    return handles[::-1] + others


def exceedance(loads, estimates, page=Page()):
    """Draws the number of peaks per hour above each force. For a single kind of runs it has its confidence band and the
    fitted tail, down to a tenth of the rate of one peak per record. Several kinds have one line each, without fits. The
    axis on the right counts peaks per kilometre; it is missing if the ship does not move. None for fewer than two peaks
    in all, or without recorded time."""
    if len(loads.forces) < 2 or not loads.hours:
        return None
    with Sheet(page, "Peaks exceeded", words.of_loads(loads)) as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        lowest = 0.1 / loads.hours
        several = len(estimates) > 1
        handles, reach = ((draw_kinds(axes, estimates), 0.0) if several
                          else draw_kind(axes, *estimates[loads.kinds()[0]], lowest))
        rates = [0.5 / of.hours if several else lowest for of, _ in estimates.values() if of.hours]
        axes.set(yscale="log", xlabel="force of a peak, MN", ylabel="exceeded, per hour", ylim=(min(rates), None))
        largest = loads.forces.max() / 1e6
        axes.set_xlim(0, max(1.1 * largest, min(1.05 * reach, WIDEST * largest)))
        if loads.kilometres > 1e-6:
            per = loads.hours / loads.kilometres
            other = axes.secondary_yaxis("right", functions=(lambda rate: rate * per, lambda rate: rate / per))
            other.set_ylabel("exceeded, per km")
            other.tick_params(labelsize=page.style.small)
        return sheet.finish(HEIGHT * page.style.scale, handles)


def draw_peaks(axes, loads, area, order, scale):
    """Draws peaks by area and pressure, marked by what ended them. `area` has the area of each peak [m²], `order` the
    indices of the peaks to draw, and `scale` is that of the page's style. Returns the legend entries."""
    handles = []
    for end, (colour, marker) in ENDS.items():
        chosen = order[loads.peaks["ended_by"][order] == end]
        if len(chosen):
            axes.plot(area[chosen], loads.peaks["pressure_Pa"][chosen] / 1e6, marker, color=colour,
                      markersize=2.5 * scale, markeredgewidth=0, alpha=0.6, clip_on=False)
            handles.append(Line2D([], [], color=colour, marker=marker, linestyle="", label=f"ended by {end}"))
    return handles


def draw_rules(axes, low, high):
    """Draws the pressures by rules for areas from `low` to `high` [m²]. Returns the legend entries, and the smallest
    and the largest pressure of the polar classes [MPa], which the axis should contain."""
    x, handles = numpy.geomspace(low, high, 200), []
    curves = [("ISO 19906, local", rules.iso_local_pressure(x), BLACK, "-")]
    curves += [(f"Polar Class {name[2:]}", rules.polar_class_pressure(x, name), PURPLE, dash)
               for name, dash in (("PC1", "--"), ("PC4", "-."), ("PC7", ":"))]
    for name, y, colour, dash in curves:
        axes.plot(x, y / 1e6, color=colour, linestyle=dash)
        handles.append(Line2D([], [], color=colour, linestyle=dash, label=name))
    classes = numpy.concatenate([y for _, y, colour, _ in curves if colour == PURPLE]) / 1e6
    return handles, classes.min(), classes.max()


def pressure_area(loads, page=Page()):
    """Draws the nominal pressure of each peak over its area, with the rules for comparison. The axes hold every drawn
    peak; the steep rule for tiny areas may leave them. None for fewer than two peaks with an area and a pressure."""
    area, pressure = loads.peaks["width_m"] * loads.peaks["height_m"], loads.peaks["pressure_Pa"] / 1e6
    drawable = numpy.flatnonzero((area > 0) & (pressure > 0))
    order = drawable[numpy.argsort(loads.forces[drawable])[::-1][:MOST_POINTS]]
    if len(order) < 2:
        return None
    with Sheet(page, "Pressure and area", "Nominal: force along the normal by width and height; rules: from "
               "memory") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        low, high = 0.7 * area[order].min(), max(20.0, 1.5 * area[order].max())
        handles, least, most = draw_rules(axes, low, high)
        handles = draw_peaks(axes, loads, area, order, page.style.scale) + handles
        set_log(axes.xaxis, low, high)
        set_log(axes.yaxis, *(limits := (min(least, pressure[order].min()) / 1.5,
                                         2.0 * max(most, pressure[order].max()))))
        axes.set(xlabel="area, m²", ylabel="pressure, MPa", xlim=(low, high), ylim=limits)
        rest = len(loads.forces) - len(order)
        note = [f"{rest} more peaks are smaller, or have no area or pressure (loads-peaks.csv)."] if rest else []
        return sheet.finish(HEIGHT * page.style.scale, handles, note)


def along(loads, page=Page()):
    """Draws for each panel along the waterline the largest force, which is that of a peak or of a recorded panel, with
    the mean force over the whole time if panels were recorded, and the number of peaks per hour. None without loaded
    panels."""
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
    """Draws the loads of the first case by place and time, as a raster of panels and BINS intervals of time. The
    waterline is unrolled from the stem, and each cell is coloured by its largest force, over three powers of ten. If no
    panels were recorded, the forces are those of peaks alone. Smaller forces than a thousandth of the largest have the
    palest colour, cells without force none. None if the first case has no loads."""
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
    """Draws the largest force and the number of peaks per hour by the direction of each panel from the middle of the
    waterline, counter-clockwise from ahead. None for a ship with propulsion, or without loaded panels."""
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


def all_of(loads, estimates, page=Page()):
    """Yields (name, description, figure or None) of each figure. The name is a part of the file's name, the description
    the caption in loads.html. `estimates` has (Loads, Estimate) by kind of runs."""
    yield "exceedance", "Peaks exceeded per hour and per kilometre", exceedance(loads, estimates, page)
    yield "pressure-area", "Pressure over area, beside rules", pressure_area(loads, page)
    yield "along", "Panels along the waterline", along(loads, page)
    yield "unrolled", "The waterline unrolled, by time", unrolled(loads, page)
    yield "polar", "By direction", polar(loads, page)
