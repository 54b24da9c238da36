"""The channel behind a ship, as `polynya channel` measures it (docs/channel.md)."""
from __future__ import annotations

import dataclasses
import os
import subprocess
import tempfile
from typing import Any

import numpy

from polynya.errors import FolderError
from polynya.files import read_json
from polynya.program import program

from .tables import read_csv, table


@dataclasses.dataclass(frozen=True)
class Channel:
    """The channel behind a ship at one time."""

    stations: Any  #: table with a row for each station along the track, with the columns of channel.csv
    #: Mean width [m], areas [m²] and so on, as in `polynya channel --json`, without the lists of floes and brash. The
    #: names end in their units.
    sums: dict
    #: Areas of channel.geojson by name: "open water", "channel", "swept band", and "brash" if there is any. Lines, such
    #: as the track, are left out. Each area is a list of polygons, and each polygon a list of rings: the outer one,
    #: then its holes. A ring is an array of n × 2 in the world [m], not closed.
    parts: dict


def measure(folder, ship, time, pandas):
    """Measures the channel of a run with `polynya channel`, without writing to the run folder. `ship` is the name of a
    ship, and `time` a time of the run [s]; None means the first ship and the end of the run. `pandas` is as in
    tables.table(). Returns a Channel. Raises FolderError, with the program's message, if the channel cannot be
    measured, for example if the run has no such ship, or if the program cannot be started."""
    with tempfile.TemporaryDirectory() as scratch:
        words = [program(), "channel", os.fspath(folder), "--out", scratch]
        words += ([] if time is None else ["--at", repr(float(time))]) + ([] if ship is None else ["--ship", ship])
        try:
            done = subprocess.run(words, capture_output=True, text=True, check=False)
        except OSError as error:
            raise FolderError(f"{words[0]}: {error.strerror}: the channel is measured by the program polynya, which "
                              f"POLYNYA_PROGRAM names") from None
        if done.returncode != 0:
            raise FolderError(done.stderr.strip().removeprefix("polynya channel: "))
        columns = read_csv(os.path.join(scratch, "channel.csv"))
        features = read_json(os.path.join(scratch, "channel.geojson"))["features"]
    parts = {
        feature["properties"]["part"]: polygons_of(feature["geometry"])
        for feature in features
        if feature["geometry"]["type"].endswith("Polygon")
    }
    sums = next((f["properties"] for f in features if f["properties"]["part"] == "open water"), {})
    return Channel(table(columns, pandas), {key: value for key, value in sums.items() if key != "part"}, parts)


# Returns the polygons of a GeoJSON geometry, a Polygon or MultiPolygon, as lists of rings, without the last point of
# each ring, which repeats the first one. An empty geometry gives no polygons.
def polygons_of(geometry):
    polygons = geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
    return [[numpy.array(ring[:-1], dtype=float) for ring in polygon] for polygon in polygons]
