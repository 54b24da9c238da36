"""The pictures of a study's page, by matplotlib: SVG and PNG."""
import math

import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the backend is chosen)

from .. import statistics  # noqa: E402
from .sample import fits_of  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999933")  # [Okabe2008]
OUTCOMES = {"pushed": "#56b4e9", "bent": "#009e73", "split": "#d55e00", "stuck": "#000000"}
PAPER = (
    0.999,
    0.99,
    0.95,
    0.9,
    0.8,
    0.5,
    0.2,
    0.1,
    0.05,
    0.02,
    0.01,
    0.005,
    0.002,
    0.001,
)  # probabilities of exceedance
SCALES = {"N": (1e6, "MN"), "Nm": (1e6, "MN m"), "J": (1e6, "MJ"), "m": (1, "m"), "s": (1, "s")}
STYLE = {
    "font.size": 8,
    "axes.titlesize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "svg.hashsalt": "polynya",
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "figure.constrained_layout.use": True,
}


def save(figure, folder, name):
    """Writes name.svg and name.png; returns the name of the SVG."""
    folder.mkdir(exist_ok=True)
    for suffix, options in ((".svg", {"metadata": {"Date": None}}), (".png", {"dpi": 200})):
        figure.savefig(folder / (name + suffix), **options)
    pyplot.close(figure)
    return name + ".svg"


def label_of(measure, is_parameter=False):
    """("resistance peak [MN]", factor) of a measure's name with its unit; of a parameter's path its last part, in the
    unit in which the scene states it."""
    name, _, index = measure.rsplit(".", 1)[-1].partition("[")
    axis = {"0]": " x", "1]": " y"}.get(index, f" {index.rstrip(']')}" if index else "")
    for unit in sorted(("m_per_s", "deg", "Pa", *SCALES), key=len, reverse=True):
        if name.endswith("_" + unit):
            plain = (1, {"m_per_s": "m/s", "deg": "°", "Nm": "N m"}.get(unit, unit))
            scale, shown = plain if is_parameter else SCALES.get(unit, plain)
            return f"{name.removesuffix('_' + unit).replace('_', ' ')}{axis} [{shown}]", 1 / scale
    return name.replace("_", " ") + axis, 1.0


def in_words(value, digits=6):
    """A number to so many significant digits, by default whole ones in full: with an exponent only below 1e-4 and from
    1e12 on. Other values as they are."""
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        return str(value).replace("inf", "∞")
    if value and not 1e-4 <= abs(value) < 1e12:
        return f"{value:.{digits}g}"
    if digits == 6 and value == int(value):
        return str(int(value))
    return numpy.format_float_positional(value, precision=digits, fractional=False, trim="-")


def group_label(name, value):
    """ "thickness 0.4 m", "scene fig4a" """
    label, _ = label_of(name, is_parameter=True)
    words, _, unit = label.partition(" [")
    return f"{words} {in_words(value)} {unit.rstrip(']')}".rstrip()


def exceedance(sample, measure, group_by, folder):
    """Peaks on Gumbel's probability paper, on which his distribution is a straight line, with both fits."""
    label, factor = label_of(measure)
    with pyplot.rc_context(STYLE):
        figure, axes = pyplot.subplots(figsize=(6.7, 4.2))
        reduced = lambda p: -numpy.log(-numpy.log1p(-numpy.asarray(p)))
        lowest = 0.5
        for (value, cases), colour in zip(sample.groups(group_by), colours()):
            values = sample.numbers(measure, cases)
            if len(values) == 0:
                continue
            ordered, above = statistics.exceedance(values)
            lowest = min(lowest, above[-1])
            named = group_label(group_by, value) if group_by else "all cases"
            axes.plot(ordered * factor, reduced(above), "o", ms=3, color=colour, label=f"{named} ({len(values)})")
            fits = fits_of(values)
            for name, line in (("gumbel", "-"), ("weibull", "--")):
                fitted = fits[name]
                if not isinstance(fitted, str):
                    p = numpy.geomspace(min(0.02, above[-1] / 2), 0.995, 200)
                    axes.plot(fitted.level_of(p) * factor, reduced(p), line, color=colour, lw=1)
        ticks = [p for p in PAPER if p >= lowest / 2.1]
        axes.set_yticks(reduced(ticks), [f"{p:g}" for p in ticks])
        axes.set(xlabel=label, ylabel="probability of exceedance in one run")
        axes.plot([], [], "-", color="#666666", lw=1, label="Gumbel")
        axes.plot([], [], "--", color="#666666", lw=1, label="Weibull")
        axes.legend(frameon=False, fontsize=7)
        return save(figure, folder, f"exceedance-{measure}")


def colours():
    while True:
        yield from COLOURS


def means(sample, measure, against, group_by, folder):
    """Means with their 95 % intervals against a parameter, a line for each group."""
    label, factor = label_of(measure)
    if group_by == against:
        group_by = None
    with pyplot.rc_context(STYLE):
        figure, axes = pyplot.subplots(figsize=(6.7, 3.4))
        for (value, cases), colour in zip(sample.groups(group_by), colours()):
            xs, estimates = [], []
            for x in sample.values_of(against):
                values = sample.numbers(measure, cases & (sample.columns[against] == x))
                if len(values) > 0:
                    single = statistics.Interval(float(values[0]), math.nan, math.nan)
                    xs.append(x)
                    estimates.append(statistics.mean(values) if len(values) > 1 else single)
            middle = numpy.array([e.value for e in estimates]) * factor
            half = numpy.array([e.half_width for e in estimates]) * factor
            label_of_group = None if group_by is None else group_label(group_by, value)
            axes.plot(xs, middle, "o-", ms=3, lw=1, color=colour, label=label_of_group)
            many = numpy.isfinite(half)  # a single case has no interval
            axes.errorbar(numpy.array(xs)[many], middle[many], half[many], fmt="none", lw=1, capsize=2, ecolor=colour)
        axes.set(xlabel=label_of(against, is_parameter=True)[0], ylabel="mean of " + label)
        if group_by is not None:
            axes.legend(frameon=False, fontsize=7)
        return save(figure, folder, f"means-{measure}")


def outcome_map(sample, over, folder):
    """The most frequent outcome over two parameters; its share of the cell's cases where it is not all."""
    xs, ys = sample.values_of(over[0]), sample.values_of(over[1])
    if len(xs) < len(ys):
        over, xs, ys = over[::-1], ys, xs
    outcomes = sample.columns["outcome"]
    with pyplot.rc_context({**STYLE, "axes.grid": False}):
        figure, axes = pyplot.subplots(figsize=(6.7, max(1.6, 0.9 + 0.28 * len(ys))))
        for i, x in enumerate(xs):
            for k, y in enumerate(ys):
                here = outcomes[(sample.columns[over[0]] == x) & (sample.columns[over[1]] == y)].tolist()
                if not here:
                    continue
                word = max(OUTCOMES, key=here.count)
                share = here.count(word) / len(here)
                axes.add_patch(
                    pyplot.Rectangle((i - 0.5, k - 0.5), 1, 1, color=OUTCOMES[word], alpha=0.25 + 0.75 * share, lw=0)
                )
                axes.add_patch(pyplot.Rectangle((i - 0.5, k - 0.5), 1, 1, fill=False, edgecolor="white", lw=0.6))
                if share < 1 and len(xs) <= 25:
                    axes.text(i, k, f"{100 * share:.0f}", ha="center", va="center", fontsize=6)
        step = max(1, len(xs) // 20)
        axes.set_xticks(range(0, len(xs), step), [in_words(x) for x in xs[::step]], rotation=0 if len(xs) <= 12 else 90)
        axes.set_yticks(range(len(ys)), [in_words(y) for y in ys])
        axes.set(
            xlim=(-0.5, len(xs) - 0.5),
            ylim=(-0.5, len(ys) - 0.5),
            xlabel=label_of(over[0], is_parameter=True)[0],
            ylabel=label_of(over[1], is_parameter=True)[0],
        )
        marks = [pyplot.Rectangle((0, 0), 1, 1, color=colour) for word, colour in OUTCOMES.items() if word in outcomes]
        axes.legend(
            marks,
            [word for word in OUTCOMES if word in outcomes],
            frameon=False,
            fontsize=7,
            ncols=4,
            loc="lower left",
            bbox_to_anchor=(0, 1),
        )
        return save(figure, folder, "outcomes")
