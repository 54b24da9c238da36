"""Exact cuts of polygons, from numpy rings or anything with __geo_interface__."""
import collections.abc
import json
import typing

import numpy

from polynya._core import cut_geojson


class Cut(typing.NamedTuple):
    """Result of a cut. area_of_pieces_m2 + removed_m2 = area_m2 + rounding_defect_m2; all of these are in the ledger
    (docs/cut.md)."""

    #: polygons: lists of numpy rings (n x 2) [m], the outer one first. Rings are open; outer rings run
    #: counter-clockwise, holes clockwise
    pieces: list
    parts: list  #: "inside" or "outside" the tool, for each piece in the order of `pieces`; for a crack "outside"
    ledger: dict  #: the polygon's entry in the ledger: the balance of its area, and what was repaired or rounded


def _ring(ring):
    """Returns the x and y of a ring (n x 2 or more columns, open or closed) as a closed list of points for GeoJSON.
    Raises ValueError if it has another shape, less than three points, or a coordinate that is not finite."""
    points = numpy.asarray(ring, dtype=float)
    if points.ndim != 2 or points.shape[1] < 2 or len(points) < 3:
        raise ValueError(f"a ring is an array of n x 2 numbers, n at least 3, not of shape {points.shape}")
    if not numpy.isfinite(points[:, :2]).all():
        raise ValueError("a ring has a coordinate that is no finite number")
    closed = points[:, :2].tolist()
    return closed if closed[0] == closed[-1] else closed + closed[:1]


def _geometry(shape):
    """Returns the GeoJSON of a polygon: of a ring, a list of rings, an object with __geo_interface__, or a GeoJSON
    object itself (Polygon, MultiPolygon, or a Feature with one). Raises ValueError for other types, and TypeError for
    what is none of these, such as None."""
    given = getattr(shape, "__geo_interface__", shape)
    if isinstance(given, collections.abc.Mapping):
        given = given.get("geometry", given) if given.get("type") == "Feature" else given
        if given.get("type") == "MultiPolygon":
            polygons = [[_ring(ring) for ring in polygon] for polygon in given["coordinates"]]
            return {"type": "MultiPolygon", "coordinates": polygons}
        if given.get("type") != "Polygon":
            raise ValueError(f"a polygon is needed, not a {given.get('type')}")
        return {"type": "Polygon", "coordinates": [_ring(ring) for ring in given["coordinates"]]}
    is_ring = len(given) > 0 and len(given[0]) > 0 and numpy.ndim(given[0][0]) == 0
    return {"type": "Polygon", "coordinates": [_ring(ring) for ring in ([given] if is_ring else given)]}


def _numbers(name, values, count):
    """Returns the `count` numbers of a tool as a list. Raises ValueError, with the tool's name, if they are not so many
    finite numbers."""
    numbers = numpy.asarray(values, dtype=float)
    if numbers.shape != (count,) or not numpy.isfinite(numbers).all():
        raise ValueError(f"{name} has {count} finite numbers, found {values!r}")
    return numbers.tolist()


def _fault(rejected):
    """Describes a fault of a ledger as "self-crossing at (5, 5)": the reason, its details, and the first places of the
    fault."""
    words = ": ".join(filter(None, (rejected["reason"], rejected.get("detail"))))
    places = ", ".join(f"({x:g}, {y:g})" for x, y in rejected["vertices"][:3])
    return f"{words} at {places}" if places else words


def cut(polygon, *, disc=None, crack=None, by=None, keep="both", repair=None):
    """Cuts a polygon exactly, and accounts for all of its area.

    polygon: a ring (n x 2 numbers [m]), a list of rings (holes after the outer one), or an object with
    __geo_interface__. Rings may be open or closed and may run in either direction. Give one tool: disc=(x, y, radius
    [m]), a regular polygon inscribed in the circle (docs/cut.md); crack=(x, y, angle in degrees from the x axis), a
    straight line through a point; by=another polygon. keep: "both", "outside" or "inside", for a disc or polygon; the
    area of other pieces is removed_m2. A crack keeps all pieces, and `keep` is ignored. A polygon that the tool misses
    stays whole, as an outside piece; with keep="inside" there is then no piece. repair: "even-odd" or "non-zero", for a
    polygon that is not valid; without it such a polygon is refused. Tools are not repaired. Returns a Cut. Raises
    ValueError with the reason if the polygon cannot be cut or an argument has a wrong value, and TypeError unless
    exactly one tool is given."""
    tools = {"disc": disc, "crack": crack, "polygon": by}
    given = [name for name, tool in tools.items() if tool is not None]
    if len(given) != 1:
        raise TypeError(f"one of disc, crack and by is needed, {len(given)} are given")
    name = given[0]
    tool = _geometry(by) if name == "polygon" else _numbers(name, tools[name], 3)
    operation = {name: tool} if name == "crack" else {name: tool, "keep": keep}
    shape = _geometry(polygon)
    if shape["type"] != "Polygon":
        raise ValueError("one polygon is cut at a time, not a MultiPolygon")
    feature = {"type": "Feature", "properties": {}, "geometry": shape}
    pieces, ledger = map(json.loads, cut_geojson(json.dumps(feature), json.dumps([operation]), repair or ""))
    floe = ledger["floes"][0]
    if floe.get("rejected"):
        raise ValueError("the polygon cannot be cut: " + _fault(floe["rejected"]))
    rings = [[numpy.array(ring[:-1]) for ring in piece["geometry"]["coordinates"]] for piece in pieces["features"]]
    return Cut(rings, [piece["properties"]["part"] for piece in pieces["features"]], floe)
