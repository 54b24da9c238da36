"""The rules of Gymnasium's API checker as tests of our own: the package is in no Debian release that this runs on.

They follow gymnasium.utils.env_checker and passive_env_checker of version 1: spaces, seeding, what reset() and step()
return, rendering, and ends."""
import inspect

import numpy
import pytest

from polynya.environment import ShipInIce, ShipsInIce, default_scene, spaces

KINDS = {"image": {"shape": (16, 16), "cell_m": 8}, "floes": {"floes": 8}}


@pytest.fixture(params=KINDS)
def env(request):
    made = ShipInIce(render_mode="rgb_array", **KINDS[request.param])
    yield made
    made.close()


def same(a, b):
    return a.keys() == b.keys() and all(numpy.array_equal(a[name], b[name]) for name in a)


def test_spaces_are_bounded_boxes_with_a_normal_action_space(env):
    action = env.action_space
    assert action.shape == (2,) and action.dtype == numpy.float32
    assert (action.low == -1).all() and (action.high == 1).all(), "symmetric and normalized"
    for box in env.observation_space.spaces.values():
        assert box.dtype == numpy.float32 and (box.low <= box.high).all() and box.low.shape == box.shape


def test_reset_takes_a_seed_and_options_and_is_seeded(env):
    parameters = inspect.signature(env.reset).parameters
    assert parameters["seed"].default is None and parameters["options"].default is None
    assert parameters["seed"].kind is inspect.Parameter.KEYWORD_ONLY
    first, info = env.reset(seed=123)
    assert isinstance(info, dict) and env.observation_space.contains(first)
    state = env.unwrapped.np_random.bit_generator.state
    second, _ = env.reset(seed=123)
    assert same(first, second) and env.unwrapped.np_random.bit_generator.state == state
    other, _ = env.reset(seed=456)
    assert env.unwrapped.np_random.bit_generator.state != state and not same(first, other)
    result = env.reset(seed=123, options={})
    assert isinstance(result, tuple) and len(result) == 2


def test_a_step_returns_five_values_of_their_types_without_nan(env):
    env.reset(seed=1)
    env.action_space.seed(0)
    for _ in range(5):
        result = env.step(env.action_space.sample())
        assert isinstance(result, tuple) and len(result) == 5
        observation, reward, terminated, truncated, info = result
        assert env.observation_space.contains(observation)
        assert all(numpy.isfinite(value).all() for value in observation.values())
        assert isinstance(reward, float) and numpy.isfinite(reward)
        assert type(terminated) is bool and type(truncated) is bool and isinstance(info, dict)


def test_steps_of_the_same_seed_and_actions_are_the_same(env):
    actions = numpy.random.default_rng(0).uniform(-1, 1, (4, 2)).astype(numpy.float32)
    runs = []
    for _ in range(2):
        env.reset(seed=9)
        runs.append([env.step(action) for action in actions])
    for a, b in zip(*runs):
        assert same(a[0], b[0]) and a[1:4] == b[1:4]


def test_a_step_before_reset_and_a_wrong_action_are_refused():
    env = ShipInIce(floes=2)
    with pytest.raises(RuntimeError):
        env.step((0.0, 0.0))
    with pytest.raises(ValueError):
        ShipInIce(floes=0)


def test_rendering_is_a_picture_of_bytes_and_can_be_closed_twice(env):
    assert "rgb_array" in env.metadata["render_modes"] and env.metadata["render_fps"] > 0
    env.reset(seed=1)
    picture = env.render()
    assert picture.dtype == numpy.uint8 and picture.ndim == 3 and picture.shape[2] == 3
    env.step(env.action_space.sample())
    assert isinstance(env.render(), numpy.ndarray)
    env.close()
    env.close()


def test_an_episode_ends_by_its_goal_or_its_time():
    env = ShipInIce(floes=4, goal=(0, 150), goal_radius=45.0)
    env.reset(seed=2)
    ends = [env.step((1.0, 0.0))[2:4] for _ in range(4)]
    assert (True, False) in ends, "terminated at the goal"
    env = ShipInIce(floes=4, time_limit=1.0)
    env.reset(seed=2)
    assert [env.step((1.0, 0.0))[2:4] for _ in range(2)] == [(False, False), (False, True)], "truncated by time"


def test_the_nearest_floes_are_those_of_the_simulation(env):
    env.reset(seed=5)
    floes, ship = env.simulation.floes, env.simulation.ships[0]
    rows = env.simulation.nearest_floes(0, 5)
    apart = numpy.hypot(*(rows[:, :2].T))
    gaps = apart - rows[:, 4]
    assert (numpy.diff(gaps) >= 0).all(), "the nearest first"
    assert rows[0, 6] == pytest.approx(0.5) and rows[0, 2] == pytest.approx(-4), "thickness, relative speed"
    areas = {round(float(area), 2) for area in numpy.float32(floes.areas)}
    assert all(round(float(area), 2) in areas for area in rows[:, 5])
    c, s = numpy.cos(ship.heading), numpy.sin(ship.heading)
    place = ship.position + (c * rows[0, 0] - s * rows[0, 1], s * rows[0, 0] + c * rows[0, 1])
    inside = [numpy.hypot(*(floes.world_vertices[a:b].mean(axis=0) - place)) for a, b in
              zip(floes.ring_offsets[:-1], floes.ring_offsets[1:])]
    assert min(inside) < rows[0, 4]
    many = env.simulation.nearest_floes(0, 1000)
    assert (many[len(floes):] == 0).all() and (many[:len(floes), 5] > 0).all()
    with pytest.raises(ValueError):
        env.simulation.nearest_floes(0, 0)


def test_many_do_what_each_does_alone():
    actions = numpy.random.default_rng(3).uniform(-1, 1, (6, 3, 2)).astype(numpy.float32)
    many = ShipsInIce(3, floes=6, workers=3)
    first, infos = many.reset(seed=11)
    rows = [many.step(action) for action in actions]
    assert infos["scene_seed"].tolist() == [11, 12, 13] and infos["_scene_seed"].all()
    for i in range(3):
        one = ShipInIce(floes=6)
        observation, _ = one.reset(seed=11 + i)
        assert all(numpy.array_equal(first[name][i], observation[name]) for name in observation)
        for row, action in zip(rows, actions[:, i]):
            observation, reward, terminated, truncated, info = one.step(action)
            assert all(numpy.array_equal(row[0][name][i], observation[name]) for name in observation)
            assert (row[1][i], row[2][i], row[3][i]) == (reward, terminated, truncated)
            assert row[4]["progress_m"][i] == info["progress_m"] and row[4]["events"][i] == info["events"]
    assert many.observation_space.contains(rows[0][0])
    assert many.observation_space.spaces["floes"].shape == (3, 6, 7) and many.action_space.shape == (3, 2)
    many.close()


def test_one_that_has_ended_is_reset_by_its_next_step():
    many = ShipsInIce(2, floes=3, time_limit=1.0)
    many.reset(seed=[5, 8])
    seen = [many.step(numpy.ones((2, 2)))[1:4] for _ in range(4)]
    assert [over.tolist() for _, _, over in seen] == [[False] * 2, [True] * 2, [False] * 2, [False] * 2]
    assert (seen[2][0] == 0).all() and (seen[1][0] != 0).all(), "the step that resets has no reward"
    with pytest.raises(ValueError):
        many.step(numpy.ones((3, 2)))
    with pytest.raises(ValueError):
        many.reset(seed=[1])
    with pytest.raises(ValueError):
        ShipsInIce(0)
    many.close()


def test_a_command_is_that_of_a_pilot_that_gives_it():
    import polynya

    def sail(command):
        simulation = polynya.Simulation(default_scene(4))
        command(simulation)
        simulation.run(until=5)
        return simulation.state_hash

    by_pilot = sail(lambda s: s.set_pilot("ship", lambda view: (0.8, 0.3 * view.steering_most)))
    assert sail(lambda s: s.set_command("ship", 0.8, 0.3)) == by_pilot
    assert sail(lambda s: s.set_command("ship", 0.8, 0.2)) != by_pilot
    simulation = polynya.Simulation(default_scene(4))
    for wrong in ((0, float("nan"), 0), (0, 1, float("inf"))):
        with pytest.raises(ValueError):
            simulation.set_command(*wrong)


def test_without_gymnasium_the_package_needs_nothing_of_it():
    if spaces.HAS_GYMNASIUM:
        pytest.skip("gymnasium is installed; test_environment.py runs its own checker")
    assert ShipInIce.__mro__[1].__module__ == "polynya.environment.spaces"
