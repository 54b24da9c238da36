"""The ice of random scenes: bands of ice from west to east, each of its own kind."""

import dataclasses
import json
import math

from random_numbers import box, turned

KINDS = {"power law": 2, "log-normal": 2, "equal": 1, "mean size": 2, "channel": 1.5, "lattice": 1, "plate": 2,
         "holed plate": 1.5, "odd shapes": 1.5, "file": 1.5}


@dataclasses.dataclass
class Band:
    """A rectangle of the layout that ice of one kind fills."""
    kind: str
    x0_m: float
    y0_m: float
    x1_m: float
    y1_m: float
    room_m: list = dataclasses.field(default_factory=list)  # boxes in which hulls may stand
    is_fast: bool = False

    def size_m(self):
        return self.x1_m - self.x0_m, self.y1_m - self.y0_m

    def box_m(self):
        return box(self.x0_m, self.y0_m, self.x1_m, self.y1_m)


def lay_bands(dice, setting):
    """Bands from x = 0 on, which touch or leave a gap."""
    bands, x = [], 0.0
    for _ in range(dice.among({1: 4, 2: 4, 3: 2})):
        width = dice.between(35, 120)
        bands.append(Band(dice.among(KINDS), x, 0.0, x + width, setting.width_m))
        x += width + dice.choice((0.0, 0.1, dice.between(0.05, 5)))
    return bands


def entries_of(dice, setting, band):
    """The entries of `floes` that fill a band."""
    makers = {"channel": channel, "lattice": lattice, "plate": plate, "holed plate": holed_plate,
              "odd shapes": odd_shapes, "file": floe_file}
    entries = makers.get(band.kind, field)(dice, setting, band)
    for entry in entries:
        if dice.chance(0.3):
            entry["ice"] = own_ice(dice, setting)
        if "fast_ice" not in entry and dice.chance(0.5):
            entry["velocity_m_per_s"] = velocity(dice, setting)
        if band.kind != "channel" and "file" not in entry and "fast_ice" not in entry and dice.chance(0.1):
            entry["angular_velocity_deg_per_s"] = spin(dice, setting, math.hypot(*band.size_m()))
    return entries


def spin(dice, setting, reach_m):
    """Of a floe whose rim is at most so far from its centre, and then moves at no more than the fastest floes."""
    rate = math.radians(dice.between(-1, 1) * setting.spin_deg_per_s)
    most = min(3, setting.fastest_m_per_s) / reach_m
    rate = max(-most, min(most, rate))
    setting.see_speed(abs(rate) * reach_m)
    return math.degrees(rate)


def velocity(dice, setting):
    speed = dice.choice((0.2, 0.5, 1, dice.decades(0.1, min(3, setting.fastest_m_per_s))))
    direction = math.radians(dice.choice((180, dice.uniform(0, 360))))
    setting.see_speed(speed)
    return setting.plane.vector(speed * math.cos(direction), speed * math.sin(direction))


def own_ice(dice, setting):
    """Of floes whose ice is not the scene's."""
    h = setting.thickness_m
    laws = {
        "thickness_m": [dice.between(0.5, 1.5) * h, {"mean": h, "spread": 0.3, "least": 0.4 * h, "most": 2 * h},
                        {"law": "uniform", "least": 0.5 * h, "most": 1.5 * h}],
        "density_kg_per_m3": [dice.between(850, 930), {"law": "normal", "mean": 890, "spread": 0.01, "most": 930}],
        "flexural_strength_Pa": [dice.between(3e5, 1e6), {"law": "normal", "spread": dice.between(0.05, 0.3)}],
        "compressive_strength_Pa": [dice.between(1.5e6, 4e6), {"spread": 0.2, "most": 2 * setting.compressive_Pa}],
        "tensile_strength_Pa": [dice.between(3e5, 1e6), {"spread": 0.2}],
        "fracture_toughness_Pa_sqrt_m": [dice.between(8e4, 2e5), {"law": "log_normal", "spread": 0.3}]}
    chosen = dice.sample(sorted(laws), dice.randint(1, 4))
    ice = {key: dice.choice(laws[key]) for key in chosen}
    if dice.chance(0.3):
        ice["seed"] = dice.randint(0, 99)
    return ice


def floe_count(dice, setting):
    return dice.decades(12, setting.most_floes)


def region(setting, band):
    """A field's rectangle; turned with the scene it is an outline."""
    if setting.plane.is_upright():
        corner = setting.plane.point(band.x0_m, band.y0_m)
        return {"corner_m": corner, "extent_m": list(band.size_m())}
    return {"outline_m": setting.plane.ring(band.box_m())}


def size_law(dice, kind, size_m):
    """A law of sizes whose mean area is about that of the size."""
    if kind == "equal":
        return {"size_m": size_m}
    if kind == "log-normal":
        return {"mean_m": 0.9 * size_m, "spread": dice.between(0.1, 0.5)}
    least = size_m / dice.between(1.5, 5)
    return {"exponent": dice.choice((0, 1, 1.87, 2, dice.between(-1, 3))), "least_m": least, "largest_m": 1.6 * size_m}


def field(dice, setting, band):
    """A random field, by a law of sizes or by a mean size. Hulls may stand in it: it keeps clear of them."""
    concentration = dice.choice((0.3, 0.5, 0.8, 0.9, dice.between(0.2, 0.95)))
    length, width = band.size_m()
    size = math.sqrt(concentration * length * width / floe_count(dice, setting))
    size = min(size, 0.2 * min(length, width))
    band.room_m.append((band.x0_m, band.y0_m, band.x1_m, band.y1_m))
    entry = {**region(setting, band), "concentration": concentration,
             "gap_m": dice.choice((0.002, 0.005, 0.01)) * size}
    if dice.chance(0.5):
        entry["seed"] = dice.randint(0, 1000)
    if band.kind == "mean size":
        entry.update(floe_size_m=size, size_spread=dice.between(0, 0.3), concentration=min(concentration, 0.9))
        return [{"field": entry}]
    entry["sizes"] = size_law(dice, band.kind, size)
    if dice.chance(0.2):
        entry.update(aspect=dice.between(1.3, 2), concentration=min(concentration, 0.8))
        if dice.chance(0.5):
            entry["orientation_deg"] = dice.choice((0, 45, dice.between(-180, 180)))
    elif dice.chance(0.2):
        entry.update(most_corners=dice.randint(6, 12), concentration=min(concentration, 0.75))
    if concentration < 0.6 and dice.chance(0.3):
        entry["packing"] = dice.choice((concentration, 0.75))
    return [{"field": entry}]


def channel(dice, setting, band):
    """A channel of small floes; a straight one lies between two plates, which are fast where the law allows it."""
    length, width = band.size_m()
    breadth = min(dice.between(8, 25), 0.5 * width)
    middle = dice.choice((width / 2, dice.uniform(0.4, 0.6) * width))
    is_bent = dice.chance(0.3)
    breadth = min(breadth, 0.25 * length) if is_bent else breadth
    aside = min(0.2 * width, 0.2 * length) if is_bent else 0
    inset = breadth / 2 if is_bent else 0  # its ends are square to the line
    line = [(band.x0_m + inset, middle), ((band.x0_m + band.x1_m) / 2, middle + aside), (band.x1_m - inset, middle)]
    concentration = dice.between(0.3, 0.9)
    count = min(floe_count(dice, setting), 100)
    size = min(math.sqrt(concentration * length * breadth / count), 0.2 * breadth)
    size = max(size, math.sqrt(concentration * length * breadth / (1.5 * setting.most_floes)))
    law = size_law(dice, dice.choice(("equal", "log-normal", "power law")), min(size, 0.3 * breadth))
    band.room_m.append((band.x0_m, middle - breadth / 2, band.x1_m, middle + breadth / 2))
    strip = {"field": {"centreline_m": setting.plane.ring(line if is_bent else line[::2]), "width_m": breadth,
                       "concentration": concentration, "gap_m": 0.01, "sizes": law}}
    if is_bent:
        return [strip]
    south = box(band.x0_m, 0.0, band.x1_m, middle - breadth / 2)
    north = box(band.x0_m, middle + breadth / 2, band.x1_m, width)
    is_fast = setting.law == "crush" and dice.chance(0.7)
    plates = [polygon(setting, side) for side in (south, north)]
    return [strip] + [{**side, "fast_ice": True} if is_fast else side for side in plates]


def polygon(setting, outer_m, holes_m=()):
    entry = {"outer_m": setting.plane.ring(outer_m)}
    if holes_m:
        entry["holes_m"] = [setting.plane.ring(hole) for hole in holes_m]
    return {"polygon": entry}


def rectangle(setting, x_m, y_m, size_m):
    entry = {"corner_m": setting.plane.point(x_m, y_m), "size_m": size_m}
    if not setting.plane.is_upright():
        entry["angle_deg"] = setting.plane.heading(0)
    return {"rectangle": entry}


def lattice(dice, setting, band):
    """Rows and columns of equal rectangles, which may touch exactly; a turned one is of single rectangles."""
    length, width = band.size_m()
    most = min(setting.most_floes, 100 if setting.plane.is_upright() else 40)
    rows = dice.randint(2, max(2, int(math.sqrt(most))))
    columns = dice.randint(2, max(2, min(most // rows, 12)))
    pitch = [length / columns, width / rows]
    share = dice.choice((1, 0.999, 0.95, dice.between(0.8, 1)))
    size = [share * pitch[0], share * pitch[1]]
    if setting.plane.is_upright():
        return [{"lattice": {"origin_m": setting.plane.point(band.x0_m, band.y0_m), "columns": columns, "rows": rows,
                             "pitch_m": pitch, "size_m": size}}]
    margin = [(pitch[0] - size[0]) / 2, (pitch[1] - size[1]) / 2]
    return [rectangle(setting, band.x0_m + i * pitch[0] + margin[0], j * pitch[1] + margin[1], size)
            for i in range(columns) for j in range(rows)]


def make_fast(dice, setting, band, entry):
    """Fast ice stands, or is driven over ground."""
    if setting.law != "crush" or not dice.chance(0.6):
        return
    entry["fast_ice"] = band.is_fast = True
    if dice.chance(0.3):
        speed = dice.choice((0.1, 0.2, 0.5, dice.decades(0.02, 1)))
        setting.see_speed(speed)
        entry["velocity_m_per_s"] = setting.plane.vector(-speed, 0)


def plate(dice, setting, band):
    """Level ice: a rectangle, or a polygon whose western edge is slanted or toothed."""
    length, width = band.size_m()
    style = dice.choice(("straight", "straight", "slanted", "toothed"))
    if style == "straight":
        entry = rectangle(setting, band.x0_m, band.y0_m, [length, width])
    elif style == "slanted":
        cut_off = (band.x0_m + 0.2 * length, width)
        entry = polygon(setting, [(band.x0_m, 0), (band.x1_m, 0), (band.x1_m, width), cut_off])
    else:
        teeth = dice.randint(2, 8)
        edge = [(band.x0_m + (0.1 * length if k % 2 else 0), width - k * width / (2 * teeth))
                for k in range(2 * teeth + 1)]
        entry = polygon(setting, edge + [(band.x1_m, 0), (band.x1_m, width)])
    make_fast(dice, setting, band, entry)
    return [entry]


def holed_plate(dice, setting, band):
    """A plate with one or two holes. In a hole is a floe, or room for a hull."""
    length, width = band.size_m()
    entries, holes = [], []
    for x in (0.5,) if dice.chance(0.5) else (0.25, 0.75):
        centre = (band.x0_m + x * length, width / 2)
        half = dice.between(0.1, 0.2) * min(length, width)
        corners = dice.choice((3, 4, 4, 6, 12))
        tilt = dice.choice((0, 45, dice.uniform(0, 360)))
        circle = [(half * math.cos(2 * math.pi * k / corners), half * math.sin(2 * math.pi * k / corners))
                  for k in range(corners)]
        holes.append(turned(circle, tilt, centre))
        if dice.chance(0.4):
            entries.append(polygon(setting, turned([(0.8 * x, 0.8 * y) for x, y in circle], tilt, centre)))
        elif half > 2:
            reach = 0.98 * half * math.cos(math.pi / corners) / math.sqrt(2)  # of a square in the hole, however turned
            band.room_m.append((centre[0] - reach, centre[1] - reach, centre[0] + reach, centre[1] + reach))
    holed = polygon(setting, band.box_m(), holes)
    make_fast(dice, setting, band, holed)
    return [holed] + entries


SHAPES = {  # in a square of half side 1
    "C": [(-1, -1), (1, -1), (1, -0.5), (-0.4, -0.5), (-0.4, 0.5), (1, 0.5), (1, 1), (-1, 1)],
    "L": [(-1, -1), (1, -1), (1, -0.3), (-0.3, -0.3), (-0.3, 1), (-1, 1)],
    "T": [(-1, 1), (-1, 0.4), (-0.3, 0.4), (-0.3, -1), (0.3, -1), (0.3, 0.4), (1, 0.4), (1, 1)],
    "triangle": [(-1, -1), (1, -1), (0, 1)],
    "square": [(-1, -1), (1, -1), (1, 1), (-1, 1)],
    "needle": [(-1, -0.12), (1, -0.12), (1, 0.12), (-1, 0.12)],
    "star": [(1, 0), (0.3, 0.3), (0, 1), (-0.3, 0.3), (-1, 0), (-0.3, -0.3), (0, -1), (0.3, -0.3)]}


def placed_shapes(dice, setting, band, most):
    """Outlines of all shapes, each turned within its own cell of the band."""
    length, width = band.size_m()
    cell = math.sqrt(length * width / dice.randint(4, most))
    cell = min(cell, length, width)
    columns, rows = int(length / cell + 1e-9), int(width / cell + 1e-9)
    half = cell / 2 * dice.choice((0.6, 0.69))
    for i in range(columns):
        for j in range(rows):
            centre = (band.x0_m + (i + 0.5) * cell, band.y0_m + (j + 0.5) * cell)
            shape = [(half * x, half * y) for x, y in SHAPES[dice.choice(sorted(SHAPES))]]
            yield turned(shape, dice.choice((0, 90, dice.uniform(0, 360))), centre), half


def odd_shapes(dice, setting, band):
    """Floes of shapes that fields do not have, concave ones too, which move and spin."""
    entries = []
    for outline, half in placed_shapes(dice, setting, band, min(30, setting.most_floes)):
        entry = polygon(setting, outline)
        if dice.chance(0.3):
            entry["velocity_m_per_s"] = velocity(dice, setting)
        if dice.chance(0.2):
            entry["angular_velocity_deg_per_s"] = spin(dice, setting, 1.5 * half)
        entries.append(entry)
    return entries


def floe_file(dice, setting, band):
    """Floes of a GeoJSON file: in metres or degrees; with properties, overlaps and crossed outlines to repair."""
    in_degrees = setting.origin is not None
    features, is_crossed = [], dice.chance(0.3)
    for outline, half in placed_shapes(dice, setting, band, min(30, setting.most_floes)):
        if is_crossed and len(outline) == 4 and half > 2:
            outline[1], outline[2] = outline[2], outline[1]
        ring = [degrees(setting.origin, *point) if in_degrees else list(point) for point in setting.plane.ring(outline)]
        properties = {}
        if dice.chance(0.3):
            properties["CM"] = 100 * setting.thickness_m * dice.between(0.5, 1.5)
        if dice.chance(0.2) and not in_degrees:
            properties["vx_m_per_s"], properties["vy_m_per_s"] = velocity(dice, setting)
        if dice.chance(0.2):
            properties["fracture_toughness_Pa_sqrt_m"] = dice.between(8e4, 2e5)
        features.append({"type": "Feature", "properties": properties,
                         "geometry": {"type": "Polygon", "coordinates": [ring + ring[:1]]}})
    name = f"floes-{len(setting.files)}.geojson"
    setting.files[name] = json.dumps({"type": "FeatureCollection", "features": features})
    rules = {"repair": dice.choice(("even-odd", "non-zero")), "properties": "thickness_m=CM*0.01", "min_area_m2": 0.5}
    if dice.chance(0.4):
        rules["simplify_m"] = dice.choice((0.01, 0.1))
    if dice.chance(0.4):
        rules["gap_m"] = dice.choice((0.01, 0.1))
    if in_degrees:
        rules["from"] = "EPSG:4326"
    return [{"file": name, "import": rules}]


def degrees(origin, x_m, y_m):
    """About the longitude and latitude of a point of the plane about a place, x to the east."""
    latitude = origin["latitude_deg"] + y_m / 111.4e3
    return [origin["longitude_deg"] + x_m / (111.4e3 * math.cos(math.radians(origin["latitude_deg"]))), latitude]
