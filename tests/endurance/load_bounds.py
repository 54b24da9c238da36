#!/usr/bin/env python3
"""States whether the loads of a run are such as ice can give.

Checked are, of every record of forces.csv and every hull:
- a mean is at most the largest single step of its interval, component by component;
- by law crush the largest single step is at most what all the ice along the hull bears as it crushes;
of every contact and peak of contacts.csv (law crush): the force along its normal is at most
sigma_c h w (1 + mu tan theta), with the ice of the floe that presses, and for the width w the smaller of the hull's and
the floe's extent across that normal; and of summary.json: the audit is closed and contacts gave no energy.

Usage: load_bounds.py RUN ...     exit code 1 where a run is faulty
"""

import bisect
import csv
import json
import math
import pathlib
import sys

ROUNDING = 1e-6           # tolerance between numbers of one file, which differ by rounding alone [-]
MARGIN = 1.02             # factor on the strength of the ice: positions in files are wrong by 1 mm and 1e-5 rad [-]
MISSED = 2                # factor for a contact's whole step, which includes the load missed in the step before [-]
ENERGY_SHARE = 1e-6       # share of the turnover, as for the audit [-]
PUSHED_APART_SHARE = 3e-3  # share of the turnover that steps may add when they push bodies apart, law crush [-]
UNSOLVED_SHARE = 1e-3      # share of the turnover that unsolved steps may add, law impulse [-]
COMPONENTS = ("surge", "sway", "yaw")
DIRECTIONS = 16           # number of directions in which a floe's extent is measured


def extent(points_m, angle):
    """Of points along a direction [rad]."""
    along = [x * math.cos(angle) + y * math.sin(angle) for x, y in points_m]
    return max(along) - min(along)


def one_sided(points_m, angle):
    """How much of an outline faces along one direction [rad], also where it is concave."""
    along = [x * math.cos(angle) + y * math.sin(angle) for x, y in points_m]
    return sum(abs(a - b) for a, b in zip(along, along[1:] + along[:1])) / 2


def diameter(points_m):
    """At most half a per cent above the true one."""
    widths = [extent(points_m, math.pi * k / DIRECTIONS) for k in range(DIRECTIONS)]
    return max(widths) / math.cos(math.pi / DIRECTIONS / 2)


class Hull:
    """A ship, structure or wall: its outline in its own frame, and how far its sides lean."""

    def __init__(self, name, outline_m, tangents, heading_deg=0.0, is_even=True):
        self.name = name
        self.outline_m = outline_m
        self.steepest_tangent = max(tangents)  # tan theta of the side that leans most
        self.heading = math.radians(heading_deg)
        self.is_even = is_even  # the lean does not follow the normal as a bow's does

    def tangent_at(self, normal):
        """tan theta where the outward normal has an angle in the hull's frame [rad]."""
        return self.steepest_tangent if self.is_even else self.steepest_tangent * max(0.0, math.cos(normal))


def wedge_outline(hull):
    length, beam = hull["length_m"], hull["beam_m"]
    bow = min(length, beam / 2 / math.tan(math.radians(hull["entrance_angle_deg"])))
    return [(length / 2, 0), (length / 2 - bow, beam / 2), (-length / 2, beam / 2), (-length / 2, -beam / 2),
            (length / 2 - bow, -beam / 2)]


def circle(radius_m):
    """A polygon around a circle."""
    around = radius_m / math.cos(math.pi / 32)
    return [(around * math.cos(math.pi * k / 16), around * math.sin(math.pi * k / 16)) for k in range(32)]


def ship_hull(ship):
    hull = ship["hull"]
    angles = hull.get("angles_from_vertical_deg") or []
    outline = hull.get("waterline_m") or wedge_outline(hull)
    if angles:
        return Hull(ship["name"], outline, [math.tan(math.radians(angle)) for angle in angles])
    lean = max(0.0, 1 / math.tan(math.radians(hull["stem_angle_deg"])))
    return Hull(ship["name"], outline, [lean], is_even=False)


def structure_hull(structure):
    outline = structure.get("waterline_m") or circle(structure["radius_m"])
    tangent = math.tan(math.radians(structure.get("wall_angle_deg", 0)))
    return Hull(structure["name"], outline, [tangent], structure.get("heading_deg", 0))


def wall_hull(wall):
    """Its x points along its normal into the ice, its face runs along y."""
    (ax, ay), (bx, by) = wall["from_m"], wall["to_m"]
    half, depth = math.hypot(bx - ax, by - ay) / 2, wall.get("depth_m", 10)
    normal_deg = math.degrees(math.atan2(bx - ax, ay - by))
    return Hull(wall["name"], [(0, -half), (0, half), (-depth, half), (-depth, -half)], [0.0], normal_deg)


def hulls_of(scene):
    """By name; of a filled scene, which a run folder has."""
    made = [ship_hull(ship) for ship in scene["ships"]]
    made += [structure_hull(structure) for structure in scene["structures"]]
    made += [wall_hull(wall) for wall in scene["walls"]]
    return {hull.name: hull for hull in made}


def stretch(part, parent):
    """The vertices of a part of a ring (docs/run-folder.md, floes.ndjson)."""
    if isinstance(part[0], list):
        return part
    ring, first, count = part
    return [parent[ring][(first + k) % len(parent[ring])] for k in range(count)]


def floes_of(run, ice):
    """Of each floe there ever was: (thickness [m], compressive strength [Pa], diameter [m])."""
    rings, floes = {None: []}, {}
    with open(run / "floes.ndjson", encoding="utf-8") as lines:
        for line in lines:
            floe = json.loads(line)
            if "ring_parts_m" in floe:
                parent = rings[floe["parent_id"]]
                own = [[point for part in ring for point in stretch(part, parent)]
                       for ring in (floe["ring_parts_m"], *floe["hole_parts_m"])]
            else:
                own = [floe["ring_m"], *floe["holes_m"]]
            rings[floe["floe_id"]] = own
            floes[floe["floe_id"]] = (floe.get("thickness_m", ice["thickness_m"]),
                                      floe.get("compressive_strength_Pa", ice["compressive_strength_Pa"]),
                                      diameter(own[0]))
    return floes


class Verdict:
    """The faults of a run, and how much was checked: a verdict about nothing is none."""

    def __init__(self):
        self.faults = []   # (kind, text)
        self.checked = {"records": 0, "means": 0, "steps": 0, "contacts": 0, "peaks": 0, "floe contacts": 0}
        self.loaded = {"means": 0, "steps": 0}  # numbers of these that are not zero
        self.largest = {}  # share of the allowed value, by kind

    def add(self, kind, value, allowed, text):
        """Compares a value with what is allowed; tells of the first fault of its kind, and counts the others."""
        share = value / allowed if allowed > 0 else (math.inf if value > 0 else 0)
        self.largest[kind] = max(share, self.largest.get(kind, 0))
        if not value <= allowed:
            self.faults.append((kind, text))

    def kinds(self):
        return sorted({kind for kind, _ in self.faults})

    def lines(self):
        """One for each kind: its first fault and how many there are."""
        for kind in self.kinds():
            texts = [text for of_kind, text in self.faults if of_kind == kind]
            yield f"{kind}: {texts[0]}" + (f"; and {len(texts) - 1} more" if len(texts) > 1 else "")


def check_means(row, arm_m, verdict):
    """A mean over an interval is at most the largest step in it; moments also differ by rounding of their forces."""
    for source in ("", "_from_ships"):
        force = math.hypot(float(row[f"surge{source}_max_N"]), float(row[f"sway{source}_max_N"]))
        for component in COMPONENTS:
            unit = "Nm" if component == "yaw" else "N"
            mean = abs(float(row[f"{component}{source}_{unit}"]))
            step = abs(float(row[f"{component}{source}_max_{unit}"]))
            verdict.checked["means"] += 1
            verdict.loaded["means"] += mean > 0
            rounding = ROUNDING * (step + 1e-6 * force * (arm_m if component == "yaw" else 1) + 1)
            verdict.add("mean over step", mean, step + rounding,
                        f"{component}{source}_{unit} of {row['ship']} at {row['t_s']} s: the mean {mean:.4g} is above "
                        f"the largest step {step:.4g}")


def arm_of(hull):
    """The greatest distance of its outline from its origin [m]."""
    return max(math.hypot(x, y) for x, y in hull.outline_m)


def most_on_hull(hull, strongest, friction):
    """What ice of a strength sigma_c h [N/m] gives a hull at most in a step: surge, sway [N] and yaw [N m].

    Along an axis: the crushing of all that faces it, and friction on all that lies along it, on both sides.
    """
    tangent = hull.steepest_tangent
    across, along = one_sided(hull.outline_m, math.pi / 2), one_sided(hull.outline_m, 0)
    normal, slip = strongest * (1 + friction * tangent), strongest * friction * math.hypot(1, tangent)
    surge, sway = normal * across + slip * 2 * along, normal * along + slip * 2 * across
    return surge, sway, 2 * (normal + slip) * (across + along) * arm_of(hull)


def check_steps(row, most, verdict):
    for component, bound in zip(COMPONENTS, most):
        unit = "Nm" if component == "yaw" else "N"
        step = abs(float(row[f"{component}_max_{unit}"]))
        verdict.checked["steps"] += 1
        verdict.loaded["steps"] += step > 0
        verdict.add("step over ice", step, MARGIN * bound,
                    f"{component}_max_{unit} of {row['ship']} at {row['t_s']} s: {step:.4g}, all ice along it bears "
                    f"{bound:.4g}")


def check_forces(run, hulls, floes, scene, verdict):
    """Checks forces.csv; returns of each hull the headings [rad] by time."""
    strongest = max((h * strength for h, strength, _ in floes.values()), default=0)
    most = {name: most_on_hull(hull, strongest, scene["ice"]["friction"]) for name, hull in hulls.items()}
    headings = {name: ([], []) for name in hulls}
    with open(run / "forces.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            verdict.checked["records"] += 1
            check_means(row, arm_of(hulls[row["ship"]]), verdict)
            if scene["contact"]["law"] == "crush":
                check_steps(row, most[row["ship"]], verdict)
            times, angles = headings[row["ship"]]
            times.append(float(row["t_s"]))
            angles.append(math.radians(float(row["heading_deg"])))
    return headings


def heading_at(headings, time):
    times, angles = headings
    return angles[min(bisect.bisect_left(times, time), len(angles) - 1)] if times else 0.0


def normals_of(row, heading):
    """The angles in the hull's frame that the outward normal of a contact may have, by its force and friction [rad]."""
    force = math.hypot(float(row["fx_N"]), float(row["fy_N"]))
    along = normal_force(row)
    aside = math.acos(min(1.0, along / force)) if force > 0 else 0.0
    outward = math.atan2(-float(row["fy_N"]), -float(row["fx_N"])) - heading
    return outward - aside, outward + aside


def normal_force(row):
    return float(row["pressure_Pa"]) * float(row["width_m"]) * float(row["height_m"])


def most_of_contact(row, hull, floe, heading, friction):
    """What the ice of a contact bears along its normal [N]."""
    thickness, strength, floe_width = floe
    bound = 0.0
    for normal in normals_of(row, heading):
        width = min(one_sided(hull.outline_m, normal + math.pi / 2), floe_width)
        bound = max(bound, strength * thickness * width * (1 + friction * hull.tangent_at(normal)))
    return bound


def check_contact_of_hull(row, hulls, headings, floes, friction, verdict):
    is_peak = row["ended_by"] != ""
    verdict.checked["peaks" if is_peak else "contacts"] += 1
    heading = heading_at(headings[row["ship"]], float(row["t_s"]))
    floe = floes[int(row["by_floe_id"])]
    most = most_of_contact(row, hulls[row["ship"]], floe, heading, friction)
    force = normal_force(row)
    kind = "peak over ice" if is_peak else "contact over ice"
    verdict.add(kind, force, most * MARGIN * (1 if is_peak else MISSED),
                f"floe {row['by_floe_id']} presses {row['ship']} at {row['t_s']} s with {force:.4g} N, its ice bears "
                f"{most:.4g} N")


def check_contact_of_floes(row, floes, verdict):
    verdict.checked["floe contacts"] += 1
    first, second = floes[int(row["floe_id"])], floes[int(row["by_floe_id"])]
    most = min(first[0], second[0]) * min(first[1], second[1]) * min(first[2], second[2])
    force = normal_force(row)
    verdict.add("floe contact over ice", force, most * MARGIN * MISSED,
                f"floes {row['floe_id']} and {row['by_floe_id']} press each other at {row['t_s']} s with {force:.4g} N,"
                f" their ice bears {most:.4g} N")


def check_contacts(run, hulls, headings, floes, scene, verdict):
    path = run / "contacts.csv"
    if scene["contact"]["law"] != "crush" or not path.exists():
        return
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            if row["by_floe_id"] == "" or (row["ship"] == "" and row["floe_id"] == ""):
                continue  # steel on steel
            if row["ship"]:
                check_contact_of_hull(row, hulls, headings, floes, scene["ice"]["friction"], verdict)
            else:
                check_contact_of_floes(row, floes, verdict)


def check_accounts(summary, law, verdict):
    """The audit is closed, and no energy comes from contacts: altogether, and in no step. By law impulse a step gives
    energy where its contacts give more than they and restitution have stored (`energy_created_J`)."""
    if summary["audit_closed"] is not True:
        verdict.faults.append(("audit", f"not closed: energy is off by {summary['energy']['imbalance_J']:.3g} J of "
                                        f"{summary['energy']['turnover_J']:.3g} J"))
    energy = summary["energy"]
    allowed = ENERGY_SHARE * energy["turnover_J"] + 1e-9
    created = summary["counts"]["energy_created_J"]
    # Law crush pushes unpaid overlap apart, which adds some energy (docs/theory/contact.md). With law impulse, steps
    # that are not solved to the end add energy as well.
    share = PUSHED_APART_SHARE if law == "crush" else UNSOLVED_SHARE
    verdict.add("energy gained", created, share * energy["turnover_J"] + 1e-9,
                f"steps whose contacts gave more than they took: {created:.3g} J of {energy['turnover_J']:.3g} J")
    taken = energy["friction_J"] + energy["crushing_J"] + energy["restitution_J"]
    verdict.add("energy gained", -taken, allowed, f"contacts gave {-taken:.3g} J altogether")


def check_run(run):
    """The verdict about a finished run."""
    run = pathlib.Path(run)
    scene = json.loads((run / "scene.json").read_text(encoding="utf-8"))
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    verdict = Verdict()
    check_accounts(summary, scene["contact"]["law"], verdict)
    hulls = hulls_of(scene)
    floes = floes_of(run, scene["ice"])
    headings = check_forces(run, hulls, floes, scene, verdict)
    check_contacts(run, hulls, headings, floes, scene, verdict)
    if hulls and verdict.checked["records"] == 0:
        verdict.faults.append(("nothing checked", "forces.csv has no record of any hull"))
    return verdict


def main():
    is_faulty = False
    for run in sys.argv[1:]:
        verdict = check_run(run)
        for line in verdict.lines():
            print(f"{run}: {line}")
        counts = ", ".join(f"{count} {what}" for what, count in verdict.checked.items())
        shares = ", ".join(f"{kind} {share:.3g}" for kind, share in verdict.largest.items())
        print(f"{run}: {len(verdict.faults)} faults; checked {counts}; largest share of what is allowed: {shares}")
        is_faulty = is_faulty or bool(verdict.faults)
    sys.exit(is_faulty)


if __name__ == "__main__":
    main()
