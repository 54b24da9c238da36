"""The figure `motion`: speed, heading and course over ground of every ship, over time."""
from __future__ import annotations

import numpy
from matplotlib.lines import Line2D

from .page import Page, Sheet, plain
from .subjects import all_labelled, colour_of, dash_of, mark_fractures, once, subjects_of

# A ship that is slower than this has no course in the figure [m/s], because noise of its velocity would determine its
# direction. Larger: more gaps in the curve of the course; smaller: the curve jumps where a ship stops.
SLOW = 0.02
# Number of rows of forces.csv from twice which on a curve is thinned to every second, third, … row, so that at least
# this many points are left. Larger: larger files without a visible difference; smaller: short peaks may be missed.
MOST_POINTS = 1500
# Dash pattern of the course, in matplotlib's form (offset, (dash, gap)) in line widths: dotted, to distinguish it from
# the heading.
COURSE = (0, (1, 1.2))


def course_of(vx, vy, heading):
    """Returns the direction of motion over ground [deg] for arrays of velocity [m/s] and heading [deg], NaN below SLOW.
    Like the heading it counts full turns: the result is within 180° of the heading, so that both curves stay near each
    other when a ship turns around several times."""
    angle = numpy.degrees(numpy.arctan2(vy, vx))
    angle = angle + 360 * numpy.round((heading - angle) / 360)
    return numpy.where(numpy.hypot(vx, vy) < SLOW, numpy.nan, angle)


def moving(runs):
    """Returns the subjects to draw: the ships of all runs, or their structures if no run has a ship."""
    subjects = subjects_of(runs)
    ships = [s for s in subjects if s.ship in {ship["name"] for ship in s.of.run.scene.get("ships", [])}]
    return ships or subjects


# Draws the speed [m/s] in one panel, and heading and course [°, counter-clockwise from the x axis] in the other; each
# ship has a colour. If there is only one ship, its cusps and splits are marked along the top. `runs` are runs, or
# Labelled ones with their own names and range of times. Returns the figure, or None if there is neither a ship nor a
# structure, or if no run has a duration.
def draw(runs, page=Page()):
    runs = all_labelled(runs)
    subjects = moving(runs)
    if not subjects:
        return None
    with Sheet(page, "Speed and course", ", ".join(run.label for run in runs)) as sheet:
        columns = page.columns_for(2, least=70)
        speed, turn = sheet.panels(2 // columns, columns).flat
        height = page.row_height(2 // columns, 46)
        handles, marks = [], []
        for i, subject in enumerate(subjects):
            times, v, heading, vx, vy = subject.columns("t_s", "speed_m_per_s",
                                                        "heading_deg", "vx_m_per_s", "vy_m_per_s")
            step = max(1, len(times) // MOST_POINTS)
            style = {"color": colour_of(i), "linestyle": dash_of(i)}
            speed.plot(times[::step], v[::step], **style)
            turn.plot(times[::step], course_of(vx, vy, heading)[::step], color=colour_of(i),
                      linestyle=COURSE, linewidth=0.9 * page.style.scale)
            turn.plot(times[::step], heading[::step], **style)
            handles.append(Line2D([], [], label=plain(subject.name), **style))
            if len(subjects) == 1:
                marks = [mark for axes in (speed, turn) for mark in mark_fractures(axes, subject, page.style.scale)]
        handles = handles if len(subjects) > 1 else [Line2D([], [], color=colour_of(0), label="speed; heading")]
        handles.append(Line2D([], [], color="#777777" if len(subjects) > 1 else colour_of(0),
                              linestyle=COURSE, label="course over ground"))
        for i, (axes, words) in enumerate(((speed, "speed over ground, m/s"), (turn, "heading and course, °"))):
            low, high = axes.get_ylim()
            if axes is speed:
                low, high = 0, max(high, 1e-3)
            axes.set(xlim=(min(r.start for r in runs), max(r.end for r in runs)), xlabel="time, s")
            sheet.label_y(axes, words, height)
            axes.set_ylim(low, high + (0.15 * (high - low) if marks else 0))
            axes.ticklabel_format(axis="y", useOffset=False)
            sheet.title_panel(axes, i, 2, "", page.width)
        return sheet.finish(2 // columns * (height + 6 * page.style.scale), handles + once(marks))
