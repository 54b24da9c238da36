"""The picture of a calibration: mean and standard deviation of each test, measured, as computed, calibrated."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SERIES = (
    ("measured_kN", "measured", "black", "s"),
    ("as_computed_kN", "as computed", "#56b4e9", "o"),
    ("calibrated_kN", "calibrated", "#d55e00", "D"),
)


def draw(rows, found, title, path):
    plt.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(figsize=(4.7, 3.4), constrained_layout=True)
    for k, (key, label, colour, marker) in enumerate(SERIES):
        for is_predicted in (False, True):
            its = [(i, row) for i, row in enumerate(rows)
                   if (key == "calibrated_kN" and not row["is_fitted"]) == is_predicted]
            if not its:
                continue
            axes.errorbar(
                [i + 0.2 * (k - 1) for i, _ in its],
                [row[key][0] for _, row in its],
                yerr=[row[key][1] for _, row in its],
                fmt=marker,
                color=colour,
                markerfacecolor="white" if is_predicted else colour,
                markersize=4,
                linewidth=1,
                capsize=2,
                label="calibrated, test not used" if is_predicted else label,
            )
    names = [f"{row['test']}\n{row['thickness_m']:g} m\n{row['speed_m_per_s']:g} m/s" for row in rows]
    axes.set_xticks(range(len(rows)), names)
    load, radius = found.factors
    words = (f"load × {load:.2f} ({found.low[0]:.2f}–{found.high[0]:.2f}), "
             f"cusp radius × {radius:.2f} ({found.low[1]:.2f}–{found.high[1]:.2f})")
    axes.set(ylabel="resistance, mean ± standard deviation [kN]", ylim=(0, None), title=f"{title}, calibrated\n{words}")
    axes.legend(frameon=False, fontsize=7)
    figure.savefig(path, dpi=200)
    plt.close(figure)
