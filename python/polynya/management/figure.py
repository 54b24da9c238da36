"""The figure of `polynya management RUN …`: six panels that compare runs of ice management. A case is a run with the
ice that passed its gates (Case in __main__.py): `before` at the upstream gate, `after` at the gate near the body."""
import numpy
from matplotlib.lines import Line2D

from ..figures.page import Sheet, plain
from ..naming import short
from .gates import distribution, managing
from .measures import loads_on, rows_of

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")  # of the first six runs [Okabe2008]
REST = "#bbbbbb"  # colour of all further runs, which share one entry of the legend
# Largest length of a run's name in the title of a panel [characters]; longer ones are shortened. Larger: the title
# needs more lines, so that panels become lower; smaller: names of runs may not be distinguished.
LONGEST = 24
# Wanted height of a row of panels on paper, for text of 8 pt [mm]; it is less if the page is too short for all rows.
HEIGHT = 62


def coloured(cases):
    """Returns (colour, case) of each run in reverse order, so that runs with their own colours are drawn last, above
    the grey ones."""
    return [(COLOURS[k] if k < len(COLOURS) else REST, case) for k, case in enumerate(cases)][::-1]


def at_least(passage, weights):
    """Returns the sizes √area of the floes of a passage in ascending order [m], and for each size the sum of the
    weights of the floes of at least that size. With weights of 1 this is a number of floes, with areas an area. Both
    arrays are empty if no floe passed."""
    order = numpy.argsort(passage.sizes)
    return passage.sizes[order], numpy.cumsum(weights[order][::-1])[::-1]


# Draws the number of floes of at least each size, and their share of the ice that passed the gate, in two panels. A
# gate that no floe passed has no line. Here and in the panels below, dashed lines and crosses are the upstream gate,
# solid lines and circles the gate near the body. A grey line marks the size from which floes count as large
# (`gates.size`) in the first case.
def draw_sizes(axes, cases):
    number, share = axes
    for colour, case in coloured(cases):
        for passage, dash in ((case.before, "--"), (case.after, "-")):
            if not len(passage.areas):
                continue
            style = {"color": colour, "linestyle": dash}
            number.step(*at_least(passage, numpy.ones(len(passage.areas))), where="pre", **style)
            sizes, area = at_least(passage, passage.areas)
            share.step(sizes, 100 * area / passage.areas.sum(), where="pre", **style)
    for axis, words in ((number, "floes of the size or more"), (share, "their share of the ice, %")):
        axis.axvline(cases[0].gates.size, color="0.7", linewidth=0.8, zorder=0)
        axis.set(xscale="log", xlabel="floe size √area, m", ylabel=words)
    number.set_yscale("log")


# Draws the percentage of time in which each load on the body is exceeded: solid by ice, dotted by the mooring. Loads of
# at most 1 kN are left out of the curves, because the axis is logarithmic; the percentages refer to the whole time
# after the start of the gates. A load that exceeds 1 kN in fewer than two rows of forces.csv has no curve.
def draw_exceedance(axes, cases):
    for colour, case in coloured(cases):
        for loads, dash in zip(loads_on(case.run, case.gates).values(), ("-", ":")):
            loads = numpy.sort(loads[loads > 1e3]) / 1e3
            if len(loads) < 2:
                continue
            part = 100 * numpy.arange(len(loads), 0, -1) / case.intervals
            axes.step(loads, part, color=colour, linestyle=dash)
    axes.set(xlabel="load on the body, kN", ylabel="time that it is exceeded, %", yscale="log", xscale="log")


def draw_tracks(axes, case, colour):
    """Draws the tracks over ground of the ships that manage ice in one run, over the whole run, and the waterline of
    the protected body at its end. Without such ships only the waterline is drawn."""
    for ship in managing(case.run.scene):
        rows = rows_of(case.run, ship)
        axes.plot(rows["x_m"], rows["y_m"], linewidth=0.6, color=colour)
    run = case.run
    outline = run.frame(run.end_time).hulls[case.gates.body]
    axes.fill(*outline.T, color="0.2")
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal")


# Draws the size of each floe that passed a gate [m] over its position across the drift [m], to port of the upstream
# direction; 0 is the body's origin.
def draw_across(axes, cases):
    for colour, case in coloured(cases):
        for passage, mark, alpha in ((case.before, "x", 0.4), (case.after, "o", 0.8)):
            axes.plot(passage.across, passage.sizes, mark, color=colour, alpha=alpha, markersize=2.5, linewidth=0)
    axes.axhline(cases[0].gates.size, color="0.7", linewidth=0.8, zorder=0)
    axes.set(xlabel="across the drift, m", ylabel="floe size √area, m")


def draw_passed(axes, cases):
    """Draws the area of ice that passed each gate by floe size, in the intervals of gates.distribution()."""
    for colour, case in coloured(cases):
        for passage, dash in ((case.before, "--"), (case.after, "-")):
            edges, _, areas = distribution(passage)
            axes.stairs(areas, edges, color=colour, linestyle=dash)
    sizes = numpy.concatenate([passage.sizes for case in cases for passage in (case.before, case.after)])
    ends = {"xlim": (0.7 * sizes.min(), 1.5 * sizes.max())} if len(sizes) else {}
    axes.set(xlabel="floe size √area, m", ylabel="ice through the gate, m²", xscale="log", **ends)


# Returns the legend entries: a colour for each run, one for all further runs, and the line styles.
def legend_of(cases):
    handles = [Line2D([], [], color=colour, label=plain(case.name))
               for colour, case in reversed(coloured(cases)) if colour != REST]
    rest = len(cases) - len(handles)
    handles += [Line2D([], [], color=REST, label=f"{rest} more runs")] if rest > 0 else []
    return handles + [Line2D([], [], color="0.2", label="at the body; load by ice"),
                      Line2D([], [], color="0.2", linestyle="--", label="upstream (×)"),
                      Line2D([], [], color="0.2", linestyle=":", label="load on the mooring")]


def draw_runs(cases, page):
    """Draws all panels on a page (figures.page.Page) and returns the figure. `cases` has at least one Case. The caption
    and the grey line are those of the first case. Tracks are drawn for the first run in which a ship manages ice, or
    for the first run if none does."""
    gates = cases[0].gates
    caption = (f"Floes through gates {gates.upstream:g} m and {gates.near:g} m upstream of {gates.body}; grey line: "
               f"floes of {gates.size:g} m")
    managed = next((k for k, case in enumerate(cases) if managing(case.run.scene)), 0)
    with Sheet(page, "Ice management", plain(caption)) as sheet:
        columns = 3 if page.width > 120 else 2
        grid = sheet.panels(6 // columns, columns).flat
        draw_sizes(grid[:2], cases)
        draw_exceedance(grid[2], cases)
        draw_across(grid[3], cases)
        draw_tracks(grid[4], cases[managed], COLOURS[managed] if managed < len(COLOURS) else REST)
        draw_passed(grid[5], cases)
        tracks = f"tracks of {short(cases[managed].name, LONGEST)} over ground"
        words = ("number", "share", "exceedance", "across", tracks, "by area")
        for number, (axes, title) in enumerate(zip(sheet.figure.axes, words)):
            sheet.title_panel(axes, number, 6, title, page.width / columns - 18)
        return sheet.finish(page.row_height(6 // columns, HEIGHT) * (6 // columns), legend_of(cases))
