"""Measures the ice that passes two gates, which are lines across the drift upstream of a protected body
(docs/management.md). One is beyond the patterns of the icebreakers, one just before the body. The gates move with the
body and turn with the drift.

`given` are the settings of a study's collect.management: body, upstream_m, near_m, width_m, size_m and from_s, each of
which may be missing. Sizes of floes are √area [m]."""
from __future__ import annotations

import dataclasses
from typing import Optional

import numpy

from ..errors import InputError
from .drift import free_drift

# Speed of the free drift below which the upstream direction stays as it was [m/s]. It must be kLeastDrift of
# simulation/ship/manage.cpp, so that gates turn as the patterns do.
LEAST_DRIFT = 0.02
# Number of equal parts of a gate's width in which managed_width looks for large floes; even, so that the middle of the
# gate is between two parts. More parts make that width finer, without effect on other measures; with fewer it is
# smaller, because a part that a floe touches counts as occupied.
BINS = 40


@dataclasses.dataclass(frozen=True)
class Gates:
    """Positions of the gates, and the size of floes that count as large. Distances are from the origin of the body's
    frame, upstream."""

    body: str  # name of the protected ship or structure
    upstream: float  # distance of the gate beyond the patterns, which ice passes before it is managed [m]
    near: float  # distance of the gate just before the body [m]
    width: float  # width of both gates across the drift, half of it on each side of the body [m]
    size: float  # √area of the smallest floe that counts as a hit and as not managed [m]; 20 m if not given
    start: float = 0.0  # only times after this one count [s]


@dataclasses.dataclass
class Passage:
    """Floes that passed a gate, in the order of their ids."""

    floes: numpy.ndarray  # ids
    times: numpy.ndarray  # times of the first frames in which they had passed [s]
    across: numpy.ndarray  # positions in the gate, to port of the upstream direction [m]
    areas: numpy.ndarray  # [m²]

    @property
    def sizes(self):
        """Sizes √area [m]."""
        return numpy.sqrt(self.areas)

    @property
    def mean_size(self):
        """Mean size √area of the floes, weighted by area [m]; None without a floe."""
        return float((self.sizes * self.areas).sum() / self.areas.sum()) if len(self.areas) else None


def managing(scene):
    """{ship: settings of its pilot `manage`} of the ships that manage ice; empty if none does. `scene` is scene.json of
    a run."""
    pilots = {ship["name"]: (ship.get("pilot") or {}).get("manage") for ship in scene["ships"]}
    return {name: pilot for name, pilot in pilots.items() if pilot}


def protected_body(scene):
    """Name of the body that the first managing pilot protects; without one the first moored ship, otherwise the first
    structure. Raises InputError if there is none of these."""
    pilots = managing(scene)
    if pilots:
        return next(iter(pilots.values()))["body"]
    moored = [ship["name"] for ship in scene["ships"] if ship.get("mooring")]
    standing = [structure["name"] for structure in scene["structures"]]
    if not moored and not standing:
        raise InputError("nothing is protected: no pilot manages ice, no ship is moored and no structure stands; "
                         "--body names one")
    return (moored + standing)[0]


def reach(waterline):
    """Distance from the frame's origin to the farthest point of the waterline [m], an array of points in the body's
    frame. It is taken as the body's radius."""
    return float(numpy.hypot(*waterline.T).max())


def gates_of(run, given):
    """Gates of a run: the given ones, otherwise derived from the patterns of its pilots. The upstream gate is then one
    radius of the body beyond the farthest pattern, the near one at 1.5 radii, and both are as wide as the widest
    pattern. A given value is always kept, also if it is narrower or nearer than the patterns. Raises InputError if the
    run has no such body, if a gate is neither given nor derivable, or if near is not before upstream."""
    scene = run.scene
    body = given.get("body") or protected_body(scene)
    if body not in run.waterlines:
        raise InputError(f'the run has no ship or structure "{body}"; allowed: {", ".join(run.waterlines)}')
    patterns = managing(scene).values()
    radius = reach(run.waterlines[body])
    far = [pilot["distance_m"] + 0.5 * depth_of(pilot) for pilot in patterns]
    upstream, width = given.get("upstream_m"), given.get("width_m")
    if not patterns and (upstream is None or width is None):
        raise InputError("no ship of the run manages ice: where the gates are has to be given: --upstream and --width")
    gates = Gates(
        body=body,
        upstream=upstream if upstream is not None else max(far) + radius,
        near=given.get("near_m", 1.5 * radius),
        width=width if width is not None else max(pilot["width_m"] for pilot in patterns),
        size=given.get("size_m", 20.0),
        start=given.get("from_s", 0.0),
    )
    if gates.near >= gates.upstream:
        raise InputError(f"the gate at the body, {gates.near:g} m, is not nearer than the one upstream, "
                         f"{gates.upstream:g} m")
    return gates


def depth_of(pilot):
    """Depth of a pattern along the drift [m]; if the scene has none, that by which complete_depth of
    io/scene/ship_completion.cpp completes it."""
    share = {"circular": 1, "largest_floe": 1, "racetrack": 0.25}.get(pilot["pattern"], 0)
    return pilot.get("depth_m") or share * pilot["width_m"]


def axes_over_time(run):
    """Returns two arrays with a row per frame of the run: the unit vector upstream, and the distance that free ice
    drifts until the next frame [m], 0 for the last one. Both are those of the middle of the interval. As long as the
    drift is slower than LEAST_DRIFT, the direction is the last one, and the x axis at the start."""
    upstream, ways = [], []
    last = numpy.array([1.0, 0.0])
    times = run.times
    for time, following in zip(times, [*times[1:], times[-1]]):
        drift = free_drift(run.scene, 0.5 * (time + following))
        speed = float(numpy.hypot(*drift))
        last = -drift / speed if speed >= LEAST_DRIFT else last
        upstream.append(last)
        ways.append(speed * (following - time))
    return numpy.array(upstream), numpy.array(ways)


def places_over_time(run, body):
    """Yields for each frame the ids of the floes that exist and are not under a hull, and the positions of their
    centres of mass relative to the body's origin, x upstream and y to port of that direction [m]. `body` is its
    name."""
    number = run.ship_names.index(body)
    upstream, _ = axes_over_time(run)
    births = run.births
    for time, axis in zip(run.times, upstream):
        floats = (time < births["died_s"]) & (time < births["went_under_s"])
        ids = numpy.flatnonzero((births["born_s"] <= time) & floats)
        origin = run.frame(time).ship_motions[number, :2]
        off = run.motions.floes_at(ids, time)[:, :2] - origin
        yield ids, numpy.column_stack((off @ axis, axis[0] * off[:, 1] - axis[1] * off[:, 0]))


def passages(run, gates):
    """Returns the Passages of the upstream gate and of the gate at the body. A floe passes once, when its centre of
    mass does between two frames. Pieces of a floe that breaks before the gate pass on their own; those of a floe that
    breaks after it do not count again. Passing beside the gate, or before gates.start, does not count, and uses up the
    one passage of the floe too. The position in the gate is interpolated between the two frames, but the time is that
    of the second one, so both depend on the interval of frames. Ice that starts between the gates and the body never
    passes the gate upstream of it."""
    count = len(run.births["floe_id"])
    parents = run.births["parent_id"]
    lines = (gates.upstream, gates.near)
    before = numpy.full((count, 2), numpy.nan)
    has_passed = numpy.zeros((2, count), dtype=bool)
    found: list = [[], []]
    for k, (ids, places) in enumerate(places_over_time(run, gates.body)):
        for floe in ids[numpy.isnan(before[ids, 0])].tolist():  # new floes start at the position of their ancestor
            ancestor = int(parents[floe])
            while ancestor >= 0 and numpy.isnan(before[ancestor, 0]):
                ancestor = int(parents[ancestor])
            if ancestor >= 0:
                before[floe] = before[ancestor]
                has_passed[:, floe] = has_passed[:, ancestor]
        for line, distance in enumerate(lines):
            crosses = (before[ids, 0] > distance) & (places[:, 0] <= distance) & ~has_passed[line, ids]
            has_passed[line, ids[crosses]] = True
            for i in numpy.flatnonzero(crosses):
                share = (before[ids[i], 0] - distance) / (before[ids[i], 0] - places[i, 0])
                y = before[ids[i], 1] + share * (places[i, 1] - before[ids[i], 1])
                if abs(y) <= 0.5 * gates.width and run.times[k] > gates.start:
                    found[line].append((int(ids[i]), float(run.times[k]), float(y)))
        before[ids] = places
    return [passage_of(run, of) for of in found]


def passage_of(run, rows):
    """The Passage of rows (floe, time [s], position across [m])."""
    rows = sorted(rows)
    floes = numpy.array([row[0] for row in rows], dtype=int)
    return Passage(floes, numpy.array([row[1] for row in rows]), numpy.array([row[2] for row in rows]),
                   run.births["area_m2"][floes])


def managed_width(passage: Passage, gates) -> float:
    """Width of the stretch around the middle of the gate in which no floe of at least gates.size passed [m], in steps
    of width / BINS; 0 if one passed through the middle of the gate, and the whole width if none passed at all. A floe
    occupies √area across the gate."""
    edges = numpy.linspace(-0.5 * gates.width, 0.5 * gates.width, BINS + 1)
    is_free = numpy.ones(BINS, dtype=bool)
    for y, size in zip(passage.across, passage.sizes):
        if size >= gates.size:
            is_free &= (edges[1:] < y - 0.5 * size) | (edges[:-1] > y + 0.5 * size)
    high = next((k for k in range(BINS // 2, BINS) if not is_free[k]), BINS)
    low = next((k for k in range(BINS // 2 - 1, -1, -1) if not is_free[k]), -1)
    return float(edges[high] - edges[low + 1])


def distribution(passage: Passage, edges: Optional[numpy.ndarray] = None):
    """Returns (edges, numbers, areas): the number of floes and their area [m²] with sizes between successive edges [m].
    `edges` are ascending sizes √area; by default there are ten classes per decade from 1 to 1000 m. Other sizes are
    left out. There is one number fewer than edges."""
    edges = numpy.geomspace(1, 1000, 31) if edges is None else edges
    numbers, _ = numpy.histogram(passage.sizes, edges)
    areas, _ = numpy.histogram(passage.sizes, edges, weights=passage.areas)
    return edges, numbers, areas
