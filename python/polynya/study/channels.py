"""A small multiple of channels: the ice and the ships at the end of some runs."""
import json
import math

from matplotlib.collections import PolyCollection

from ..figures.page import Page, Sheet, plain
from .folder import RUN
from .measures import rows_by_ship
from .pictures import group_label, save

COLUMNS, SMALL = 4, 6  # of panels; size of their titles [pt]


def choose(study, sample, group_by, count):
    """Cases whose run is kept: of each group as many, evenly, and not more than `count` in all."""
    groups = sample.groups(group_by)
    each, chosen = max(1, count // len(groups)), []
    for _, cases in groups if count > 0 else []:
        numbers = [n for n in sample.columns["case"][cases].astype(int).tolist() if is_kept(study, n)]
        chosen += [numbers[i * len(numbers) // each] for i in range(each)] if len(numbers) > each else numbers
    return chosen[:count]


def is_kept(study, number):
    return (study.case_folder(number) / RUN / "final.geojson").exists()


def draw(study, sample, numbers, group_by, folder):
    """Writes the picture; returns the name of its SVG."""
    ends = [read_end(study.case_folder(number) / RUN) for number in numbers]
    columns = min(COLUMNS, len(numbers))
    rows = -(-len(numbers) // columns)
    points = [point for end in ends for ring in end["rings"] for point in ring]
    points += [point for end in ends for ship in end["ships"] for point in ship["track"]]
    (left, right), (low, high) = ((min(axis), max(axis)) for axis in zip(*points))
    row_of = {number: i for i, number in enumerate(sample.columns["case"].astype(int).tolist())}
    with Sheet(Page(), "The ice at the end of some runs", "with the ships and their tracks") as sheet:
        grid = sheet.panels(rows, columns)
        width = sheet.page.width / columns - 4
        lines = 1
        for axes, number, end in zip(grid.flat, numbers, ends):
            draw_end(axes, end)
            axes.set(xlim=(left, right), ylim=(low, high), aspect="equal")
            group = f": {group_label(group_by, sample.columns[group_by][row_of[number]])}" if group_by else ""
            words = sheet.wrapped(plain(f"case {number}{group}"), SMALL, width)
            axes.set_title("\n".join(words), fontsize=SMALL, pad=1.5)
            lines = max(lines, len(words))
        for axes in grid.flat:
            axes.set_axis_off()
        panel = min(60.0, width * (high - low) / (right - left)) + 3 * lines
        return save(sheet.finish(max(10.0, panel) * rows, is_snug=True), folder, "channels")


def read_end(run):
    """The rings of the ice at the end of a run, and its ships: track and waterline in the world."""
    features = json.loads((run / "final.geojson").read_text(encoding="utf-8"))["features"]
    scene = json.loads((run / "scene.json").read_text(encoding="utf-8"))
    rows = rows_by_ship(run / "forces.csv")
    ships = []
    for ship in scene["ships"]:
        columns = rows.get(ship["name"])
        if columns:
            at = columns["x_m"][-1], columns["y_m"][-1], math.radians(columns["heading_deg"][-1])
            track = list(zip(columns["x_m"], columns["y_m"]))
            ships.append({"track": track, "hull": placed(waterline(ship["hull"]), *at)})
    return {"rings": [ring for feature in features for ring in outer_rings(feature["geometry"])], "ships": ships}


def outer_rings(shape):
    polygons = [shape["coordinates"]] if shape["type"] == "Polygon" else shape["coordinates"]
    return [polygon[0] for polygon in polygons]


def waterline(hull):
    """A resolved scene's waterline, in the ship's frame; a wedge bow as `wedge_bow_waterline` of
    simulation/world/scene.cpp."""
    if "waterline_m" in hull:
        return hull["waterline_m"]
    length, half = hull["length_m"], hull["beam_m"] / 2
    shoulder = length / 2 - half / math.tan(math.radians(hull["entrance_angle_deg"]))
    return [[length / 2, 0], [shoulder, half], [-length / 2, half], [-length / 2, -half], [shoulder, -half]]


def placed(ring, x, y, heading):
    c, s = math.cos(heading), math.sin(heading)
    return [[x + c * a - s * b, y + s * a + c * b] for a, b in ring]


def draw_end(axes, end):
    axes.add_collection(PolyCollection(end["rings"], facecolors="#cfe3ef", edgecolors="#5b7f95", linewidths=0.15))
    for ship in end["ships"]:
        axes.plot(*zip(*ship["track"]), color="#d55e00", lw=0.6)
        axes.add_collection(PolyCollection([ship["hull"]], facecolors="#d55e00", edgecolors="none"))
