"""The picture of a curve: speed over thickness, with published formulas and reported speeds for comparison."""
import matplotlib

matplotlib.use("Agg")
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

from ..figures.page import Page, Sheet  # noqa: E402
from ..files import naming  # noqa: E402
from ..formulas import KNOT  # noqa: E402
from .curve import VALIDATED_THICKNESS, formula_words  # noqa: E402

# Half of the 95 % interval over the standard error of a mean speed, by Student's distribution with 5 degrees of
# freedom: the error is estimated from level_ice.BLOCKS = 6 parts of the course.
STUDENT = 2.571

# (name of the formula in the rows, name in the legend, line style). The shaded band lies between their speeds.
FORMULAS = (
    ("lindqvist", "Lindqvist 1989", "-"),
    ("riska", "Riska 1997", "--"),
    ("spencer_jones", "Spencer, Jones 2001", ":"),
)
BLUE, RED = "#0072b2", "#d55e00"  # colours of simulated points, and of their warnings and design points
WIDTH, HEIGHT = 130, 75  # width of the page, height of the panel [mm]
# Range of thickness shown on each side of a single one, as a fraction of it. Without it the formulas would be points.
AROUND = 0.3
POINTS = 40  # number of thicknesses for which the formulas are drawn; fewer: their lines have visible corners
# Marks: points that are not supported are hollow, those beyond all formulas have a square around them as well, and
# design points are triangles.
THICK = {"marker": "o", "markersize": 3.5, "color": BLUE, "markerfacecolor": "white", "linestyle": "none"}
BEYOND = {"marker": "s", "markersize": 7, "color": RED, "markerfacecolor": "none", "linestyle": "none"}
REPORTED = {"marker": "^", "markersize": 5, "color": RED, "linestyle": "none"}


def thicknesses_of(rows):
    """Thicknesses for which the formulas are drawn [m]: from the thinnest to the thickest row, and around a single one.
    There must be a row."""
    every = [row["thickness_m"] for row in rows]
    low, high = min(every), max(every)
    if low == high:
        low, high = (1 - AROUND) * low, (1 + AROUND) * high
    return [low + (high - low) * k / (POINTS - 1) for k in range(POINTS)]


def formula_rows(curve, rows):
    """Speeds by the formulas over the range of the figure, as rows with the keys thickness_m and <formula>_m_per_s, as
    in the rows of a Curve."""
    return [{"thickness_m": h, **{f"{name}_m_per_s": v for name, v in curve.formula_speeds(h).items()}}
            for h in thicknesses_of(rows)]


def draw_formulas(axes, rows):
    """Draws the formulas and their band; at a single thickness as marks. Returns the legend entries."""
    thickness = [row["thickness_m"] for row in rows]
    speeds = [[row[f"{name}_m_per_s"] for name, _, _ in FORMULAS] for row in rows]
    mark = "_" if len(rows) == 1 else ""
    axes.fill_between(thickness, list(map(min, speeds)), list(map(max, speeds)), color="0.9", linewidth=0)
    handles = [Patch(color="0.9", label="band of the formulas")]
    for name, label, dash in FORMULAS:
        style = {"linestyle": dash, "color": "0.35", "linewidth": 0.9, "marker": mark}
        axes.plot(thickness, [row[f"{name}_m_per_s"] for row in rows], **style)
        handles.append(Line2D([], [], label=label, **style))
    return handles


def draw_points(axes, rows):
    """Draws the points of the simulation with their marks and the interval of the run's scatter (95 % by Student's
    distribution). The legend also states the share of Lindqvist's formula in the resistance. Returns
    the legend entries."""
    thickness, speed = ([row[key] for row in rows] for key in ("thickness_m", "speed_m_per_s"))
    scatter = [STUDENT * row["error_m_per_s"] for row in rows]
    of_points = axes.errorbar(thickness, speed, yerr=scatter, fmt="o-", color=BLUE, markersize=3.5, linewidth=1.2,
                              capsize=2, label="Polynya, ± 95 % of the run's own scatter")
    handles = [of_points]
    if words := formula_words(rows):
        handles.append(Line2D([], [], linestyle="none", label=words))
    thicker = [row for row in rows if not row["is_in_validated_range"]]
    beyond = [row for row in rows if row["beyond_formulas"]]
    for marked, words, style in ((thicker, f"thicker than {VALIDATED_THICKNESS:g} m: outside validation", THICK),
                                 (beyond, "", THICK), (beyond, "outside the band of the formulas", BEYOND)):
        if marked:
            at = [[row[key] for row in marked] for key in ("thickness_m", "speed_m_per_s")]
            axes.plot(*at, zorder=3, **style)
            handles += [Line2D([], [], label=words, **style)] if words else []
    return handles


def draw_reported(axes, reported):
    """Draws the design points: speeds in ice that the ship is reported to reach at least. `reported` are rows with
    thickness_m and speed_m_per_s. Returns a list with the legend entry, empty without points."""
    if not reported:
        return []
    axes.plot([point["thickness_m"] for point in reported], [point["speed_m_per_s"] for point in reported], **REPORTED)
    return [Line2D([], [], label="design points: at least", **REPORTED)]


def draw(rows, title, reported, path, of_formulas=None):
    """Writes the picture of the rows of a Curve in the format of the path's extension. The first line of `title` is the
    heading, the second a caption below it. `reported` are the design points, which may be none. `of_formulas` are rows
    of the formulas' speeds (formula_rows); if not given, the formulas are drawn at the points only. A file of that name
    is replaced. Raises OSError with the path if it cannot be written."""
    title, _, caption = title.partition("\n")
    page = Page(given_width=WIDTH)
    with Sheet(page, title, caption) as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        handles = draw_formulas(axes, of_formulas or rows) + draw_points(axes, rows) + draw_reported(axes, reported)
        of_right = [row["thickness_m"] for row in (of_formulas or rows)] + [r["thickness_m"] for r in reported]
        low, high = min(of_right), max(of_right)
        margin = 0.03 * (high - low) or AROUND * high
        axes.set(xlabel="thickness of level ice, m", ylabel="speed, m/s", xlim=(low - margin, high + margin),
                 ylim=(0, 1.08 * axes.get_ylim()[1]))
        right = axes.secondary_yaxis("right", functions=(lambda v: v / KNOT, lambda v: v * KNOT))
        right.set_ylabel("speed, kn")
        right.tick_params(labelsize=page.style.small)
        figure = sheet.finish(HEIGHT, handles)
    with naming(path):
        figure.savefig(path, dpi=200)
