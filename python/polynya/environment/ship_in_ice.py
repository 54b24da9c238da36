"""ShipInIce: a ship that an agent steers through ice, as an environment of Gymnasium (docs/environment.md)."""
from __future__ import annotations

import copy
import math
import typing

import numpy

import polynya

from .default_scene import default_scene
from .spaces import Box, Dict, Env

# Colours of render() as red, green and blue from 0 to 255: water, ice, other ships and structures, and the own ship.
_COLOURS = (143, 184, 208), (255, 255, 255), (122, 92, 46), (43, 43, 43)
WATER, ICE, OTHERS, OWN = (numpy.array(colour, dtype=float) for colour in _COLOURS)
#: Seeds of scenes that reset() draws are below this value. Larger: more different scenes. A given seed is not limited.
MOST_SEED = 2**31
#: Number of columns of Simulation.nearest_floes. With another value, observations are not in the observation space.
FLOE_COLUMNS = 7


class Change(typing.NamedTuple):
    """Changes in one step, from which rewards are computed."""

    #: Distance gained towards the goal, or along the initial heading without a goal [m]; negative if the ship lost
    #: some.
    progress: float
    #: Energy that the ship lost to contacts with ice and to ice under the hull in the step [J]: minus the mean forces
    #: and yaw moment times the mean velocities and yaw rate, in the ship's frame at the end of the step.
    ice_work: float
    seconds: float  #: simulated time of the step [s]
    reached: bool  #: true if the ship is within the radius of the goal after the step; false without a goal
    ship: polynya.Ship  #: ship after the step; its forces are means of the step
    events: list  #: events of the step, as in the lines of events.ndjson


def metres_less_work(change):
    """The default reward of a step: the distance gained [m], minus 1 m for each megajoule that the ship lost to the
    ice. With more than 1 m per megajoule, agents would make longer detours around floes."""
    return change.progress - 1e-6 * change.ice_work


class ShipInIce(Env):
    """A ship with an engine in a scene, in Gymnasium's convention.

    scene: anything that polynya.Scene accepts, or a callable that makes a scene from a seed; default_scene if not
    given. For a scene that is no callable, reset(seed) replaces its `seed`, from which random fields of floes are
    drawn. A scene that is not valid is refused here, that of a callable by reset().
    ship: index or name of the ship to steer. reset() refuses a ship that does not exist or cannot take commands.
    goal: x, y in the world [m], which counts as reached when the ship is within `goal_radius` [m]; without a goal the
    ship is to go along its initial heading.
    seconds: simulated time per step [s], a multiple of the scene's time step (time.step_s). It replaces the scene's
    record.forces_interval_s, so that the forces of a Change are means of the step.
    shape, cell_m, ahead_m: rows and columns of the image, size of a cell [m], and distance of the image's centre ahead
    of the ship's centre of gravity [m], as in Simulation.occupancy.
    floes: number of floes, for an observation of the nearest floes instead of the image.
    time_limit: simulated time at which an episode is truncated [s]; the scene's until_s if not given.
    reward: a callable that computes the reward from a Change.
    threads: number of threads of the simulation; 1 is best if several environments run at once.
    render_mode: "rgb_array" if render() is used, otherwise None.

    Action: lever and steering angle, each from -1 to 1, the angle as a fraction of the largest, positive to port. Both
    move as fast as the scene's ship allows. Observation: "image", 2 x rows x columns: fractions of each cell that ice,
    and that other ships and structures, cover, with the view ahead at the top and port on the left; or "floes",
    floes x 7 numbers of the nearest floes, as in Simulation.nearest_floes. "ship": speed ahead and to port [m/s], yaw
    rate [rad/s], lever, steering angle as a fraction, and the position of the goal ahead and to port [m] (0 without a
    goal). `simulation` is the Simulation that is stepped; None before the first reset().

    Raises ValueError for a `goal`, `floes` or `render_mode` that is not allowed."""

    metadata = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(self, scene=default_scene, *, ship=0, goal=None, goal_radius=100.0, seconds=0.5,
                 shape=(96, 96), cell_m=4.0, ahead_m=0.0, floes=None, time_limit=None,
                 reward=metres_less_work, threads=1, render_mode=None):
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode is {render_mode!r}, allowed: None, 'rgb_array'")
        self.render_mode = render_mode
        self._make_scene = scene if callable(scene) else _seeded(polynya.Scene(scene))
        self._given_ship, self.seconds = ship, float(seconds)
        self.goal = None if goal is None else numpy.array(goal, dtype=float)
        if self.goal is not None and (self.goal.shape != (2,) or not numpy.isfinite(self.goal).all()):
            raise ValueError(f"goal is {goal!r}, allowed: x, y [m]")
        self.goal_radius, self._time_limit, self._reward, self._threads = goal_radius, time_limit, reward, threads
        self._view = {"shape": tuple(shape), "cell_m": cell_m, "ahead_m": ahead_m}
        self.action_space = Box(-1.0, 1.0, (2,), numpy.float32)
        if floes is not None and (not isinstance(floes, int) or floes < 1):
            raise ValueError(f"floes is {floes!r}, allowed: None, or a number of floes from 1 on")
        self._floes = floes
        ice = {"image": Box(0.0, 1.0, (2, *self._view["shape"]), numpy.float32)} if floes is None else {
            "floes": Box(-numpy.inf, numpy.inf, (floes, FLOE_COLUMNS), numpy.float32)}
        self.observation_space = Dict({**ice, "ship": Box(-numpy.inf, numpy.inf, (7,), numpy.float32)})
        self.simulation = None

    def reset(self, *, seed=None, options=None):
        """Starts a new simulation with the scene's seed `seed`; `options` are ignored. If `seed` is None, a seed is
        drawn from np_random, which the last given seed started, so that a series of episodes can be repeated. Lever and
        steering begin at 0. Returns the observation, and info with `scene_seed` and `time_s`. Raises ValueError if
        `seconds` is no multiple of the scene's time step."""
        super().reset(seed=seed)
        self.scene_seed = int(self.np_random.integers(MOST_SEED)) if seed is None else seed
        given = self._make_scene(self.scene_seed)
        resolved = copy.copy(given if isinstance(given, dict) and "time" in given else polynya.Scene(given).resolved)
        resolved["record"] = {**resolved.get("record", {}), "forces_interval_s": self.seconds}
        scene = polynya.Scene(resolved)
        time = scene.resolved["time"]
        self._steps = round(self.seconds / time["step_s"])
        if self._steps < 1 or abs(self._steps * time["step_s"] - self.seconds) > 1e-9 * self.seconds:
            raise ValueError(f"a step of {self.seconds:g} s is no whole number of the scene's time steps of "
                             f"{time['step_s']:g} s")
        self._end = time["until_s"] if self._time_limit is None else self._time_limit
        self.simulation = polynya.Simulation(scene, threads=self._threads)
        names = [ship.name for ship in self.simulation.ships]
        self._ship = names.index(self._given_ship) if self._given_ship in names else self._given_ship
        self.simulation.set_command(self._ship, 0.0, 0.0)
        self._steering_most = _largest_angle(scene.resolved["ships"][self._ship])
        self._now = self.simulation.ships[self._ship]
        self._waterline, self._course = None, self._now.heading
        return self._observation(), {"scene_seed": self.scene_seed, "time_s": self.simulation.time}

    def step(self, action):
        """Sets lever and steering to an action, whose numbers are limited to -1 and 1, and simulates one step. Returns
        the observation, the reward, whether the goal is reached, whether the time is over, and info with `time_s`,
        `progress_m`, `ice_work_J` and `events`. Both ends can be true in one step; further steps are not refused.
        Raises RuntimeError before the first reset(), ValueError for an action that is not two finite numbers, and
        SimulationError if the run cannot continue."""
        if self.simulation is None:
            raise RuntimeError("reset() comes before the first step()")
        wanted = numpy.asarray(action, dtype=float)
        if wanted.shape != (2,) or not numpy.isfinite(wanted).all():
            raise ValueError(f"an action is lever and steering, two numbers from -1 to 1, found {action!r}")
        self.simulation.set_command(self._ship, *numpy.clip(wanted, -1.0, 1.0).tolist())
        before = self._now
        self.simulation.step(self._steps)
        self._now = self.simulation.ships[self._ship]
        change = self._change(before)
        info = {"time_s": self.simulation.time, "progress_m": change.progress, "ice_work_J": change.ice_work,
                "events": change.events}
        is_over = self.simulation.time >= self._end - 1e-9
        return self._observation(), float(self._reward(change)), change.reached, is_over, info

    # Returns the Change from the state of the ship `before` the step to the present one.
    def _change(self, before):
        after, forces = self._now, self._now.forces
        if self.goal is None:
            ahead = numpy.array([numpy.cos(self._course), numpy.sin(self._course)])
            progress, reached = float((after.position - before.position) @ ahead), False
        else:
            left = numpy.hypot(*(self.goal - after.position))
            progress = float(numpy.hypot(*(self.goal - before.position)) - left)
            reached = bool(left <= self.goal_radius)
        surge, sway = _in_ship(0.5 * (before.velocity + after.velocity), after.heading)
        turning = 0.5 * (before.yaw_rate + after.yaw_rate)
        work = -self.seconds * sum(
            speed * (forces[f"{along}_{unit}"] + forces[f"{along}_from_submerged_ice_{unit}"])
            for along, unit, speed in (("surge", "N", surge), ("sway", "N", sway), ("yaw", "Nm", turning)))
        return Change(progress, float(work), self.seconds, reached, after, self.simulation.events())

    # Returns the observation of the present state, as the docstring of the class describes it.
    def _observation(self):
        ship = self._now
        to_goal = (0.0, 0.0) if self.goal is None else _in_ship(self.goal - ship.position, ship.heading)
        share = ship.steering_angle / self._steering_most if self._steering_most else 0.0
        state = (*_in_ship(ship.velocity, ship.heading), ship.yaw_rate, ship.lever, share, *to_goal)
        ice = {"image": self.simulation.occupancy(self._ship, **self._view)} if self._floes is None else {
            "floes": self.simulation.nearest_floes(self._ship, self._floes)}
        return {**ice, "ship": numpy.array(state, dtype=numpy.float32)}

    def render(self):
        """Returns the image in colours, with the ship: rows x columns x 3 bytes (red, green, blue). None without a
        render_mode. The image is drawn even if the observation has floes instead. Needs matplotlib, and a reset()
        before."""
        if self.render_mode is None:
            return None
        ice, others = self.simulation.occupancy(self._ship, **self._view)
        picture = WATER + ice[..., None] * (ICE - WATER)
        picture += others[..., None] * (OTHERS - picture)
        picture[self._own_hull()] = OWN
        return picture.astype(numpy.uint8)

    def _own_hull(self):
        """Returns a mask of the image's cells whose centre is inside the ship's waterline. It is computed once per
        reset, because the image turns with the ship."""
        if self._waterline is None:
            from matplotlib.path import Path

            from polynya.results.hulls import waterline

            (rows, columns), cell, ahead = self._view["shape"], self._view["cell_m"], self._view["ahead_m"]
            along = ahead + cell * (rows / 2 - numpy.arange(rows) - 0.5)
            across = cell * (columns / 2 - numpy.arange(columns) - 0.5)
            scene = polynya.Scene(self._make_scene(self.scene_seed)).resolved
            hull = Path(waterline([*scene.get("ships", []), *scene.get("structures", [])][self._ship]))
            cells = numpy.stack(numpy.meshgrid(along, across, indexing="ij"), axis=-1).reshape(-1, 2)
            self._waterline = hull.contains_points(cells).reshape(rows, columns)
        return self._waterline


def _seeded(scene):
    """Returns a callable that makes the resolved scene with another seed."""
    resolved = scene.resolved
    return lambda seed: {**resolved, "seed": seed}


def _largest_angle(ship):
    """Largest angle of the ship's rudder or thrusters to either side [rad]; 0 if it has none."""
    return math.radians(max((kind["max_deg"] for kind in ship.get("steering", {}).values()), default=0.0))


def _in_ship(vector, heading):
    """Returns the components ahead and to port of a vector in the world, for a heading [rad]."""
    c, s = numpy.cos(heading), numpy.sin(heading)
    return float(c * vector[0] + s * vector[1]), float(-s * vector[0] + c * vector[1])
