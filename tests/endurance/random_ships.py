"""The ships of random scenes: hulls, engines, steering, pilots, moorings; and places for all hulls."""

import math

from random_numbers import are_apart, box, turned


def wedge(length, beam, entrance_deg):
    """The waterline that the main dimensions of a wedge bow give."""
    bow = min(length, beam / 2 / math.tan(math.radians(entrance_deg)))
    return [(length / 2, 0), (length / 2 - bow, beam / 2), (-length / 2, beam / 2), (-length / 2, -beam / 2),
            (length / 2 - bow, -beam / 2)]


def hull(dice, length):
    """A hull, and its waterline in the ship's frame."""
    beam = length * dice.between(0.16, 0.24)
    angle = dice.choice((20, 27, 30, 45, dice.between(15, 70)))
    if dice.chance(0.75):
        keys = {"length_m": length, "beam_m": beam, "entrance_angle_deg": angle}
        outline = wedge(length, beam, angle)
        if dice.chance(0.8):
            keys["stem_angle_deg"] = dice.choice((20, 30, 45, 60, 78, 79, 85, 90, dice.between(15, 90)))
    else:
        outline = dice.choice((box(-length / 2, -beam / 2, length / 2, beam / 2),
                               wedge(length, beam, angle),
                               [(0.5 * length, 0), (0.3 * length, beam / 2), (-0.4 * length, beam / 2),
                                (-0.5 * length, 0), (-0.4 * length, -beam / 2), (0.3 * length, -beam / 2)]))
        keys = {"waterline_m": [list(point) for point in outline]}
        if dice.chance(0.4):
            keys["angles_from_vertical_deg"] = [dice.choice((0, 10, 30, 45, 60)) for _ in outline]
    return keys, outline, beam


def ship_of_size(dice, length):
    """A ship without place, propulsion or pilot; and its waterline and draught, which may be none."""
    keys, outline, beam = hull(dice, length)
    deep = beam * dice.between(0.25, 0.42)
    block = dice.between(0.5, 0.75)
    mass = 1000 * block * length * beam * deep
    ship = {"hull": keys}
    if dice.chance(0.85):
        keys.update(draught_m=deep, block_coefficient=block)
        if dice.chance(0.2):
            keys["submersion_speed_factor"] = "none"
    else:
        deep = None
        ship.update(mass_kg=mass, moment_of_inertia_kg_m2=mass * length**2 / 16)
    if dice.chance(0.15):  # mass and inertia differ from those of draught and block coefficient
        ship.update(moment_of_inertia_kg_m2=mass * length**2 / 16 * dice.between(0.5, 1.5),
                    mass_kg=mass * dice.between(0.6, 1.4))
    if dice.chance(0.2):
        ship["panels"] = panels(dice)
    return ship, outline, deep, mass


def panels(dice):
    return {"length_m": dice.choice((1, 2.5, dice.between(0.5, 10))), "bottom_m": -2, "top_m": 1,
            "rows": dice.randint(1, 4)}


def preset(dice):
    """A ship that is asked for by name, with the measures of the program's table."""
    name, length, beam, entrance, deep = dice.choice((
        ("sawamura2017", 120, 24, 27, None), ("reference", 120, 24, 27, 6), ("araon", 95, 19, 30, 6.8)))
    ship = {"ship": name, "hull": {}}
    return ship, wedge(length, beam, entrance), deep, 6e6 if name == "araon" else 1e7


def engine(dice, length, deep):
    power = 6 * (length / 80) ** 2 * dice.between(1, 2.5)
    keys = {"open_water_speed_m_per_s": dice.between(3.5, 4.5) * (length / 80) ** 0.5}
    if dice.chance(0.6):
        keys.update(power_MW=power, propeller_diameter_m=0.6 * deep, propellers=dice.randint(1, 3))
        if dice.chance(0.3):
            keys["nozzles"] = True
    else:
        keys["bollard_pull_kN"] = 120 * power
    if dice.chance(0.5):
        keys["lever_rate_per_s"] = dice.choice((0.033, 0.1, 1))
    if dice.chance(0.3):
        keys["astern_share"] = dice.between(0.3, 1)
    return keys


def propel(dice, setting, ship, length, deep, mass, speed):
    """Gives a ship its propulsion and steering. Returns whether it has an engine, and whether it is steered."""
    if deep is not None and dice.chance(0.7):
        if "ship" not in ship or dice.chance(0.5):
            ship["propulsion"] = {"engine": engine(dice, length, deep)}
        else:
            ship["propulsion"] = {"engine": {"lever_rate_per_s": 0.1}}
        ship["speed_m_per_s"] = speed
        setting.see_speed(abs(speed), 4.5 * (length / 80) ** 0.5 + 8 * ("ship" in ship))
        if dice.chance(0.2):
            return True, False
        ship["steering"] = dice.choice(({"rudder": {}}, {"rudder": {"area_m2": 0.02 * length * deep}}, {"azimuth": {}}))
        return True, True
    if dice.chance(0.5):
        ship["propulsion"] = {"constant_speed_m_per_s": speed}
        setting.see_speed(abs(speed))
        return False, False
    ship["propulsion"] = {"thrust_N": math.copysign(mass * dice.choice((0, 0.05, 0.1, dice.decades(0.02, 0.3))), speed)}
    ship["speed_m_per_s"] = speed
    setting.see_speed(abs(speed), 4)
    if dice.chance(0.15):
        ship.update(sway_speed_m_per_s=dice.between(-0.5, 0.5), yaw_rate_deg_per_s=dice.between(-2, 2))
    if deep is not None and dice.chance(0.5):
        ship["water"] = {"model": "manoeuvring"}
        if dice.chance(0.3):
            ship["water"]["resistance_coefficient"] = dice.between(0, 0.01)
    return False, False


def pilot(dice, setting, ship, is_steered, place):
    """A pilot that finds its way alone."""
    kinds = {"constant": 1, "hold_speed": 1, "table": 1, "ram": 2}
    if is_steered:
        kinds.update(hold_heading=1, route=3)
    x, y, heading_deg = place
    kind = dice.among(kinds)
    settings = {}
    if kind == "constant":
        settings = {"lever": dice.choice((1, 0.5, -1))}
        if is_steered:
            settings["steering_deg"] = dice.choice((0, 10, -35, dice.between(-30, 30)))
    elif kind == "hold_speed":
        settings = {"speed_m_per_s": dice.between(0.5, 4)}
        if is_steered and dice.chance(0.3):
            settings["heading_deg"] = setting.plane.heading(heading_deg + dice.between(-20, 20))
    elif kind == "table":
        steering = (0, 10, -20) if is_steered else (0,)
        settings = {"rows": [{"t_s": t, "lever": dice.choice((1, 0.5, 0, -0.5)), "steering_deg": dice.choice(steering)}
                             for t in range(0, 60, dice.choice((10, 20, 30)))]}
    elif kind == "ram":
        if dice.chance(0.5):
            settings = {"stuck_s": dice.choice((1, 3, 10)), "back_m": dice.choice((5, 20)),
                        "stuck_speed_m_per_s": dice.choice((0.1, 0.5))}
    elif kind == "hold_heading":
        settings = {"heading_deg": setting.plane.heading(heading_deg + dice.choice((0, 90, dice.between(-40, 40)))),
                    "lever": dice.choice((1, 0.7))}
    else:
        settings = {"waypoints": waypoints(dice, setting, x, y, heading_deg)}
        if dice.chance(0.3):
            settings["look_ahead_lengths"] = dice.between(1, 4)
    ship["pilot"] = {kind: settings}


def waypoints(dice, setting, x, y, heading_deg):
    """Of a route ahead, each leg turned by little. It must not come near to a hull that stands."""
    points, angle = [], heading_deg
    for _ in range(dice.randint(1, 3)):
        leg = dice.between(80, 200)
        x, y = x + leg * math.cos(math.radians(angle)), y + leg * math.sin(math.radians(angle))
        points.append({"position_m": setting.plane.point(x, y), "speed_m_per_s": dice.between(1, 5)})
        angle += dice.between(-40, 40)
    return points


def legs_are_clear(setting, start, points, beam):
    """Does a route, and the way to it, keep clear of what stands?"""
    line = [setting.plane.point(*start)] + [point["position_m"] for point in points]
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        leg = [(ax, ay), (bx, by), ((ax + bx) / 2, (ay + by) / 2)]
        if any(not are_apart(leg, setting.plane.ring(body), beam) for body in setting.standing):
            return False
    return True


def mooring(dice, mass, length):
    """With natural periods of 10 to 60 s."""
    stiffness = mass * (2 * math.pi / dice.between(10, 60)) ** 2
    turning = stiffness * length**2 / 16
    keys = {"surge_stiffness_N_per_m": stiffness, "sway_stiffness_N_per_m": stiffness,
            "yaw_stiffness_Nm_per_rad": turning}
    if dice.chance(0.6):
        damping = dice.choice((0.1, 0.5)) * 2 * math.sqrt(stiffness * mass)
        keys.update(surge_damping_N_s_per_m=damping, sway_damping_N_s_per_m=damping,
                    yaw_damping_Nm_s_per_rad=damping * length**2 / 16)
    if dice.chance(0.3):
        keys["break_load_N"] = stiffness * dice.between(0.5, 5)
    return keys


def places(dice, setting, outline, is_round):
    """Places to try for a hull: (x, y, heading), west or east of the ice, or in room within it."""
    length = max(x for x, _ in outline) - min(x for x, _ in outline)
    for _ in range(12):
        middle = setting.width_m / 2
        y = dice.choice((middle, middle, dice.uniform(0.2, 0.8) * setting.width_m))
        swing = 0 if is_round else dice.choice((0, 0, dice.uniform(-15, 15)))
        side = dice.among({"west": 4, "east": 1, "inside": 2})
        if side != "inside":
            heading = swing + dice.choice((0, 0, 0, 180)) if side == "west" else swing + 180
            corners = turned(outline, heading)
            if side == "west":
                yield -max(x for x, _ in corners) - setting.gap(), y, heading, True
            else:
                yield setting.length_m - min(x for x, _ in corners) + setting.gap(), y, heading, True
            continue
        rooms = [room for room in setting.room_m if room[2] - room[0] > 1.4 * length and room[3] - room[1] > 12]
        if rooms and length < 0.5 * setting.length_m:
            x0, y0, x1, y1 = dice.choice(rooms)
            yield (dice.uniform(x0 + 0.6 * length, x1 - 0.6 * length), dice.uniform(y0 + 5, y1 - 5),
                   dice.choice((0, 90, dice.uniform(-180, 180))), False)


def stand(dice, setting, outline, is_round=False):
    """Finds and takes a place for a hull; None where there is none. A round one is not turned."""
    for x, y, heading, is_outside in places(dice, setting, outline, is_round):
        body = turned(outline, heading, (x, y))
        # Outside it must not extend over the ice, and inside it must stay within the room for hulls.
        is_free = is_outside or any(all(x0 < px < x1 and y0 < py < y1 for px, py in body)
                                    for x0, y0, x1, y1 in setting.room_m)
        if is_free and all(are_apart(body, other, 1) for other in setting.hulls):
            setting.hulls.append(body)
            return x, y, heading, is_outside
    return None


def drop_blocked_routes(setting):
    """A route that comes near to what stands is refused: such a ship goes straight on."""
    for ship, place, beam in setting.routes:
        route = ship.get("pilot", {}).get("route")
        if route and not legs_are_clear(setting, place, route["waypoints"], beam):
            ship["pilot"] = {"constant": {}}


def place_ship(dice, setting, ship, place):
    x, y, heading, _ = place
    ship["position_m"] = setting.plane.point(x, y)
    ship["heading_deg"] = setting.plane.heading(heading)
    if ship["heading_deg"] == 0 and dice.chance(0.5):
        del ship["heading_deg"]


def speed_into_ice(dice, setting, place):
    """Of a ship, along its heading: into the ice, also by the stern, or any way within it."""
    speed = dice.choice((0.5, 1, 2, 3, dice.decades(0.3, 5), dice.decades(1, setting.fastest_m_per_s)))
    if setting.exact_m_per_s:
        speed = setting.exact_m_per_s
    if not place[3]:
        return dice.choice((0, 1, -1, min(speed, 4)))
    is_stern_first = (abs(place[2]) < 90) != (place[0] < 0)
    return -speed if is_stern_first else speed


def ships(dice, setting):
    """Up to three ships; with two or more, one may follow another or manage the ice of another body."""
    result = []
    for number in range(dice.among({0: 1, 1: 5, 2: 4, 3: 2})):
        if dice.chance(0.1):
            ship, outline, deep, mass = preset(dice)
        else:
            ship, outline, deep, mass = ship_of_size(dice, dice.choice((30, 60, 100, dice.between(15, 120))))
        length = max(x for x, _ in outline) - min(x for x, _ in outline)
        place = stand(dice, setting, outline)
        if not place:
            continue
        ship["name"] = f"vessel {number + 1}"
        place_ship(dice, setting, ship, place)
        if "ship" not in ship and dice.chance(0.2):
            ship["propulsion"] = {"thrust_N": 0}
            ship["mooring"] = mooring(dice, mass, length)
            if deep is not None and dice.chance(0.7):
                ship["water"] = {"model": "manoeuvring"}
        else:
            speed = speed_into_ice(dice, setting, place)
            has_engine, is_steered = propel(dice, setting, ship, length, deep, mass, speed)
            if has_engine and dice.chance(0.9):
                choose_pilot(dice, setting, ship, is_steered, place, length, result)
                setting.routes.append((ship, place[:2], length / 4))
        result.append(ship)
    return result


def choose_pilot(dice, setting, ship, is_steered, place, length, others):
    moored = [other["name"] for other in others if "mooring" in other] + setting.structure_names
    ahead = [other["name"] for other in others if "mooring" not in other]
    if is_steered and ahead and dice.chance(0.4):
        ship["pilot"] = {"follow": {"ship": dice.choice(ahead), "distance_m": dice.between(10, 100)}}
    elif is_steered and moored and dice.chance(0.6):
        ship["pilot"] = {"manage": manage(dice, dice.choice(moored), length)}
    else:
        pilot(dice, setting, ship, is_steered, place[:3])


def manage(dice, body, length):
    """A pattern far enough from the body for the safety radius."""
    pattern = dice.choice(("linear", "sector", "circular", "racetrack", "largest_floe"))
    distance = dice.between(180, 400)
    width = dice.between(0.4, 0.6) * distance
    keys = {"body": body, "pattern": pattern, "distance_m": distance, "width_m": width,
            "safety_radius_m": min(0.3 * distance, 40 + length / 2), "frame": dice.choice(("body", "ice"))}
    if dice.chance(0.7):
        keys["speed_m_per_s"] = dice.between(1, 4)
    if dice.chance(0.4):
        keys["depth_m"] = dice.between(0.1, 0.3) * width
    if pattern == "largest_floe" and dice.chance(0.5):
        keys["least_floe_m2"] = 20
    if pattern != "largest_floe":
        keys["phase"] = dice.choice((0, 0.5, dice.between(0, 0.99)))
    return keys
