#!/usr/bin/env python3
"""What the ice ahead of a stem bears: three-dimensional elements of the notches that cusps left, beside the law.

  studies/benches/bow_stem.py RUN... [--cusps N] [--strength S]

A stem crushes a groove and presses its two flanks apart. Radial cracks open one after the other, along the bisectors of
what they part, until the next one takes more than the ice bears. Their faces press on each other where they close, up
to S times the flexural strength, without friction; "tied": held together at the top fibres instead. Runs of level ice
at constant speed along x. Needs numpy, scipy and matplotlib.
"""
import argparse
import json
import math
import os

import numpy as np
from scipy.spatial import cKDTree

import bow_edges
from bow_solid import GAP, WEIBULL, Solid, chord, next_crack, sampled

ALONG_CRACK = 1.2  # [l] where its faces may press on each other
OF_HEIGHT = (2 / 3, 1 / 6)  # shares of a face: its middle and its top; the bottom opens


def directions(edge, count):
    """Of so many cracks, and of the bisectors of the parts between them; one alone lies ahead of the stem."""
    ring, r = np.array(edge["ring"]), 0.3 * edge["l"]
    first = math.atan2(*chord(ring, 1, r)[::-1])
    share = bow_edges.openings(edge, [r])[0] / (count + 1)
    cracks = [first + share * (k + 1) for k in range(count)]
    if count == 1:
        cracks = [math.atan2(edge["normal"][1], edge["normal"][0])]
    return cracks, [first + share * (k + 0.5) for k in range(count + 1)]


def faces(solid, crack):
    """Pairs of nodes left and right of it, the direction across, and their shares of its length."""
    along = np.array([math.cos(crack), math.sin(crack)])
    across = np.array([-along[1], along[0]])
    s = solid.plan @ along
    on = np.flatnonzero((abs(solid.plan @ across) < 1e-7) & (s > -1e-9) & (s < ALONG_CRACK * solid.l))
    beside = {node: {} for node in on}
    for middle, nodes in zip(solid.plan[solid.triangles].mean(1), solid.six):
        for node in beside.keys() & set(nodes):
            off = math.atan2(middle @ across, middle @ along - s[node])
            side = beside[node]
            side[off > 0] = min(side.get(off > 0, 9), abs(off))
    pairs = []
    for place in np.unique(np.round(s[on], 6)):
        here = [node for node in on if abs(s[node] - place) < 1e-5]
        left = min(here, key=lambda node: beside[node].get(True, 9))
        right = min(here, key=lambda node: beside[node].get(False, 9))
        if left != right:
            pairs.append((left, right, place))
    place = np.array([p[2] for p in pairs])
    share = 0.5 * (np.r_[place[1:], place[-1]] - np.r_[place[0], place[:-1]])
    return [(left, right, across, length) for (left, right, _), length in zip(pairs, share)]


def strongest(solid, tensors, cracks):
    """The top's greatest principal stress on circles about the tip, away from the cracks' faces."""
    radii, most = np.exp(np.arange(math.log(solid.depth + GAP) + 0.02, math.log(1.3 * solid.l), 0.06)), []
    for r in radii:
        start, end = (math.atan2(*chord(solid.outline, step, r)[::-1]) for step in (1, -1))
        cuts = [0, *((crack - start) % (2 * math.pi) for crack in cracks), (end - start) % (2 * math.pi)]
        angles = []
        for k, (a, b) in enumerate(zip(cuts[:-1], cuts[1:])):
            least, last = 0.01 if k == 0 else 0.12, 0.99 if k == len(cuts) - 2 else 0.88
            angles += list(start + a + (b - a) * np.linspace(least, last, 12))
        there = sampled(solid, tensors, r * np.c_[np.cos(angles), np.sin(angles)])[:, :2, :2]
        most.append(np.linalg.eigvalsh(there)[:, 1].max())
    return radii, np.array(most)


class Parted:
    """An edge with cracks whose faces press on each other where they close."""

    def __init__(self, edge, count, is_tied):
        self.cracks, self.bisectors = directions(edge, count)
        self.solid = Solid(np.array(edge["ring"]), edge["normal"], edge["depth"], edge["slope"], edge["l"], 0.18, 0.2,
                           cracks=[(c, 2 * edge["l"]) for c in self.cracks], half_angle=edge["half_angle"],
                           is_held=is_tied)
        (_, _, self.bare), = self.solid.solve((edge["thrust"],))
        rows, self.area = [], []
        for left, right, across, length in () if is_tied else (f for c in self.cracks for f in faces(self.solid, c)):
            for level, height in enumerate(OF_HEIGHT, 1):
                row = np.zeros(self.bare.shape)
                row[left + level * self.solid.count, :2] += across
                row[right + level * self.solid.count, :2] -= across
                rows.append(row.ravel()[self.solid.free])
                self.area.append(height * length)
        self.area = np.array(self.area)
        if rows:
            rows = np.array(rows)
            self.by_force = self.solid.factor.solve(rows.T.copy())
            self.flexibility, self.gap = rows @ self.by_force, rows @ self.bare.ravel()[self.solid.free]

    def surfaces(self, force, strength):
        """Of the top and of the bottom, per V/h², at that V; Gauss-Seidel of the faces' forces."""
        u = self.bare.ravel().copy()
        if len(self.area):
            pressed, most = np.zeros(len(self.area)), strength * self.area / force
            for _ in range(4000):
                before = pressed.copy()
                for i, row in enumerate(self.flexibility):
                    pressed[i] = min(most[i], max(0, pressed[i] - (self.gap[i] + row @ pressed) / row[i]))
                if abs(pressed - before).max() < 1e-5 * max(1e-9, pressed.max()):
                    break
            u[self.solid.free] += self.by_force @ pressed
        u = u.reshape(-1, 3)
        return self.solid.surface(u, 0, 1.0), self.solid.surface(u, 0, -1.0)

    def bears(self, strength):
        """V_b, the expected R, and V of the next crack."""
        low, high = 0.05, 8.0
        for _ in range(9):
            force = math.sqrt(low * high)
            top, bottom = self.surfaces(force, strength)
            radii, most = strongest(self.solid, top, self.cracks)
            low, high = (low, force) if most.max() * force > 1 else (force, high)
        weight = np.maximum(most, 0) ** WEIBULL
        return {"V": force, "R": math.exp(weight @ np.log(radii) / weight.sum()),
                "next": next_crack(self.solid, bottom, self.bisectors)}


def edges_of(run, count):
    with open(os.path.join(run, "scene.json"), encoding="utf-8") as file:
        hull = json.load(file)["ships"][0]["hull"]
    edges = bow_edges.different(bow_edges.edges_of(run, 20 * count, is_stem=True))[:count]
    return [edge | {"half_angle": math.radians(hull["entrance_angle_deg"])} for edge in edges]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+")
    parser.add_argument("--cusps", type=int, default=2)
    parser.add_argument("--strength", type=float, default=4, help="of the cracks' faces, over the flexural strength")
    arguments = parser.parse_args()
    print("| run | l/h | ξ/h | V_b, next crack: whole | one crack | three | R | tied: V_b | law: V_b | R |\n|"
          + "---|" * 10, flush=True)
    ratios = []
    for edge in (edge for run in arguments.runs for edge in edges_of(run, arguments.cusps)):
        whole, one, three = (Parted(edge, count, False).bears(arguments.strength) for count in (0, 1, 3))
        tied = Parted(edge, 3, True).bears(arguments.strength)
        force, _, place = bow_edges.by_sections(edge, load_place=1 / 3)
        ratios.append((force / three["V"], place / three["R"]))
        print(f"| {edge['run']} | {edge['l']:.1f} | {edge['depth']:.2f} | "
              + " | ".join(f"{e['V']:.2f}, {e['next']:.2f}" for e in (whole, one, three))
              + f" | {three['R']:.1f} | {tied['V']:.2f} | {force:.2f} | {place:.1f} |", flush=True)
    print("\nlaw over three cracks, least, median, largest: V_b, R "
          + ", ".join(f"{x:.2f}" for x in np.percentile(np.array(ratios), [0, 50, 100], axis=0).T.ravel()))


if __name__ == "__main__":
    main()
