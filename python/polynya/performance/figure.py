"""The picture of a curve: speed over thickness, with published formulas and reported speeds for comparison."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from ..files import naming  # noqa: E402
from ..formulas import KNOT  # noqa: E402
from .curve import VALIDATED_THICKNESS, formula_words  # noqa: E402

FORMULAS = (
    ("lindqvist", "Lindqvist 1989", "-"),
    ("riska", "Riska 1997", "--"),
    ("spencer_jones", "Spencer, Jones 2001", ":"),
)


def draw(rows, title, reported, path):
    """Writes the picture in the format of the path's extension."""
    thickness = [row["thickness_m"] for row in rows]
    plt.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(figsize=(4.7, 3.4), constrained_layout=True)
    band = [[row[f"{name}_m_per_s"] for name, _, _ in FORMULAS] for row in rows]
    axes.fill_between(
        thickness,
        [min(b) for b in band],
        [max(b) for b in band],
        color="0.9",
        linewidth=0,
        label="band of the formulas",
    )
    for name, label, style in FORMULAS:
        axes.plot(thickness, [row[f"{name}_m_per_s"] for row in rows], style, color="0.35", linewidth=0.9, label=label)
    axes.errorbar(
        thickness,
        [row["speed_m_per_s"] for row in rows],
        yerr=[1.96 * row["error_m_per_s"] for row in rows],
        fmt="o-",
        color="#0072b2",
        markersize=3.5,
        linewidth=1.2,
        capsize=2,
        label="Polynya, ± 95 % of the run's own scatter",
    )
    if words := formula_words(rows):
        axes.plot([], [], linestyle="none", label=words)
    thicker = [row for row in rows if not row["is_in_validated_range"]]
    beyond = [row for row in rows if row["beyond_formulas"]]
    for marked, words, style in (
        (thicker, f"thicker than {VALIDATED_THICKNESS:g} m: outside validation",
         {"marker": "o", "markersize": 3.5, "color": "#0072b2", "markerfacecolor": "white"}),
        (beyond, None, {"marker": "o", "markersize": 3.5, "color": "#0072b2", "markerfacecolor": "white"}),
        (beyond, "outside the band of the formulas",
         {"marker": "s", "markersize": 7, "color": "#d55e00", "markerfacecolor": "none"}),
    ):
        if marked:
            at = [[row[key] for row in marked] for key in ("thickness_m", "speed_m_per_s")]
            axes.plot(*at, linestyle="none", zorder=3, label=words, **style)
    if reported:
        axes.plot(
            [r["thickness_m"] for r in reported],
            [r["speed_m_per_s"] for r in reported],
            "^",
            color="#d55e00",
            markersize=5,
            linestyle="none",
            label="design points: at least",
        )
    axes.set(xlabel="thickness of level ice [m]", ylabel="speed [m/s]", ylim=(0, None), title=title)
    right = axes.secondary_yaxis("right", functions=(lambda v: v / KNOT, lambda v: v * KNOT))
    right.set_ylabel("[kn]")
    axes.legend(frameon=False, fontsize=7)
    with naming(path):
        figure.savefig(path, dpi=200)
    plt.close(figure)
