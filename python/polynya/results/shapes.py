"""Shapes of a run's floes in their body frames [m]. The file has whole rings, or references to the rings of parents
(docs/run-folder.md, "floes.ndjson"). A shape may thus need those of all its ancestors. Rings are open: the last point
does not repeat the first."""
from __future__ import annotations

import numpy

from polynya.errors import FolderError

# Largest number of vertices of assembled shapes that are kept: 128 MiB at 16 bytes each. Fewer save memory, but shapes
# that are wanted again are assembled again.
MOST_KEPT = 8 << 20


class Shapes:
    """Assembles shapes when they are wanted, and keeps those that were first asked for last, with up to MOST_KEPT
    vertices."""

    def __init__(self, births, path):
        """`births` are the objects of floes.ndjson, in which each floe's id is its index. `path` is used in errors."""
        self._births, self._path = births, path
        self._kept, self._vertices = {}, 0

    def of(self, floes):
        """{id: [outer ring, holes …]} of some floes; each ring is an array of n × 2 in the floe's body frame [m]. The
        arrays are shared with later calls, so they must not be changed. Raises FolderError, with the line, if a shape
        or one of its ancestors' is damaged. The ids must be those of floes of the run, which is not checked."""
        wanted = {int(floe) for floe in floes}
        needed, waiting = set(), list(wanted)
        while waiting:
            floe = waiting.pop()
            if floe in needed:
                continue
            needed.add(floe)
            if floe not in self._kept and "ring_parts_m" in self._births[floe]:
                waiting.append(self._parent_of(floe))
        found, children = {}, {}
        for floe in needed:
            if floe not in self._kept and "ring_parts_m" in self._births[floe]:
                parent = self._parent_of(floe)
                children[parent] = children.get(parent, 0) + 1
        for floe in sorted(needed):  # a parent has a smaller id than its children
            found[floe] = self._kept[floe] if floe in self._kept else self._assembled(floe, found, children, wanted)
        shapes = {floe: found[floe] for floe in wanted}
        self._keep(shapes)
        return shapes

    def _parent_of(self, floe):
        """The id of the floe whose rings the floe refers to. Raises FolderError if there is none, or if it is not
        smaller than the floe's own id."""
        parent = self._births[floe]["parent_id"]
        if parent is None or not 0 <= parent < floe:
            raise FolderError(f"{self._path}:{floe + 1}: parts of a parent that is not on a line before")
        return parent

    # Returns the rings of a floe. `found` has the shapes assembled so far, `children` the number of floes that still
    # need each parent, `wanted` the ids whose shapes of() returns. A parent that is neither needed any more nor wanted
    # is removed from `found`, which saves memory. Raises FolderError with the line if the shape is damaged.
    def _assembled(self, floe, found, children, wanted):
        birth = self._births[floe]
        try:
            if "ring_parts_m" not in birth:
                return [ring_of(ring) for ring in (birth["ring_m"], *birth["holes_m"])]
            parent = birth["parent_id"]
            rings = [
                numpy.concatenate([vertices(part, found[parent]) for part in ring])
                for ring in (birth["ring_parts_m"], *birth["hole_parts_m"])
            ]
        except (IndexError, KeyError, TypeError, ValueError) as error:
            raise FolderError(f"{self._path}:{floe + 1}: no shape of a floe: {error!r}") from None
        children[parent] -= 1
        if children[parent] == 0 and parent not in wanted:
            del found[parent]
        return rings

    def _keep(self, shapes):
        """Keeps the shapes, and drops those kept longest until at most MOST_KEPT vertices or one shape are left. Using
        a kept shape again does not make it newer."""
        for floe, rings in shapes.items():
            if floe not in self._kept:
                self._kept[floe] = rings
                self._vertices += sum(map(len, rings))
        while self._vertices > MOST_KEPT and len(self._kept) > 1:
            self._vertices -= sum(map(len, self._kept.pop(next(iter(self._kept)))))


def ring_of(points):
    """Converts a list of points [x, y] to an array. Raises ValueError if it is not a ring."""
    ring = numpy.array(points, dtype=float)
    if ring.ndim != 2 or ring.shape[1] != 2 or len(ring) < 3 or not numpy.isfinite(ring).all():
        raise ValueError("a ring has three points or more, of two finite coordinates each")
    return ring


def vertices(part, parent):
    """Vertices of a part of a ring. A part is a list of new vertices [x, y], or three numbers: the index of a ring of
    the parent (0 is the outer ring), the index of the first vertex in it, and the number of vertices. The stretch
    continues from the last vertex of that ring with the first one. Raises IndexError, TypeError or ValueError if the
    part is none of these, which _assembled() turns into a FolderError."""
    if isinstance(part[0], list):
        return numpy.array(part, dtype=float)
    ring, first, count = part
    return numpy.take(parent[ring], numpy.arange(first, first + count), axis=0, mode="wrap")
