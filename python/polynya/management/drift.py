"""Velocity of free ice in a scene over time, from which the upstream direction of the gates is computed.

It must be the same as `free_drift` in simulation/world/scene.cpp, by which the pilots place their patterns. Scenes are
resolved ones, with all defaults. Velocities are vectors over ground [m/s]. Directions are those in which water or air
moves, counter-clockwise from the x axis [deg]."""
import math

import numpy


def unit(degrees):
    """Unit vector of a direction, counter-clockwise from the x axis [deg]."""
    angle = math.radians(degrees)
    return numpy.array([math.cos(angle), math.sin(angle)])


def by_rows(rows, time):
    """Velocity from the rows of a drift or wind table, which has one or more in ascending order of time, at a time [s],
    as a vector [m/s]. Both components are interpolated linearly between rows; before the first row the velocity is that
    of the first, after the last row that of the last."""
    times = [row["t_s"] for row in rows]
    velocities = numpy.array([row["speed_m_per_s"] * unit(row["direction_deg"]) for row in rows])
    return numpy.array([numpy.interp(time, times, velocities[:, k]) for k in (0, 1)])


def tide(ellipse, time):
    """Velocity of the tidal current at a time [s], as a vector [m/s]: the major axis times the cosine of the phase
    along the ellipse's direction, and the minor axis times its sine to port of that direction."""
    angle = 2 * math.pi * time / ellipse["period_s"] + math.radians(ellipse["phase_deg"])
    along = unit(ellipse["direction_deg"])
    across = numpy.array([-along[1], along[0]])
    return ellipse["major_m_per_s"] * math.cos(angle) * along + ellipse["minor_m_per_s"] * math.sin(angle) * across


def free_drift(scene, time):
    """Velocity of free ice over ground at a time [s], as a vector [m/s]: that of the water, plus the velocity through
    the water at which the drag of the wind and that of the water are equal. A table of the scene replaces the constant
    velocity (`drift_table` that of the water, `table` that of the wind), and a tide is added. Without drag of the water
    (skin_drag_coefficient 0) the wind is ignored, because the velocity would be infinite."""
    water, wind = scene["water"], scene["wind"]
    rows = water.get("drift_table")
    velocity = by_rows(rows, time) if rows else numpy.array(water["drift_m_per_s"], dtype=float)
    if water.get("tide"):
        velocity = velocity + tide(water["tide"], time)
    friction = water["density_kg_per_m3"] * water["skin_drag_coefficient"]
    if friction > 0:
        rows = wind.get("table")
        blows = by_rows(rows, time) if rows else numpy.array(wind["velocity_m_per_s"], dtype=float)
        velocity = velocity + math.sqrt(wind["air_density_kg_per_m3"] * wind["drag_coefficient"] / friction) * blows
    return velocity
