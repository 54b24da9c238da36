"""Many ships in ice at once, each in its own simulation, in the convention of Gymnasium's vector environments."""
from __future__ import annotations

import concurrent.futures

import numpy

from .ship_in_ice import ShipInIce
from .spaces import VectorEnv, batch_space


class ShipsInIce(VectorEnv):
    """`num_envs` environments ShipInIce, which are stepped together in threads. The threads run in parallel, because
    steps and images release Python's lock.

    workers: number of threads; if not given, one per simulation, but at most one per processor. It does not change
    results. settings: those of ShipInIce, the same for all, including the errors that they raise.

    Observations are stacked along a first axis; rewards and ends are arrays with one entry per environment. An
    environment that has ended is reset by its next step, which ignores the action and returns the first observation,
    reward 0 and no end (Gymnasium's autoreset mode "next step"). The info of a step is a dict of arrays; "events" is an
    array of lists. Raises ValueError if `num_envs` is no whole number from 1 on.

    An error of one environment is raised by the step of all. The others may have been stepped then, so only reset()
    leads back to a common state."""

    def __init__(self, num_envs=1, *, workers=None, **settings):
        if not isinstance(num_envs, int) or num_envs < 1:
            raise ValueError(f"num_envs is {num_envs!r}, allowed: a whole number from 1 on")
        self.envs = [ShipInIce(**settings) for _ in range(num_envs)]
        self.num_envs, self.closed = num_envs, False
        self.metadata = {**ShipInIce.metadata, "autoreset_mode": _next_step()}
        self.render_mode = self.envs[0].render_mode
        self.single_observation_space = self.envs[0].observation_space
        self.single_action_space = self.envs[0].action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._has_ended = numpy.zeros(num_envs, dtype=bool)
        self._pool = concurrent.futures.ThreadPoolExecutor(workers or min(num_envs, _processors()))

    def reset(self, *, seed=None, options=None):
        """Starts a new simulation in each environment. A number `seed` gives the seeds seed, seed + 1, …; a list gives
        one seed per environment (ValueError for another length); None lets each environment draw its own, as
        ShipInIce.reset does. `options` are ignored. Returns stacked observations and infos."""
        seeds = [None if seed is None else seed + i for i in range(self.num_envs)] if not _is_list(seed) else seed
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds are given for {self.num_envs} environments")
        results = list(self._pool.map(lambda env, one: env.reset(seed=one, options=options), self.envs, seeds))
        self._has_ended[:] = False
        return _stacked([observation for observation, _ in results]), _gathered([info for _, info in results])

    def step(self, actions):
        """Steps all environments with actions, an array of num_envs × 2 (ValueError for another shape): lever and
        steering of each. Returns observations, rewards, masks of the environments whose goal is reached and whose time
        is over, and infos."""
        actions = numpy.asarray(actions, dtype=float)
        if actions.shape != (self.num_envs, 2):
            raise ValueError(f"actions have the shape {actions.shape}, allowed: ({self.num_envs}, 2)")
        results = list(self._pool.map(self._step_one, range(self.num_envs), actions))
        observations, rewards, reached, over, infos = zip(*results)
        reached, over = numpy.array(reached), numpy.array(over)
        self._has_ended = reached | over
        return _stacked(observations), numpy.array(rewards), reached, over, _gathered(infos)

    def _step_one(self, i, action):
        """Steps environment i. If its last step was its end, resets it instead, with a seed that it draws itself."""
        if not self._has_ended[i]:
            return self.envs[i].step(action)
        observation, info = self.envs[i].reset()
        return observation, 0.0, False, False, info

    def render(self):
        """Returns a tuple with the picture of each environment (ShipInIce.render), or None without `render_mode`."""
        return None if self.render_mode is None else tuple(env.render() for env in self.envs)

    def close(self, **_):
        """Ends the threads after their present work. Later steps and resets raise RuntimeError."""
        self._pool.shutdown()
        self.closed = True


# Returns True if `seed` has one seed per environment.
def _is_list(seed):
    return isinstance(seed, (list, tuple, numpy.ndarray))


def _processors():
    """Number of processors that this process may use."""
    import os

    return len(os.sched_getaffinity(0))


def _next_step():
    """Gymnasium's value for the autoreset mode "next step", or a text if Gymnasium is missing or too old to have it."""
    try:
        from gymnasium.vector import AutoresetMode
    except ImportError:
        return "NextStep"
    return AutoresetMode.NEXT_STEP


def _stacked(observations):
    """One dict of arrays with a first axis for the environments, from a dict per environment with the same names."""
    return {name: numpy.stack([one[name] for one in observations]) for name in observations[0]}


def _gathered(infos):
    """Returns one dict from the infos of all environments, as Gymnasium does: for each key an array of the values, with
    0 (for "events" an empty list) where an environment has no value, and under "_" + key the mask of those that have
    one."""
    gathered = {}
    for name in dict.fromkeys(name for info in infos for name in info):
        has = numpy.array([name in info for info in infos])
        if name == "events":
            values = numpy.empty(len(infos), dtype=object)
            values[:] = [info.get(name, []) for info in infos]
        else:
            values = numpy.array([info.get(name, 0) for info in infos])
        gathered[name], gathered[f"_{name}"] = values, has
    return gathered
