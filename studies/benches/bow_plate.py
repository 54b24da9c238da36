#!/usr/bin/env python3
"""What the edge of a floating plate bears, by finite elements of any outline; the tables of docs/theory/bow.md.

  studies/benches/bow_plate.py wedges         against docs/theory/bending.md, "Verification"
  studies/benches/bow_plate.py edges RUN...   the edges at which a run's cusps broke, beside what the run took them for
  studies/benches/bow_plate.py cracks         a radial crack along the bisector, open or closing above, and the thrust

At rest, on springs, free edges; lengths in l, forces in σ_f h². Plate: Morley's elements; in-plane: quadratic
triangles. A push of radius 0.02 l at the tip. Breaks: where the top fibre's greatest principal stress, at 0.08 l and
more from the tip, is σ_f. Needs numpy, scipy and matplotlib.
"""
import argparse
import json
import math
import os

import numpy as np
from matplotlib.path import Path
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree

from bow_solid import chord, resampled

NU = 0.3
PUSH = 0.02
QUADRATURE = np.array([[1 / 3, 1 / 3, 1 / 3]] + [np.roll([a, b, b], k) for a, b in ((0.0597158717, 0.4701420641),
                       (0.7974269853, 0.1012865073)) for k in range(3)])
WEIGHTS = np.array([0.225] + 3 * [0.1323941527] + 3 * [0.1259391805])


def mesh(outline, ratio, reach=6.0, finest=0.0025, coarsest=0.5):
    """Triangles of the ice within `reach` of the tip (0, 0), which is the outline's first vertex, in proportion to
    their distance from it."""
    size = lambda r: min(coarsest, max(finest, ratio * r))
    closed = np.vstack([outline, outline[:1]])
    edge = [outline[0]]
    for p in resampled(closed, lambda p: size(math.hypot(*p)))[1:]:
        r = math.hypot(*p)
        if r < 1.02 * reach and math.dist(p, edge[-1]) > 0.3 * size(r) and (len(edge) < 2 or r > 0.3 * finest):
            edge.append(p)
    path, rings, r = Path(outline), [], finest
    while r < reach:
        count = max(6, int(2 * math.pi * r / size(r)))
        angle = 2 * math.pi * (np.arange(count) + 0.5 * (len(rings) % 2)) / count
        rings.append(np.c_[r * np.cos(angle), r * np.sin(angle)])
        r += 0.87 * size(r)
    inner = np.vstack(rings)
    inner = inner[path.contains_points(inner)]
    away, _ = cKDTree(resampled(closed, lambda p: 0.3 * size(math.hypot(*p)))).query(inner)
    inner = inner[away > 0.6 * np.clip(ratio * np.hypot(*inner.T), finest, coarsest)]
    points = np.vstack([edge, inner])
    triangles = Delaunay(points).simplices
    middle = points[triangles].mean(1)
    sides = [np.hypot(*(points[triangles[:, i]] - points[triangles[:, (i + 1) % 3]]).T) for i in range(3)]
    a, b = points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
    doubled = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    is_sound = doubled > 2e-3 * np.max(sides, 0) ** 2
    triangles = triangles[path.contains_points(middle) & (np.hypot(*middle.T) < reach) & is_sound]
    used = np.unique(triangles)
    number = np.full(len(points), -1)
    number[used] = np.arange(len(used))
    return points[used], number[triangles]


class Plate:
    """Bending: a deflection at each vertex, a slope at each edge's middle. In-plane: two displacements at both."""

    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles
        ends = np.sort(np.stack([triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]], 1), 2)
        keys, first, inverse = np.unique(ends[..., 0].ravel() * len(points) + ends[..., 1].ravel(),
                                         return_index=True, return_inverse=True)
        self.dof = np.hstack([triangles, len(points) + inverse.reshape(ends.shape[:2])])
        self.count = len(points) + len(keys)
        self.ends = ends.reshape(-1, 2)[first]
        corners = points[triangles]
        self.middle = corners.mean(1)
        local = corners - self.middle[:, None]
        a, b = local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]
        determinant = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        self.area = np.abs(determinant) / 2
        values = lambda q: np.stack([np.ones(q.shape[:-1]), q[..., 0], q[..., 1],
                                     q[..., 0] ** 2 / 2, q[..., 1] ** 2 / 2, q[..., 0] * q[..., 1]], -1)
        along = points[ends[..., 1]] - points[ends[..., 0]]
        normal = np.stack([along[..., 1], -along[..., 0]], -1) / np.hypot(along[..., 0], along[..., 1])[..., None]
        x, y = np.moveaxis((points[ends[..., 0]] + points[ends[..., 1]]) / 2 - self.middle[:, None], -1, 0)
        zero, one = 0 * x, 0 * x + 1
        conditions = np.concatenate([values(local), normal[..., :1] * np.stack([zero, one, zero, x, zero, y], -1)
                                     + normal[..., 1:] * np.stack([zero, zero, one, zero, y, x], -1)], 1)
        self.shape = np.linalg.inv(conditions)
        at = np.einsum("ql,mlk->mqk", QUADRATURE, local)
        self.at, self.value = at + self.middle[:, None], np.einsum("mqk,mki->mqi", values(at), self.shape)
        zero = 0 * at[..., 0]
        self.slope_x = np.einsum("mqk,mki->mqi", np.stack([zero, zero + 1, zero, at[..., 0], zero, at[..., 1]], -1),
                                 self.shape)
        rigidity = np.array([[1, NU, 0], [NU, 1, 0], [0, 0, 2 * (1 - NU)]])
        self.curvature = self.shape[:, 3:]
        self.weight = WEIGHTS * self.area[:, None]
        self.bending = (np.einsum("mai,ab,mbj->mij", self.curvature, rigidity,
                                  self.curvature) * self.area[:, None, None]
                        + np.einsum("mq,mqi,mqj->mij", self.weight, self.value, self.value))
        self.gradient = np.stack([np.stack([corners[:, (i + 1) % 3, 1] - corners[:, (i + 2) % 3, 1],
                                            corners[:, (i + 2) % 3, 0] - corners[:, (i + 1) % 3, 0]],
                                            1) / determinant[:, None] for i in range(3)], 1)

    def strain(self, barycentric):
        """Of the quadratic triangles, per displacement."""
        p = barycentric
        slopes = np.array([[4 * p[0] - 1, 0, 0], [0, 4 * p[1] - 1, 0], [0, 0, 4 * p[2] - 1], [0, 4 * p[2], 4 * p[1]],
                           [4 * p[2], 0, 4 * p[0]], [4 * p[1], 4 * p[0], 0]])
        g = np.einsum("kl,mld->mkd", slopes, self.gradient)
        strain = np.zeros((len(g), 3, 12))
        strain[:, 0, 0::2], strain[:, 1, 1::2] = g[..., 0], g[..., 1]
        strain[:, 2, 0::2], strain[:, 2, 1::2] = g[..., 1], g[..., 0]
        return strain

    def load(self):
        """The push's share of each quadrature point."""
        inside = (np.hypot(self.at[..., 0], self.at[..., 1]) < PUSH) * self.weight
        return inside / inside.sum()

    def moments(self, amplitudes):
        """Of each triangle, tension of the bottom fibre positive, per V."""
        k = np.einsum("mai,mi->ma", self.curvature, amplitudes[self.dof])
        return -np.c_[k[:, 0] + NU * k[:, 1], k[:, 1] + NU * k[:, 0], (1 - NU) * k[:, 2]]

    def at_vertices(self, of_triangles):
        total, area = np.zeros((len(self.points), 3)), np.zeros(len(self.points))
        for i in range(3):
            np.add.at(total, self.triangles[:, i], self.area[:, None] * of_triangles)
            np.add.at(area, self.triangles[:, i], self.area)
        return total / area[:, None]


def assembled(size, rows, blocks):
    n = rows.shape[1]
    return coo_matrix((blocks.ravel(), (np.repeat(rows, n, 1).ravel(), np.tile(rows, (1, n)).ravel())),
                      shape=(size, size))


def principal(s):
    mean, spread = (s[:, 0] + s[:, 1]) / 2, np.hypot((s[:, 0] - s[:, 1]) / 2, s[:, 2])
    return mean + spread, mean - spread


def along_ray(plate, values, angle):
    """The component of a symmetric tensor along a ray from the tip, its greatest and where."""
    from matplotlib.tri import LinearTriInterpolator, Triangulation
    radii = np.exp(np.linspace(math.log(0.05), math.log(2.5), 300))
    x, y, c, s = radii * math.cos(angle), radii * math.sin(angle), math.cos(angle), math.sin(angle)
    net = Triangulation(*plate.points.T, plate.triangles)
    xx, yy, xy = (LinearTriInterpolator(net, values[:, i])(x, y).filled(np.nan) for i in range(3))
    radial = xx * c * c + yy * s * s + 2 * xy * c * s
    best = int(np.nanargmax(radial))
    return radial[best], radii[best]


def bears(outline, bisector=0.0, ratio=0.08):
    """V where the top fibre fails on the bisector and R, V where it fails anywhere, the tip's w ρ_w g l²/V, and the
    bottom fibre's greatest stress over the top's."""
    plate = Plate(*mesh(outline, ratio))
    force = np.zeros(plate.count)
    np.add.at(force, plate.dof.ravel(), np.einsum("mq,mqi->mi", plate.load(), plate.value).ravel())
    amplitudes = splu(assembled(plate.count, plate.dof, plate.bending).tocsc()).solve(force)
    m = plate.at_vertices(plate.moments(amplitudes))
    r = np.hypot(*plate.points.T)
    most, least = principal(m)
    anywhere = (-least)[(r > 0.08) & (r < 3)].max()
    on_bisector, radius = along_ray(plate, -m, bisector)
    return {"V": 1 / 6 / on_bisector, "R": radius, "V anywhere": 1 / 6 / anywhere, "w": amplitudes[np.argmin(r)],
            "bottom": most[(r > 0.03)].max() / on_bisector}


def wedge(degrees, reach=7):
    angle = np.linspace(-0.5, 0.5, 60) * math.radians(degrees)
    return np.vstack([[0, 0], np.c_[reach * np.cos(angle), reach * np.sin(angle)]])


def study_wedges(_):
    print("| 2α | V [σ_f h²] on the bisector | R/l | V anywhere | w ρ_w g l²/V | bottom / top stress |\n|---|---|---|"
          "---|---|---|")
    for degrees in (60, 90, 112, 120, 150, 180, 220):
        b = bears(wedge(degrees))
        print(f"| {degrees}° | {b['V']:.3f} | {b['R']:.3f} | {b['V anywhere']:.3f} | {b['w']:.3f} | {b['bottom']:.2f} |"
              f"")


class CrackedWedge:
    """Half of a wedge, its bisector along y = 0: cracked from the tip to `crack`, and pushed with V and V · thrust
    along the bisector, that at the height `above` of the middle plane."""

    def __init__(self, degrees, h, ratio=0.08, reach=6.0):
        angle = np.linspace(0, math.radians(degrees) / 2, 60)
        outline = np.vstack([[0, 0], np.c_[reach * np.cos(angle), reach * np.sin(angle)]])
        self.h, self.plate = h, Plate(*mesh(outline, ratio, 1.001 * reach))
        p = self.plate
        self.size = 3 * p.count
        self.membrane = np.zeros((len(p.dof), 12), int)
        self.membrane[:, 0::2], self.membrane[:, 1::2] = p.count + 2 * p.dof, p.count + 2 * p.dof + 1
        self.elasticity = 12 / h ** 2 * np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]])
        blocks = sum(np.einsum("mai,ab,mbj->mij", b, self.elasticity, b) * p.area[:, None, None] / 3
                     for b in map(p.strain, ((2 / 3, 1 / 6, 1 / 6), (1 / 6, 2 / 3, 1 / 6), (1 / 6, 1 / 6, 2 / 3))))
        self.stiffness = (assembled(self.size, p.dof, p.bending) + assembled(self.size, self.membrane, blocks)).tocsr()
        self.on_axis = np.flatnonzero(np.abs(p.points[:, 1]) < 1e-9)
        self.rim = np.flatnonzero(np.hypot(*p.points.T) > 0.995 * reach)

    def solve(self, kind, thrust=0.0, above=0.0, crack=9.0):
        p, size = self.plate, self.size
        load, force = p.load(), np.zeros(size)
        np.add.at(force, p.dof.ravel(), np.einsum("mq,mqi->mi", load, p.value + thrust * above * p.slope_x).ravel() / 2)
        q = QUADRATURE
        quadratic = np.stack([q[:, 0] * (2 * q[:, 0] - 1), q[:, 1] * (2 * q[:, 1] - 1), q[:, 2] * (2 * q[:, 2] - 1),
                              4 * q[:, 1] * q[:, 2], 4 * q[:, 2] * q[:, 0], 4 * q[:, 0] * q[:, 1]], 1)
        np.add.at(force, self.membrane[:, 0::2].ravel(), thrust * np.einsum("mq,qk->mk", load, quadratic).ravel() / 2)
        free, ties = np.ones(size, bool), []
        for v in self.rim:
            free[p.count + 2 * v: p.count + 2 * v + 2] = False
        axis = np.isin(p.ends, self.on_axis).all(1)
        for k in np.flatnonzero(axis):
            a, b = p.points[p.ends[k]]
            edge, across = len(p.points) + k, p.count + 2 * (len(p.points) + k) + 1
            is_cracked = kind != "whole" and abs(a[0] + b[0]) / 2 < crack
            if not is_cracked:
                free[[edge, across]] = False
            elif kind == "closing":  # the top fibres stay in touch: u_y = -(h/2) w_y
                free[across] = False
                ties.append((across, edge, 0.5 * self.h * np.sign(b[0] - a[0])))
        for v in self.on_axis:
            if kind == "whole" or p.points[v, 0] >= crack:
                free[p.count + 2 * v + 1] = False
        number = np.cumsum(free) - 1
        rows, columns, values = list(np.flatnonzero(free)), list(number[free]), [1.0] * int(free.sum())
        for across, edge, factor in ties:
            rows.append(across), columns.append(number[edge]), values.append(factor)
        reduce = coo_matrix((values, (rows, columns)), shape=(size, int(free.sum()))).tocsr()
        x = reduce @ splu((reduce.T @ self.stiffness @ reduce).tocsc()).solve(reduce.T @ force)
        in_plane = np.einsum("mai,mi->ma", p.strain((1 / 3, 1 / 3, 1 / 3)), x[self.membrane]) @ self.elasticity.T
        top, _ = principal(p.at_vertices(self.h * in_plane - 6 * p.moments(x)))
        r = np.hypot(*p.points.T)
        chosen = (r > 0.08) & (r < 3)
        worst = np.flatnonzero(chosen)[np.argmax(top[chosen])]
        return {"V": 1 / top[worst], "R": r[worst], "w": x[np.argmin(r)]}


def study_cracks(_):
    h, l, toughness, strength = 0.5, 8.909, 150e3, 0.8e6
    print("V [σ_f h²] and where the top fibre fails [l]; h 0.5 m. Thrust: H = 1.9 V (θ_s 38°, μ 0.2), 0.35 h above the "
          "middle plane.\n\n"
          "| 2α | whole | cracked, open | cracked, closing above | whole, thrust | closing, thrust |\n|---|---|---|---|"
          "---|---|")
    for degrees in (60, 90, 112, 150, 180, 220):
        half = CrackedWedge(degrees, h / l)
        cells = [half.solve("whole"), half.solve("open"), half.solve("closing"), half.solve("whole", 1.9, 0.35 * h / l),
                 half.solve("closing", 1.9, 0.35 * h / l)]
        print(f"| {degrees}° | " + " | ".join(f"{c['V']:.3f} at {c['R']:.2f}" for c in cells) + " |")
    # Linear elastic fracture: ½ V² dC/da = K² h / E, with the compliance C of the tip; V is in σ_f h².
    ends = (0.05, 0.1, 0.2, 0.4, 0.7, 1, 1.5, 2, 3)
    print(f"\nV [σ_f h²] that drives a radial crack of length a, K_IC {toughness / 1e3:g} kPa√m\n\n| 2α | "
          + " | ".join(f"a {math.sqrt(a * b):.2f} l" for a, b in zip(ends, ends[1:]))
          + " |\n|---|" + "---|" * (len(ends) - 1))
    for degrees in (112, 180):
        for kind in ("open", "closing"):
            half = CrackedWedge(degrees, h / l, 0.06)
            w = [half.solve(kind, crack=a)["w"] for a in ends]
            drives = [math.sqrt(2 * toughness ** 2 * (b - a) / (12 * (1 - NU ** 2) * strength ** 2 * l * (v - u)))
                      for a, b, u, v in zip(ends, ends[1:], w, w[1:])]
            print(f"| {degrees}°, {kind} | " + " | ".join(f"{d:.2f}" for d in drives) + " |")


def outer_rings(run):
    """The outer ring of every floe, and the vertices that its birth made."""
    rings, made = {}, {}
    with open(os.path.join(run, "floes.ndjson"), encoding="utf-8") as file:
        for floe in map(json.loads, file):
            number = floe["floe_id"]
            if "ring_m" in floe:
                rings[number], made[number] = np.array(floe["ring_m"]), []
                continue
            parent, points, new = rings[floe["parent_id"]], [], []
            for part in floe["ring_parts_m"]:
                if isinstance(part[0], list):
                    points += part
                    new += part
                else:
                    points += [list(parent[(part[1] + i) % len(parent)]) for i in range(part[2])]
            rings[number], made[number] = np.array(points), new
    return rings, made


def centre_of(points, radius):
    """Of the circle of that radius through the points."""
    points = np.array(points)
    centre = np.linalg.lstsq(np.c_[2 * points, np.ones(len(points))], (points ** 2).sum(1), rcond=None)[0][:2]
    for _ in range(20):
        off = points - centre
        r = np.hypot(*off.T)
        centre = centre - np.linalg.lstsq(-off / r[:, None], r - radius, rcond=None)[0]
    return centre, np.abs(np.hypot(*(points - centre).T) - radius).max()


def study_edges(arguments):
    lengths = (0.1, 0.3, 0.6, 1.0)
    angles, capacities = (20, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165, 180), []
    for degrees in angles:
        capacities.append(bears(wedge(degrees))["V"])
    print("| run | cusps | V on the bisector [σ_f h²] 10, 50, 90 % | R/l | V anywhere | opening [°] over "
          + ", ".join(f"{s:g} l" for s in lengths)
          + " | V of the wedge of that opening / V on the bisector |\n|---|---|---|---|---|---|---|")
    for run in arguments.runs:
        with open(os.path.join(run, "scene.json"), encoding="utf-8") as file:
            ice = json.load(file)["ice"]
        h = ice["thickness_m"]
        l = (ice["youngs_modulus_Pa"] * h ** 3 / (12 * (1 - NU ** 2) * 9810)) ** 0.25
        rings, made = outer_rings(run)
        with open(os.path.join(run, "events.ndjson"), encoding="utf-8") as file:
            bends = [e for e in map(json.loads, file) if e["kind"] == "bend" and len(e["children"]) == 1
                     and e["normal"][0] < 0.9]
        rows = []
        for e in np.random.default_rng(1).permutation(bends[len(bends) // 4:]):
            new = made[e["children"][0]]
            if len(new) < 4 or len(rows) == arguments.cusps:
                continue
            tip, error = centre_of(new, e["cusp_radius_m"])
            if error > 0.02 * e["cusp_radius_m"]:
                continue
            ring = (rings[e["floe"]] - tip) / l
            first = int(np.argmin(np.hypot(*ring.T)))
            ring = np.roll(ring, -first, 0)
            if math.hypot(*ring[0]) > 0.003:  # the hull touched an edge, not a vertex
                continue
            ring[0] = 0
            chords = [(chord(ring, 1, s), chord(ring, -1, s)) for s in lengths]
            opening = [math.degrees((math.atan2(b[1], b[0]) - math.atan2(f[1], f[0])) % (2 * math.pi))
                       for f, b in chords]
            forward = math.atan2(chords[1][0][1], chords[1][0][0])
            b = bears(ring, forward + math.radians(opening[1]) / 2, 0.09)
            rows.append([b["V"], b["R"], b["V anywhere"]] + opening
                        + [np.interp(o, angles, capacities) / b["V"] for o in opening])
        rows = np.array(rows)
        three = lambda values, digits: ", ".join(f"{v:.{digits}f}" for v in np.percentile(values, [10, 50, 90]))
        n = 3 + len(lengths)
        print(f"| {os.path.basename(os.path.normpath(run))} | {len(rows)} | {three(rows[:, 0], 2)} | "
              f"{np.median(rows[:, 1]):.2f} | {three(rows[:, 2], 2)} | "
              + ", ".join(f"{v:.0f}" for v in np.median(rows[:, 3:n], 0)) + " | "
              + ", ".join(f"{v:.2f}" for v in np.median(rows[:, n:], 0)) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    studies = parser.add_subparsers(dest="study", required=True)
    studies.add_parser("wedges").set_defaults(function=study_wedges)
    studies.add_parser("cracks").set_defaults(function=study_cracks)
    edges = studies.add_parser("edges")
    edges.add_argument("runs", nargs="+")
    edges.add_argument("--cusps", type=int, default=25)
    edges.set_defaults(function=study_edges)
    arguments = parser.parse_args()
    arguments.function(arguments)


if __name__ == "__main__":
    main()
