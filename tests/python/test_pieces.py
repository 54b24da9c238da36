"""However a run is cut into pieces, it is the same run: state, recorded rows and every byte of its folder."""
import json
import math
import os
import random

import pytest

import polynya
from program import BREAKER, succeeded

from test_recording import expect_same

ENGINE = {"bollard_pull_kN": 400, "open_water_speed_m_per_s": 7}
INSTANTS = (0.0137, 1 / 3, 1.9999, 3.3333, math.pi, 4.4001, 7.77, 9.009)  # [s]; multiples of nothing


def random_scene(seed):
    """A ship into floes and, for some seeds, a piling, fast ice, a drift or wind; its tick is given or chosen."""
    dice = random.Random(seed)
    time = {"until_s": 12}
    if dice.random() < 0.5:
        time["step_s"] = dice.choice([0.013, 0.02, 0.05, 0.1])
    ship = {**BREAKER, "hull": {**BREAKER["hull"], "draught_m": 4}, "mass_kg": 2e6}
    ship["speed_m_per_s"] = round(dice.uniform(0.5, 6), 1)
    ship["propulsion"] = dice.choice([{"constant_speed_m_per_s": ship["speed_m_per_s"]}, {"engine": ENGINE}])
    scene = {
        "name": f"pieces-{seed}", "seed": seed, "time": time, "ships": [ship],
        "record": {"forces_interval_s": dice.choice([0.1, 0.25, 0.37]), "frames_interval_s": dice.choice([0.5, 1.3])},
        "ice": {"thickness_m": round(dice.uniform(0.1, 1), 2)},
        "floes": [{"field": {"corner_m": [2, -30], "extent_m": [80, 60], "floe_size_m": dice.uniform(6, 15),
                             "concentration": dice.uniform(0.4, 0.8)}}],
    }
    if dice.random() < 0.3:
        scene["water"] = {"drift_m_per_s": [dice.uniform(-0.3, 0), dice.uniform(-0.1, 0.1)]}
    if dice.random() < 0.3:
        scene["wind"] = {"velocity_m_per_s": [dice.uniform(-10, 10), 5]}
    return scene


def ends(simulation):
    """What the run has come to."""
    events = simulation.events()
    return simulation.steps, simulation.time, simulation.state_hash, json.dumps(events)


def in_pieces(simulation, instants, until):
    for instant in sorted(instants):
        if instant < until:
            simulation.run(until=instant)
    simulation.run(until=until)


@pytest.mark.parametrize("seed", range(50))
def test_a_random_run_does_not_depend_on_how_it_is_cut(seed):
    scene, until = random_scene(seed), 3 + seed % 3
    whole = polynya.Simulation(scene)
    whole.run(until=until)
    steps, expected = whole.steps, ends(whole)
    assert steps * whole.scene.resolved["time"]["step_s"] >= until - 1e-9
    by_ticks = polynya.Simulation(scene, threads=2)
    for _ in range(steps):
        by_ticks.step(1)
    assert ends(by_ticks) == expected
    dice = random.Random(seed)
    pieces = polynya.Simulation(scene, threads=3)
    in_pieces(pieces, [dice.uniform(0, until) for _ in range(6)], until)
    assert ends(pieces) == expected


@pytest.mark.parametrize("seed", (3, 4, 8))
def test_a_folder_is_the_same_bytes_however_it_was_made(seed, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "/")
    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps(random_scene(seed)))
    options = {"env": {**os.environ, "PATH": "/"}}
    succeeded("run", scene, "--out", tmp_path / "whole", "--until", 9.009, **options)
    succeeded("run", scene, "--out", tmp_path / "resumed", "--until", INSTANTS[0], **options)
    for instant in INSTANTS[1:]:
        succeeded("resume", tmp_path / "resumed", "--until", instant, **options)
    expect_same(tmp_path / "whole", tmp_path / "resumed")
    simulation = polynya.Simulation(scene)
    with simulation.record(tmp_path / "mine"):
        in_pieces(simulation, INSTANTS, 9.009)
    expect_same(tmp_path / "whole", tmp_path / "mine")


def test_a_pilot_from_outside_that_repeats_a_built_in_one_makes_the_same_run():
    scene = random_scene(4)
    ship = scene["ships"][0]
    ship["propulsion"] = {"engine": ENGINE}
    ship["pilot"] = {"constant": {"lever": 0.7}}
    built_in, outside = polynya.Simulation(scene), polynya.Simulation(scene)
    outside.set_pilot(0, lambda view: (0.7, 0.0))
    built_in.run(until=6)
    for instant in (0.777, 2.1, 6):
        outside.run(until=instant)
    assert ends(outside) == ends(built_in)
