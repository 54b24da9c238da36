#!/usr/bin/env python3
"""What splits part in 27 runs of hulls and structures in large floes; a table of docs/validation.md, "Splitting".

  studies/benches/crack_trials.py [POLYNYA]      prints each run

Of every split: whether the narrower piece is a strip, longer along the crack than eight times its width (area over the
crack's length); whether the crack begins or leads inside a body by more than 0.3 m (frames are 0.5 s apart); whether it
turned to a free edge beside it; F/F_max. Needs numpy.
"""
import pathlib
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from tables import ROOT, Runs, Table  # noqa: E402
from polynya.results.motions import placed  # noqa: E402  (tables has found the package)

TOLERANCE = 0.3  # [m]
HULL = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30, "draught_m": 6,
        "block_coefficient": 0.58}
ENGINE = {"engine": {"power_MW": 12, "propeller_diameter_m": 4, "propellers": 2, "open_water_speed_m_per_s": 8}}
AHEAD = {"hold_heading": {"heading_deg": 0}}


def scene(h, floe, until, ship=None, **more):
    ice = {"thickness_m": h} | more.pop("ice", {})
    fracture = {} if "structures" in more else {"resurface": {"enabled": False}}
    return {"time": {"step_s": 0.01, "until_s": until}, "ice": ice, "fracture": fracture, "floes": [floe],
            "ships": [ship] if ship else [], "record": {"frames_interval_s": 0.5, "contacts": "none"}} | more


def icebreaker(y=0.0, speed=3.0, pilot=None):
    return {"hull": HULL, "propulsion": ENGINE, "steering": {"rudder": {}}, "position_m": [-61, y], "heading_deg": 0,
            "speed_m_per_s": speed, "pilot": pilot or AHEAD}


def rectangle(length, width, x=0.0):
    return {"rectangle": {"corner_m": [x, -width / 2], "size_m": [length, width]}}


def trials():
    araon = {"ship": "araon", "pilot": {"hold_heading": {"heading_deg": 0, "lever": 1.0}}, "position_m": [-60, 0.0],
             "speed_m_per_s": 3.0}
    turn = {"constant": {"lever": 1, "steering_deg": 35}}
    all_of = {f"centre-{side}-{h}": scene(h, rectangle(side, side), 120 if side < 1000 else 200, icebreaker())
              for side in (300, 500, 1000) for h in (0.3, 0.7, 1.2)}
    for offset in (20, 60, 120, 250):
        all_of[f"offset-{offset}"] = scene(0.7, rectangle(1000, 1000), 120, icebreaker(offset - 500))
    for speed in (1.5, 5):
        all_of[f"speed-{speed}"] = scene(0.7, rectangle(500, 500), 100, icebreaker(speed=speed))
    all_of["long"] = scene(0.7, rectangle(2000, 150), 120, icebreaker())
    all_of["wide"] = scene(0.7, rectangle(200, 1500), 120, icebreaker())
    all_of["plate-2500"] = scene(1.02, rectangle(2500, 2500), 300, araon,
                                 ice={"flexural_strength_Pa": 630000.0, "friction": 0.1})
    for h in (0.3, 0.7, 1.2):
        all_of[f"turn-800-{h}"] = scene(h, rectangle(800, 800), 200, icebreaker(-200, pilot=turn))
    drift = {"water": {"drift_m_per_s": [-0.5, 0], "skin_drag_coefficient": 0.004}}
    for radius in (5, 15):
        all_of[f"struct-1000-{radius}"] = scene(0.7, rectangle(1000, 1000, radius + 1), 120, **drift,
                                                structures=[{"radius_m": radius, "position_m": [0, 0]}])
    all_of["struct-300"] = scene(0.3, rectangle(300, 300, 6), 120, **drift,
                                 structures=[{"radius_m": 5, "position_m": [0, 30]}])
    def box(x0, y0, x1, y1):
        return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]

    for name, holes in (("hole", [box(100, -20, 140, 30)]), ("holes", [box(60, -10, 70, 10), box(200, -40, 230, 25)])):
        plate = {"polygon": {"outer_m": box(0, -150, 400, 150), "holes_m": holes}}
        all_of[name] = scene(0.7, plate, 120, icebreaker())
    pressure = {"line_load_N_per_m": 5e4, "closing_speed_m_per_s": 0.2}
    walls = [{"from_m": [-300, -100.1], "to_m": [300, -100.1], "pressure": pressure},
             {"from_m": [300, 100.1], "to_m": [-300, 100.1]}]
    all_of["besieged"] = scene(0.7, rectangle(400, 200), 80, icebreaker(), walls=walls)
    assert len(all_of) == 27
    return {name: {**one, "name": name} for name, one in all_of.items()}


def depth_in(ring, points):
    """How deep points lie in a polygon [m]; negative outside."""
    a, b = ring, np.roll(ring, -1, 0)
    p = points[:, None]
    t = np.clip(((p - a) * (b - a)).sum(2) / ((b - a) ** 2).sum(1), 0, 1)
    away = np.hypot(*np.moveaxis(p - a - t[..., None] * (b - a), 2, 0)).min(1)
    above = (a[:, 1] > p[..., 1]) != (b[:, 1] > p[..., 1])
    rise = np.where(b[:, 1] == a[:, 1], 1, b[:, 1] - a[:, 1])
    is_left = p[..., 0] < a[:, 0] + (p[..., 1] - a[:, 1]) / rise * (b[:, 0] - a[:, 0])
    return np.where((above & is_left).sum(1) % 2 == 1, away, -away)


def crack_of(run, frame, children, begins_at):
    """The line of a crack in the world, from where it begins on: the vertices that its pieces share."""
    shapes = run.shapes.of(np.array(children))
    rings = [np.vstack(shapes[child]) for child in children]
    shared = np.array([p for i, ring in enumerate(rings) for other in rings[:i] for p in ring
                       if np.hypot(*(other - p).T).min() == 0])
    pose = frame.poses[frame.ids.tolist().index(children[0])]
    return np.array(sorted(placed(shared, *pose), key=lambda p: np.hypot(*(p - begins_at))))


def samples(line, begins_at):
    """Points each metre on the way from where a crack begins to its far end."""
    points, at = [], begins_at
    ahead = [p for p in line if np.dot(p - begins_at, line[-1] - begins_at) > 0]
    for p in ahead:
        points.append(at + np.linspace(0, 1, max(2, int(np.hypot(*(p - at)))))[:, None] * (p - at))
        at = p
    return np.vstack(points)


def judged(run):
    one = run.scene
    areas = run.births["area_m2"]
    found = {"splits": 0, "strips": 0, "begin": 0, "lead": 0, "turned": 0, "most": 0.0}
    for event in run.events:
        if event["kind"] != "split" or not event["opening_capacity_N"] > 0:  # a beam that breaks is no crack
            continue
        found["splits"] += 1
        length, width = event["crack_length_m"], event["crack_width_m"]
        narrower = min(areas[list(event["children"])])
        found["strips"] += length > 8 * narrower / length
        share = event["opening_force_N"] / event["opening_capacity_N"]
        found["most"] = max(found["most"], share)
        ice = one["ice"]["thickness_m"] * event["fracture_toughness_Pa_sqrt_m"]
        found["turned"] += abs(event["opening_capacity_N"] - 0.293 * ice * (width / 2) ** 0.5) < 1
        frame, begins_at = run.frame(event["t_s"]), np.array([event["x_m"], event["y_m"]])
        way = samples(crack_of(run, frame, event["children"], begins_at), begins_at)
        depth = max(depth_in(np.asarray(hull), way[:1])[0] for hull in frame.hulls.values())
        found["begin"] += depth > TOLERANCE
        deepest = max(depth_in(np.asarray(hull), way).max() for hull in frame.hulls.values())
        found["lead"] += depth <= TOLERANCE < deepest
    return found


SHOWN = ("centre-1000-0.3", "centre-1000-0.7", "plate-2500", "turn-800-0.3", "turn-800-0.7")  # cases shown on the page


def table(runs, shown=SHOWN):
    found = {key[0]: judged(run)
             for key, run in runs.scenes("crack-trials", {(name,): one for name, one in trials().items()}).items()}
    total = {key: sum(row[key] for row in found.values()) for key in ("splits", "strips", "begin", "lead", "turned")}
    total["most"] = max(row["most"] for row in found.values())
    rows = [[name, *(str(row[key]) for key in ("splits", "strips", "begin", "lead", "turned")), f"{row['most']:.2f}"]
            for name, row in [*((name, found[name]) for name in shown or found), ("all 27", total)]]
    return Table(["run", "splits", "strips", "begin in a body", "lead into one", "turned to an edge",
                  "greatest F/F_max"], rows, within=0.1)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/app/polynya"
        print(table(Runs(program, scratch, 2), shown=None))
