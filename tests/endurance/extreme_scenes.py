#!/usr/bin/env python3
"""Runs scenes with one to four numbers at the ends of what the schema allows, or drawn from all of it.

What `polynya validate` lets through must run: a scene may be refused (exit code 3, with a place and what is allowed),
and must else run its first ticks with every account closed and every check passed (0). The scene.json of its run folder
must be valid, and `polynya inspect --check` must be able to read the folder. Anything else is kept and told.

Usage: tests/endurance/extreme_scenes.py [TRIALS [SEED [POLYNYA]]]   100, 1, build/dev/app/polynya; failures go to
runs/extreme
"""

import collections
import copy
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

TICKS = 40         # ticks of a run: a scene that fails by its numbers alone fails early
TIME_LIMIT = 600   # time after which a command counts as hanging [s]
LEAST_SIZE = 1e-100  # least size of a number that is not 0; smaller ones are refused
TRIED = ("runs", "is refused")

SHIP = {"hull": {"length_m": 60, "beam_m": 12, "entrance_angle_deg": 30, "draught_m": 4, "block_coefficient": 0.6},
        "position_m": [-32, 0], "propulsion": {"constant_speed_m_per_s": 1}}
SAILING = {**SHIP, "propulsion": {"engine": {"bollard_pull_kN": 500, "open_water_speed_m_per_s": 7}},
           "steering": {"rudder": {}}, "speed_m_per_s": 2}
PUSHED = {**SHIP, "propulsion": {"thrust_N": 2e5}, "speed_m_per_s": 1, "mass_kg": 2e6,
          "moment_of_inertia_kg_m2": 4e8, "hull": {"length_m": 60, "beam_m": 12, "entrance_angle_deg": 30}}
MOORED = {**SAILING, "mooring": {"surge_stiffness_N_per_m": 1e5, "sway_stiffness_N_per_m": 1e5,
                                 "yaw_stiffness_Nm_per_rad": 1e8}}
ICE = [{"rectangle": {"corner_m": [0.5, -10], "size_m": 20}},
       {"rectangle": {"corner_m": [21, -10], "size_m": [10, 8]}, "velocity_m_per_s": [-0.5, 0.1],
        "angular_velocity_deg_per_s": 2}]
HOLED = {"polygon": {"outer_m": [[0.5, -12], [25, -12], [25, 12], [0.5, 12]],
                     "holes_m": [[[8, -3], [14, -3], [14, 3], [8, 3]]]}}
FIELD = {"field": {"corner_m": [0.5, -15], "extent_m": [40, 30], "concentration": 0.6, "floe_size_m": 6}}
LATTICE = {"lattice": {"origin_m": [0.5, -15], "columns": 3, "rows": 3, "pitch_m": 11, "size_m": 10},
           "ice": {"thickness_m": {"mean": 0.4, "spread": 0.3}}}
PILE = {"radius_m": 3, "position_m": [40, 0], "panels": {"length_m": 1}}
BOX = {"waterline_m": [[-3, -3], [3, -3], [3, 3], [-3, 3]], "position_m": [40, 0], "wall_angle_deg": 40}
WALLS = [{"from_m": [0, -11], "to_m": [30, -11], "velocity_m_per_s": [0, 0.2]},
         {"from_m": [30, 11], "to_m": [0, 11], "pressure": {"line_load_N_per_m": 1e5}}]
PILOTS = ({"constant": {}}, {"hold_speed": {"speed_m_per_s": 2}}, {"hold_heading": {}}, {"ram": {}},
          {"table": {"rows": [{"t_s": 0, "lever": 1}, {"t_s": 3, "lever": -1, "steering_deg": 5}]}},
          {"route": {"waypoints": [{"position_m": [500, 0], "speed_m_per_s": 3}]}})
MANAGING = {**SAILING, "position_m": [200, 0],
            "pilot": {"manage": {"body": "tower", "pattern": "circular", "width_m": 80, "distance_m": 200,
                                 "safety_radius_m": 60}}}
FOLLOWING = {**SAILING, "name": "second", "position_m": [-32, 30],
             "pilot": {"follow": {"ship": "ship-1", "distance_m": 100}}}
BASES = [{"ships": [ship], "floes": ICE} for ship in (SHIP, PUSHED, MOORED)] + [
    {"ships": [{**SAILING, "pilot": pilot}], "floes": ICE} for pilot in PILOTS] + [
    {"ships": [{**SHIP, "panels": {"length_m": 3}}], "structures": [PILE], "floes": ICE},
    {"ships": [SHIP], "floes": [HOLED], "fracture": {"cusp_fate": "float"}},
    {"structures": [PILE], "floes": ICE[1:]},
    {"structures": [BOX], "floes": ICE, "water": {"drift_m_per_s": [0.5, 0.1]}},
    {"ships": [{**SHIP, "position_m": [-32.4, 0]}], "floes": [{**ICE[0], "fast_ice": True}, ICE[1]]},
    {"walls": WALLS, "floes": ICE},
    {"wind": {"velocity_m_per_s": [8, 3]}, "water": {"shear": {"rate_per_s": 0.001}}, "floes": ICE},
    {"ships": [MOORED], "water": {"tide": {"major_m_per_s": 0.5}}, "floes": ICE},
    {"ships": [SHIP], "floes": [FIELD]},
    {"ships": [SAILING], "floes": [LATTICE]},
    {"ships": [SHIP, FOLLOWING], "floes": ICE},
    {"ships": [MANAGING], "structures": [{"name": "tower", "radius_m": 5}],
     "floes": [{"rectangle": {"corner_m": [8, 0], "size_m": 9}}]}]

# Objects that a scene has even if its file does not state them.
SETTINGS = ("time", "water", "ice", "contact", "fracture", "record")
# Numbers of fields and lattices that may make a million floes of them.
LARGE = {"columns", "rows", "extent_m", "floe_size_m", "size_m", "mean_m", "least_m", "largest_m", "gap_m"}


def numbers(schema, path=()):
    """Every number of a schema and every choice, by its path, in which [] stands for an item of a list."""
    for alternative in schema.get("oneOf", []):
        yield from numbers(alternative, path)
    if schema.get("type") in ("number", "integer") or "enum" in schema:
        yield path, schema
    if isinstance(schema.get("items"), dict):
        yield from numbers(schema["items"], path + ("[]",))
    for key, value in schema.get("properties", {}).items():
        yield from numbers(value, path + (key,))


def places(value, path):
    """Where a path of the schema leads in a scene: lists of keys. The last key, and settings, need not be there."""
    if not path:
        return [[]]
    key, rest = path[0], path[1:]
    if key == "[]":
        items = value if isinstance(value, list) else []
        return [[i] + keys for i, item in enumerate(items) for keys in places(item, rest)]
    if not isinstance(value, dict) or (key not in value and rest and key not in SETTINGS and value):
        return []
    return [[key] + keys for keys in places(value.get(key, {}), rest)]


def put(scene, keys, value):
    for key in keys[:-1]:
        scene = scene.setdefault(key, {}) if isinstance(scene, dict) else scene[key]
    scene[keys[-1]] = value


def drawn(dice, schema):
    """A choice, or a number at an end of its range, next to 0, or even over the range's decades."""
    if "enum" in schema:
        return dice.choice(schema["enum"])
    low = schema.get("minimum", schema.get("exclusiveMinimum", -1e9))
    high = schema.get("maximum", schema.get("exclusiveMaximum", 1e9))
    least = max(low, LEAST_SIZE) if "exclusiveMinimum" in schema and low >= 0 else low
    most = math.nextafter(high, low) if "exclusiveMaximum" in schema else high
    choices = [least, most, least, most, dice.uniform(least, most)]
    if low <= 0 < high:
        choices += [math.copysign(10 ** dice.uniform(-100, 0), dice.choice([-1, 1]) if low < 0 else 1), most * 1e-9]
    if high > 0:
        decades = math.log10(max(least, high * 1e-12)), math.log10(high)
        choices += [10 ** dice.uniform(*decades), 10 ** dice.uniform(*decades)]
    value = min(max(dice.choice(choices), least), most)
    return round(value) if schema["type"] == "integer" else value


def drawn_scene(dice, choices):
    """One of the bases, by either law, with one to four numbers drawn anew."""
    scene = copy.deepcopy(dice.choice(BASES))
    if dice.random() < 0.2:
        scene["contact"] = {"law": "impulse"}
    for _ in range(dice.randint(1, 4)):
        path, schema = dice.choice(choices)
        found = places(scene, path)
        if found and not (path[0] == "floes" and LARGE & set(path)):
            put(scene, dice.choice(found), drawn(dice, schema))
    return scene


class Trial:
    """A scene that is tried in a folder."""

    def __init__(self, polynya, folder):
        self.polynya, self.folder = polynya, pathlib.Path(folder)

    def call(self, *arguments):
        """The exit code of a command, its output and its messages; None for the code where it hangs."""
        try:
            done = subprocess.run([self.polynya, *map(str, arguments)], capture_output=True, text=True, check=False,
                                  timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            return None, "", f"more than {TIME_LIMIT} s"
        return done.returncode, done.stdout, done.stderr.strip()

    def judge(self, scene):
        """What became of a scene, in two or three words, and the messages."""
        file, run = self.folder / "scene.json", self.folder / "run"
        file.write_text(json.dumps(scene))
        code, out, told = self.call("validate", file)
        if code == 3:
            return ("is refused", "") if "found" in told and "scene.json:" in told else ("is refused without why", told)
        if code != 0:
            return f"validate ends with {code}", told
        tick_s = float(out.split(" in ticks of ")[1].split(" s")[0])
        until_s = max(1e-9, min(scene.get("time", {}).get("until_s", 550), TICKS * tick_s))
        code, _, told = self.call("run", file, "--check", "--out", run, "--until", until_s, "--no-map")
        if code != 0:
            stops = [line for line in told.splitlines() if "stopped at" in line]
            return f"run ends with {code}", stops[0] if stops else told
        code, _, told = self.call("validate", run / "scene.json")
        if code != 0:
            return "its scene.json is refused", told
        code, _, told = self.call("inspect", run, "--check", "--json")
        return ("runs", "") if code in (0, 4) else ("its folder is not read", told)


def main():
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    dice = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    polynya = sys.argv[3] if len(sys.argv) > 3 else "build/dev/app/polynya"
    schema = json.loads(subprocess.run([polynya, "schema"], capture_output=True, check=True, text=True).stdout)
    choices = list(numbers(schema))
    kept = pathlib.Path("runs/extreme")
    ended = collections.Counter()
    for trial in range(trials):
        scene = drawn_scene(dice, choices)
        with tempfile.TemporaryDirectory(prefix="polynya-extreme-") as folder:
            end, told = Trial(polynya, folder).judge(scene)
        ended[end] += 1
        if end in TRIED:
            continue
        kept.mkdir(parents=True, exist_ok=True)
        (kept / f"{trial}.json").write_text(json.dumps(scene))
        print(f"{kept / str(trial)}.json: {end}: {told[-300:]}", flush=True)
    print(f"{trials} scenes of {len(choices)} numbers and choices: "
          + ", ".join(f"{n}: {end}" for end, n in ended.most_common()))
    sys.exit(any(end not in TRIED for end in ended))


if __name__ == "__main__":
    main()
