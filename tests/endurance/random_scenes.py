#!/usr/bin/env python3
"""Makes random scenes in which all that a scene may have occurs at once, each with a probability.

A scene follows from its seed alone, on every machine. Laid out from west to east: bands of ice, hulls within and
around them, walls along their edges; a third of the scenes is turned and moved as a whole.

Usage: random_scenes.py SEED [LAW [FOLDER]]    writes the scene, and the floe files that it names, into the folder
"""

import json
import pathlib
import sys

import random_ice
import random_ships
import random_structures
from random_numbers import Dice, Plane

TICKS_S = (0.1, 0.05, 0.025, 0.02, 0.01, 0.005)
MOST_STEPS = 8000


class Setting:
    """What the parts of one scene have in common, and what is known of those that are already there."""

    def __init__(self, dice, law):
        self.law = law
        turn = dice.choice((0, 0, 0, 90, 45, dice.uniform(-180, 180)))
        self.plane = Plane(turn, (dice.between(-500, 500), dice.between(-500, 500)) if turn or dice.chance(0.1)
                           else (0.0, 0.0))
        self.width_m = dice.choice((60.0, 100.0, dice.between(30, 160)))
        self.length_m = 0.0  # length of all bands
        self.thickness_m = dice.choice((0.5, 1.0, dice.decades(0.05, 3), dice.decades(0.1, 1.5)))
        self.compressive_Pa = dice.choice((2.8e6, dice.between(1e6, 5e6)))
        self.fastest_m_per_s = dice.choice((3, 5, 10))
        self.spin_deg_per_s = dice.choice((1, 10, 60))
        self.most_floes = dice.choice((40, 100, 200))
        self.radius_m = dice.choice((1, 1, 1, 0.5, 2))
        self.origin = None
        self.exact_m_per_s, self.exact_step_s = 0.0, 0.0  # of scenes whose hulls reach edges exactly at a tick
        self.top_speed_m_per_s = 0.5
        self.run_up_m_per_s = 1.0
        self.files = {}            # floe files, by name
        self.room_m = []           # boxes in which hulls may stand
        self.hulls, self.standing = [], []  # outlines of all hulls, and of those at rest
        self.structure_names = []
        self.routes = []           # ships with pilots, their places and how far they keep from hulls
        self.dice = dice

    def see_speed(self, *speeds_m_per_s):
        self.top_speed_m_per_s = max(self.top_speed_m_per_s, *speeds_m_per_s)

    def gap(self):
        """Between a hull and the edge of the ice: none, a way of whole ticks, or any."""
        if self.exact_m_per_s:
            return self.dice.randint(0, 100) * self.exact_m_per_s * self.exact_step_s
        return self.dice.choice((0.0, 1.0, 2.0, self.dice.uniform(0, 5)))


def water(dice, setting):
    keys = {}
    if dice.chance(0.3):
        keys["density_kg_per_m3"] = dice.choice((1025, 1010))
    if dice.chance(0.2):
        keys["drag_coefficient"] = dice.between(0, 1)
    if dice.chance(0.2):
        keys["drag_area"] = "plan"
    if dice.chance(0.2):
        keys["skin_drag_coefficient"] = dice.between(0.003, 0.0055)
    flow = dice.among({"none": 3, "drift": 3, "table": 2})
    if flow == "drift":
        speed = dice.choice((0.2, 0.5, 1, dice.decades(0.05, 1.5)))
        setting.see_speed(speed + 0.5)
        x, y = dice.choice(((-1, 0), (0, 1), (-0.6, 0.8)))
        keys["drift_m_per_s"] = setting.plane.vector(x * speed, y * speed)
    elif flow == "table":
        keys["drift_table"] = flow_table(dice, setting, 1.2)
    if dice.chance(0.2):
        keys["tide"] = {"period_s": dice.choice((60, 600, 3600)), "major_m_per_s": dice.between(0.05, 0.8),
                        "minor_m_per_s": dice.between(-0.3, 0.3), "phase_deg": dice.choice((0, 90, 180)),
                        "direction_deg": setting.plane.heading(dice.choice((0, 90, 30)))}
        setting.see_speed(1.2)
    if dice.chance(0.15):
        keys["shear"] = {"rate_per_s": dice.choice((-1, 1)) * dice.decades(1e-4, 5e-3),
                         "direction_deg": setting.plane.heading(dice.choice((0, 180, 37))),
                         "origin_m": setting.plane.point(0, setting.width_m / 2)}
        setting.see_speed(2)
    return keys


def flow_table(dice, setting, most_m_per_s):
    times = sorted(dice.sample(range(0, 120, 5), dice.randint(1, 4)))
    setting.see_speed(most_m_per_s if most_m_per_s < 5 else 0)
    return [{"t_s": t, "speed_m_per_s": dice.between(0, most_m_per_s),
             "direction_deg": setting.plane.heading(dice.choice((180, 0, 90, dice.uniform(0, 360))))} for t in times]


def wind(dice, setting):
    if dice.chance(0.65):
        return {}
    keys = {"table": flow_table(dice, setting, 25)} if dice.chance(0.3) else {
        "velocity_m_per_s": setting.plane.vector(-dice.between(0, 25), dice.choice((0, dice.between(-10, 10))))}
    if dice.chance(0.3):
        keys["drag_coefficient"] = dice.between(0.001, 0.003)
    return keys


def ice(dice, setting):
    keys = {"thickness_m": setting.thickness_m, "compressive_strength_Pa": setting.compressive_Pa}
    ranges = {"density_kg_per_m3": (850, 930), "youngs_modulus_Pa": (1e9, 9e9), "poisson_ratio": (0.2, 0.4),
              "flexural_strength_Pa": (3e5, 1.2e6), "tensile_strength_Pa": (3e5, 1.2e6),
              "fracture_toughness_Pa_sqrt_m": (5e4, 2.5e5), "friction": (0, 0.6)}
    for key, (low, high) in ranges.items():
        if dice.chance(0.35):
            keys[key] = dice.between(low, high)
    return keys


def contact(dice, setting):
    keys = {"law": setting.law, "circle_radius_m": setting.radius_m}
    if setting.law == "crush":
        if dice.chance(0.15):
            keys["substeps"] = dice.randint(2, 4)
        if dice.chance(0.15):
            keys["start"] = "zero"
    else:
        keys.update(restitution=dice.choice((0, 0.1, 0.5, 1, dice.between(0, 1))),
                    normal=dice.choice(("boundary", "boundary", "circle-centres")))
        if dice.chance(0.3):
            keys["contact_time_s"] = dice.choice((0.1, 0.5, 2))
    if dice.chance(0.2):
        keys["separation_time_s"] = dice.choice((0.1, 1, 10))
    if dice.chance(0.15):
        keys["iterations"] = dice.choice((20, 300))
    return keys


def fracture(dice, ships):
    """The models that break ice. Ice goes under hulls only where a ship has a draught."""
    bending, splitting = {}, {}
    options = {"model": ("nevel", "kashtelyan", "fsi-database"), "radial_cracks": ("ignored",), "outline": ("wedge",),
               "deflection": ("ignored",), "decks": ("wet",), "strength_spread": (0.1, 0.3)}
    for key, values in options.items():
        if dice.chance(0.2):
            bending[key] = dice.choice(values)
    if dice.chance(0.4):
        splitting["model"] = dice.choice(("none", "michel", "lefm"))
    if dice.chance(0.15):
        splitting.update(least_piece_width_over_l=dice.choice((0, 1)), least_piece_area_over_l2=dice.choice((0, 1)))
    keys = {"bending": bending, "splitting": splitting}
    if dice.chance(0.15):
        keys["breakable_size_factor"] = dice.choice((0, 0.5, 2))
    if dice.chance(0.05):
        keys["characteristic_length"] = "as_printed"
    has_draught = any("draught_m" in ship["hull"] or ship.get("ship") in ("reference", "araon") for ship in ships)
    if dice.chance(0.4):
        fates = ("submerge", "float") + ("under_hull",) * has_draught
        keys["cusp_fate"] = dice.choice(fates)
    if dice.chance(0.2):
        keys["going_under"] = {"enabled": has_draught and dice.chance(0.5)}
    if dice.chance(0.15):
        keys["smallest_floe_m2"] = dice.choice((0.01, 0.5, 1))
    return keys


def record(dice, duration_s):
    keys = {"frames_interval_s": max(dice.choice((0.5, 1, 2, 5)), duration_s / 60),
            "contacts": dice.among({"ships": 6, "all": 3, "none": 1})}
    if dice.chance(0.6):
        keys["forces_interval_s"] = dice.choice((0.05, 0.1, 0.2, 0.5, 1))
    if dice.chance(0.3):
        keys["peak_response_s"] = dice.choice((0, 0.05))
    if dice.chance(0.4):
        keys["least_peak_N"] = 0
    return keys


def duration(dice, setting):
    """10 to 120 s; less where thin ice or fast bodies ask for many steps, which take long [s]."""
    wanted = dice.choice((10, 20, 30, 60, 120, dice.uniform(10, 120), dice.uniform(10, 120)))
    most_ways = 2500 if setting.law == "crush" else 1000  # of the ice's thickness; rigid impulses have no long steps
    return min(wanted, max(10, most_ways * setting.thickness_m / setting.top_speed_m_per_s))


def given_step(dice, setting, duration_s):
    """A tick in which nothing comes near to moving as far as a contact circle's radius; None: let it be chosen."""
    longest = 0.4 * setting.radius_m / setting.top_speed_m_per_s
    if setting.exact_step_s and setting.exact_step_s <= longest:
        return setting.exact_step_s
    if dice.chance(0.5):
        return None
    shortest = duration_s / MOST_STEPS
    ticks = [tick for tick in TICKS_S if shortest <= tick <= longest]
    if ticks and dice.chance(0.8):
        return dice.choice(ticks)
    return min(0.1, longest) * dice.uniform(0.5, 1)


def let_fast_ice_stand(floes):
    """Takes its velocity from all fast ice where one entry is driven and another is not: both could meet."""
    fast = [entry for entry in floes if entry.get("fast_ice")]
    if len({tuple(entry.get("velocity_m_per_s", (0.0, 0.0))) for entry in fast}) > 1:
        for entry in fast:
            entry.pop("velocity_m_per_s", None)


def build(seed, law, time_scale=1.0):
    """The scene of a seed, and the floe files beside it by name. A time scale below 1 shortens the run."""
    dice = Dice(seed)
    setting = Setting(dice, law)
    if dice.chance(0.2):
        setting.exact_step_s, setting.exact_m_per_s = dice.choice((0.05, 0.02, 0.01)), dice.choice((0.5, 1.0, 2.0))
    if dice.chance(0.3):
        setting.origin = {"latitude_deg": dice.choice((0, 70, 78.5, -65)),
                          "longitude_deg": dice.choice((0, 15.5, -120))}
    bands = random_ice.lay_bands(dice, setting)
    setting.length_m = bands[-1].x1_m
    floes = [entry for band in bands for entry in random_ice.entries_of(dice, setting, band)]
    let_fast_ice_stand(floes)
    setting.room_m = [room for band in bands for room in band.room_m]
    scene = {"name": f"random-{law}-{seed}", "seed": dice.randint(1, 10**6), "floes": floes,
             "structures": random_structures.structures(dice, setting),
             "ships": random_ships.ships(dice, setting),
             "walls": random_structures.walls(dice, setting), "water": water(dice, setting),
             "wind": wind(dice, setting), "ice": ice(dice, setting), "contact": contact(dice, setting)}
    random_ships.drop_blocked_routes(setting)
    if setting.origin:
        scene["origin"] = setting.origin
    scene["fracture"] = fracture(dice, scene["ships"])
    duration_s = duration(dice, setting)
    step_s = given_step(dice, setting, duration_s)
    scene["record"] = record(dice, duration_s)
    scene["time"] = {"until_s": max(2.0, duration_s * time_scale)}
    if step_s:
        scene["time"]["step_s"] = step_s
    return scene, setting.files


def scene(seed, law):
    """The scene of a seed, by contact law `crush` or `impulse`."""
    return build(seed, law)[0]


def write(folder, seed, law, time_scale=1.0):
    """Writes a scene and its floe files into a folder; returns the scene's path."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    made, files = build(seed, law, time_scale)
    for name, text in files.items():
        (folder / name).write_text(text)
    path = folder / "scene.json"
    path.write_text(json.dumps(made, indent=1))
    return path


def main():
    seed = int(sys.argv[1])
    law = sys.argv[2] if len(sys.argv) > 2 else "crush"
    print(write(sys.argv[3] if len(sys.argv) > 3 else f"random-{law}-{seed}", seed, law))


if __name__ == "__main__":
    main()
