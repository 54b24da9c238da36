"""Waterlines of a resolved scene's ships, structures and walls, in their own frames [m]."""
from __future__ import annotations

import math

import numpy

# Largest distance between a cylinder and its polygon [m], as in `cylinder_waterline` of simulation/world/scene.cpp.
SAGITTA = 0.01


def waterline(body):
    """Waterline as an array of n × 2 [m]: the given one, or that of a wedge-shaped bow, a cylinder, or a wall behind
    its face."""
    if "radius_m" in body:
        radius = body["radius_m"]
        half_turn = math.acos(max(-1.0, 1 - SAGITTA / radius))
        angles = 2 * math.pi * numpy.arange(corners := max(24, math.ceil(math.pi / half_turn))) / corners
        return radius * numpy.column_stack((numpy.cos(angles), numpy.sin(angles)))
    if "from_m" in body:
        half = math.dist(body["from_m"], body["to_m"]) / 2
        return numpy.array([[0, -half], [0, half], [-body["depth_m"], half], [-body["depth_m"], -half]])
    hull = body.get("hull", body)
    if "waterline_m" in hull:
        return numpy.array(hull["waterline_m"], dtype=float)
    length, half = hull["length_m"], hull["beam_m"] / 2
    shoulder = length / 2 - half / math.tan(math.radians(hull["entrance_angle_deg"]))
    return numpy.array([[length / 2, 0], [shoulder, half], [-length / 2, half],
                        [-length / 2, -half], [shoulder, -half]])


def first_motion(body):
    """Initial pose at rest: x, y [m], heading [rad] and their rates. The heading of a wall is the direction of its
    face, to the left of the line from `from_m` to `to_m`."""
    if "from_m" in body:
        (x0, y0), (x1, y1) = body["from_m"], body["to_m"]
        return [(x0 + x1) / 2, (y0 + y1) / 2, math.atan2(x1 - x0, y0 - y1), 0, 0, 0]
    return [*body.get("position_m", (0, 0)), math.radians(body.get("heading_deg", 0)), 0, 0, 0]
