"""A ship in ice as an environment in Gymnasium's convention."""
import gc
import json
import os
import subprocess
import sys
import weakref

import numpy
import pytest

import polynya
from program import SCENES
from polynya import environment
from polynya.environment import spaces

SCENE = {
    "name": "agent",
    "time": {"step_s": 0.05, "until_s": 30},
    "ice": {"thickness_m": 0.4},
    "ships": [
        {"name": "beset", "hull": {"length_m": 20, "beam_m": 8, "entrance_angle_deg": 40},
         "mass_kg": 1e6, "moment_of_inertia_kg_m2": 4e7,
         "position_m": [60, -60], "propulsion": {"constant_speed_m_per_s": 0}},
        {"name": "agent", "hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30,
                                   "draught_m": 5, "block_coefficient": 0.58},
         "position_m": [-40, 0], "speed_m_per_s": 3,
         "propulsion": {"engine": {"bollard_pull_kN": 500, "open_water_speed_m_per_s": 7}},
         "steering": {"rudder": {"area_m2": 8}}},
    ],
    "floes": [{"field": {"corner_m": [0, -50], "extent_m": [150, 100], "floe_size_m": 12,
                         "size_spread": 0.2, "concentration": 0.4}}],
}


def agent(scene=SCENE, **settings):
    return environment.ShipInIce(scene, ship="agent", shape=(24, 32), cell_m=5, **settings)


def episode(env, seed, actions):
    observation, info = env.reset(seed=seed)
    return [(observation, 0.0, False, False, info), *map(env.step, actions)]


def same(a, b):
    return all(numpy.array_equal(a[name], b[name]) for name in ("image", "ship"))


def test_what_a_step_returns_is_in_the_spaces():
    env = agent(goal=(300, 40))
    env.action_space.seed(1)
    observation, info = env.reset(seed=5)
    assert env.observation_space.contains(observation) and info == {"scene_seed": 5, "time_s": 0.0}
    for _ in range(6):
        action = env.action_space.sample()
        assert env.action_space.contains(action)
        observation, reward, terminated, truncated, info = env.step(action)
        assert env.observation_space.contains(observation) and isinstance(reward, float)
        assert (type(terminated), type(truncated)) == (bool, bool)
    assert info["time_s"] == pytest.approx(3) and env.simulation.steps == 60
    assert observation["ship"].dtype == observation["image"].dtype == numpy.float32


def test_an_episode_is_that_of_its_seed():
    actions = [(0.8, 0.1), (1.0, -0.4), (0.2, 1.0)]
    first, again, other = (episode(agent(), seed, actions) for seed in (3, 3, 4))
    assert all(same(a[0], b[0]) and a[1] == b[1] for a, b in zip(first, again))
    assert not same(first[0][0], other[0][0]), "another seed is another field"
    env = agent()
    drawn = [env.reset(seed=7)[1]["scene_seed"], env.reset()[1]["scene_seed"], env.reset()[1]["scene_seed"]]
    env.reset(seed=7)
    assert drawn[0] == 7 and drawn[1] != drawn[2] and env.reset()[1]["scene_seed"] == drawn[1]


def test_the_scene_is_that_of_the_command_line_with_the_same_seed_or_made_of_it():
    env = agent()
    env.reset(seed=9)
    numpy.testing.assert_array_equal(env.simulation.floes.poses, polynya.Simulation({**SCENE, "seed": 9}).floes.poses)
    env = agent(lambda seed: {**SCENE, "seed": seed, "ice": {"thickness_m": 0.1 * seed}})
    for seed in (3, 6):
        env.reset(seed=seed)
        assert env.simulation.floes.thickness[0] == pytest.approx(0.1 * seed)


def test_an_action_moves_lever_and_rudder():
    env = agent()
    rows = episode(env, 1, [(1.0, 1.0)] * 30)
    ship = env.simulation.ships[1]
    assert ship.lever == 1 and ship.heading > 0.02, "to port"
    state = rows[-1][0]["ship"]
    assert state[3] == 1 and state[4] == pytest.approx(1) and state[2] > 0
    speed = numpy.cos(ship.heading) * ship.velocity[0] + numpy.sin(ship.heading) * ship.velocity[1]
    assert state[0] == pytest.approx(speed, rel=1e-6)
    other = agent()
    beyond = episode(other, 1, [(5.0, 9.0)] * 30)
    assert same(rows[-1][0], beyond[-1][0]), "what is beyond the bounds is at them"


def test_progress_reward_and_ends():
    env = agent(goal=(60.0, 0.0), goal_radius=80.0)
    rows = episode(env, 2, [(1.0, 0.0)] * 22)
    assert rows[0][0]["ship"][5] == pytest.approx(100)
    made_good = sum(row[4]["progress_m"] for row in rows[1:])
    left = numpy.hypot(*(env.goal - env.simulation.ships[1].position))
    assert made_good == pytest.approx(100 - left, abs=1e-9)
    assert [row[2] for row in rows[1:]].count(True) > 0 and rows[1][2] is False and rows[-1][2] is True
    for row in rows[1:]:
        assert row[1] == pytest.approx(row[4]["progress_m"] - 1e-6 * row[4]["ice_work_J"])
    time = env.simulation.ships[1].forces["t_s"]
    assert time == pytest.approx(rows[-1][4]["time_s"]), "the forces are those of the step"
    assert sum(row[4]["ice_work_J"] for row in rows[1:]) > 0 and any(row[4]["events"] for row in rows[1:])
    timed = agent(time_limit=1.0)
    assert [row[3] for row in episode(timed, 2, [(0, 0)] * 3)[1:]] == [False, True, True]
    along = agent(reward=lambda change: change.seconds)
    assert episode(along, 2, [(0, 0)])[1][1] == 0.5


def test_a_picture_of_what_the_agent_sees():
    env = agent(render_mode="rgb_array")
    env.reset(seed=1)
    picture = env.render()
    assert picture.shape == (24, 32, 3) and picture.dtype == numpy.uint8
    assert picture[12, 16].tolist() == [43, 43, 43] and picture[0, 0].tolist() == [143, 184, 208]
    assert agent().render() is None


@pytest.mark.parametrize("wrong, error", [
    (lambda: agent().step((0, 0)), RuntimeError),
    (lambda: episode(agent(), 1, [(0, 0, 0)]), ValueError),
    (lambda: episode(agent(), 1, [(float("nan"), 0)]), ValueError),
    (lambda: agent(goal=(1, 2, 3)), ValueError),
    (lambda: agent(render_mode="human"), ValueError),
    (lambda: agent(seconds=0.12).reset(seed=1), ValueError),
    (lambda: environment.ShipInIce(SCENE, ship="beset").reset(seed=1), ValueError),
    (lambda: environment.ShipInIce(SCENE, ship="none").reset(seed=1), ValueError),
    (lambda: environment.ShipInIce({"floes": 3}), polynya.SceneError),
])
def test_what_cannot_be_is_refused(wrong, error):
    with pytest.raises(error):
        wrong()


def test_an_environment_is_collected():
    env = agent()
    env.reset(seed=1)
    env.step((1, 0))
    alive = weakref.ref(env)
    del env
    gc.collect()
    assert alive() is None


def test_a_scene_file_is_an_environment():
    env = environment.ShipInIce(SCENES / "route-in-ice.json")
    observation, _ = env.reset(seed=1)
    assert observation["image"].shape == (2, 96, 96)
    assert json.dumps(env.step((1.0, 0.0))[4])


def test_it_passes_gymnasiums_own_check():
    if not spaces.HAS_GYMNASIUM:
        pytest.skip("gymnasium is not installed; Debian has no package of it")
    from gymnasium.utils.env_checker import check_env
    check_env(agent(goal=(300, 40)), skip_render_check=True)


GYMNASIUM = '''
import importlib, numpy
registry = {}
def register(id, entry_point=None, vector_entry_point=None, **kwargs):
    assert id not in registry
    registry[id] = entry_point, vector_entry_point
def make(id, which=0, **kwargs):
    module, name = registry[id][which].split(":")
    return getattr(importlib.import_module(module), name)(**kwargs)
class Env:
    np_random = numpy.random.default_rng()
    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self.np_random = numpy.random.default_rng(seed)
'''
SPACES = '''
import numpy
class Box:
    def __init__(self, low, high, shape=None, dtype=numpy.float32, seed=None):
        self.low, self.high, self.shape, self.dtype = low, high, shape, dtype
class Dict:
    def __init__(self, spaces=None, seed=None, **more):
        self.spaces = spaces
'''


def test_where_gymnasium_is_installed_it_is_one_of_its_environments(tmp_path):
    if spaces.HAS_GYMNASIUM:
        pytest.skip("the real one is checked above")
    (tmp_path / "gymnasium").mkdir()
    (tmp_path / "gymnasium" / "__init__.py").write_text(GYMNASIUM)
    (tmp_path / "gymnasium" / "spaces.py").write_text(SPACES)
    code = ("import json, sys, gymnasium\nfrom polynya.environment import ShipInIce\n"
            "env = ShipInIce(json.loads(sys.argv[1]), ship='agent', shape=(8, 8))\n"
            "assert isinstance(env, gymnasium.Env) and isinstance(env.observation_space, gymnasium.spaces.Dict)\n"
            "observation, info = env.reset(seed=2)\n"
            "assert list(gymnasium.registry) == ['polynya/ShipInIce-v0']\n"
            "made = gymnasium.make('polynya/ShipInIce-v0', shape=(8, 8))\n"
            "assert made.reset(seed=1)[0]['image'].shape == (2, 8, 8)\n"
            "many = gymnasium.make('polynya/ShipInIce-v0', which=1, num_envs=2, floes=4)\n"
            "assert many.reset(seed=1)[0]['floes'].shape == (2, 4, 7)\n"
            "print(info['scene_seed'], observation['image'].shape == env.observation_space.spaces['image'].shape)\n")
    with_it = {**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ['PYTHONPATH']}"}
    done = subprocess.run([sys.executable, "-c", code, json.dumps(SCENE)], env=with_it,
                          capture_output=True, text=True, check=False)
    assert done.stdout == "2 True\n", done.stderr
