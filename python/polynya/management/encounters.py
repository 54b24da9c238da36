"""Contacts of the protected body with other ships, and the closest distance between their waterlines.

An icebreaker that manages ice close to a ship may hit it. The loads of such a run are no benefit of the pattern."""
from __future__ import annotations

import dataclasses
import math

import numpy

from ..results.motions import placed
from .gates import axes_over_time, reach

# Largest relative displacement of two hulls between two compared poses [m]. Apart from rotation, the smallest distance
# is too large by at most half of it. Smaller values are slower and more exact.
STEP = 0.5
# Largest number of compared poses between two rows of forces.csv. It bounds the time for rows far apart, where steps
# are then longer than STEP.
MOST_STEPS = 50


@dataclasses.dataclass(frozen=True)
class Encounters:
    """Encounters of the protected body with all other ships of a scene in the whole run, also before Gates.start."""

    hits: int  # number of separate contacts (encounters_of)
    load: float  # largest horizontal force of hulls on the body during a contact, mean over a row of forces.csv [N]
    distance: float  # smallest distance between the waterlines; 0 at a contact [m]


def other_ships(run, body):
    """Names of the ships of the scene, without the protected body."""
    return [ship["name"] for ship in run.scene["ships"] if ship["name"] != body]


def loads_of_hulls(run, name):
    """Magnitude of the horizontal force of other hulls on a body [N], one per row of forces.csv."""
    columns = run.force_columns
    own = columns["ship"] == name
    return numpy.hypot(columns["surge_from_ships_N"][own], columns["sway_from_ships_N"][own])


def poses(run, name):
    """Times [s] and poses x, y [m], heading [rad] of a body in the world: at the start of the run, then of each row of
    forces.csv. Headings do not jump by 360°, so that they can be interpolated."""
    columns = run.force_columns
    own = columns["ship"] == name
    rows = numpy.column_stack([columns[key][own] for key in ("x_m", "y_m", "heading_deg")])
    rows[:, 2] = numpy.unwrap(numpy.radians(rows[:, 2]))
    first = run.first_motions[run.ship_names.index(name), :3]
    if len(rows):
        turns = round((rows[0, 2] - first[2]) / (2 * math.pi))
        first = first + [0, 0, 2 * math.pi * turns]
    return numpy.concatenate([[run.start_time], columns["t_s"][own]]), numpy.vstack([first, rows])


def refined(times, of_body, of_ship):
    """Poses of both bodies at the given times and between them, such that the origin of one moves at most STEP relative
    to the other between two poses (but MOST_STEPS). Motion between rows is linear. Rotation is not limited."""
    moved = numpy.hypot(*(numpy.diff(of_ship, axis=0) - numpy.diff(of_body, axis=0))[:, :2].T)
    counts = numpy.clip(numpy.ceil(moved / STEP), 1, MOST_STEPS).astype(int)
    fine = numpy.concatenate([numpy.linspace(a, b, n, endpoint=False) for a, b, n in zip(times, times[1:], counts)]
                             + [times[-1:]])
    return [numpy.column_stack([numpy.interp(fine, times, of[:, k]) for k in range(3)]) for of in (of_body, of_ship)]


def to_edges(points, ring):
    """Smallest distance from points to the edges of a ring, both n × 2 [m]."""
    start, way = ring, numpy.roll(ring, -1, axis=0) - ring
    off = points[:, None, :] - start[None, :, :]
    length = numpy.maximum((way**2).sum(axis=1), 1e-300)  # no division by 0 for an edge without length
    share = numpy.clip((off * way).sum(axis=2) / length, 0, 1)
    return float(numpy.sqrt(((off - share[:, :, None] * way) ** 2).sum(axis=2)).min())


def cross(a, b):
    """Cross products of vectors along the last axis; positive if b points to port of a."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def contains(ring, point):
    """Returns True if a point lies inside a ring. The result for a point on the ring is arbitrary."""
    (x, y), following = ring.T, numpy.roll(ring, -1, axis=0)
    crosses = (y > point[1]) != (following[:, 1] > point[1])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        at = x + (point[1] - y) / (following[:, 1] - y) * (following[:, 0] - x)
    return bool(numpy.count_nonzero(crosses & (at > point[0])) % 2)


def overlap(one, other):
    """Returns True if two rings cross or touch, or if one lies inside the other. Parallel edges never cross."""
    a, b = numpy.roll(one, -1, axis=0) - one, numpy.roll(other, -1, axis=0) - other
    off = other[None, :, :] - one[:, None, :]
    turn = cross(a[:, None, :], b[None, :, :])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        along_a, along_b = cross(off, b[None, :, :]) / turn, cross(off, a[:, None, :]) / turn
    crosses = (along_a >= 0) & (along_a <= 1) & (along_b >= 0) & (along_b <= 1)
    return bool(crosses.any()) or contains(one, other[0]) or contains(other, one[0])


def ring_distance(one, other):
    """Distance between two rings [m]; 0 if they overlap."""
    return 0.0 if overlap(one, other) else min(to_edges(one, other), to_edges(other, one))


def closest(run, body, ship):
    """Smallest distance between the waterlines of two bodies in the whole run [m]; 0 if they overlap. Poses are
    compared in the order of a lower bound, the distance of the bodies' origins minus the radii of both waterlines about
    them, until the bound of the next pose is not below the smallest distance found."""
    (times, of_body), (of_times, of_ship) = poses(run, body), poses(run, ship)
    # Rows of all bodies have the same times. A killed run may lack the last row of some of them.
    count = min(len(times), len(of_times))
    of_body, of_ship = refined(times[:count], of_body[:count], of_ship[:count])
    rings = [run.waterlines[name] for name in (body, ship)]
    least = numpy.hypot(*(of_ship - of_body)[:, :2].T) - sum(map(reach, rings))
    found = math.inf
    for k in numpy.argsort(least, kind="stable"):
        if least[k] >= found or found == 0:
            break
        found = min(found, ring_distance(placed(rings[0], *of_body[k]), placed(rings[1], *of_ship[k])))
    return found


def met(run, body, ship):
    """Returns True if events.ndjson has a contact of the two bodies. It catches contacts between two compared poses."""
    events = run.event_columns
    pairs = zip(events["kind"], events.get("ship", ()), events.get("by_ship", ()))
    return any(kind == "ship_contact" and {one, other} == {body, ship} for kind, one, other in pairs)


def encounters_of(run, body):
    """Encounters of a body with the other ships; None if the scene has no other ship. A hit is a stretch of successive
    rows of forces.csv in which hulls press both the body and the other ship, if the two touched at any time. A row does
    not tell which hull presses, so a third ship may contribute. A ship that touched the body without such a row, for
    example because both motions are prescribed, counts as one hit."""
    ships = other_ships(run, body)
    if not ships:
        return None
    own, hits, load, distance = loads_of_hulls(run, body), 0, 0.0, math.inf
    for ship in ships:
        nearest = closest(run, body, ship)
        is_hit = nearest == 0 or met(run, body, ship)
        of_ship = loads_of_hulls(run, ship)
        count = min(len(own), len(of_ship))
        touches = (own[:count] > 0) & (of_ship[:count] > 0) & is_hit
        begins = int(numpy.count_nonzero(touches & ~numpy.concatenate([[False], touches[:-1]])))
        hits += max(begins, 1) if is_hit else 0
        load = max(load, float(own[:count][touches].max(initial=0)))
        distance = min(distance, 0.0 if is_hit else nearest)
    return Encounters(hits, load, distance)


def beyond_gate(run, gates):
    """Time after gates.start for which a vertex of the waterline of any other ship was beyond the upstream gate, within
    its width [s]. That ship breaks ice before it is counted there, of which cautions.py warns. Only frames are looked
    at: each counts for the time until the next one."""
    upstream, _ = axes_over_time(run)
    steps = numpy.diff(run.times, append=run.times[-1:])
    number, seconds = run.ship_names.index(gates.body), 0.0
    numbers = [run.ship_names.index(name) for name in other_ships(run, gates.body)]
    for time, step, axis in zip(run.times, steps, upstream):
        moved = run.frame(time).ship_motions
        for other in numbers:
            off = placed(run.waterlines[run.ship_names[other]], *moved[other, :3]) - moved[number, :2]
            is_beyond = (off @ axis > gates.upstream) & (numpy.abs(cross(axis, off)) <= 0.5 * gates.width)
            if time > gates.start and is_beyond.any():
                seconds += float(step)
                break
    return seconds
