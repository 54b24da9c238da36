"""What stands in the ice of random scenes: piles, boxes and cones; and walls, which may also move and press."""

import math

from random_numbers import are_apart, box, turned
from random_ships import panels, stand


def structures(dice, setting):
    """Piles, boxes and cones, in room within the ice or before its edges."""
    result = []
    for number in range(dice.among({0: 4, 1: 4, 2: 3, 4: 1})):
        size = dice.choice((0.5, 1, 5, dice.decades(0.3, 10)))
        keys = {"name": f"structure {number + 1}"}
        if dice.chance(0.6):
            outline = [(size * math.cos(math.pi * k / 12), size * math.sin(math.pi * k / 12)) for k in range(24)]
            keys["radius_m"] = size
        else:
            outline = dice.choice((box(-size, -size, size, size), box(-2 * size, -size, size, size),
                                   [(size, 0), (0, size), (-size, 0), (0, -size)]))
            keys["waterline_m"] = [list(point) for point in outline]
        if dice.chance(0.4):
            keys["wall_angle_deg"] = dice.choice((10, 30, 45, 60, dice.between(5, 75)))
        if dice.chance(0.2):
            keys["panels"] = panels(dice)
        is_round = "radius_m" in keys
        place = (stand if size > 2 else stand_small)(dice, setting, outline, is_round)
        if not place:
            continue
        keys["position_m"] = setting.plane.point(*place[:2])
        if "waterline_m" in keys:
            keys["heading_deg"] = setting.plane.heading(place[2])
        setting.standing.append(setting.hulls[-1])
        setting.structure_names.append(keys["name"])
        result.append(keys)
    return result


def stand_small(dice, setting, outline, is_round):
    """A place for what is small, mostly in a hole or field."""
    for _ in range(12):
        if not setting.room_m or dice.chance(0.3):
            return stand(dice, setting, outline, is_round)
        x0, y0, x1, y1 = dice.choice(setting.room_m)
        x, y = dice.choice(((x0 + x1) / 2, dice.uniform(x0, x1))), dice.choice(((y0 + y1) / 2, dice.uniform(y0, y1)))
        body = turned(outline, 0, (x, y))
        is_inside = all(x0 < px < x1 and y0 < py < y1 for px, py in body)
        if is_inside and all(are_apart(body, other, 1) for other in setting.hulls):
            setting.hulls.append(body)
            return x, y, 0, False
    return None


def walls(dice, setting):
    """Walls along edges of the ice, which they may touch exactly: they stand, move inwards or press."""
    if dice.chance(0.5):
        return []
    x1, y1 = setting.length_m, setting.width_m
    overhang = dice.choice((0, 5, 20))
    gap = dice.choice((0.0, 0.1, dice.between(0.05, 3)))
    faces = {"south": ((-overhang, -gap), (x1 + overhang, -gap)),
             "north": ((x1 + overhang, y1 + gap), (-overhang, y1 + gap)),
             "east": ((x1 + gap, -5), (x1 + gap, y1 + 5))}
    names = dice.choice((["south", "north"], ["east"], ["north"], ["south", "north", "east"]))
    result = []
    for name in names:
        (ax, ay), (bx, by) = faces[name]
        if name == "east":  # within the others, whose bodies it would meet
            ay, by = (-gap, y1 + gap) if len(names) > 1 else (ay, by)
        depth = dice.choice((2, 10))
        length = math.hypot(bx - ax, by - ay)
        nx, ny = (by - ay) / length, (ax - bx) / length  # away from the ice
        body = [(ax, ay), (bx, by), (bx + depth * nx, by + depth * ny), (ax + depth * nx, ay + depth * ny)]
        if not all(are_apart(body, other, 0.5) for other in setting.hulls):
            continue
        setting.hulls.append(body)
        setting.standing.append(body)
        wall = {"name": name, "from_m": setting.plane.point(ax, ay), "to_m": setting.plane.point(bx, by),
                "depth_m": depth}
        move(dice, setting, wall, (-nx, -ny))
        result.append(wall)
    return result


def move(dice, setting, wall, inwards):
    way = dice.among({"stands": 1, "moves": 1, "presses": 2 * (setting.law == "crush")})
    if way == "moves":
        speed = dice.choice((0.1, 0.2, dice.decades(0.02, 1)))
        wall["velocity_m_per_s"] = setting.plane.vector(speed * inwards[0], speed * inwards[1])
    elif way == "presses":
        most = 0.3 * setting.compressive_Pa * setting.thickness_m
        wall["pressure"] = {"line_load_N_per_m": min(most, dice.decades(5e3, 5e5))}
        if dice.chance(0.4):
            wall["pressure"]["closing_speed_m_per_s"] = dice.choice((0.05, 0.2, 0.5))
