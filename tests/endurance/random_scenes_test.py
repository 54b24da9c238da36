#!/usr/bin/env python3
"""A seed gives one scene, and in some hundred seeds all that a scene may have occurs."""

import collections
import json
import math
import unittest

import random_scenes

SEEDS = range(1, 301)


def features(scene):
    """What occurs in a scene, in words."""
    yield from (f"floes of {next(iter(entry))}" for entry in scene["floes"])
    for entry in scene["floes"]:
        yield from (f"floes with {key}" for key in entry)
        yield from (f"field with {key}" for key in entry.get("field", {}))
        yield from (f"sizes by {key}" for key in entry.get("field", {}).get("sizes", {}))
        if entry.get("polygon", {}).get("holes_m"):
            yield "a plate with holes"
        if entry.get("fast_ice") and "velocity_m_per_s" in entry:
            yield "fast ice that is driven"
    for ship in scene["ships"]:
        yield from (f"ship with {key}" for key in ship)
        yield from (f"propulsion by {key}" for key in ship["propulsion"])
        yield from (f"steering by {key}" for key in ship.get("steering", {}))
        yield from (f"pilot {key}" for key in ship.get("pilot", {}))
        yield from (f"pattern {settings['pattern']}" for settings in ship.get("pilot", {}).values()
                    if "pattern" in settings)
    for structure in scene["structures"]:
        shape = "pile" if "radius_m" in structure else "box"
        yield f"{'inclined ' if 'wall_angle_deg' in structure else ''}{shape}"
    for wall in scene["walls"]:
        yield f"wall that {'presses' if 'pressure' in wall else 'moves' if 'velocity_m_per_s' in wall else 'stands'}"
    for part in ("water", "wind", "time", "contact", "fracture"):
        yield from (f"{part}.{key}" for key in scene[part])
    yield from (f"fracture.bending.{key}" for key in scene["fracture"]["bending"])
    yield f"contacts of {scene['record']['contacts']}"
    yield "a chosen tick" if "step_s" not in scene["time"] else "a given tick"


EXPECTED = {
    "floes of lattice", "floes of rectangle", "floes of polygon", "floes of field", "floes of file", "floes with ice",
    "floes with fast_ice", "floes with velocity_m_per_s", "floes with angular_velocity_deg_per_s", "floes with import",
    "a plate with holes", "fast ice that is driven", "field with floe_size_m", "field with centreline_m",
    "field with outline_m", "field with corner_m", "field with aspect", "field with packing", "sizes by size_m",
    "sizes by mean_m", "sizes by exponent", "ship with ship", "ship with mooring", "ship with panels",
    "ship with sway_speed_m_per_s", "propulsion by thrust_N",
    "propulsion by constant_speed_m_per_s", "propulsion by engine", "steering by rudder", "steering by azimuth",
    "pilot constant", "pilot hold_speed", "pilot hold_heading", "pilot route", "pilot table", "pilot ram",
    "pilot follow", "pilot manage", "pattern linear", "pattern sector", "pattern circular", "pattern racetrack",
    "pattern largest_floe", "pile", "box", "inclined pile", "inclined box", "wall that stands", "wall that moves",
    "wall that presses", "water.drift_m_per_s", "water.drift_table", "water.tide", "water.shear",
    "wind.velocity_m_per_s", "wind.table", "contact.substeps", "fracture.cusp_fate", "fracture.going_under",
    "fracture.bending.model", "fracture.bending.strength_spread", "contacts of all", "contacts of ships",
    "contacts of none", "a chosen tick", "a given tick"}


def numbers(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            yield from numbers(item)
    elif isinstance(value, float):
        yield value


class RandomScenes(unittest.TestCase):
    def test_a_seed_gives_one_scene(self):
        for law in ("crush", "impulse"):
            for seed in (1, 2, 3):
                self.assertEqual(random_scenes.build(seed, law), random_scenes.build(seed, law))
        self.assertNotEqual(random_scenes.scene(1, "crush"), random_scenes.scene(2, "crush"))

    def test_a_short_scene_is_the_same_but_for_its_duration(self):
        for seed in SEEDS[:30]:
            whole, short = random_scenes.build(seed, "crush")[0], random_scenes.build(seed, "crush", 0.4)[0]
            self.assertLess(short["time"].pop("until_s"), whole["time"].pop("until_s"))
            self.assertEqual(whole, short)

    def test_all_that_a_scene_may_have_occurs(self):
        found = collections.Counter()
        for seed in SEEDS:
            found.update(set(features(random_scenes.scene(seed, "crush"))))
        self.assertEqual(sorted(EXPECTED - set(found)), [])

    def test_numbers_are_finite_and_durations_within_bounds(self):
        for law in ("crush", "impulse"):
            for seed in SEEDS:
                scene = random_scenes.scene(seed, law)
                self.assertTrue(all(map(math.isfinite, numbers(scene))), seed)
                self.assertTrue(10 <= scene["time"]["until_s"] <= 120, seed)

    def test_what_law_impulse_does_not_allow_is_left_out(self):
        for seed in SEEDS:
            text = json.dumps(random_scenes.scene(seed, "impulse"))
            self.assertFalse("fast_ice" in text or '"pressure"' in text, seed)
            self.assertFalse("circle-centres" in json.dumps(random_scenes.scene(seed, "crush")), seed)

    def test_floe_files_are_those_that_the_scene_names(self):
        for seed in SEEDS:
            scene, files = random_scenes.build(seed, "crush")
            self.assertEqual({entry["file"] for entry in scene["floes"] if "file" in entry}, set(files), seed)


if __name__ == "__main__":
    unittest.main()
