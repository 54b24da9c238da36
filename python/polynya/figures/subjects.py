"""Subjects of figures: the ships and structures of runs, with names, colours, and the range of time that is drawn."""
from __future__ import annotations

import dataclasses

import numpy
from matplotlib.lines import Line2D

#: Colours of runs or subjects in their order: black, vermilion, sky blue, blue, purple, green. They can be told apart
#: by colour-blind readers [Okabe2008]. The first three also differ in greyscale.
COLOURS = ("#000000", "#d55e00", "#56b4e9", "#0072b2", "#aa4499", "#009e73")
DASHES = ("-", "--", "-.")  #: line styles; the next one is used when all colours have been used
CUSP, SPLIT = "#555555", "#d55e00"  #: colours of the marks of cusps and of splits


@dataclasses.dataclass(frozen=True)
class Labelled:
    """A run with its name and range of times in figures."""

    run: object  #: results.run.Run
    label: str  #: name in titles and legends
    start: float  #: first simulated time that is drawn [s]
    end: float  #: last simulated time that is drawn [s]; equal to `start` only for a run without a duration


def labelled(run, label=None, start=None, end=None):
    """Returns a run as Labelled, with the name of its scene and its whole time unless `label`, `start` or `end` [s] is
    given. Raises ValueError, with a message that names the options --from and --until, if a time is outside of the run
    or `start` is not before `end`. A run without a duration is accepted."""
    for word, time in (("--from", start), ("--until", end)):
        if time is not None and not run.start_time <= time <= run.end_time:
            raise ValueError(f"{word} {time:g}: {run.folder} goes from {run.start_time:g} to {run.end_time:g} s")
    start, end = run.start_time if start is None else start, run.end_time if end is None else end
    if start >= end and run.end_time > run.start_time:
        raise ValueError(f"--from {start:g} is not before --until {end:g}")
    return Labelled(run, run.name if label is None else label, start, end)


# Returns runs as Labelled. A run that already is Labelled keeps its name and times; any other gets the name of its
# scene and its whole time.
def all_labelled(runs):
    return [run if isinstance(run, Labelled) else labelled(run) for run in runs]


@dataclasses.dataclass(frozen=True)
class Subject:
    """A ship or structure of one of the runs; `ship` is its name in the scene."""

    of: Labelled
    ship: str

    @property
    def name(self):
        """Name in legends: that of the run, and also that of the ship if the run has several."""
        return self.of.label if len(self.of.run.ship_names) == 1 else f"{self.of.label}, {self.ship}"

    def columns(self, *names):
        """Returns these columns of forces.csv as arrays, for the rows of the ship within the range of times, both ends
        included. Units are those in the names. A column that a run of an older version does not have is NaN."""
        forces = self.of.run.force_columns
        rows = (forces["ship"] == self.ship) & (forces["t_s"] >= self.of.start) & (forces["t_s"] <= self.of.end)
        return [forces[name][rows] if name in forces else numpy.full(numpy.count_nonzero(rows), numpy.nan)
                for name in names]

    def fractures(self, kind):
        """Returns the times [s], within the range, at which the ship broke ice in one way: `kind` is "bend" for cusps
        or "split" for split floes."""
        events = self.of.run.event_columns
        times = events["t_s"]
        is_within = (times >= self.of.start) & (times <= self.of.end)
        return times[(events["kind"] == kind) & (events["ship"] == self.ship) & is_within]


def subjects_of(runs):
    """Returns all subjects of Labelled runs. A run without a duration is left out, because it has no curves."""
    return [Subject(run, ship) for run in runs for ship in run.run.ship_names if run.start < run.end]


# Colour of the subject with this number, from 0. Together with dash_of() it repeats after 18 subjects.
def colour_of(number):
    return COLOURS[number % len(COLOURS)]


# Line style of the subject with this number, from 0.
def dash_of(number):
    return DASHES[number // len(COLOURS) % len(DASHES)]


def mark_fractures(axes, subject, scale):
    """Marks the cusps and splits of a subject in a panel over time: a short stroke at the top for each cusp, and for
    each split a triangle there with a thin line down to the bottom. `scale` is that of the page's style. Returns the
    legend entries of the kinds that occur. From 150 cusps on the strokes are half transparent, so that dense ones can
    still be distinguished."""
    handles = []
    across = axes.get_xaxis_transform()
    cusps, splits = subject.fractures("bend"), subject.fractures("split")
    if len(cusps):
        style = {"color": CUSP, "linewidth": 0.5 * scale, "alpha": 1 if len(cusps) < 150 else 0.5}
        axes.vlines(cusps, 0.925, 0.985, transform=across, **style)
        handles.append(Line2D([], [], color=CUSP, linestyle="none", marker="|",
                              markersize=5 * scale, markeredgewidth=0.7 * scale, label="cusp broken by bending"))
    if len(splits):
        axes.vlines(splits, 0, 0.955, transform=across, color=SPLIT, linewidth=0.4 * scale, alpha=0.6, zorder=1)
        style = {"color": SPLIT, "linestyle": "none", "marker": "^", "markersize": 4 * scale, "markeredgewidth": 0}
        axes.plot(splits, numpy.full(len(splits), 0.955), transform=across, **style)
        handles.append(Line2D([], [], label="floe split", **style))
    return handles


def once(handles):
    """Returns the legend entries without those whose label occurred before, in their order."""
    return list({handle.get_label(): handle for handle in reversed(handles)}.values())[::-1]
