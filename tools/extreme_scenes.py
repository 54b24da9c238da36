#!/usr/bin/env python3
"""Runs scenes whose numbers are drawn from the whole of what the schema allows, most at its ends.

What `polynya validate` lets through must run: a scene may be refused (exit code 3), and must else run its steps with
every account closed and every check passed (0). Anything else is kept and told.

Usage: tools/extreme_scenes.py [TRIALS [SEED [POLYNYA]]]   100, 1, build/dev/app/polynya; failures in runs/extreme
"""

import collections
import copy
import json
import math
import pathlib
import random
import subprocess
import sys

STEPS = 60
TIME_LIMIT = 600  # for one run, which then hangs [s]

BASE = {
    "time": {"step_s": 0.01, "until_s": 1},
    "ships": [{
        "hull": {"length_m": 60, "beam_m": 16, "entrance_angle_deg": 30}, "mass_kg": 3e6,
        "moment_of_inertia_kg_m2": 8e8, "position_m": [-31, 0], "speed_m_per_s": 3,
        "propulsion": {"constant_speed_m_per_s": 3}}],
    "structures": [{"radius_m": 5, "position_m": [90, 0]}],
    "floes": [{"lattice": {"origin_m": [1, -20], "rows": 4, "columns": 4, "pitch_m": 10, "size_m": 9.9}},
              {"rectangle": {"corner_m": [42, -30], "size_m": 40}, "velocity_m_per_s": [-0.5, 0]},
              {"field": {"corner_m": [100, -60], "extent_m": [100, 100], "floe_size_m": 12, "concentration": 0.7}}],
}
KEPT = {"$schema", "name", "description", "origin", "record", "file", "until_s", "keep_clear_m", "corner_m", "origin_m",
        "position_m", "waterline_m", "outer_m", "holes_m", "outline_m", "extent_m"}


def numbers(schema, path=()):
    """(path, schema) of every number that a scene may give where BASE has, or could have, an object."""
    for key, value in schema.get("properties", {}).items():
        if key in KEPT:
            continue
        value = value.get("oneOf", [value])[0] if "type" not in value and "enum" not in value else value
        if value.get("type") in ("number", "integer") or "enum" in value or is_vector(value):
            yield path + (key,), value
        elif value.get("type") == "object":
            yield from numbers(value, path + (key,))
        elif value.get("type") == "array" and value.get("items", {}).get("type") == "object":
            for i in range(len(BASE.get(key, []))):
                yield from numbers(value["items"], path + (key, i))


def is_vector(schema):
    return schema.get("minItems") == schema.get("maxItems") == 2 and schema["items"].get("type") == "number"


def drawn(dice, schema):
    if is_vector(schema):
        return [drawn(dice, schema["items"]), drawn(dice, schema["items"])]
    if "enum" in schema:
        return dice.choice(schema["enum"])
    low = schema.get("minimum", schema.get("exclusiveMinimum", -1e9))
    high = schema.get("maximum", schema.get("exclusiveMaximum", 1e9))
    kind = dice.randrange(5)
    if schema["type"] == "integer":
        return dice.choice([low, high, dice.randint(low, min(high, low + 50))])
    if kind == 0 and "minimum" in schema:
        return low
    if kind == 1 and "maximum" in schema:
        return high
    if kind == 2 and low <= 0:
        return math.copysign(10 ** dice.uniform(-320, 0), dice.choice([-1, 1]) if low < 0 else 1)
    if low >= 0 and high > 0:  # even over the decades
        return 10 ** dice.uniform(math.log10(max(low, high * 1e-15)), math.log10(high))
    return dice.uniform(low, high)


def fits(scene, path, schema):
    """Has the scene a number there, or may one be added: it, or the object that holds it, can be left out?"""
    here = scene
    for key in path[:-1]:
        if isinstance(here, dict) and key not in here:
            return path[0] in ("water", "ice", "contact", "fracture")
        here = here[key]
    return path[-1] in here or "default" in schema


def put(scene, path, value):
    here = scene
    for key in path[:-1]:
        here = here.setdefault(key, {}) if isinstance(here, dict) else here[key]
    here[path[-1]] = value


def main():
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    dice = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    polynya = sys.argv[3] if len(sys.argv) > 3 else "build/dev/app/polynya"
    schema = json.loads(subprocess.run([polynya, "schema"], capture_output=True, check=True, text=True).stdout)
    choices = [(path, kind) for path, kind in numbers(schema) if fits(BASE, path, kind)]
    folder = pathlib.Path("runs/extreme")
    folder.mkdir(parents=True, exist_ok=True)
    ended = collections.Counter()
    for trial in range(trials):
        scene = copy.deepcopy(BASE)
        for path, kind in dice.sample(choices, dice.randint(1, 4)):
            if fits(scene, path, kind):
                put(scene, path, drawn(dice, kind))
        if dice.random() < 0.5:  # at most 10 m/s², lest it run away from any accuracy
            ship = scene["ships"][0]
            ship["propulsion"] = {"thrust_N": ship["mass_kg"] * 10 ** dice.uniform(-6, 1)}
        scene["time"]["until_s"] = STEPS * scene["time"]["step_s"]
        file = folder / f"{trial}.json"
        file.write_text(json.dumps(scene))
        try:
            done = subprocess.run([polynya, "run", str(file), "--check", "--overwrite", "--out", str(folder / "run")],
                                  capture_output=True, text=True, timeout=TIME_LIMIT)
            code, told = done.returncode, done.stderr.strip().splitlines()[-1:] or [""]
        except subprocess.TimeoutExpired:
            code, told = "late", [f"more than {TIME_LIMIT} s"]
        ended[code] += 1
        if code in (0, 3):
            file.unlink()
        else:
            print(f"{file}: {code}: {told[0]}", flush=True)
    print(f"{trials} scenes of {len(choices)} numbers: " + ", ".join(f"{n} ended {c}"
                                                                     for c, n in sorted(ended.items(), key=str)))
    sys.exit(any(code not in (0, 3) for code in ended))


if __name__ == "__main__":
    main()
