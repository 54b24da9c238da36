#!/usr/bin/python3
"""A pilot in Python: a ship that steers around big floes, beside one that goes straight through them.

    python3 examples/python_pilot.py         (--out FOLDER; --short: the first seconds)

Shows a callable that steers. The pilot sees the ice ahead as an image (Simulation.occupancy), adds up what a straight
way into each of some directions would cross, and turns into the cheapest one. Draws python-pilot.png: both tracks, and
what each lost to the ice.
"""
import argparse
import pathlib

import find_polynya  # noqa: F401
import polynya

polynya.require("numpy", "matplotlib")

import numpy
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

SCENE = {
    "name": "big-floes",
    "seed": 1,
    "time": {"step_s": 0.02, "until_s": 220},
    "record": {"forces_interval_s": 0.5},
    "ice": {"thickness_m": 0.6},
    "ships": [{
        "name": "icebreaker",
        "hull": {"length_m": 80, "beam_m": 18, "entrance_angle_deg": 27, "stem_angle_deg": 30,
                 "draught_m": 6, "block_coefficient": 0.58},
        "position_m": [-60, 250], "speed_m_per_s": 4,
        "propulsion": {"engine": {"power_MW": 10, "propeller_diameter_m": 3.6, "propellers": 2,
                                  "open_water_speed_m_per_s": 7}},
        "steering": {"rudder": {"area_m2": 14}},
        "pilot": {"constant": {"lever": 0.5}},
    }],
    "floes": [{"field": {"corner_m": [0, 0], "extent_m": [900, 500], "floe_size_m": 70,
                         "size_spread": 0.3, "concentration": 0.3}}],
}
CELL, ROWS, COLUMNS, AHEAD = 5.0, 60, 60, 130.0  # of the image [m]
DIRECTIONS = numpy.radians(numpy.arange(-50, 51, 5))  # to port, from the bow
FIRST, FAR = 50.0, 270.0  # of a way that is looked along, from the centre of gravity [m]
BREADTH = 14.0  # to each side of it [m]
OFF_COURSE = 0.2  # what a way a radian off the course costs, in shares of ice


def ways():
    """Rows and columns of the cells along each direction."""
    along = numpy.arange(FIRST, FAR, CELL)[:, None]
    aside = numpy.arange(-BREADTH, BREADTH + 1, CELL)[None, :]
    for direction in DIRECTIONS:
        ahead = along * numpy.cos(direction) - aside * numpy.sin(direction)
        to_port = along * numpy.sin(direction) + aside * numpy.cos(direction)
        rows = (ROWS / 2 - (ahead - AHEAD) / CELL).astype(int)
        columns = (COLUMNS / 2 - to_port / CELL).astype(int)
        is_seen = (rows >= 0) & (rows < ROWS) & (columns >= 0) & (columns < COLUMNS)
        yield rows[is_seen], columns[is_seen]


class AroundFloes:
    """Turns towards where least ice is, once a second; between that it holds the heading it chose."""

    def __init__(self, simulation, course=0.0):
        self.simulation, self.course = simulation, course
        self.wanted, self.next_time = course, 0.0
        self.ways = list(ways())

    def __call__(self, view):
        if view.time >= self.next_time:
            self.next_time = view.time + 1.0
            self.wanted = self.choose(view.heading)
        lever = 0.75 if view.speed_over_ground < 4 else 0.4
        steering = 1.2 * (self.wanted - view.heading) - 6.0 * view.through_water[2]
        return lever, steering

    def choose(self, heading):
        ice, others = self.simulation.occupancy("icebreaker", shape=(ROWS, COLUMNS), cell_m=CELL, ahead_m=AHEAD)
        seen = ice + 5 * others
        costs = [seen[rows, columns].mean() + OFF_COURSE * abs(heading + direction - self.course)
                 + 0.05 * abs(direction)
                 for direction, (rows, columns) in zip(DIRECTIONS, self.ways)]
        return heading + DIRECTIONS[int(numpy.argmin(costs))]


class Straight:
    """Holds its course."""

    def __call__(self, view):
        return 0.75 if view.speed_over_ground < 4 else 0.4, -1.2 * view.heading - 6.0 * view.through_water[2]


def sail(make_pilot, until):
    """The track [m], the work lost to the ice [J] against time [s], and the simulation."""
    simulation = polynya.Simulation(SCENE)
    simulation.set_pilot("icebreaker", make_pilot(simulation))
    track, work, times = [simulation.ships[0].position], [0.0], [0.0]
    while simulation.time < until - 1e-9:
        simulation.run(until=simulation.time + 0.5)
        ship = simulation.ships[0]
        speed = numpy.cos(ship.heading) * ship.velocity[0] + numpy.sin(ship.heading) * ship.velocity[1]
        track.append(ship.position)
        times.append(simulation.time)
        work.append(work[-1] - 0.5 * ship.forces["surge_N"] * speed)
    return numpy.array(track), numpy.array(times), numpy.array(work), simulation


def draw(outlines, sailed, path):
    figure = Figure(figsize=(6.7, 5.6), layout="constrained")
    ice, lost = figure.subplots(2, 1, height_ratios=(3.2, 1))
    ice.set_facecolor("#8fb8d0")
    ice.add_collection(PolyCollection(outlines, facecolors="#ffffff", edgecolors="#3d5261", linewidths=0.4))
    for (name, (track, times, work, _)), colour in zip(sailed.items(), ("#000000", "#d55e00")):
        ice.plot(*track.T, color=colour, linewidth=1.5, label=name)
        lost.plot(times, 1e-6 * work, color=colour, linewidth=1.2)
    ice.set(aspect="equal", xlim=(-110, 910), ylim=(-10, 510), xlabel="x [m]", ylabel="y [m]",
            title="the floes at the start, and the two tracks")
    ice.legend(loc="lower left")
    lost.set(xlabel="time [s]", ylabel="lost to\nthe ice [MJ]", xlim=(0, None), ylim=(0, None))
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("examples-out"), help="folder of the picture")
    parser.add_argument("--short", action="store_true", help="the first seconds only")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    floes = polynya.Simulation(SCENE).floes
    outlines = [floes.world_vertices[floes.ring_offsets[r]:floes.ring_offsets[r + 1]] for r in floes.floe_offsets[:-1]]
    until = 15 if options.short else SCENE["time"]["until_s"]
    sailed = {"straight": sail(lambda simulation: Straight(), until), "around the floes": sail(AroundFloes, until)}
    for name, (track, times, work, simulation) in sailed.items():
        kinds = [event["kind"] for event in simulation.events()]
        print(f"{name}: {track[-1, 0] - track[0, 0]:.0f} m made good in {times[-1]:g} s, {1e-6 * work[-1]:.0f} MJ lost "
              f"to the ice, "
              f"{kinds.count('bend')} cusps, {kinds.count('split')} splits")
    draw(outlines, sailed, options.out / "python-pilot.png")
    print(options.out / "python-pilot.png")


if __name__ == "__main__":
    main()
