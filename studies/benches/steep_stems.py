"""Hulls that hardly press ice down: the tables of docs/theory/bow.md, "Steep stems" and "Shoulders". Run by
studies/bow.py.

Stems are of 60° to 89.95° in half a metre of fast ice at 1 m/s. Shoulders are those of a ship at 0.25 m/s in a free
plate of 1.5 m, by what edges bear, by the step and by the spread of strength.
"""
import numpy as np

from tables import Table

SETTLED = 30  # time until all of the bow is in the ice, left out of the stems' runs [s]
SQUEEZED = 100  # the same of the shoulders' runs [s]
ANGLES = (*range(60, 90, 2), 89, 89.5, 89.75, 89.95)  # [°]
SHIP = {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}
PLACES = (("stem", 1), ("flanks", 22), ("shoulders", 25), ("sides", 120))  # up to this distance behind the stem [m]
CASES = {"as the scene": {}, "step 0.02 s": {"time": {"step_s": 0.02}}, "step 0.00125 s": {"time": {"step_s": 0.00125}},
         "strength spread 0.2": {"fracture": {"bending": {"strength_spread": 0.2}}},
         "outline wedge": {"fracture": {"bending": {"outline": "wedge"}}}}


def without_sign(value, digits):
    """A number with so many decimals; 0 has no sign."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


def stem_scene(stem_deg):
    hull = SHIP | {"stem_angle_deg": stem_deg, "draught_m": 6, "block_coefficient": 0.579}
    return {"time": {"until_s": 70}, "record": {"forces_interval_s": 0.1, "frames_interval_s": 1e4},
            "fracture": {"splitting": {"model": "none"}},
            "ships": [{"name": "a", "hull": hull, "position_m": [-61, 0],
                       "propulsion": {"constant_speed_m_per_s": 1}}],
            "floes": [{"rectangle": {"corner_m": [0, -60], "size_m": [142, 120]}, "fast_ice": True}]}


def stems(runs):
    rows = []
    for (name,), run in runs.scenes("steep-stems", {(f"{angle:g}",): stem_scene(angle) for angle in ANGLES}).items():
        forces = run.force_columns
        settled = forces["t_s"] > SETTLED
        rows.append([name, f"{-1e-6 * forces['surge_N'][settled].mean():.2f}",
                     f"{1e-6 * np.abs(forces['surge_max_N']).max():.1f}",
                     without_sign(-1e-6 * forces["surge_from_submerged_ice_N"][settled].mean(), 2),
                     str(run.summary["counts"]["bends"])])
    return Table(["stem [°]", "mean [MN]", "largest step [MN]", "ice that goes under, mean [MN]", "cusps"], rows)


def squeeze_scene(changes):
    scene = {"time": {"step_s": 0.005, "until_s": 800},
             "ice": {"thickness_m": 1.5, "flexural_strength_Pa": 8e5},
             "record": {"forces_interval_s": 0.1, "frames_interval_s": 0.25},
             "ships": [{"name": "s", "hull": SHIP | {"stem_angle_deg": 30}, "mass_kg": 1e7,
                        "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0],
                        "propulsion": {"constant_speed_m_per_s": 0.25}}],
             "floes": [{"rectangle": {"corner_m": [0, -2000], "size_m": [4000, 4000]}}]}
    for section, values in changes.items():
        scene[section] = scene.get(section, {}) | values
    return scene


def shoulders(runs):
    rows = []
    found = runs.scenes("shoulders", {(name.replace(" ", "-"),): squeeze_scene(of) for name, of in CASES.items()})
    for name, run in zip(CASES, found.values()):
        forces, contacts = run.force_columns, run.contacts
        is_late = forces["t_s"] > SQUEEZED
        contacts = contacts[contacts["t_s"] > SQUEEZED]
        frames = (run.times > SQUEEZED).sum()
        parts, begin = [], -1
        for _, end in PLACES:
            is_there = (contacts["station_m"] > begin) & (contacts["station_m"] <= end)
            parts.append(-1e-3 * contacts["fx_N"][is_there].sum() / frames)
            begin = end
        peaks = run.peaks
        peak = peaks[np.argmax(np.hypot(peaks["fx_N"], peaks["fy_N"]))]
        rows.append([name, f"{-1e-3 * forces['surge_N'][is_late].mean():.0f}",
                     f"{1e-6 * np.abs(forces['surge_max_N'][is_late]).max():.2f}",
                     ", ".join(without_sign(part, 0) for part in parts),
                     f"{1e-6 * np.hypot(peak['fx_N'], peak['fy_N']):.2f} at {peak['station_m']:.1f} m, "
                     f"{-1e-6 * peak['fx_N']:.2f} of it surge"])
    return Table(["1.5 m, 0.25 m/s", "mean 100 to 800 s [kN]", "largest step [MN]",
                  "stem, flanks, shoulders, sides [kN]", "largest contact [MN]"], rows)
