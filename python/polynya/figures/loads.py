"""The figure "loads": surge, sway and yaw on every ship and structure over time, with marks for the cusps and splits of
each."""
from __future__ import annotations

import dataclasses
import itertools

import numpy
from matplotlib.patches import Patch, StepPatch

from .page import Page, Sheet
from .subjects import all_labelled, mark_fractures, once, subjects_of

# Components of a load, one panel each, with the unit in the column's name.
COMPONENTS = (("surge", "N"), ("sway", "N"), ("yaw", "Nm"))
# Colours of the first (in front) and the second of the loads that are drawn together; they also differ in greyscale.
# chosen() returns at most as many loads.
FRONT, BEHIND = "#000000", "#56b4e9"
# Width on paper of a stretch of time, of which only the largest and the smallest value are drawn [mm]. It is about the
# width of the drawn line (0.25 pt): smaller stretches only make larger files, larger ones look like steps.
STRETCH = 0.1


@dataclasses.dataclass(frozen=True)
class Load:
    """A measure of the load (docs/theory/forces.md), with the columns of forces.csv for surge, sway and yaw."""

    middle: str  # part of the column's name between component and unit, such as "_max"
    words: str  # text in the legend

    # Returns the name of its column for one of COMPONENTS: "surge_max_N".
    def column(self, component, unit):
        return f"{component}{self.middle}_{unit}"


def chosen(run, choice):
    """The loads that the value `choice` of `--load` names, the one that is drawn in front first. Empty if the run has
    no load of that kind: "ships" with a single hull, or "j-over-tau-c" if another model splits floes. The words state
    the recording interval [s], rounded to whole time steps as in the run."""
    scene = run.scene
    step = scene["time"]["step_s"]
    interval = max(1, round(scene["record"]["forces_interval_s"] / step)) * step
    mean, largest = f"mean over {interval:.6g} s", "largest single step (depends on the step)"
    found = {"mean": [Load("", mean)], "max": [Load("_max", largest)]}
    found["true"] = found["mean"] + found["max"]
    if len(run.ship_names) > 1:
        found["ships"] = [Load("_from_ships", mean), Load("_from_ships_max", largest)]
    if scene.get("fracture", {}).get("splitting", {}).get("model") == "michel":
        found["j-over-tau-c"] = [Load("_j_over_tau_c", r"$j/\tau_c$ of the paper")]
    return found.get(choice, [])


def why_not(run, choice):
    """Message that says why a run has no load of the kind `choice` ("ships" or "j-over-tau-c"); the other kinds are in
    every run."""
    what = "does not split floes by j/tau_c (fracture.splitting.model michel)"
    if choice == "ships":
        what = "has one ship and no structure"
    return f"--load {choice}: {run.folder} {what}"


def prefixed(most):
    """Returns (factor, prefix) of the unit for values up to `most`: (1e6, "M") from 1e6 on, and so on; (1, "") below
    1000. Values are divided by the factor."""
    return next(((factor, name) for factor, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")) if most >= factor), (1, ""))


def envelope(times, values, start, end, stretches):
    """Divides the time from `start` to `end` [s] into equal stretches. Returns their limits, and in each the smallest
    and the largest of its values and 0, so that no peak is lost and the area between them reaches the axis. A value
    belongs to the stretch that ends at or after its time; values that are not finite are left out. A stretch without
    values has 0 and 0."""
    edges = numpy.linspace(start, end, stretches + 1)
    low, high = numpy.zeros(stretches), numpy.zeros(stretches)
    is_number = numpy.isfinite(values)
    here = numpy.clip(numpy.searchsorted(edges, times[is_number], side="left") - 1, 0, stretches - 1)
    numpy.minimum.at(low, here, values[is_number])
    numpy.maximum.at(high, here, values[is_number])
    return edges, low, high


def scale_of(subjects, loads, component, unit):
    """Limits (low, high) of the scale that holds 0 and all values of a component [N or N m], with room for the marks of
    fractures above: 20 % of the range, and 3 % below. If all values are 0 or missing, the range is that from -1 to
    1."""
    values = [subject.columns(load.column(component, unit))[0] for subject in subjects for load in loads]
    values = numpy.concatenate([[0.0], *values])
    values = values[numpy.isfinite(values)]
    low, high = values.min(), values.max()
    if low == high:
        low, high = -1.0, 1.0
    return low - 0.03 * (high - low), high + 0.2 * (high - low)


def draw(runs, page=Page(), choice="true"):
    """Draws a column of panels for each ship and structure, with one scale each for surge, sway and yaw. `choice` is
    the value of --load, and the scene of the first run decides which loads it has. A run without one of their columns
    gets an empty panel. Returns the matplotlib figure, or None if there is nothing to draw: no ship or structure, no
    duration, or no such load."""
    runs = all_labelled(runs)
    subjects = subjects_of(runs)
    loads = chosen(runs[0].run, choice) if subjects else []
    if not loads:
        return None
    source = "other ships and structures" if choice == "ships" else "ice"
    target = "ships and structures" if len(subjects) > len(runs) else "the ship"
    caption = "In the ship's frame: surge forward, sway to port, yaw counter-clockwise."
    scales = [scale_of(subjects, loads, component, unit) for component, unit in COMPONENTS]
    forces = prefixed(max(max(-low, high) for low, high in scales[:2]))  # surge and sway use one unit
    prefixes = [forces, forces, prefixed(max(map(abs, scales[2])))]
    with Sheet(page, f"Load of {source} on {target}", caption) as sheet:
        columns = page.columns_for(len(subjects))
        groups = -(-len(subjects) // columns)
        height = page.row_height(3 * groups, 31)
        grid = sheet.panels(3 * groups, columns)
        handles, number = [], 0
        for group, k, column in itertools.product(range(groups), range(3), range(columns)):
            axes, i = grid[3 * group + k][column], group * columns + column
            if i >= len(subjects):
                axes.remove()
                continue
            (component, unit), (low, high), (factor, prefix) = COMPONENTS[k], scales[k], prefixes[k]
            handles += draw_panel(axes, subjects[i], loads, (component, unit), factor, page)
            axes.set(xlim=(subjects[i].of.start, subjects[i].of.end), ylim=(low / factor, high / factor))
            sheet.title_panel(axes, number, 3 * len(subjects), subjects[i].name if k == 0 else "",
                              (page.width - 16 * page.style.scale) / columns - 2 * page.style.scale)
            label(axes, is_left=column == 0, is_lowest=k == 2)
            if column == 0:
                sheet.label_y(axes, f"{component}, {prefix}{'N m' if unit == 'Nm' else unit}", height)
            number += 1
        shown = [Patch(color=colour, label=load.words) for load, colour in zip(loads, (FRONT, BEHIND))]
        return sheet.finish(3 * groups * height + groups * 8 * page.style.scale, shown + once(handles))


def draw_panel(axes, subject, loads, component, factor, page):
    """Draws the loads of one component, (name, unit), divided by `factor`, and the marks of fractures. `loads` has at
    most two, the first of which is drawn in front. Returns the legend entries of the marks."""
    times, *values = subject.columns("t_s", *(load.column(*component) for load in loads))
    stretches = max(100, int(0.8 * page.width / STRETCH / page.style.scale))
    for of, colour in reversed(list(zip(values, (FRONT, BEHIND)))):
        edges, low, high = envelope(times, of / factor, subject.of.start, subject.of.end, stretches)
        stairs = StepPatch(high, edges, baseline=low, fill=True, color=colour, linewidth=0.25 * page.style.scale)
        axes.add_artist(stairs)  # without rescaling, which would take half a second, because the scale is already set
    axes.axhline(0, color="#000000", linewidth=0.4 * page.style.scale)
    return mark_fractures(axes, subject, page.style.scale)


def label(axes, is_left, is_lowest):
    """Labels the ticks and the time axis of a panel. Scales are common, so numbers of the y axis are only at the left
    and the name of the time axis only at the lowest panel."""
    axes.locator_params(axis="y", nbins=4)
    axes.locator_params(axis="x", nbins=5)
    axes.tick_params(labelleft=is_left, labelbottom=is_lowest)
    if is_lowest:
        axes.set_xlabel("time, s")
