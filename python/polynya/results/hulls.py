"""Waterlines and initial poses of the ships, structures and walls of a resolved scene. They are computed as the program
does, so that Python can draw bodies of which a run records only the pose.

A body's own frame has its origin at the body's position in the scene, x ahead and y to port [m]."""
from __future__ import annotations

import math

import numpy

# Largest distance between a cylinder's circle and its polygon [m]. Smaller values give more corners. It must be equal
# to kSagitta of `cylinder_waterline` in simulation/world/scene.cpp; otherwise Python would draw another outline than
# the one with which ice collides.
SAGITTA = 0.01


def waterline(body):
    """Returns the waterline of a body of the scene as an array of n × 2 in the body's own frame [m], not closed. A
    cylinder (`radius_m`) is a polygon. A wall (`from_m`) is a rectangle behind its face, with the origin at the middle
    of the face. A hull has its given waterline (`waterline_m`), otherwise a wedge-shaped bow with a parallel midbody
    and a square stern, which has the origin at half its length. A resolved scene has all keys that this needs;
    otherwise a KeyError is raised."""
    # A small cylinder has at least 24 corners, as in the program, so that it is round also if SAGITTA asks for fewer.
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
    """Returns the initial motion of a body as a list: x, y [m], heading [rad, counter-clockwise from the x axis] and
    their three rates [m/s, m/s, rad/s]. The rates are 0 even if the scene gives the body a speed, so use only the pose.
    A body without a position or heading in the scene has (0, 0) and 0. The heading of a wall is the direction in which
    its face points: to the left of the line from `from_m` to `to_m`."""
    if "from_m" in body:
        (x0, y0), (x1, y1) = body["from_m"], body["to_m"]
        return [(x0 + x1) / 2, (y0 + y1) / 2, math.atan2(x1 - x0, y0 - y1), 0, 0, 0]
    return [*body.get("position_m", (0, 0)), math.radians(body.get("heading_deg", 0)), 0, 0, 0]
