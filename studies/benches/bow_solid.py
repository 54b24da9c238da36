"""Three-dimensional elements of an edge of floating ice that a hull crushes and presses down and inwards. Not a
program.

Lengths in the thickness h, the top surface at z = 1, springs of the water below; stress in V/h². The hull has crushed
what lies within `depth` of its line, from the tip along the inward normal, down to an inclined facet; there it presses
with V down and H inwards, evenly by plan area. Quadratic prisms, two through the thickness.
"""
import math

import numpy as np
from matplotlib.path import Path
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree

NU = 0.3
LAYERS = 1
THINNEST = 0.15  # thickness of the ice that is left below the facet [h]
_a, _b = 0.445948490915965, 0.091576213509771
TRIANGLE = np.array([np.roll([1 - 2 * p, p, p], k) for p in (_a, _b) for k in range(3)])
TRIANGLE_WEIGHTS = np.array(3 * [0.223381589678011] + 3 * [0.109951743655322])
_g = math.sqrt(0.6)
LINE, LINE_WEIGHTS = np.array([-_g, 0, _g]), np.array([5, 8, 5]) / 9
ENDS = ((0, 1), (1, 2), (2, 0))


def triangle_shape(p):
    """The six quadratic functions and their slopes by the first two area coordinates."""
    a, b, c = p
    value = np.array([a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a])
    of = np.array([[4 * a - 1, 0, 0], [0, 4 * b - 1, 0], [0, 0, 4 * c - 1], [4 * b, 4 * a, 0],
                   [0, 4 * c, 4 * b], [4 * c, 0, 4 * a]])
    return value, np.stack([of[:, 0] - of[:, 2], of[:, 1] - of[:, 2]], 1)


def line_shape(t):
    return np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - 0.5, -2 * t, t + 0.5])


def prism_shape(p, t):
    """Eighteen functions and their slopes; node 6 k + i is the triangle's node i at level k."""
    f, df = triangle_shape(p)
    g, dg = line_shape(t)
    value = np.outer(g, f).ravel()
    slope = np.stack([np.outer(g, df[:, 0]).ravel(), np.outer(g, df[:, 1]).ravel(), np.outer(dg, f).ravel()], 1)
    return value, slope


def resampled(line, size):
    """A polyline's points at the spacing size(point)."""
    points = [line[0]]
    for a, b in zip(line[:-1], line[1:]):
        length, at = math.dist(a, b), 0
        while length > 0:
            step = size(a + (b - a) * (at / length))
            if length - at <= 1.5 * step:
                break
            at += step
            points.append(a + (b - a) * (at / length))
        points.append(b)
    return np.array(points)


def mesh(outline, normal, depth, reach, ratio, finest, coarsest, cracks=(), half_angle=None):
    """Triangles of the ice within `reach` of the outline's first vertex, which is the tip; an edge of the mesh along
    the facet's inner end (a stem's two flanks) and along each crack (its direction and length)."""
    size = lambda p: min(coarsest, max(finest, ratio * math.hypot(*p)))
    closed = np.vstack([outline, outline[:1]])
    edge = [outline[0]]
    for p in resampled(closed, size)[1:]:
        if math.hypot(*p) < 1.05 * reach and math.dist(p, edge[-1]) > 0.35 * size(p) and math.hypot(*p) > 0.35 * finest:
            edge.append(p)
    path = Path(outline)
    across = np.array([-normal[1], normal[0]])
    back = 0 if half_angle is None else 1 / math.tan(half_angle)
    steps = 0.7 * finest * np.arange(-math.ceil(9 * max(depth / finest, 1)), math.ceil(9 * max(depth / finest, 1)))
    lines = [depth * normal + np.outer(steps, across) / math.hypot(1, back) - np.outer(abs(steps), normal) * back /
             math.hypot(1, back)]
    for angle, length in cracks:
        along = np.array([math.cos(angle), math.sin(angle)])
        nearest = min((abs(angle - other) for other, _ in cracks if other != angle), default=1)
        at, points = finest * max(0.7, 0.42 / nearest), []
        while at < length:
            points.append(at * along)
            at += 0.7 * size(at * along)
        lines.append(np.array(points))
    rim = cKDTree(resampled(closed, lambda p: 0.3 * size(p)))
    fixed = np.array(edge)
    for line in lines:
        inside = line[path.contains_points(line)]
        if len(inside):
            inside = inside[rim.query(inside)[0] > 0.3 * finest]
        if len(inside):
            inside = inside[cKDTree(fixed).query(inside)[0] > 0.4 * np.array([size(p) for p in inside])]
            fixed = np.vstack([fixed, inside])
    rings, r = [], finest
    while r < reach:
        count = max(6, int(2 * math.pi * r / size((r, 0))))
        angle = 2 * math.pi * (np.arange(count) + 0.5 * (len(rings) % 2)) / count
        rings.append(np.c_[r * np.cos(angle), r * np.sin(angle)])
        r += 0.87 * size((r, 0))
    inner = np.vstack(rings)
    inner = inner[path.contains_points(inner)]
    sizes = np.clip(ratio * np.hypot(*inner.T), finest, coarsest)
    inner = inner[(rim.query(inner)[0] > 0.55 * sizes) & (cKDTree(fixed).query(inner)[0] > 0.6 * sizes)]
    points = np.vstack([fixed, inner])
    triangles = Delaunay(points).simplices
    corners = points[triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    doubled = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    triangles[doubled < 0] = triangles[doubled < 0][:, [0, 2, 1]]
    longest = np.max([np.hypot(*(corners[:, i] - corners[:, (i + 1) % 3]).T) for i in range(3)], 0)
    middle = corners.mean(1)
    keep = path.contains_points(middle) & (np.hypot(*middle.T) < reach) & (abs(doubled) > 5e-3 * longest ** 2)
    triangles = triangles[keep]
    used = np.unique(triangles)
    number = np.full(len(points), -1)
    number[used] = np.arange(len(used))
    return points[used], number[triangles]


class Solid:
    def __init__(self, outline, normal, depth, slope, l, ratio=0.2, finest=0.12, reach=4.0, cracks=(),
                 half_angle=None, is_held=True):
        """Outline in h, its first vertex the tip at (0, 0); the facet falls by 1/slope towards the tip (slope tan θ_s);
        l in h. A stem of that half-angle has crushed a groove whose two flanks it presses apart. The parts of
        cracks are held together at their top fibres or not at all."""
        normal = np.asarray(normal) / math.hypot(*normal)
        self.outline, self.normal, self.depth = np.asarray(outline), normal, depth
        self.across = np.array([-normal[1], normal[0]])
        self.half_angle, self.slope = half_angle, slope
        points, triangles = mesh(outline, normal, depth, reach * l, ratio, finest, 0.4 * l, cracks, half_angle)
        for crack in cracks:
            points, triangles = slit(points, triangles, crack)
        ends = np.sort(np.stack([triangles[:, list(e)] for e in ENDS], 1), 2)
        keys, inverse = np.unique(ends[..., 0].ravel() * len(points) + ends[..., 1].ravel(), return_inverse=True)
        middles = 0.5 * (points[keys // len(points)] + points[keys % len(points)])
        self.plan = np.vstack([points, middles])
        self.six = np.hstack([triangles, len(points) + inverse.reshape(-1, 3)])
        self.triangles, self.corner_count = triangles, len(points)
        levels, n = 2 * LAYERS + 1, len(self.plan)
        height = 1 - np.clip(self.passed(self.plan) / max(slope, 1e-6), 0, 1 - THINNEST)
        self.levels, self.count = levels, n
        self.nodes = np.concatenate([np.c_[self.plan, height * k / (levels - 1)] for k in range(levels)])
        self.prisms = np.vstack([np.hstack([self.six + n * (2 * layer + k) for k in range(3)])
                                 for layer in range(LAYERS)])
        # A crack closes above: the parts hang together at their top fibres.
        self.first = np.arange(n)
        for i, j in cKDTree(self.plan).query_pairs(1e-9) if is_held else ():
            self.first[max(i, j)] = min(self.first[max(i, j)], i, j)
        top = (levels - 1) * n
        self.prisms = np.where(self.prisms >= top, top + self.first[np.maximum(self.prisms - top, 0)], self.prisms)
        self.k = 1 / (12 * (1 - NU ** 2) * l ** 4)
        self.reach, self.l = reach * l, l

    def gradients(self, p, t):
        value, slope = prism_shape(p, t)
        jacobian = np.einsum("nd,mnk->mdk", slope, self.nodes[self.prisms])
        inverse, determinant = np.linalg.inv(jacobian), np.linalg.det(jacobian)
        return np.einsum("mkd,nd->mnk", inverse, slope), determinant

    def stiffness(self):
        lame, shear = NU / ((1 + NU) * (1 - 2 * NU)), 1 / (2 * (1 + NU))
        elastic = np.diag(3 * [2 * shear] + 3 * [shear])
        elastic[:3, :3] += lame
        m = len(self.prisms)
        blocks = np.zeros((m, 54, 54))
        for p, wp in zip(TRIANGLE, TRIANGLE_WEIGHTS):
            strains = np.zeros((m, len(LINE), 6, 18, 3))
            weights = []
            for k, t in enumerate(LINE):
                g, determinant = self.gradients(p, t)
                weights.append(0.5 * wp * LINE_WEIGHTS[k] * determinant)
                for a in range(3):
                    strains[:, k, a, :, a] = g[:, :, a]
                for row, (a, b) in enumerate(((1, 2), (2, 0), (0, 1)), 3):
                    strains[:, k, row, :, a], strains[:, k, row, :, b] = g[:, :, b], g[:, :, a]
            strains = strains.reshape(m, len(LINE), 6, 54)
            stresses = np.stack(weights, 1)[:, :, None, None] * (elastic @ strains)
            blocks += np.swapaxes(strains.reshape(m, -1, 54), 1, 2) @ stresses.reshape(m, -1, 54)
        dof = (3 * self.prisms[:, :, None] + np.arange(3)).reshape(m, 54)
        size = 3 * len(self.nodes)
        matrix = coo_matrix((blocks.ravel(), (np.repeat(dof, 54, 1).ravel(), np.tile(dof, (1, 54)).ravel())),
                            shape=(size, size))
        rows, columns, values = [], [], []
        area = self.areas()
        springs = sum(w * np.outer(triangle_shape(p)[0], triangle_shape(p)[0])
                      for p, w in zip(TRIANGLE, TRIANGLE_WEIGHTS))
        vertical = 3 * self.six + 2
        matrix += coo_matrix(((self.k * area[:, None, None] * springs).ravel(),
                              (np.repeat(vertical, 6, 1).ravel(), np.tile(vertical, (1, 6)).ravel())),
                             shape=(size, size))
        return matrix.tocsc()

    def apart(self):
        """Of a stem's flanks, what each node has of the push to either side, per V: half of it times H/V of a flank
        across the ship."""
        pressed, side = self.is_pressed(), np.zeros(self.count)
        left = self.plan[self.triangles].mean(1) @ self.across > 0
        mean = sum(w * triangle_shape(p)[0] for p, w in zip(TRIANGLE, TRIANGLE_WEIGHTS))
        for on, sign in ((pressed & left, 1), (pressed & ~left, -1)):
            of = np.bincount(self.six[on].ravel(), (self.areas()[on, None] * mean).ravel(), self.count)
            side += sign * 0.5 * of / (of.sum() * self.slope * math.tan(self.half_angle))
        return np.bincount(self.first, side, self.count)

    def areas(self):
        c = self.plan[self.triangles]
        a, b = c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]
        return abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2

    def passed(self, points):
        """How far the hull's waterline is past points of the plan, along the normal."""
        back = 0 if self.half_angle is None else abs(points @ self.across) / math.tan(self.half_angle)
        return self.depth - points @ self.normal - back

    def is_pressed(self):
        """The triangles of the facet at the tip."""
        middle = self.plan[self.triangles].mean(1)
        return (self.passed(middle) > 0) & (np.hypot(*middle.T) < max(4 * self.depth, 1.0))

    def solve(self, thrusts):
        """For each H/V: stress tensors at the vertices of the top and of the bottom surface, per V/h²."""
        top = (self.levels - 1) * self.count
        pressed, area = self.is_pressed(), self.areas()
        share = np.zeros(self.count)
        mean = sum(w * triangle_shape(p)[0] for p, w in zip(TRIANGLE, TRIANGLE_WEIGHTS))
        np.add.at(share, self.six[pressed].ravel(), (area[pressed, None] * mean).ravel())
        share /= share.sum()
        share = np.bincount(self.first, share, self.count)
        self.centroid = float(share @ (self.plan @ self.normal))
        size = 3 * len(self.nodes)
        load = np.zeros((size, 2))
        load[3 * top + 2::3, 0][:self.count] = -share
        apart = 0 if self.half_angle is None else self.apart()
        for a in range(2):
            load[3 * top + a::3, 1][:self.count] = share * self.normal[a]
            load[3 * top + a::3, 0][:self.count] += apart * self.across[a]
        free = np.zeros(size, bool)
        free[(3 * np.unique(self.prisms)[:, None] + np.arange(3)).ravel()] = True
        rim = np.flatnonzero(np.hypot(*self.plan.T) > 0.93 * self.reach)
        for level in range(self.levels):
            free[3 * (rim + level * self.count)] = free[3 * (rim + level * self.count) + 1] = False
        at = np.flatnonzero(free)
        k = self.stiffness()[at][:, at]
        self.free = at
        self.factor = splu(k, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        x = np.zeros((size, 2))
        for i in range(2):
            x[at, i] = self.factor.solve(load[at, i])
        results = []
        for thrust in thrusts:
            u = (x[:, 0] + thrust * x[:, 1]).reshape(-1, 3)
            results.append((self.surface(u, LAYERS - 1, 1.0), self.surface(u, 0, -1.0), u))
        return results

    def surface(self, u, layer, t):
        m = len(self.triangles)
        prisms = slice(layer * m, (layer + 1) * m)
        total, weight, area = np.zeros((self.corner_count, 3, 3)), np.zeros(self.corner_count), self.areas()
        lame, shear = NU / ((1 + NU) * (1 - 2 * NU)), 1 / (2 * (1 + NU))
        for corner in range(3):
            g, _ = self.gradients(np.eye(3)[corner], t)
            grad = np.einsum("mni,mnj->mij", u[self.prisms[prisms]], g[prisms])
            strain = 0.5 * (grad + np.swapaxes(grad, 1, 2))
            stress = 2 * shear * strain + lame * np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(3)
            np.add.at(total, self.triangles[:, corner], area[:, None, None] * stress)
            np.add.at(weight, self.triangles[:, corner], area)
        return total / np.maximum(weight, 1e-30)[:, None, None]


def slit(points, triangles, crack):
    """Parts the mesh along the crack: a second vertex for each on it but its end, for the triangles on its left, up to
    the opposite of it or to an earlier crack."""
    along = np.array([math.cos(crack[0]), math.sin(crack[0])])
    across = np.array([-along[1], along[0]])
    s, off = points @ along, points @ across
    on = np.flatnonzero((abs(off) < 1e-9) & (s > -1e-9))
    on = on[np.argsort(s[on])][:-1]
    twin = np.arange(len(points))
    twin[on] = len(points) + np.arange(len(on))
    left = points[triangles].mean(1) @ across > 0
    triangles = triangles.copy()
    triangles[left] = twin[triangles[left]]
    return np.vstack([points, points[on]]), triangles


GAP = 1.0  # [h] from the facet: nearer, the load's own introduction is not the stress of a section


def peak_along(r, stress, least, most):
    """The greatest stress by distance, and where: of the greatest in each of rings, the maximum of a quartic in ln r
    through those within 15 % of the greatest and around it (a flat maximum: a mesh's own rings would decide its
    place)."""
    edges = np.exp(np.linspace(math.log(least), math.log(most), 26))
    ring = np.digitize(r, edges)
    x, y = [], []
    for i in range(1, len(edges)):
        if (ring == i).any():
            best = np.flatnonzero(ring == i)[np.argmax(stress[ring == i])]
            x.append(math.log(r[best]))
            y.append(stress[best])
    x, y = np.array(x), np.array(y)
    top = int(np.argmax(y))
    near = abs(x - x[top]) < 0.8
    if near.sum() < 7:
        return y[top], math.exp(x[top])
    fit = np.polynomial.Polynomial.fit(x[near], y[near], 4)
    fine = np.linspace(x[near][0], x[near][-1], 400)
    return y[top], math.exp(fine[np.argmax(fit(fine))])


WEIBULL = 6  # Weibull modulus of ice whose strength scatters by 0.2


def sampled(solid, tensors, points):
    """Of tensors at the vertices, linear within the triangles; where a point lies in none, the nearest one's mean."""
    plan = solid.plan[:solid.corner_count]
    _, near = cKDTree(plan[solid.triangles].mean(1)).query(points, k=12)
    result = tensors[solid.triangles[near[:, 0]]].mean(1)
    missing = np.ones(len(points), bool)
    for k in range(12):
        triangles = solid.triangles[near[:, k]]
        a, b, c = np.moveaxis(plan[triangles], 1, 0)
        cross = lambda u, v: u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        share = np.stack([cross(b - points, c - points), cross(c - points, a - points), cross(a - points, b - points)],
                         1) / cross(b - a, c - a)[:, None]
        found = missing & (share.min(1) > -0.02)
        result[found] = np.einsum("pi,pijk->pjk", share[found], tensors[triangles[found]])
        missing &= ~found
    return result


def expected_place(solid, outline, top):
    """exp of the mean of ln r by the greatest stress on circles about the tip to the power WEIBULL: where the ice
    breaks on an average if the strength of each ring scatters for itself."""
    radii = np.exp(np.arange(math.log(solid.depth + GAP) + 0.03, math.log(1.041 * solid.l), 0.06))
    most = []
    for r in radii:
        forward, backward = chord(outline, 1, r), chord(outline, -1, r)
        start = math.atan2(forward[1], forward[0])
        angle = start + (math.atan2(backward[1], backward[0]) - start) % (2 * math.pi) * np.linspace(0.01, 0.99, 17)
        points = r * np.c_[np.cos(angle), np.sin(angle)]
        most.append(np.linalg.eigvalsh(sampled(solid, top, points)[:, :2, :2])[:, 1].max())
    weight = np.maximum(most, 0) ** WEIBULL
    return math.exp(weight @ np.log(radii) / weight.sum())


def next_crack(solid, bottom, directions):
    """V at which the bottom fibre is pulled apart across one of these directions, up to l from the tip."""
    radii, most = np.exp(np.arange(math.log(solid.depth + 0.5), math.log(solid.l), 0.1)), 0
    for angle in directions:
        across = np.array([-math.sin(angle), math.cos(angle)])
        there = sampled(solid, bottom, np.outer(radii, (across[1], -across[0])))[:, :2, :2]
        most = max(most, np.einsum("i,pij,j->p", across, there, across).max())
    return 1 / max(most, 1e-9)


def chord(outline, step, length):
    """Where the outline leaves a circle about its first vertex."""
    a, k = outline[0], 0
    while True:
        k += step
        b = outline[k % len(outline)]
        if math.hypot(*b) > length:
            d, f = b - a, a
            return a + (-(f @ d) + math.sqrt(max(0, (f @ d) ** 2 - (d @ d) * (f @ f - length ** 2)))) / (d @ d) * d
        a = b


def breaking(solid, thrusts, directions=()):
    """For each H/V: V_b [σ_f h²], by the top's greatest principal stress in its plane (of the rest, which is none on
    a free surface, the elements have only errors) farther than GAP from the facet, or where the bottom cracks along
    one of the directions; the distance from the tip [h] of that stress, the expected one, and V by the bottom's
    greatest tension."""
    results, p = [], solid.plan[:solid.corner_count]
    r, s = np.hypot(*p.T), p @ solid.normal
    for top, bottom, u in solid.solve(thrusts):
        most, below = np.linalg.eigvalsh(top[:, :2, :2])[:, 1], np.linalg.eigvalsh(bottom)[:, 2]
        ahead = (s > solid.depth + 0.03) & (r > solid.depth + GAP) & (r < 2 * solid.l)
        stress, place = peak_along(r[ahead], most[ahead], solid.depth + GAP, 2 * solid.l)
        held = next_crack(solid, bottom, directions) if directions else math.inf
        results.append({"V": min(1 / stress, held), "R": place, "expected": expected_place(solid, solid.outline, top),
                        "bottom": 1 / below[r > solid.depth + 0.3].max(),
                        "w": -u[(solid.levels - 1) * solid.count:][np.argmin(r), 2]})
    return results


def wedge(degrees, reach):
    angle = np.linspace(-0.5, 0.5, 80) * math.radians(degrees)
    return np.vstack([[0, 0], np.c_[reach * np.cos(angle), reach * np.sin(angle)]])
