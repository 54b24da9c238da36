"""Positions of all bodies at any time of a run, from frames.bin (docs/run-folder.md). Between frames, motion is
linear. A frame has a record of every ship, but of a floe only if it deviates from its last record, carried on at
constant velocity, by more than a tolerance."""
from __future__ import annotations

import numpy

from polynya.errors import FolderError, VersionError
from polynya.files import read_bytes

# Sizes of the file's header, of a frame before its ships, of a ship and of a floe [bytes]. They and the other constants
# must be those of io/run/frames.hpp.
HEAD, FRAME_HEAD, SHIP, FLOE = 16, 24, 48, 56
VERSION = 1  # of the file; files of another version are refused
FLOE_RECORD = numpy.dtype([("floe", "<i8"), ("motion", "<f8", 6)])


class Motions:
    """Records of a run's frames: for ships x, y [m], heading [rad] and their rates, for floes the same with the angle.
    Angles are not wrapped, so they can be interpolated. `floes` is the number of floes of the run; records of floes
    with larger ids, which floes.ndjson of a killed run may lack, are ignored. `times` are the times of the frames [s].

    Raises FolderError if the file at `path` cannot be read or is damaged, and VersionError if it has another version. A
    last frame that is incomplete, as a killed run may leave it, is ignored."""

    def __init__(self, path, floes):
        data = read_bytes(path)
        if data[:8] != b"PLYNYFRM" or len(data) < HEAD:
            raise FolderError(f"{path}: not a file of frames")
        version = int.from_bytes(data[8:12], "little")
        if version != VERSION:
            raise VersionError(f"{path}: frames of version {version}; this polynya reads version {VERSION}")
        times, ships, records = [], [], []
        at = HEAD
        while at + FRAME_HEAD <= len(data):
            if data[at : at + 4] != b"FRAM":
                raise FolderError(f"{path}: a damaged frame at byte {at}")
            ship_count, floe_count = numpy.frombuffer(data, "<u4", 2, at + 4).tolist()
            end = at + FRAME_HEAD + SHIP * ship_count + FLOE * floe_count
            if end > len(data):
                break  # incomplete frame of a killed run
            times.append(float(numpy.frombuffer(data, "<f8", 1, at + 16)[0]))
            ships.append(numpy.frombuffer(data, "<f8", 6 * ship_count, at + FRAME_HEAD).reshape(ship_count, 6))
            records.append(numpy.frombuffer(data, FLOE_RECORD, floe_count, at + FRAME_HEAD + SHIP * ship_count))
            at = end
        self.times = numpy.array(times)
        self._ships = ships
        self._index(records, floes)

    def _index(self, records, floes):
        """Sorts the records by floe, then by frame. `_keys` are ascending numbers made of both, in which _last_record()
        searches; `_first` has the index of the first record of each floe."""
        frame = numpy.repeat(numpy.arange(len(records)), [len(of) for of in records])
        floe = numpy.concatenate([of["floe"] for of in records]) if records else numpy.empty(0, numpy.int64)
        motion = numpy.concatenate([of["motion"] for of in records]) if records else numpy.empty((0, 6))
        is_known = (floe >= 0) & (floe < floes)
        frame, floe, motion = frame[is_known], floe[is_known], motion[is_known]
        order = numpy.lexsort((frame, floe))
        self._frame, self._motion = frame[order], motion[order]
        self._keys = floe[order] * max(1, len(records)) + self._frame
        self._first = numpy.searchsorted(floe[order], numpy.arange(floes + 1))

    def _last_record(self, floes, frame):
        """Index of each floe's last record up to a frame (its number, -1: before the first frame), or of its first one
        if all are later; -1 if it has none."""
        first, after = self._first[floes], self._first[floes + 1]
        found = numpy.searchsorted(self._keys, floes * max(1, len(self.times)) + frame, side="right") - 1
        return numpy.where(after > first, numpy.maximum(found, first), -1)

    def floes_at(self, floes, time):
        """Returns an array of n × 6 for the floes with these ids: x, y of the centre of mass [m], angle [rad] and their
        rates [m/s, rad/s]; NaN for a floe that no frame has. Before its first record and after its last one a floe
        moves at constant velocity, whether or not it exists at that time."""
        found = numpy.full((len(floes), 6), numpy.nan)
        if len(self._motion) == 0:
            return found
        here = int(numpy.searchsorted(self.times, time, side="right")) - 1
        last = self._last_record(floes, here)
        is_recorded = last >= 0
        last, floes = last[is_recorded], floes[is_recorded]
        recorded_at = self.times[self._frame[last]]
        moved = carried_on(self._motion[last], time - recorded_at)
        if 0 <= here < len(self.times) - 1:
            following = self._last_record(floes, here + 1)
            between = (following != last) & (recorded_at <= time)
            start, end = self.times[here], self.times[here + 1]
            begin = carried_on(self._motion[last], start - recorded_at)
            part = (time - start) / (end - start)
            moved = numpy.where(between[:, None], begin + part * (self._motion[following] - begin), moved)
        found[is_recorded] = moved
        return found

    def are_steady(self, floes, start, end):
        """Mask of the floes with these ids whose motion no frame changes between two times [s], so that they move at
        constant velocity. The frame after `end` counts too, because motion is interpolated towards it. False for a floe
        that no frame has."""
        if len(self._motion) == 0:
            return numpy.zeros(len(floes), dtype=bool)
        here, after = (int(numpy.searchsorted(self.times, time, side="right")) - 1 for time in (start, end))
        last = self._last_record(floes, here)
        return (last >= 0) & (last == self._last_record(floes, min(after + 1, len(self.times) - 1)))

    def ships_at(self, time):
        """Returns an array with a row for every ship, structure and wall, in the order of the scene: x, y [m], heading
        [rad] and their rates; no rows if there is no frame. Before the first frame it is the state of that frame; after
        the last one, ships move on at constant velocity."""
        if len(self.times) == 0:
            return numpy.empty((0, 6))
        after = int(numpy.searchsorted(self.times, time, side="right"))
        if after == 0:
            return self._ships[0]
        if after == len(self.times):
            return carried_on(self._ships[-1], numpy.full(len(self._ships[-1]), time - self.times[-1]))
        start, end = self.times[after - 1], self.times[after]
        return self._ships[after - 1] + (time - start) / (end - start) * (self._ships[after] - self._ships[after - 1])


def carried_on(motions, durations):
    """Extrapolates motions, n × 6, by n durations [s] at constant velocity; negative ones go back."""
    later = motions.copy()
    later[:, :3] += numpy.asarray(durations)[:, None] * motions[:, 3:]
    return later


def placed(ring, x, y, angle):
    """Returns a ring of a body, given in its body frame [m], in the world [m]. `x` and `y` are the position of the
    origin of that frame [m], `angle` its rotation, counter-clockwise [rad]."""
    c, s = numpy.cos(angle), numpy.sin(angle)
    return numpy.column_stack((x + c * ring[:, 0] - s * ring[:, 1], y + s * ring[:, 0] + c * ring[:, 1]))
