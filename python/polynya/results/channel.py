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
    """A channel at a time. `parts` has the shapes of channel.geojson by name, such as "open water" and "brash". Each
    polygon is a list of rings, which are arrays of n × 2 [m]."""

    stations: Any  #: table of channel.csv
    sums: dict  #: mean width, areas and so on, as in `polynya channel --json`
    parts: dict


def measure(folder, ship, time, pandas):
    """Measures a channel without writing to the run folder."""
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


def polygons_of(geometry):
    polygons = geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
    return [[numpy.array(ring[:-1], dtype=float) for ring in polygon] for polygon in polygons]
