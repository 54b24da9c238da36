#!/usr/bin/env python3
"""A crack beside a free edge, by finite elements of a plate in its plane; the tables of docs/theory/splitting.md and
docs/validation.md.

  studies/benches/crack_plate.py square    the edge crack under forces at its mouth against the rule's
  studies/benches/crack_plate.py arms      a straight crack of length a beside an arm of width b: K_I, K_II; a beam's
  studies/benches/crack_plate.py paths     the path by the largest hoop stress of a crack b from a plate's corner

Plane stress, quadratic triangles, K_I and K_II by the interaction integral. The mouth is at (0, b), the free edge
beside the crack is y = 0, the two lips are pushed apart by ±F across the crack. Lengths in b, K in F/(h √b). Needs
numpy and scipy.
"""
import math
import pathlib
import sys

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from tables import Table  # noqa: E402

NU = 0.3
ELASTICITY = np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]]) / (1 - NU ** 2)  # plane stress with E = 1
QUADRATURE = np.array([np.roll([a, b, b], k) for a, b in ((0.108103018, 0.445948491), (0.816847573, 0.091576214))
                       for k in range(3)])
WEIGHTS = np.repeat([0.223381590, 0.109951744], 3)


def polyline_distance(points, line):
    nearest = np.full(len(points), np.inf)
    for a, b in zip(line[:-1], line[1:]):
        t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(points - a - t[:, None] * (b - a)).T))
    return nearest


def along(line, size):
    """A polyline's points at the spacing size(points)."""
    points = [line[0]]
    for a, b in zip(line[:-1], line[1:]):
        length, at = math.dist(a, b), 0.0
        while length - at > 1.4 * (step := size((a + (b - a) * (at / length))[None])[0]):
            at += step
            points.append(a + (b - a) * (at / length))
        points.append(b)
    return np.array(points)


class Mesh:
    """Triangles of a rectangle with a crack, finest at its tip. The crack's lips have vertices of their own."""

    def __init__(self, sides, crack, finest, arm):
        self.crack, tip, coarsest = crack, crack[-1], max(sides) / 12
        under = np.array([[0, 0], [tip[0], 0]])

        def size(p):
            from_arm = np.minimum(polyline_distance(p, crack), polyline_distance(p, under))
            return np.clip(np.minimum(finest + 0.3 * np.hypot(*(p - tip).T), arm + 0.3 * from_arm), finest, coarsest)

        (width, height), mouth = sides, crack[0]
        edge = along(np.array([[0, 0], [width, 0], [width, height], [0, height], mouth, [0, 0]], float), size)[:-1]
        lips = along(crack[::-1], lambda p: 0.7 * size(p))[::-1]
        fixed, grids, spacing = np.vstack([edge, lips[1:]]), [], finest
        while spacing < 1.5 * coarsest:
            reach = 10.4 * spacing if spacing < arm / 1.5 else max(sides)
            low, high = np.maximum(tip - reach, 0), np.minimum(tip + reach, sides)
            x, y = np.meshgrid(np.arange(low[0], high[0], spacing), np.arange(low[1], high[1], 0.866 * spacing))
            x[1::2] += spacing / 2
            grid = np.c_[x.ravel(), y.ravel()] + 0.31 * spacing
            s = size(grid)
            to_edge = np.minimum(grid, np.array(sides) - grid).min(1)
            grids.append(grid[(to_edge > 0.4 * s) & (1.2 * s >= spacing) & (0.8 * s < spacing)])
            spacing *= 1.5
        inner = np.vstack(grids)
        near, _ = cKDTree(fixed).query(inner)
        inner = inner[(near > 0.55 * size(inner)) & (polyline_distance(inner, crack) > 0.45 * size(inner))]
        points = np.vstack([fixed, inner])
        _, of_lips = cKDTree(points).query(lips)
        triangles = Delaunay(points).simplices
        a, b = points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
        doubled = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        triangles[doubled < 0] = triangles[doubled < 0][:, [0, 2, 1]]
        triangles = triangles[np.abs(doubled) > 1e-9 * np.maximum((a ** 2).sum(1), (b ** 2).sum(1))]
        edges = {tuple(sorted(e)) for t in triangles for e in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))}
        if not all(tuple(sorted(e)) in edges for e in zip(of_lips[:-1], of_lips[1:])):
            raise SystemExit("crack_plate: a lip of the crack is no edge of the mesh")
        self.upper, self.lower = of_lips[0], len(points)
        self.points, self.triangles = self.parted(points, triangles, list(of_lips))

    @staticmethod
    def parted(points, triangles, lips):
        """The vertices on the crack, but the tip, are doubled: below it the triangles have the new ones."""
        new = {}
        for k, v in enumerate(lips[:-1]):
            ahead = math.atan2(*(points[lips[k + 1]] - points[v])[::-1])
            behind = math.atan2(*(points[lips[k - 1]] - points[v])[::-1]) if k else math.pi
            new[v] = len(points) + k
            for t in np.flatnonzero((triangles == v).any(1)):
                corner = np.where(triangles[t] >= len(points), triangles[t] - len(points), 0)
                own = np.where(triangles[t] >= len(points), np.array(lips)[corner], triangles[t])
                middle = math.atan2(*(points[own].mean(0) - points[v])[::-1])
                if (middle - ahead) % (2 * math.pi) > (behind - ahead) % (2 * math.pi):
                    triangles[t] = np.where(triangles[t] == v, new[v], triangles[t])
        return np.vstack([points, points[lips[:-1]]]), triangles


def shape_slopes(p):
    return np.array([[4 * p[0] - 1, 0, 0], [0, 4 * p[1] - 1, 0], [0, 0, 4 * p[2] - 1], [0, 4 * p[2], 4 * p[1]],
                     [4 * p[2], 0, 4 * p[0]], [4 * p[1], 4 * p[0], 0]])


class Plate:
    def __init__(self, mesh):
        self.mesh = mesh
        points, triangles = mesh.points, mesh.triangles
        ends = np.sort(np.stack([triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]], 1), 2)
        _, inverse = np.unique(ends[..., 0].ravel() * len(points) + ends[..., 1].ravel(), return_inverse=True)
        nodes = np.hstack([triangles, len(points) + inverse.reshape(ends.shape[:2])])
        self.dof = np.stack([2 * nodes, 2 * nodes + 1], 2).reshape(len(nodes), 12)
        self.count = 2 * (nodes.max() + 1)
        c = points[triangles]
        a, b = c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]
        determinant = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        self.area = determinant / 2
        opposite = np.roll(c, -1, 1) - np.roll(c, -2, 1)
        self.gradient = gradient = np.stack([opposite[..., 1], -opposite[..., 0]], 2) / determinant[:, None, None]
        self.slopes = [np.einsum("kl,mld->mkd", shape_slopes(p), gradient) for p in QUADRATURE]
        self.at = [np.einsum("l,mld->md", p, c) for p in QUADRATURE]
        blocks = sum(w * np.einsum("mai,ab,mbj,m->mij", b, ELASTICITY, b, self.area, optimize=True)
                     for w, b in zip(WEIGHTS, map(self.strain, self.slopes)))
        rows, columns = np.repeat(self.dof, 12, 1).ravel(), np.tile(self.dof, (1, 12)).ravel()
        self.stiffness = coo_matrix((blocks.ravel(), (rows, columns)), shape=(self.count, self.count)).tocsc()

    @staticmethod
    def strain(slopes):
        b = np.zeros((len(slopes), 3, 12))
        b[:, 0, 0::2], b[:, 1, 1::2] = slopes[..., 0], slopes[..., 1]
        b[:, 2, 0::2], b[:, 2, 1::2] = slopes[..., 1], slopes[..., 0]
        return b

    def displacements(self):
        """Under ±1 across the edge at the crack's lips. The plate is held at two far places, which carry nothing."""
        force = np.zeros(self.count)
        force[2 * self.mesh.upper + 1], force[2 * self.mesh.lower + 1] = 1, -1
        points = self.mesh.points
        far, other = np.argmax(points.sum(1)), np.argmax(points @ [-1, 2.0])
        free = np.delete(np.arange(self.count), [2 * far, 2 * far + 1, 2 * other + 1])
        u = np.zeros(self.count)
        u[free] = splu(self.stiffness[free][:, free].tocsc()).solve(force[free])
        return u

    def intensities(self, reach):
        """K_I and K_II by the interaction integral over a disc about the tip, in which the crack is straight."""
        u = self.displacements()
        crack = self.mesh.crack
        tip, x1 = crack[-1], (crack[-1] - crack[-2]) / math.dist(crack[-1], crack[-2])
        turn = np.array([x1, [-x1[1], x1[0]]])
        r = np.hypot(*(self.mesh.points - tip).T)
        weight = np.clip((reach - r) / (0.6 * reach), 0, 1)[self.mesh.triangles]
        chosen = np.flatnonzero((weight.max(1) > 0) & (weight.min(1) < 1))
        slope = np.einsum("ml,mld,ed->me", weight[chosen], self.gradient[chosen], turn)
        total = np.zeros(2)
        for w, slopes, at in zip(WEIGHTS, self.slopes, self.at):
            gradient = np.einsum("mkd,mki->mid", slopes[chosen], u[self.dof[chosen]].reshape(-1, 6, 2))
            gradient = np.einsum("ei,mid,fd->mef", turn, gradient, turn)
            stress = stresses(gradient)
            local = (at[chosen] - tip) @ turn.T
            for mode in (0, 1):
                other, other_stress = williams(local, mode)
                work = np.einsum("mij,mij->m", stress, other)
                flux = np.einsum("mij,mi->mj", stress, other[:, :, 0])
                flux += np.einsum("mij,mi->mj", other_stress, gradient[:, :, 0])
                flux[:, 0] -= work
                total[mode] += (w * self.area[chosen] * np.einsum("mj,mj->m", flux, slope)).sum()
        return total / 2


def stresses(gradient):
    e = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], 1) @ ELASTICITY.T
    return np.stack([np.stack([e[:, 0], e[:, 2]], 1), np.stack([e[:, 2], e[:, 1]], 1)], 1)


def williams(local, mode):
    """Displacement gradient and stress of K = 1 about a tip whose crack lies along negative x; E = 1, plane stress."""
    r, t = np.hypot(*local.T), np.arctan2(local[:, 1], local[:, 0])
    kappa, shear = (3 - NU) / (1 + NU), 1 / (2 * (1 + NU))

    def displacement(x, y):
        z = np.sqrt(x + 1j * y)  # √r (cos t/2 + i sin t/2)
        c, s, cos_t = z.real, z.imag, x / np.hypot(x, y)
        if mode == 0:
            return np.array([c * (kappa - cos_t), s * (kappa - cos_t)]) / (2 * shear * math.sqrt(2 * math.pi))
        return np.array([s * (kappa + 2 + cos_t), -c * (kappa - 2 + cos_t)]) / (2 * shear * math.sqrt(2 * math.pi))

    d = 1e-6 * r
    x, y = local.T
    by_x = (displacement(x + d, y) - displacement(x - d, y)) / (2 * d)
    by_y = (displacement(x, y + d) - displacement(x, y - d)) / (2 * d)
    gradient = np.moveaxis(np.array([by_x, by_y]), [0, 1, 2], [2, 1, 0])
    return gradient, stresses(gradient)


def intensities(sides, crack, reach, arm):
    return Plate(Mesh(sides, np.array(crack, float), reach / 13, arm)).intensities(reach)


def kink(k):
    """The direction of the largest hoop stress off the crack's own [rad]."""
    return 2 * math.atan(-2 * k[1] / (k[0] + math.hypot(k[0], math.sqrt(8) * k[1])))


def drive(k):
    """K_I of a mode I crack with the same largest hoop stress."""
    half = kink(k) / 2
    return math.cos(half) ** 2 * (k[0] * math.cos(half) - 3 * k[1] * math.sin(half))


def square():
    """The edge crack under a pair of forces at its mouth, beside the table of the rule (fracture/splitting.hpp)."""
    rows = []
    for ratio, length, table in ((0.25, 0.05, 0.092), (0.5, 0.075, 0.134), (1, 0.15, 0.187), (2, 0.175, 0.2105)):
        k = intensities((1, ratio), [[0, ratio / 2], [length, ratio / 2]], length / 2, 0.12 * min(1, ratio))
        rows.append([f"{ratio:g}", f"{length:g}", f"{1 / k[0]:.4f}", f"{table:g}"])
    return Table(["W/L", "a/L", "F/(h K √L) here", "the rule's table"], rows, within=0.005)


def arms():
    """A straight crack of length a that leaves an arm of width b, against a beam's."""
    rows = []
    for ratio in (0.02, 0.05, 0.1, 0.25, 0.5, 1, 2.5):
        a = 1 / ratio
        k = intensities((1.6 * a + 10, 1.6 * a + 10), [[0, 1], [a, 1]], min(0.3, 0.75 * a), 0.3)
        rows.append([f"{ratio:g}", f"{k[0]:.2f}", f"{k[1]:.2f}", f"{k[1] / k[0]:.3f}",
                     f"{math.hypot(*k) / (math.sqrt(6) * a):.3f}", f"{1 + 0.64 * ratio:.3f}",
                     f"{math.degrees(kink(k)):.1f}°"])
    return Table(["b/a", "K_I", "K_II", "K_II/K_I", "√(K_I² + K_II²) b/(√6 a)", "of a beam of length a + 0.64 b",
                  "kink"], rows, within=0.01)


def path_of(side, step, nearest=0.12):
    """The path of a crack from (0, 1) in a square plate, by steps along the largest hoop stress; F/(h K √b) at each."""
    crack, angle, tangent, forces = [np.array([0, 1.0]), np.array([step, 1.0])], 0.0, 0.0, []
    while True:
        k = intensities((side, side), crack, 0.9 * step, 0.35)
        forces.append(1 / drive(k))
        before, tangent = tangent, angle + kink(k)
        angle = tangent + (tangent - before) / 2  # in the middle of the next step
        ahead = np.array([math.cos(angle), math.sin(angle)])
        if crack[-1][1] + step * ahead[1] < nearest:
            return np.vstack(crack + [crack[-1] - crack[-1][1] / ahead[1] * ahead]), forces
        crack.append(crack[-1] + step * ahead)


def paths(straight=0.63, end=1.04, step=0.05):
    """The path by the largest hoop stress of a crack that begins b from a corner, at two steps and carried on to 0."""
    legs, rows = np.array([[0, 1], [straight, 1], [end, 0]]), []
    for ratio in (0.02, 0.1, 0.25):
        found = []
        for at_step in (2 * step, step):
            path, forces = path_of(1 / ratio, at_step)
            piece = ((path[1:, 0] - path[:-1, 0]) * (path[1:, 1] + path[:-1, 1])).sum() / 2
            found.append(np.array([max(forces), path[-1, 0], piece]))
        cells = [f"{a:.3f}, {b:.3f}, {2 * b - a:.3f}" for a, b in zip(*found)]
        rows.append([f"{ratio:g}", cells[0], f"{step * (1 + int(np.argmax(forces))):.2f}", cells[1], cells[2],
                     f"{polyline_distance(path, legs).max():.2f}"])
    return Table(["b/L", "F_max/(h K √b) at two steps, at 0", "at a/b", "ends at x/b", "piece/b²",
                  "path off two legs/b"], rows, within=0.01)


if __name__ == "__main__":
    for name in sys.argv[1:] or ("square", "arms", "paths"):
        print({"square": square, "arms": arms, "paths": paths}[name]())
