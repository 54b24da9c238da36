"""What grows with speed at the bow: the size of each part from the cusps of runs; a table of docs/theory/bow.md, "What
grows with speed". Not a program.

A cusp of area A and depth R turns about its far edge by ψ, the near one is pressed down at w = v tan(stem). By the way:
  ice       its kinetic energy, ρ_i h A w²/6
  water     that of the water below, half of a plate's that turns about its edge in water without bounds,
            (9π/512) ρ_w R A w² (1 + (R/b)²)^-½, b = A/R
  drag      of its turning by ψ, C_D ρ_w w² R A ψ/8, C_D 1.1: an upper bound, the water's own energy is in it
  decks     the water that is missing on its deck, for a sector of that area and radius whose straight sides border
            older cusps of its depth with their axes where the sides begin: dry, no water at all (all that is left is
            friction); closed, sides and arc closed; most, the largest that any inflow could take, the cavity's greatest
            energy and all of the dry friction; built; C_d 0.8; and built with a gap of 0.1 h all along the sides
The hull works against friction too: all times η/η₀, the thrust with friction over that without. Needs numpy.
"""
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from tables import Table, events_of  # noqa: E402

G, RHO_I, RHO_W, STEM = 9.81, 900, 1000, math.radians(30)
SPEED = "ships[0].propulsion.constant_speed_m_per_s"
FRICTION, DRAG, ORIFICE, STRIPS, STEPS, CUSPS = 0.2, 1.1, 0.6, 8, 80, 60
DECKS = {"dry": {"discharge": 0}, "most": {"discharge": 0, "is_most": True}, "sides closed": {"are_closed": True},
         "built": {}, "C_d 0.8": {"discharge": 0.8}, "gap": {"gap": 0.1}}


def strips_of(area, depth):
    """A sector of that area about its tip: of each strip, from the axis on, distance, width, width of the sides across
    the hull's normal and their length, width of the arc across it and its length; where the sides begin [m]."""
    half = min(area / depth**2, 0.49 * math.pi)
    wider = area / (half * depth**2)
    edges = np.linspace(0, depth, 40 * STRIPS + 1)
    u = depth - (edges[1:] + edges[:-1]) / 2
    is_side = u <= depth * math.cos(half)
    width = 2 * np.minimum(u * math.tan(half), np.sqrt(depth**2 - u**2))
    across = np.where(is_side, 2 * math.tan(half) * depth / len(u), 0)
    arc = np.where(is_side, 0, 2 * depth * np.diff(np.arccos(1 - edges / depth)))
    half_chord = np.sqrt(np.maximum(0, depth**2 - (depth - edges)**2))
    by_strip = lambda x: wider * x.reshape(STRIPS, -1).sum(1)
    return ((np.arange(STRIPS) + 0.5) * depth / STRIPS, by_strip(width) / 40, by_strip(across),
            by_strip(across / math.sin(half)), by_strip(np.where(is_side, 0, 2 * np.diff(half_chord))), by_strip(arc),
            depth * (1 - math.cos(half)))


def plate(depth, h, slope, waterline):
    """Turn [rad] of a plate about the lower corner of its far edge, and how far it has slid down along the hull [m]."""
    along = h * (1 - math.sin(slope)) / math.cos(slope)
    at = min(max(waterline, along), depth)
    turned = math.acos(min(1, (at * math.cos(slope) + h * math.sin(slope)) / math.hypot(depth, h)))
    turn = min(max(turned + math.atan(h / depth) - slope, 0), math.pi / 2 - slope)
    return (0 if waterline >= depth else turn), max(0, along - waterline) / math.tan(slope)


def corner(r, h, psi, sunk=0.0):
    return r * math.cos(psi) + h * math.sin(psi), r * math.sin(psi) + h * (1 - math.cos(psi)) + sunk


def opening(h, depth, slope, r, psi, waterline, axis, across, length):
    """Between the sides at r and an older cusp of the same depth whose axis is there [m²]."""
    of_older, sunk = plate(depth, h, slope, waterline - axis)
    x, z = corner(r, h, psi)
    older_x, older_z = corner(r - axis, h, of_older, sunk)
    x, z = older_x + axis - x, older_z - z
    x, z = np.array([x, x - h * math.sin(of_older)]), np.array([z, z + h * math.cos(of_older)])
    along = (x * math.cos(psi) + z * math.sin(psi)).min(0)
    off = z * math.cos(psi) - x * math.sin(psi)
    return np.maximum.reduce([0 * r, along * across, (off.min(0) - h) * length, -off.max(0) * length])


def deck_work(h, area, depth, speed, slope, more, discharge=ORIFICE, are_closed=False, is_most=False, gap=0):
    """Of the missing water, over a turn under a hull at `slope` from the vertical with that speed normal to it, whose
    friction makes the work at the near edge `more` times that without [J]."""
    r, width, side, side_length, arc, arc_length, axis = strips_of(area, depth)
    freeboard, end = (1 - RHO_I / RHO_W) * h, depth - h * (1 - math.sin(slope)) / math.cos(slope)
    if end <= 0:
        return 0.0
    strip, step = depth / STRIPS, end / speed / STEPS
    pool = lost = pressed = before = most = 0.0
    for share in (np.arange(STEPS) + 1) / STEPS:
        waterline = depth - share * end
        psi, _ = plate(depth, h, slope, waterline)
        x, z = corner(r, h, psi)
        z = np.maximum(0, z - freeboard)
        hull = np.maximum(0, (x - waterline) / math.tan(slope) - freeboard)
        below = lambda y: math.cos(psi) * strip * np.sum(width * np.maximum(0, z - np.maximum(y, hull)))
        most = max(most, RHO_W * G * math.cos(psi) * strip * np.sum(width * np.maximum(0, z**2 - hull**2)) / 2)
        pool, low, high = min(pool, below(0)), 0, z[-1]
        for _ in range(14 if pool < below(0) else 0):
            middle = (low + high) / 2
            low, high = (middle, high) if below(middle) > pool else (low, middle)
        y = (low + high) / 2 if pool < below(0) else 0
        opened = gap * h * side_length
        if not are_closed:
            opened = opened + opening(h, depth, slope, r, psi, waterline, axis, side, side_length)
        beside_sheet = np.where(r * math.sin(psi) < h, r * (1 - math.cos(psi)) * arc,
                                np.hypot((x - r) * arc, (z + freeboard - h) * arc_length))
        flow = step * discharge * np.sum((opened + beside_sheet) * np.sqrt(2 * G * np.minimum(y, z)))
        flow = min(flow, max(0, below(0) - pool))
        pool += flow
        lost += RHO_W * G * y * flow
        pressed += RHO_W * G * strip * np.sum(np.minimum(z, y) * r * width) * (psi - before)
        before = psi
    return (most if is_most else lost) + (more - 1) * pressed


def parts_of(run, way_in=32):
    """Of the measured way of a run: the contacts' mean surge, the other parts, and the decks' [N]."""
    h, v = run.scene["ice"]["thickness_m"], run.scene["ships"][0]["propulsion"]["constant_speed_m_per_s"]
    forces, start = run.force_columns, way_in / v
    surge = -forces["surge_N"][forces["t_s"] > start].mean()
    bends = [event for event in events_of(run) if event["kind"] == "bend" and event["t_s"] > start]
    sample = bends[::max(1, len(bends) // CUSPS)]
    sums = np.zeros(3 + len(DECKS))
    for e in sample:
        area, depth, ahead = e["submerged_area_m2"], e["cusp_radius_m"], e["normal"][0]
        tilt = math.atan(math.tan(STEM) / ahead)  # inclination of the hull from the horizontal, ψ
        held = max(0.1, 1 - FRICTION * math.tan(tilt))  # beside a shoulder friction would hold the cusp up
        more = (math.tan(tilt) + FRICTION) / held / math.tan(tilt)
        w = v * math.tan(STEM)
        sums += np.array([
            more * RHO_I * h * area * w**2 / 6,
            more * 9 * math.pi / 512 * RHO_W * depth * area * w**2 / math.hypot(1, depth**2 / area),
            more * DRAG * RHO_W * w**2 * depth * area * tilt / 8,
            *(deck_work(h, area, depth, v * ahead, math.pi / 2 - tilt, more, **settings)
              for settings in DECKS.values())])
    return np.array([surge, *(sums * len(bends) / len(sample) / (v * (run.end_time - start)))])


def table(study):
    """Of the cases of studies/bow-speed.json [kN]."""
    rows = []
    for case, (h, v) in enumerate(zip(study.table["ice.thickness_m"], study.table[SPEED])):
        rows.append([f"{h:g}", f"{v:g}", *(f"{1e-3 * value:.1f}" if value < 1e4 else f"{1e-3 * value:.0f}"
                                           for value in parts_of(study.run(case)))])
    head = ["h [m]", "v [m/s]", "crushing and bending", "ice", "water", "drag", *DECKS]
    head[6] = f"decks: {head[6]}"
    return Table(head, rows, within=0.1)
