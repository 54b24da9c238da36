"""Waterlines of a resolved scene's ships and structures, in their own frames [m]."""
from __future__ import annotations

import math

import numpy

SAGITTA = 0.01  # of a cylinder's polygon [m], as `cylinder_waterline` of simulation/scene.cpp


def waterline(body):
    """An array of n × 2: as given, a wedge bow's, or a cylinder's."""
    if "radius_m" in body:
        radius = body["radius_m"]
        half_turn = math.acos(max(-1.0, 1 - SAGITTA / radius))
        angles = 2 * math.pi * numpy.arange(corners := max(24, math.ceil(math.pi / half_turn))) / corners
        return radius * numpy.column_stack((numpy.cos(angles), numpy.sin(angles)))
    hull = body.get("hull", body)
    if "waterline_m" in hull:
        return numpy.array(hull["waterline_m"], dtype=float)
    length, half = hull["length_m"], hull["beam_m"] / 2
    shoulder = length / 2 - half / math.tan(math.radians(hull["entrance_angle_deg"]))
    return numpy.array([[length / 2, 0], [shoulder, half], [-length / 2, half], [-length / 2, -half], [shoulder, -half]])
