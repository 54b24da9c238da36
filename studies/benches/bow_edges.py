"""Where the edges of a run break: three-dimensional elements of the true outlines beside the law of their sections;
tables of docs/theory/bow.md. Not a program.

Runs of level ice at constant speed along x. Of each run cusps drawn evenly from its last three quarters; the hull has
crushed as deep as the run states. The law is that of fracture/bending/edge_sections.hpp. Needs numpy, scipy and
matplotlib.
"""
import json
import math
import os
import pathlib
import sys

import numpy as np

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(pathlib.Path(__file__).resolve().parent.parent)]
import bow_solid  # noqa: E402
from bow_plate import centre_of, outer_rings  # noqa: E402
from bow_solid import chord  # noqa: E402
from tables import Table  # noqa: E402

NU = 0.3
RHO_G = 9810


def narrow_wedge(reach=6.0, count=3000):
    """Moment over that of a bare lever, of a narrow wedge on water, its tip loaded by a force 1 and by a moment 1; by
    r/l.

    (ρ w'')'' + ρ w = 0, by finite differences of w and M = ρ w''."""
    from scipy.sparse import lil_matrix
    from scipy.sparse.linalg import splu
    r = np.linspace(0, reach, count + 1)
    d = r[1] - r[0]
    n = count + 1
    a = lil_matrix((2 * n, 2 * n))  # w, M
    b = np.zeros((2 * n, 2))
    for i in range(1, count):
        for j, c in ((i - 1, 1), (i, -2), (i + 1, 1)):
            a[i, j] = c * r[i] / d ** 2
            a[n + i, n + j] = c / d ** 2
        a[i, n + i] = -1
        a[n + i, i] = r[i]
    # At the tip M is given: 0, or 1. M'(0) = 1 or 0, with M'' = -ρ w = 0 there.
    a[n, n] = 1
    b[n] = 0, 1
    a[0, n + 1], a[0, n] = 1 / d, -1 / d
    b[0] = 1, 0
    a[count, count], a[2 * n - 1, 2 * n - 1] = 1, 1
    x = splu(a.tocsc()).solve(b)
    return r, x[n:, 0], x[n:, 1]


RADII, LEVER, HOLD = narrow_wedge()


def stress_of_section(r, width, l, offset, thrust):
    """σ h²/V of a section at r of that width; lengths in h. `offset` of the load from the tip with the thrust's
    lever."""
    rho = r / l
    return (6 * (l * np.interp(rho, RADII, LEVER) - offset * np.interp(rho, RADII, HOLD)) - thrust) / width


def edges_of(run, count, seed=1, is_stem=False):
    """Of bends of a run at the flanks, or at the stem: the outline from the tip, in thicknesses, and the hull's
    push."""
    with open(os.path.join(run, "scene.json"), encoding="utf-8") as file:
        scene = json.load(file)
    ice, ship = scene["ice"], scene["ships"][0]
    h = ice["thickness_m"]
    l = (ice.get("youngs_modulus_Pa", 5.4e9) * h ** 3 / (12 * (1 - NU ** 2) * RHO_G)) ** 0.25
    stem, friction = math.radians(ship["hull"]["stem_angle_deg"]), ice.get("friction", 0.2)
    rings, made = outer_rings(run)
    with open(os.path.join(run, "events.ndjson"), encoding="utf-8") as file:
        bends = [e for e in map(json.loads, file) if e["kind"] == "bend" and len(e["children"]) >= 1
                 and (e["normal"][0] > 0.9) == is_stem]
    found = []
    for e in np.random.default_rng(seed).permutation(bends[len(bends) // 4:]):
        if len(found) == count:
            break
        new = [p for child in e["children"] if child in made for p in made[child]]
        if len(new) < 4:
            continue
        tip, error = centre_of(new, e["cusp_radius_m"])
        if error > 0.02 * e["cusp_radius_m"]:
            continue
        ring = (rings[e["floe"]] - tip) / h
        ahead = np.roll(ring, -1, 0) - ring
        share = np.clip(-(ring * ahead).sum(1) / np.maximum((ahead ** 2).sum(1), 1e-12), 0, 1)
        nearest = ring + share[:, None] * ahead
        k = int(np.argmin(np.hypot(*nearest.T)))
        if math.hypot(*nearest[k]) > 0.05:
            continue
        if math.hypot(*ring[k]) < 0.06:
            ring = np.roll(ring, -k, 0)
        elif math.hypot(*ring[(k + 1) % len(ring)]) < 0.06:
            ring = np.roll(ring, -k - 1, 0)
        else:
            ring = np.vstack([[0, 0], np.roll(ring, -k - 1, 0)])
        ring[0] = 0
        normal = np.array(e["normal"])
        slope = normal[0] / math.tan(stem)
        angle = math.atan(slope)
        down = normal[0] * math.sin(angle)
        down /= math.hypot(down, normal[1])
        thrust = (math.cos(angle) + friction * math.sin(angle)) / (math.sin(angle) - friction * math.cos(angle) * down)
        found.append({"run": os.path.basename(os.path.normpath(run)), "ring": ring.tolist(),
                      "normal": normal.tolist(), "slope": slope,
                      "thrust": thrust, "l": l / h, "h": h, "depth": e["penetration_m"] / h,
                      "R run": e["cusp_radius_m"] / h,
                      "V run": e["criterion"]["bending_capacity_N"] / (ice["flexural_strength_Pa"] * h ** 2)})
    return found


def openings(edge, radii):
    """Angle of the ice on circles about the tip, between the first exits of the outline [rad]."""
    ring = np.array(edge["ring"])
    result = []
    for r in radii:
        forward, backward = chord(ring, 1, r), chord(ring, -1, r)
        result.append((math.atan2(backward[1], backward[0]) - math.atan2(forward[1], forward[0])) % (2 * math.pi))
    return np.array(result)


def by_elements(edge, ratio, finest):
    """V_b, R of the whole edge and, where the bottom cracks first, of the edge with a crack along its bisector, which
    bears no more where its halves crack first."""
    thrusts = (edge["thrust"], 0.0)
    arguments = (np.array(edge["ring"]), edge["normal"], edge["depth"], edge["slope"], edge["l"], ratio, finest)
    whole, bare = bow_solid.breaking(bow_solid.Solid(*arguments), thrusts)
    result = {"whole": whole, "bare": bare}
    if whole["bottom"] < whole["V"]:
        r = 0.3 * edge["l"]
        forward = chord(np.array(edge["ring"]), 1, r)
        start, opening = math.atan2(forward[1], forward[0]), openings(edge, [r])[0]
        solid = bow_solid.Solid(*arguments, cracks=[(start + 0.5 * opening, 2 * edge["l"])])
        result["cracked"] = bow_solid.breaking(solid, thrusts[:1], (start + 0.25 * opening, start + 0.75 * opening))[0]
    return result


def whole_edge_factor(opening):
    return 1 + 0.18 * np.maximum(0, opening - math.radians(45))


RADII_OF_LAW = 0.08 * 1.25 ** np.arange(12)  # [l]


def sides(edge, radii):
    """On circles about the tip the angles from the hull's normal to the first exits of the outline, of both sides
    [rad]."""
    ring, (nx, ny) = np.array(edge["ring"]), edge["normal"]
    ends = np.array([[chord(ring, step, r) for r in radii] for step in (1, -1)])
    return abs(np.arctan2(nx * ends[..., 1] - ny * ends[..., 0], ends @ (nx, ny)))


def rim_of_force(front, back, l):
    """What the rims of cracked sections have of the mean bending stress under V."""
    middle = 0.5 * (front - back)
    turn = np.minimum(abs(np.r_[middle[2:], middle[-1], middle[-1]] - middle), 1)
    return 0.87 + 0.18 * (np.clip(l, 10, 21.2) / 15 - 1) - 0.04 * (np.minimum(front + back, math.pi) - 2) + 0.19 * turn


def by_sections(edge, share=None, load_place=2 / 3):
    """V_b, R and the expected R of the law; `share` of the crack as the outline has it, or as given; the load's place
    between the first touch and the far end of the facet."""
    l, thrust = edge["l"], edge["thrust"]
    r = RADII_OF_LAW * l
    front, back = sides(edge, r)
    opening = front + back
    lever, hold = (np.interp(r / l, RADII, column) for column in (LEVER, HOLD))
    distance, up = load_place * edge["depth"], max(0, 0.5 - edge["depth"] / (3 * edge["slope"]))
    moment, couple = l * lever - distance * hold, thrust * up * hold
    widest = opening[r <= 0.5 * l].max()
    if share is None:
        share = np.clip((math.degrees(widest) - 90) / 15, 0, 1)
    whole = np.maximum(0, 6 * (moment - couple) - thrust) / (opening * r) / whole_edge_factor(opening)
    counts = np.clip(np.log(r * 1.25 ** 0.5 / (edge["depth"] + 1)) / math.log(1.25), 0, 1)
    rims = (np.maximum(0, 6 * (rim_of_force(front, back, l) * moment - 0.31 * couple) - 0.93 * thrust)
            / (opening * r) * counts ** (1 / 6))
    next_cracks = 0.585 * (1 + max(0, widest - math.pi))
    stress = share * rims + (1 - share) * whole
    weight = rims ** 6
    place = share * (weight @ np.arange(12)) / max(weight.sum(), 1e-30) + (1 - share) * np.argmax(whole)
    return 1 / max(stress.max(), share / next_cracks), r[np.argmax(stress)], r[0] * 1.25 ** place


def different(edges):
    """Without edges that repeat: a settled bow breaks the same cusp again and again."""
    kept = []
    for edge in edges:
        shape = openings(edge, np.geomspace(0.08, 0.931, 10) * edge["l"])
        if not any(k["run"] == edge["run"] and np.abs(k["shape"] - shape).max() < 0.03 for k in kept):
            kept.append(edge | {"shape": shape})
    return kept


def three(values):
    return ", ".join(f"{v:.2f}" for v in np.percentile(values, [10, 50, 90]))


def solved(study, folder, cusps=12, ratio=0.16, finest=0.17):
    """Edges of the runs of a study, with what elements give; kept in a file of that folder."""
    path = pathlib.Path(folder) / "bow-edges-solved.json"
    if not path.exists():
        edges = []
        for case in range(len(study.table["case"])):
            for edge in edges_of(study.run(case).folder, cusps):
                edge["run"] = case
                try:
                    edge["elements"] = by_elements(edge, ratio, finest)
                except (RuntimeError, np.linalg.LinAlgError, ValueError) as error:  # a mesh of a needle
                    print("an edge is left out:", error, file=sys.stderr, flush=True)
                    continue
                edges.append(edge)
            print(f"{len(edges)} edges", file=sys.stderr, flush=True)
        path.write_text(json.dumps(edges), encoding="utf-8")
    return different(json.loads(path.read_text(encoding="utf-8")))


def edges(study, folder):
    """What elements give for the edges, beside the run."""
    found = solved(study, folder)
    of = lambda key: three([e["elements"].get("cracked", e["elements"]["whole"])[key] for e in found])
    return Table(["edges", "elements, cracked: V_b [σ_f h²] 10, 50, 90 %", "R/h, largest stress", "R̄/h", "run: V_b",
                  "R/h"],
                 [[str(len(found)), of("V"), of("R"), of("expected"), three([e["V run"] for e in found]),
                   three([e["R run"] for e in found])]], within=0.1)


def law(study, folder):
    """The law over the elements, and the 90th percentile of its error."""
    found, cells = solved(study, folder), []
    by_law = np.array([by_sections(e) for e in found])
    for values, key in zip(by_law.T, ("V", "R", "expected")):
        ratio = values / [e["elements"].get("cracked", e["elements"]["whole"])[key] for e in found]
        cells += [three(ratio), f"{100 * np.percentile(abs(ratio - 1), 90):.0f} %"]
    return Table(["edges", "cracked: V_b", "error", "R, largest stress", "error", "R̄", "error"],
                 [[str(len(found)), *cells]], within=0.1)


def wedges():
    depth, slope, l, rows = 0.36, math.tan(math.radians(38.2)), 15.0, []
    for degrees in (40, 90, 150, 180):
        solids = [bow_solid.Solid(bow_solid.wedge(degrees, 6 * l), (1, 0), depth, slope, l, 0.18, 0.2, cracks=cracks)
                  for cracks in ((), [(0.0, 2 * l)])]
        thrusts = (0.0, 1.7)
        whole, cracked = (bow_solid.breaking(solid, thrusts) for solid in solids)
        r = np.linspace(0.05, 1.5, 300) * l
        for thrust, w, c in zip(thrusts, whole, cracked):
            offset = 2 / 3 * depth + thrust * (0.5 - depth / (3 * slope))
            stress = stress_of_section(r, r * math.radians(degrees), l, offset, thrust)
            rows.append([f"{degrees}°", f"{thrust:g}", f"{w['V']:.3f} at {w['R'] / l:.2f}",
                         f"{c['V']:.3f} at {c['R'] / l:.2f}",
                         f"{1 / stress.max():.3f} at {r[stress.argmax()] / l:.2f}", f"{w['bottom']:.3f}"])
    return Table(["2α", "H/V", "whole: V_b [σ_f h²] at R/l", "cracked", "sections alone", "bottom cracks at"], rows,
                 within=0.01)
