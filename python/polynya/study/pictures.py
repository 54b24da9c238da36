"""Pictures of a study's page, drawn with matplotlib as SVG and PNG: exceedance of peaks, means, and a map of outcomes.
`sample` is a sample.Sample, `folder` the pathlib.Path of the pictures' folder, `measure` and `group_by` are names of
its columns. A picture that exists is replaced."""
import math
import re

import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from .. import statistics
from ..figures import page
from .sample import fits_of, refuted

# Colours of groups in their order; people with impaired colour vision can distinguish them [Okabe2008]. Their number is
# that of the groups with fits and legend entries.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999933")
GREY = "#bbbbbb"  # colour of groups beyond the number of COLOURS, which have no fits and no legend entry of their own
# Colours of the outcomes of measures.outcome, all of which must be here. If several are most frequent, the first one of
# them is drawn.
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
)  # probabilities of exceedance at ticks of the probability paper
# Unit at the end of a measure's name -> (size of the drawn unit in that unit, name of the drawn unit), so that loads in
# N are drawn in MN. Others are drawn as they are.
SCALES = {"N": (1e6, "MN"), "Nm": (1e6, "MN m"), "J": (1e6, "MJ"), "m": (1, "m"), "s": (1, "s")}


def save(figure, folder, name):
    """Writes name.svg and name.png into the folder, which it makes; the folder above must exist. Returns the name of
    the SVG, without the folder. Raises OSError with the file's name if one cannot be written."""
    folder.mkdir(exist_ok=True)
    list(page.save(figure, str(folder / name), ("svg", "png"), 200))
    return name + ".svg"


def label_of(measure, is_parameter=False):
    """Returns a label such as "resistance peak [MN]" for the name of a measure with its unit, and the factor by which
    values are multiplied to be in the label's unit. For the path of a parameter the label is its last part in the unit
    of the scene, and the factor 1. The index of a list becomes x, y or the number: "position x [m]". A name that ends
    with no known unit is the label without a unit."""
    name, _, index = measure.rsplit(".", 1)[-1].partition("[")
    axis = {"0]": " x", "1]": " y"}.get(index, f" {index.rstrip(']')}" if index else "")
    for unit in sorted(("m_per_s", "deg", "Pa", *SCALES), key=len, reverse=True):
        if name.endswith("_" + unit):
            plain = (1, {"m_per_s": "m/s", "deg": "°", "Nm": "N m"}.get(unit, unit))
            scale, shown = plain if is_parameter else SCALES.get(unit, plain)
            return f"{name.removesuffix('_' + unit).replace('_', ' ')}{axis} [{shown}]", 1 / scale
    return name.replace("_", " ") + axis, 1.0


def name_of(measure):
    """The name of a measure in titles and captions: its label without the unit."""
    return label_of(measure)[0].partition(" [")[0]


def label_for(measure, values):
    """Label and factor of label_of for these values [SI]; forces, moments and energies that are all below 0.1 of the
    label's unit are in kN, kN m and kJ."""
    label, factor = label_of(measure)
    largest = numpy.nanmax(numpy.abs(values), initial=0) * factor
    return (label.replace("[M", "[k"), 1e3 * factor) if "[M" in label and largest < 0.1 else (label, factor)


def in_words(value, digits=6):
    """A number as text with that many significant digits; with the default, whole numbers have all their digits. An
    exponent is used only below 1e-4 and from 1e12 on. Other values, also texts and NaN, are converted by str(), in
    which the word "inf" becomes ∞."""
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        return re.sub(r"\binf\b", "∞", str(value))
    if value and not 1e-4 <= abs(value) < 1e12:
        return f"{value:.{digits}g}"
    if digits == 6 and value == int(value):
        return str(int(value))
    return numpy.format_float_positional(value, precision=digits, fractional=False, trim="-")


def group_label(name, value):
    """Label of the group in which the parameter `name` has a value: "thickness 0.4 m", "scene fig4a"."""
    label, _ = label_of(name, is_parameter=True)
    words, _, unit = label.partition(" [")
    return f"{words} {in_words(value)} {unit.rstrip(']')}".rstrip()


def lines_of(sample, group_by):
    """[(value, cases, colour)] of the groups by a parameter, or of all cases if it is None. `cases` is a mask. Groups
    beyond the number of colours are grey. The groups are in the order of their values."""
    groups = sample.groups(group_by)
    return [(value, cases, COLOURS[k] if k < len(COLOURS) else GREY) for k, (value, cases) in enumerate(groups)]


def more(lines):
    """List with the legend entry of the grey groups; empty if there are none."""
    rest = sum(colour == GREY for _, _, colour in lines)
    return [Line2D([], [], color=GREY, label=f"{rest} more groups")] if rest else []


def reduced(p):
    """Gumbel's reduced variate −ln(−ln(1 − p)) for a probability of exceedance p. As the y coordinate, it makes his
    distribution a straight line. p is a number or an array between 0 and 1; 0 gives ∞ and 1 gives −∞."""
    return -numpy.log(-numpy.log1p(-numpy.asarray(p)))


def draw_fits(axes, values, factor, lowest, colour):
    """Draws lines of both fits to the values, dotted if they are refuted, from the probability of exceedance 0.995 down
    to half of `lowest`, but at least to 0.02, so that also a small group shows the value exceeded in 2 % of the runs.
    `values` are in the measure's unit, and `factor` converts to the label's. Returns {text for the legend: line style};
    a fit that failed, for example for too few values, is left out."""
    found = {}
    for name, dash in (("gumbel", "-"), ("weibull", "--")):
        fitted = fits_of(values)[name]
        if not isinstance(fitted, str):
            p = numpy.geomspace(min(0.02, lowest / 2), 0.995, 200)
            is_refuted = bool(refuted(fitted))
            axes.plot(fitted.level_of(p) * factor, reduced(p), ":" if is_refuted else dash, color=colour)
            found["refuted fit" if is_refuted else name.capitalize()] = ":" if is_refuted else dash
    return found


def exceedance(sample, measure, group_by, folder):
    """Draws the values of a measure and both fits on Gumbel's probability paper, on which his distribution is a
    straight line, with a colour for each group. Grey groups have no fit, and a group without values is left out.
    Returns the name of the SVG. Drawing takes long, because each fit needs a bootstrap."""
    label, factor = label_for(measure, sample.columns[measure])
    lowest, handles, dashes = 0.5, [], {}
    lines = lines_of(sample, group_by)
    with page.Sheet(page.Page(), f"How often the {name_of(measure)} of a run exceeds a value") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        for value, cases, colour in lines[::-1]:
            values = sample.numbers(measure, cases)
            if len(values) == 0:
                continue
            ordered, above = statistics.exceedance(values)
            lowest = min(lowest, above[-1])
            axes.plot(ordered * factor, reduced(above), "o", ms=3, color=colour)
            if colour != GREY:
                dashes.update(draw_fits(axes, values, factor, above[-1], colour))
                named = group_label(group_by, value) if group_by else "all cases"
                handles.insert(0, Line2D([], [], linestyle="", marker="o", ms=3, color=colour,
                                         label=page.plain(f"{named} ({len(values)})")))
        ticks = [p for p in PAPER if p >= lowest / 2.1]
        axes.set_yticks(reduced(ticks), [f"{p:g}" for p in ticks])
        axes.set(xlabel=label, ylabel="probability of exceedance in one run")
        axes.grid(color="#dddddd", linewidth=0.5)
        handles += more(lines)
        handles += [Line2D([], [], color="#666666", linestyle=dash, label=name)
                    for name, dash in sorted(dashes.items())]
        return save(sheet.finish(85, handles), folder, f"exceedance-{measure}")


def means(sample, measure, against, group_by, folder):
    """Draws means of a measure with 95 % intervals over the parameter `against`, with a line for each group. Returns
    the name of the SVG. A single case is a point without an interval; a value of `against` without cases has no point.
    If `group_by` is `against`, all cases are one line."""
    label, factor = label_for(measure, sample.columns[measure])
    lines, handles = lines_of(sample, None if group_by == against else group_by), []
    with page.Sheet(page.Page(), f"Mean of the {name_of(measure)}", "with its 95 % interval") as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        for value, cases, colour in lines[::-1]:
            xs, estimates = [], []
            for x in sample.values_of(against):
                values = sample.numbers(measure, cases & (sample.columns[against] == x))
                if len(values) > 0:
                    single = statistics.Interval(float(values[0]), math.nan, math.nan)
                    xs.append(x)
                    estimates.append(statistics.mean(values) if len(values) > 1 else single)
            middle = numpy.array([e.value for e in estimates]) * factor
            half = numpy.array([e.half_width for e in estimates]) * factor
            style = "o-" if sample.has_numbers(against) else "o"  # words have no values between them
            axes.plot(xs, middle, style, ms=3, lw=1, color=colour)
            many = numpy.isfinite(half)  # a single case has no interval
            axes.errorbar(numpy.array(xs)[many], middle[many], half[many], fmt="none", lw=1, capsize=2, ecolor=colour)
            if value is not None and colour != GREY:
                handles.insert(0, Line2D([], [], marker="o", ms=3, color=colour,
                                         label=page.plain(group_label(group_by, value))))
        axes.set(xlabel=label_of(against, is_parameter=True)[0])
        if not sample.has_numbers(against) and sum(len(str(x)) for x in sample.values_of(against)) > 90:
            axes.tick_params(axis="x", rotation=90)
        axes.grid(color="#dddddd", linewidth=0.5)
        sheet.label_y(axes, "mean of " + label, 70)
        return save(sheet.finish(70, handles + more(lines)), folder, f"means-{measure}")


def outcome_map(sample, over, folder):
    """Draws the most frequent outcome over two parameters, the one with more values along x, with its fraction of the
    cell's cases if it is not all. `over` has the names of both parameters. Fractions are left out if there are more
    than 25 columns, because they would not fit; a cell without cases stays empty. Returns the name of the SVG. The
    table must have the column "outcome"."""
    xs, ys = sample.values_of(over[0]), sample.values_of(over[1])
    if len(xs) < len(ys):
        over, xs, ys = over[::-1], ys, xs
    outcomes = sample.columns["outcome"]
    with page.Sheet(page.Page(), "Outcomes of the cases", CAPTION) as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        for i, x in enumerate(xs):
            for k, y in enumerate(ys):
                here = outcomes[(sample.columns[over[0]] == x) & (sample.columns[over[1]] == y)].tolist()
                if here:
                    draw_cell(axes, i, k, here, is_numbered=len(xs) <= 25)
        step, step_y = max(1, len(xs) // 20), max(1, len(ys) // 30)
        words = [page.plain(in_words(x)) for x in xs[::step]]
        is_wide = sum(map(len, words)) > 90
        axes.set_xticks(range(0, len(xs), step), words, rotation=90 if is_wide else 0)
        axes.set_yticks(range(0, len(ys), step_y), [page.plain(in_words(y)) for y in ys[::step_y]])
        axes.set(xlim=(-0.5, len(xs) - 0.5), ylim=(-0.5, len(ys) - 0.5),
                 xlabel=label_of(over[0], is_parameter=True)[0], ylabel=label_of(over[1], is_parameter=True)[0])
        marks = [Patch(color=colour, label=word) for word, colour in OUTCOMES.items() if word in outcomes]
        height = 18 + min(160, 7 * len(ys)) + (12 + max(map(len, words)) if is_wide else 0)
        return save(sheet.finish(height, marks), folder, "outcomes")


# Caption of the map of outcomes: what draw_cell() draws.
CAPTION = "Outcome of most cases; paler, with its share, where it is not the outcome of all"


def draw_cell(axes, i, k, outcomes, is_numbered):
    """Draws the most frequent outcome of the cases in column i and row k of the map: paler the fewer cases have it,
    with its percentage if `is_numbered` and if not all have it."""
    word = max(OUTCOMES, key=outcomes.count)
    share = outcomes.count(word) / len(outcomes)
    axes.add_patch(Rectangle((i - 0.5, k - 0.5), 1, 1, color=OUTCOMES[word], alpha=0.25 + 0.75 * share, lw=0))
    axes.add_patch(Rectangle((i - 0.5, k - 0.5), 1, 1, fill=False, edgecolor="white", lw=0.6))
    if share < 1 and is_numbered:
        axes.text(i, k, f"{100 * share:.0f}", ha="center", va="center", fontsize=6)
