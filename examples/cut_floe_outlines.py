#!/usr/bin/python3
"""Cuts of irregular floes: outlines from a GeoJSON file, cut by cracks and discs, every square metre accounted for.

    python3 examples/cut_floe_outlines.py    (--out FOLDER; --floes FILE: your own, polygons in metres; --short: two)

Shows polynya.cut on what has __geo_interface__ and on numpy rings. Each floe is split by a crack through its middle;
from the larger part a cusp is cut at its edge, and what a ship's channel takes of each floe is measured.
floe-outlines.geojson has outlines as rough as those that are traced in aerial photographs, two of them with holes; they
are made up. Segmented satellite images have real ones, such as those of doi.org/10.5281/zenodo.6341620:
`gdal_polygonize.py` makes polygons of them. Draws cut-floe-outlines.png.
"""
import argparse
import json
import pathlib

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

import numpy
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

HERE = pathlib.Path(__file__).resolve().parent
BEAM = 24.0  # of the channel [m]
CUSP = 12.0  # radius [m]


class Outline:
    """A floe of the file, as shapely's polygons show themselves."""

    def __init__(self, feature):
        self.name = feature.get("properties", {}).get("floe", "?")
        self.__geo_interface__ = feature["geometry"]


def area_of(rings):
    """[m²]; holes run clockwise and count less."""
    return sum(0.5 * float(x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
               for x, y in ((ring - ring[0]).T for ring in rings))


def broken(outline):
    """The pieces of a floe, its channel's share [m²], and the largest defect of a ledger [m²]."""
    ring = numpy.array(outline.__geo_interface__["coordinates"][0])
    middle = ring.mean(axis=0)
    split = polynya.cut(outline, crack=(*middle, 65))
    halves = sorted(split.pieces, key=area_of)
    tip = halves[-1][0][numpy.argmax(halves[-1][0][:, 0])]  # where a ship from the right would meet it
    cusp = polynya.cut(halves[-1], disc=(*tip, CUSP))
    low, high = middle[1] - BEAM / 2, middle[1] + BEAM / 2
    band = numpy.array([(ring[:, 0].min() - 1, low), (ring[:, 0].max() + 1, low),
                        (ring[:, 0].max() + 1, high), (ring[:, 0].min() - 1, high)])
    channel = polynya.cut(outline, by=band, keep="outside")
    taken = channel.ledger["removed_m2"]
    defect = max(abs(float(cut.ledger["rounding_defect_m2"])) for cut in (split, cusp, channel))
    exact = {cut.ledger["exact_defect_m2"] for cut in (split, cusp, channel)}
    assert exact == {"0"}, "what exact arithmetic leaves over is exactly nothing"
    return [*halves[:-1], *cusp.pieces], taken, defect


def path_of(rings):
    closed = [numpy.concatenate([ring, ring[:1]]) for ring in rings]
    codes = [[Path.MOVETO, *[Path.LINETO] * (len(ring) - 2), Path.CLOSEPOLY] for ring in closed]
    return Path(numpy.concatenate(closed), numpy.concatenate(codes))


def draw(floes, path):
    figure = Figure(figsize=(6.7, 4.4), layout="constrained")
    axes = figure.subplots()
    axes.set_facecolor("#8fb8d0")
    for pieces in floes:
        for piece, colour in zip(pieces, ("#ffffff", "#f6f0da", "#f0c987", "#fbeec2")):
            axes.add_patch(PathPatch(path_of(piece), facecolor=colour, edgecolor="#3d5261", linewidth=0.5))
    axes.autoscale_view()
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]",
             title="each floe split by a crack, and a cusp cut from the larger part")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--floes", type=pathlib.Path, default=HERE / "floe-outlines.geojson",
                        help="GeoJSON, polygons in metres")
    parser.add_argument("--short", action="store_true", help="two floes only")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    features = json.loads(options.floes.read_text())["features"]
    floes = []
    for outline in map(Outline, features[:2] if options.short else features):
        try:
            pieces, taken, defect = broken(outline)
        except ValueError as error:  # rings that cross, no polygon
            print(f"floe {outline.name}: left out: {error}")
            continue
        floes.append(pieces)
        vertices = sum(len(ring) for ring in outline.__geo_interface__["coordinates"])
        print(f"floe {outline.name}: {vertices} vertices, {len(pieces)} pieces of "
              f"{', '.join(f'{area_of(piece):.0f}' for piece in pieces)} m²; a channel of "
              f"{BEAM:g} m takes {taken:.0f} m²; rounding moved {defect:.1e} m²")
    draw(floes, options.out / "cut-floe-outlines.png")
    print(options.out / "cut-floe-outlines.png")


if __name__ == "__main__":
    main()
