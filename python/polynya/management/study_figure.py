"""Figures of a study of ice management: patterns ranked by measures, and measures over a parameter. A pattern is a way
in which icebreakers sail; the patterns are compared in conditions, such as speeds of drift, over several fields of ice.
`found` is management.study.Found."""
from matplotlib.lines import Line2D

from ..figures.page import Sheet, plain
from ..naming import UNITS, short
from . import cautions, ranking
from .figure import COLOURS
from .study import MEASURES, UNMANAGED

# Styles of the lines of patterns: solid with circles in each colour, then dashed with squares. draw_study() draws at
# most as many patterns as there are styles.
LINES = [{"color": colour, "marker": mark, "linestyle": dash}
         for dash, mark in (("-", "o"), ("--", "s")) for colour in COLOURS]
# Measures that draw_study() shows, in its order, and their words on the axes. draw_ranking() uses these words too, so
# every measure of study.MEASURES must be among them.
SHOWN = {
    "management_ice_load_mean_N": "mean load of the ice",
    "management_ice_load_q99_N": "load of the ice exceeded 1 % of the time",
    "management_mooring_load_mean_N": "mean load of the mooring",
    "management_mooring_load_q99_N": "load of the mooring exceeded 1 % of the time",
    "management_largest_at_body_m": "largest floe that arrives",
    "management_mean_size_at_body_m": "mean floe size at the body, by area",
    "management_hit_s": "time with floes of the size on the body",
    "management_managed_width_m": "managed width",
}
MOST_NOTES = 4  # largest number of warnings below a figure; the others are only in the output of the command
# The number of patterns in a panel of the ranking is what the page has room for, but within these limits. If the page
# has room for fewer than the first, it becomes taller; more than the second would be hard to read, even on a tall page.
FEWEST_PATTERNS, MOST_PATTERNS = 8, 24
OF_PANEL = 14  # height of a panel of the ranking without its patterns: title, axis and its label [mm]
# With more points on the x axis, intervals are drawn as bands without marks, because bars would overlap. At most as
# many patterns as there are colours are then drawn.
MANY = 12
# Height of a pattern in the ranking, with its words and its interval below them [mm]. Smaller: the words of one pattern
# touch the interval of the one above.
ROW = 5.2
HIT = "#d55e00"  # colour of a pattern whose ship hit the protected body
# The axis of a ranking ends at this multiple of the largest mean; wider intervals end in an arrow. Larger: wide
# intervals are seen whole, but means lie closer together.
WIDEST = 4


def scaled(measure, most):
    """Returns the size and the name of the unit in which a measure is drawn, from the end of its name: for forces, of
    which the largest is `most` [N], one of N, kN and MN; otherwise 1 and the unit of the name. Values are divided by
    the size."""
    unit = measure.rpartition("_")[2]
    if unit == "N":
        return next(((factor, name) for factor, name in ((1e6, "MN"), (1e3, "kN")) if most >= factor), (1, "N"))
    return 1, unit


def end_of_axis(places, factor):
    """End of the axis of a ranking, in units of `factor`: near the largest end of an interval, but no farther than
    WIDEST times the largest mean, so that means stay apart beside intervals that are far wider. `places` are
    ranking.Place, at least one; 1 if all means are 0."""
    means = [place.mean.value / factor for place in places]
    ends = [mean + (place.mean.half or 0) / factor for mean, place in zip(means, places)]
    return min(1.05 * max(ends), WIDEST * max(means)) or 1


def fitted(sheet, name, ending, width):
    """A name with its ending, with the name shortened in the middle until both are at most `width` wide [mm], but not
    to fewer than 5 characters."""
    most, words = len(name), plain(name) + ending
    while sheet.width_of(words, sheet.page.style.small) > width and most > 5:
        most -= 1
        words = plain(short(name, most)) + ending
    return words


def draw_place(axes, place, y, factor, page, hits, words):
    """Draws mean and interval of a pattern in its row `y` of the ranking, with `words` above: its name, and its hits of
    a ship if it has some. An interval ends at 0, below which none of the measures lies, or at the end of the axis, with
    an arrow. A pattern with a hit (`hits` from cautions.hits_of(), or None) has a cross in the colour HIT; the pattern
    without management is grey. `factor` is the size of the unit, from scaled(). With a single field there is no
    interval."""
    is_hit, most = bool(hits and hits.hit), axes.get_xlim()[1]
    colour = HIT if is_hit else "0.45" if place.name == UNMANAGED else COLOURS[0]
    mean, half, scale = place.mean.value / factor, (place.mean.half or 0) / factor, page.style.scale
    axes.errorbar(mean, y + 0.2, xerr=[[min(half, mean)], [min(half, most - mean)]], fmt="X" if is_hit else "o",
                  markersize=3 * scale, capsize=2 * scale, color=colour, linewidth=scale)
    if mean + half > most:
        axes.plot(most, y + 0.2, ">", color=colour, markersize=3.5 * scale, clip_on=False)
    axes.text(0.01, y - 0.25, words, fontsize=page.style.small, transform=axes.get_yaxis_transform(),
              verticalalignment="center", color=HIT if is_hit else "black", in_layout=False)


def bracket_alike(axes, places, scale):
    """Draws a bar at the right of each group of neighbouring patterns that do not differ significantly (ranking.alike).
    The axis is made longer for the bars. `scale` is that of the page's style."""
    names = [place.name for place in places]
    groups = ranking.alike(places)
    low, high = axes.get_xlim()
    axes.set_xlim(low, high + (high - low) * 0.04 * (len(groups) + 1))
    for k, group in enumerate(groups):
        ends = names.index(group[0]), names.index(group[-1])
        x = 1 - 0.03 * (k + 1) / (1 + 0.04 * (len(groups) + 1))
        axes.plot((x, x), (ends[0] - 0.05, ends[1] + 0.45), transform=axes.get_yaxis_transform(), color="0.35",
                  linewidth=1.6 * scale, solid_capstyle="butt")


def most_places(page, lines):
    """Largest number of patterns in a panel, so that `lines` rows of panels fit onto a page if possible, between
    FEWEST_PATTERNS and MOST_PATTERNS. 30 mm of the page are for heading and notes."""
    room = (page.style.tallest / page.style.scale - 30) / lines - OF_PANEL
    return max(FEWEST_PATTERNS, min(MOST_PATTERNS, int(room / ROW)))


def draw_places(sheet, axes, measure, condition, width, most):
    """Draws at most `most` patterns of one condition by one measure, best first, in a panel of `width` [mm]. Patterns
    without the measure are left out. Returns the number of ranked patterns that were not drawn."""
    page = sheet.page
    every = condition.ranked(measure)
    places = every[:most]
    factor, unit = scaled(measure, max((abs(place.mean.value) for place in places), default=0))
    axes.set_xlim(0, end_of_axis(places, factor) if places else 1)
    for y, place in enumerate(places):
        hits = cautions.hits_of(condition, place.name)
        ending = f" (hit in {hits.hit} of {hits.fields})" if hits and hits.hit else ""
        words = fitted(sheet, place.name, ending, width - 2 * page.style.scale)
        draw_place(axes, place, y, factor, page, hits, words)
    bracket_alike(axes, places, page.style.scale)
    axes.set(ylim=(max(len(places), 1) - 0.4, -0.6), yticks=[])
    axes.set_xlabel("\n".join(sheet.wrapped(f"{SHOWN[measure]}, {unit}", page.style.text, width)))
    axes.grid(axis="x", linewidth=0.4, color="0.9")
    axes.set_axisbelow(True)
    return len(every) - len(places)


def draw_ranking(found, page):
    """Draws, for each condition and measure, the patterns with their intervals, best first. Bars join patterns that do
    not differ significantly. As many conditions as fit onto a page are drawn, at least one; a note says how many
    conditions are missing, and the largest number of patterns that a panel lacks. `page` is a figures.page.Page.
    Returns the matplotlib figure, or None if nothing is ranked."""
    measures = [name for name in MEASURES if any(condition.ranked(name) for condition in found.conditions)]
    every = [condition for condition in found.conditions if any(condition.ranked(name) for name in measures)]
    if not every:
        return None
    columns = page.columns_for(len(measures))
    lines = -(-len(measures) // columns)
    most = most_places(page, lines)
    height = (OF_PANEL + ROW * max(2, min(len(found.patterns), most))) * page.style.scale
    drawn = every[:max(1, int((page.style.tallest - 30 * page.style.scale) / (height * lines)))]
    caption = "Means over fields of ice with Student's 95 % intervals; a bar joins what is not distinguishable"
    if cautions.contacts(found):
        caption += f"; cross: a ship hit {found.body}"
    serious = [*cautions.few_fields(found), *cautions.contacts(found)]
    width = page.width / columns - 8 * page.style.scale
    with Sheet(page, f"Patterns ranked: {plain(found.name)}", caption) as sheet:
        grid = sheet.panels(lines * len(drawn), columns)
        hidden = 0
        for k, condition in enumerate(drawn):
            panels = list(grid[k * lines:(k + 1) * lines].flat)
            for axes, measure in zip(panels, measures):
                hidden = max(hidden, draw_places(sheet, axes, measure, condition, width, most))
            for axes in panels[len(measures):]:
                axes.axis("off")
            grid[k * lines, 0].set_title(plain(condition.name), loc="left", fontsize=page.style.text, fontweight="bold")
        missing = [(len(every) - len(drawn), "conditions"), (hidden, "patterns")]
        note = [f"{count} more {what} are in management-ranking.csv." for count, what in missing if count > 0]
        note += [plain(sentence) for sentence in serious[:MOST_NOTES]]
        return sheet.finish(height * lines * len(drawn), notes=note)


def draw_line(axes, points, style, is_dense):
    """Draws the means of a pattern with their intervals, which are bands without marks if `is_dense`. `points` are (x,
    mean, half of the interval), at least one, in the units of the axes. `style` is one of LINES."""
    x, y, half = (list(column) for column in zip(*points))
    if not is_dense:
        axes.errorbar(x, y, yerr=half, **style, markersize=3, linewidth=1, capsize=2)
        return
    axes.plot(x, y, color=style["color"], linestyle=style["linestyle"])
    axes.fill_between(x, [a - b for a, b in zip(y, half)], [a + b for a, b in zip(y, half)], color=style["color"],
                      alpha=0.15, linewidth=0)


def draw_study(found, page):
    """Draws means with 95 % intervals of some measures over the parameter `found.against`, with a line for each
    pattern. Lines are shifted a little sideways, so that their intervals stay apart; bands are not. A note says how
    many patterns have no line. Returns the matplotlib figure, or None if there is no such parameter with at least two
    values, if other parameters vary too, or if no measure of SHOWN is there."""
    xs = [condition.x for condition in found.conditions]
    shown = [name for name in SHOWN if name in found.measures]
    if not found.against or len(set(xs)) < 2 or len(set(xs)) < len(xs) or not shown:
        return None
    columns = page.columns_for(len(shown))
    rows = -(-len(shown) // columns)
    is_dense = len(xs) > MANY
    named = found.patterns[:len(COLOURS) if is_dense else len(LINES)]
    rest = len(found.patterns) - len(named)
    note = [f"{rest} more patterns are in management.csv."] if rest > 0 else []
    title = f"Ice management: {plain(found.name)}"
    with Sheet(page, title, "Means over fields of ice with Student's 95 % intervals") as sheet:
        grid = sheet.panels(rows, columns)
        step = 0 if is_dense else 0.012 * (max(xs) - min(xs))
        for axes, measure in zip(grid.flat, shown):
            means = {name: [ranking.mean_of(c.values.get(measure, {}).get(name, {}).values())
                            for c in found.conditions] for name in named}
            most = max((abs(mean.value) for of in means.values() for mean in of if mean), default=0)
            factor, unit = scaled(measure, most)
            for k, name in enumerate(named):
                points = [(x + step * (k - 0.5 * len(named)), mean.value / factor, (mean.half or 0) / factor)
                          for x, mean in zip(xs, means[name]) if mean]
                if points:
                    draw_line(axes, points, LINES[k], is_dense)
            highest = max((mean.value + (mean.half or 0) for of in means.values() for mean in of if mean), default=0)
            axes.set(xlabel=words_of(found.against), ylim=(0, 1.08 * highest / factor or 1))
            sheet.label_y(axes, f"{SHOWN[measure]}, {unit}", page.row_height(rows, 48))
        for axes in list(grid.flat)[len(shown):]:
            axes.axis("off")
        handles = [Line2D([], [], label=plain(name), markersize=3, **LINES[k]) for k, name in enumerate(named)]
        return sheet.finish(page.row_height(rows, 52) * rows, handles, note)


def words_of(parameter):
    """Last name of a parameter with its unit: "drift, m/s" for water.drift_m_per_s[0]; without a known unit only the
    name."""
    label = parameter.rpartition(".")[2].partition("[")[0]
    for ending, unit in sorted(UNITS.items(), key=lambda item: -len(item[0])):
        if label.endswith("_" + ending):
            return f"{label.removesuffix('_' + ending).replace('_', ' ')}, {unit}"
    return label.replace("_", " ")
