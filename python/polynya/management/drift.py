"""Drift of a scene over time, as in simulation/world/scene.cpp."""
import math

import numpy


def unit(degrees):
    angle = math.radians(degrees)
    return numpy.array([math.cos(angle), math.sin(angle)])


def by_rows(rows, time):
    """Velocity from a table as a vector, linear between its rows [m/s]."""
    times = [row["t_s"] for row in rows]
    velocities = numpy.array([row["speed_m_per_s"] * unit(row["direction_deg"]) for row in rows])
    return numpy.array([numpy.interp(time, times, velocities[:, k]) for k in (0, 1)])


def tide(ellipse, time):
    angle = 2 * math.pi * time / ellipse["period_s"] + math.radians(ellipse["phase_deg"])
    along = unit(ellipse["direction_deg"])
    across = numpy.array([-along[1], along[0]])
    return ellipse["major_m_per_s"] * math.cos(angle) * along + ellipse["minor_m_per_s"] * math.sin(angle) * across


def free_drift(scene, time):
    """Velocity of free ice over ground: that of the water, plus that by wind through the water [m/s]."""
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
