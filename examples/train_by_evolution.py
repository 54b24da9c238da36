#!/usr/bin/python3
"""Evolution trains a small policy that steers a ship around floes, and it beats straight ahead on fields it never saw.

    python3 examples/train_by_evolution.py   (--out FOLDER; --short: one generation; --minutes M)

Shows many environments on threads (polynya.environment.ShipsInIce) and a learner of forty lines. The policy has twelve
weights: how much ice to port and starboard, near and far, turns the ship, and how the bearing of the goal and the yaw
rate do. It begins as straight ahead, with no eye for the ice. The lever is fixed, so that all it can learn is to steer.
Draws train-by-evolution.png: reward by generation, and the paired differences on thirty fields held out.
"""
import argparse
import pathlib
import time

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

import numpy
from matplotlib.figure import Figure

from polynya.environment import ShipsInIce, default_scene

LEVER, GOAL, SECONDS, LIMIT = 0.7, (5000.0, 150.0), 1.0, 110.0
CELL, ROWS, COLUMNS, AHEAD = 10.0, 24, 24, 110.0  # of the image [m]
NEAR_TO_FAR, ASIDE = ((45, 90), (90, 150), (150, 230)), ((0, 15), (15, 40), (40, 90))  # [m]
STRAIGHT = numpy.array([0.0] * 9 + [0.0, 2.5, -6.0])  # nine of the ice, a bias, bearing, yaw rate
PLACE_OF_SEEDS, HELD_OUT = 1000, range(1, 31)
POPULATION, FIELDS, SPREAD = 12, 4, 0.6


def scene(seed):
    """A ship before big floes of 1.2 m, which stop her where she does not go around them."""
    made = default_scene(seed)
    made["ice"]["thickness_m"], made["time"]["step_s"] = 1.2, 0.1
    made["floes"][0]["field"].update(floe_size_m=80)
    return made


def sectors():
    """Cells of each of the nine sectors to port, and their mirror images to starboard."""
    ahead = AHEAD + CELL * (ROWS / 2 - numpy.arange(ROWS) - 0.5)[:, None]
    port = CELL * (COLUMNS / 2 - numpy.arange(COLUMNS) - 0.5)[None, :]
    for near, far in NEAR_TO_FAR:
        for inner, outer in ASIDE:
            rows = (ahead >= near) & (ahead < far)
            yield rows & (port > inner) & (port <= outer), rows & (port < -inner) & (port >= -outer)


SECTORS = list(sectors())


def features(observation):
    """What the policy sees of each environment: a row each."""
    ice, ship = observation["image"][:, 0], observation["ship"]
    seen = [ice[:, left].mean(axis=1) - ice[:, right].mean(axis=1) for left, right in SECTORS]
    bearing = numpy.arctan2(ship[:, 6], ship[:, 5])
    return numpy.column_stack([*seen, numpy.zeros(len(ship)), bearing, ship[:, 2]])


def returns(many, policies, seeds):
    """The reward of each episode: policies by seeds, as many at a time as there are environments."""
    pairs = [(policy, seed) for policy in policies for seed in seeds]
    totals = []
    for first in range(0, len(pairs), many.num_envs):
        batch = pairs[first:first + many.num_envs]
        batch += batch[-1:] * (many.num_envs - len(batch))  # the last ones run beside, and are not counted
        weights = numpy.array([policy for policy, _ in batch])
        observation, _ = many.reset(seed=[int(seed) for _, seed in batch])
        total = numpy.zeros(many.num_envs)
        for _ in range(round(LIMIT / SECONDS)):
            steering = numpy.tanh((weights * features(observation)).sum(axis=1))
            observation, reward, *_ = many.step(numpy.column_stack([numpy.full(many.num_envs, LEVER), steering]))
            total += reward
        totals.extend(total[:len(pairs) - first])
    return numpy.array(totals).reshape(len(policies), len(seeds))


def evolve(many, seconds, generations):
    """The mean of the population after a time [s], and the mean reward of each generation."""
    random = numpy.random.default_rng(64)
    mean, spread = STRAIGHT.copy(), numpy.full(STRAIGHT.size, SPREAD)
    best = POPULATION // 4
    weights = numpy.log(best + 0.5) - numpy.log(numpy.arange(1, best + 1))
    weights /= weights.sum()
    history, start = [], time.monotonic()
    for generation in range(generations):
        policies = mean + spread * random.standard_normal((POPULATION, mean.size))
        seeds = PLACE_OF_SEEDS + FIELDS * generation + numpy.arange(FIELDS)  # new fields, the same for all
        rewards = returns(many, policies, seeds).mean(axis=1)
        order = numpy.argsort(-rewards)[:best]
        chosen = policies[order]
        spread = 0.7 * spread + 0.3 * numpy.sqrt(weights @ (chosen - mean) ** 2)
        mean = mean + 0.7 * (weights @ chosen - mean)
        history.append(rewards.mean())
        print(f"generation {generation + 1:2d}: mean reward {rewards.mean():7.1f}, best {rewards.max():7.1f}",
              flush=True)
        if time.monotonic() - start > seconds:
            break
    return mean, history


def draw(history, difference, path):
    figure = Figure(figsize=(6.7, 3.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    left.plot(range(1, len(history) + 1), history, color="#0072b2")
    left.set(xlabel="generation", ylabel="mean reward [m]", title="training")
    right.axhline(0, color="#000000", linewidth=0.8)
    right.plot(range(1, len(difference) + 1), numpy.sort(difference), ".", color="#d55e00")
    right.set(xlabel="held-out field, sorted", ylabel="trained − straight ahead [m]", title="reward, paired")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="one generation, four held-out fields")
    parser.add_argument("--minutes", type=float, default=3.0, help="wall time of the training; 3 if not given")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    held_out = range(1, 5) if options.short else HELD_OUT
    many = ShipsInIce(8, scene=scene, goal=GOAL, seconds=SECONDS, time_limit=LIMIT + 1, shape=(ROWS, COLUMNS),
                      cell_m=CELL, ahead_m=AHEAD)
    trained, history = evolve(many, 60 * options.minutes, 1 if options.short else 1000)
    straight, steered = returns(many, [STRAIGHT, trained], held_out)
    many.close()
    difference = steered - straight
    error = difference.std(ddof=1) / numpy.sqrt(len(difference))
    print(f"{len(history)} generations; weights {numpy.array2string(trained, precision=2, max_line_width=100)}")
    print(f"{len(difference)} held-out fields: straight ahead {straight.mean():.1f}, trained {steered.mean():.1f}, "
          f"difference {difference.mean():+.1f}, standard error {error:.1f}: {difference.mean() / error:.1f} standard "
          f"errors")
    draw(history, difference, options.out / "train-by-evolution.png")
    print(options.out / "train-by-evolution.png")


if __name__ == "__main__":
    main()
