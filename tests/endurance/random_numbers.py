"""Draws the numbers of random scenes, and turns a scene about the origin."""

import math
import random


class Dice(random.Random):
    """Draws numbers; half of all scenes have round ones, of one or two digits, as people type them."""

    def __init__(self, seed):
        super().__init__(seed)
        self.is_round = self.random() < 0.5

    def chance(self, probability):
        return self.random() < probability

    def between(self, low, high):
        """A number between two, even."""
        return self.rounded(self.uniform(low, high), low, high)

    def decades(self, low, high):
        """A number between two positive ones, even in its logarithm."""
        return self.rounded(math.exp(self.uniform(math.log(low), math.log(high))), low, high)

    def rounded(self, value, low, high):
        """The value, with two digits where the scene has round numbers and these lie between the bounds."""
        if not self.is_round or value == 0:
            return value
        short = float(f"{value:.{self.choice((0, 1))}e}")
        return short if low <= short <= high else value

    def among(self, weights):
        """A key of a dictionary that has a weight for each."""
        return self.choices(list(weights), list(weights.values()))[0]


class Plane:
    """The plane in which a scene is laid out, turned and moved: points, vectors and headings of the scene."""

    def __init__(self, turn_deg=0.0, shift_m=(0.0, 0.0)):
        self.turn_deg = turn_deg
        self.shift_m = shift_m
        quarter = {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}.get(turn_deg % 360)
        turn = math.radians(turn_deg)
        self.cosine, self.sine = quarter or (math.cos(turn), math.sin(turn))

    def is_upright(self):
        """Are rectangles along the axes still so, with their corner of least x and y where it was?"""
        return self.turn_deg == 0

    def vector(self, x, y):
        return [self.cosine * x - self.sine * y, self.sine * x + self.cosine * y]

    def point(self, x_m, y_m):
        x, y = self.vector(x_m, y_m)
        return [x + self.shift_m[0], y + self.shift_m[1]]

    def ring(self, points_m):
        return [self.point(x, y) for x, y in points_m]

    def heading(self, angle_deg):
        """Between -180 and 180 degrees."""
        turned = (angle_deg + self.turn_deg) % 360
        return turned - 360 if turned > 180 else turned


def turned(points, angle_deg, at=(0.0, 0.0)):
    """Points of a body's frame, where the body stands."""
    frame = Plane(angle_deg, at)
    return [tuple(frame.point(x, y)) for x, y in points]


def box(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def are_apart(first, second, gap_m):
    """Are two outlines, taken as convex, at least so far apart, along an edge of one of them?"""
    for outline in (first, second):
        for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
            length = math.hypot(bx - ax, by - ay)
            if length == 0:
                continue
            nx, ny = (by - ay) / length, (ax - bx) / length
            along = [[nx * x + ny * y for x, y in body] for body in (first, second)]
            if min(along[0]) - max(along[1]) >= gap_m or min(along[1]) - max(along[0]) >= gap_m:
                return True
    return False
