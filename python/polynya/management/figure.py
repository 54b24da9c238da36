"""Pictures of ice management."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402

from .gates import distribution, managing  # noqa: E402
from .measures import loads_on, rows_of  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")  # [Okabe2008]
STYLE = {"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "legend.fontsize": 7}


def at_least(passage, weights):
    """Sizes, and the sum of the weights of the floes of each size or more."""
    order = numpy.argsort(passage.sizes)
    return passage.sizes[order], numpy.cumsum(weights[order][::-1])[::-1]


def draw_sizes(axes, cases):
    number, share = axes
    for colour, case in zip(COLOURS, cases):
        for passage, dash, where in ((case.before, "--", "upstream"), (case.after, "-", "at the body")):
            if not len(passage.areas):
                continue
            style = {"color": colour, "linestyle": dash, "linewidth": 1.2, "label": f"{case.name}, {where}"}
            number.step(*at_least(passage, numpy.ones(len(passage.areas))), where="pre", **style)
            sizes, area = at_least(passage, passage.areas)
            share.step(sizes, 100 * area / passage.areas.sum(), where="pre", **style)
    for axis, words in ((number, "floes of the size or more"), (share, "their share of the ice [%]")):
        axis.axvline(cases[0].gates.size, color="0.7", linewidth=0.8, zorder=0)
        axis.set(xscale="log", xlabel="floe size √area [m]", ylabel=words)
    number.set_yscale("log")
    number.legend()


def draw_exceedance(axes, cases):
    for colour, case in zip(COLOURS, cases):
        for (name, loads), dash in zip(loads_on(case.run, case.gates).items(), ("-", ":")):
            loads = numpy.sort(loads[loads > 1e3]) / 1e3
            if len(loads) < 2:
                continue
            part = 100 * numpy.arange(len(loads), 0, -1) / case.intervals
            axes.step(loads, part, color=colour, linestyle=dash, linewidth=1.2,
                      label=f"{case.name}, {name.split('_')[0]}")
    axes.set(xlabel="load on the body [kN]", ylabel="time that it is exceeded [%]", yscale="log", xscale="log")
    axes.legend()


def draw_tracks(axes, case):
    """Where the icebreakers went, over ground, and what passed the gates across the drift."""
    for ship in managing(case.run.scene):
        rows = rows_of(case.run, ship)
        axes.plot(rows["x_m"], rows["y_m"], linewidth=0.6, label=ship)
    body = rows_of(case.run, case.gates.body)
    axes.plot(body["x_m"][-1:], body["y_m"][-1:], "s", color="0.2", markersize=4, label=case.gates.body)
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title=f"{case.name}: tracks over ground")
    axes.legend(loc="upper left", fontsize=6)


def draw_across(axes, cases):
    for colour, case in zip(COLOURS, cases):
        for passage, mark, alpha in ((case.before, "x", 0.4), (case.after, "o", 0.8)):
            axes.plot(passage.across, passage.sizes, mark, color=colour, alpha=alpha, markersize=2.5, linewidth=0)
    axes.axhline(cases[0].gates.size, color="0.7", linewidth=0.8, zorder=0)
    axes.set(xlabel="across the drift [m]", ylabel="floe size √area [m]", title="× upstream, ● at the body")


def draw_runs(cases, path):
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(2, 3, figsize=(10.5, 6), constrained_layout=True)
        draw_sizes(axes[0, :2], cases)
        draw_exceedance(axes[0, 2], cases)
        draw_across(axes[1, 0], cases)
        managed = [case for case in cases if managing(case.run.scene)] or cases
        draw_tracks(axes[1, 1], managed[0])
        draw_hits(axes[1, 2], cases)
        figure.savefig(path, dpi=160)
        plt.close(figure)


def draw_hits(axes, cases):
    """The ice of each size that came to the body, by area."""
    for colour, case in zip(COLOURS, cases):
        for passage, dash in ((case.before, "--"), (case.after, "-")):
            edges, _, areas = distribution(passage)
            axes.stairs(areas, edges, color=colour, linestyle=dash)
    axes.set(xlabel="floe size √area [m]", ylabel="ice through the gate [m²]", xscale="log",
             title="-- upstream, — at the body")


def draw_study(groups, against, shown, path):
    """Means with their 95 % intervals of some measures against a parameter, a line a group; groups: name -> measure ->
    rows of (x, mean, half width)."""
    with plt.rc_context(STYLE):
        columns = min(3, len(shown))
        lines = -(-len(shown) // columns)
        figure, axes = plt.subplots(lines, columns, figsize=(3.5 * columns, 2.9 * lines),
                                    constrained_layout=True, squeeze=False)
        for axis, (measure, words) in zip(axes.flat, shown.items()):
            for k, (name, of) in enumerate(groups.items()):
                rows = [row for row in of[measure] if row[1] is not None]
                if not rows:
                    continue
                x, mean, half = map(numpy.array, zip(*rows))
                step = 0.012 * (x.max() - x.min()) * (k - 0.5 * len(groups))
                colour = "0.3" if k >= len(COLOURS) else COLOURS[k]
                axis.errorbar(x + step, mean, yerr=half, fmt="o-", markersize=3,
                              linewidth=1, capsize=2, label=name, color=colour)
            axis.set(xlabel=against, ylabel=words, ylim=(0, None))
        for axis in list(axes.flat)[len(shown):]:
            axis.axis("off")
        axes.flat[min(3, len(shown) - 1)].legend(fontsize=6, loc="upper left")
        figure.savefig(path, dpi=160)
        plt.close(figure)
