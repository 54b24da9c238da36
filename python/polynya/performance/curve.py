"""Runs of a curve, one per thickness. A run is repeated with a longer course until the speed is steady. Finished runs
are kept and reused."""
import dataclasses
import pathlib

from .. import formulas
from ..runs_kept import kept_run
from . import level_ice

FIRST, MOST = 5, 20  # first and largest length of the course, in lengths of the ship
# Ice up to this thickness was compared with measurements [m], docs/validation.md, "A ship in level ice".
VALIDATED_THICKNESS = 0.5
THICKER = f"thicker than {VALIDATED_THICKNESS:g} m, outside the range of validation"
BEYOND = {1: "faster than by every formula", -1: "slower than by every formula"}


def beyond_band(speed, of_formulas):
    """1 if a speed is above those of all formulas, -1 if it is below all, 0 if it is between them."""
    return int(speed > max(of_formulas)) - int(speed < min(of_formulas))


def mark_of(row):
    """Mark of a point that is not supported: "!" outside of the range of the formulas, "*" for ice thicker than was
    validated."""
    return ("*" if not row["is_in_validated_range"] else "") + ("!" if row["beyond_formulas"] else "")


def formula_words(rows):
    """The share of the resistance that no mechanics of the simulation gives, of the points where the ship moves; or
    nothing."""
    shares = [100 * row["formula_share"] for row in rows if row["formula_share"] > 0]
    if not shares:
        return ""
    least, most = f"{min(shares):.0f}", f"{max(shares):.0f}"
    return f"{least if least == most else f'{least} to {most}'} % of its resistance is Lindqvist's formula"


class Curve:
    def __init__(self, ship, hull, engine, ice, folder, program, error, step):
        self.ship, self.hull, self.engine, self.ice = ship, hull, engine, ice
        self.folder, self.program, self.error, self.step = pathlib.Path(folder), program, error, step

    def level(self, thickness):
        """Ice of a thickness [m]."""
        return dataclasses.replace(self.ice, thickness=thickness)

    def formula_speeds(self, thickness):
        """Speeds at which published resistances equal the net thrust [m/s]."""
        return formulas.level_ice_speeds(self.hull, self.engine, self.level(thickness))

    def first_speed(self, thickness):
        """Initial speed of a run [m/s]: slightly less than Lindqvist's resistance equals the net thrust there."""
        ice = self.level(thickness)
        speed = formulas.equilibrium(
            self.engine["bollard_pull_N"],
            self.engine["open_water_speed_m_per_s"],
            lambda v: 0.8 * sum(formulas.lindqvist(self.hull, ice, v)),
        )
        return max(0.5, speed)

    def point(self, thickness):
        """Computes one row of the curve."""
        speed, lengths = self.first_speed(thickness), FIRST
        while True:
            name = f"level-{thickness:g}-{lengths}"
            scene = level_ice.scene(self.ship, self.level(thickness), speed, lengths, self.step)
            way = scene["floes"][0]["rectangle"]["size_m"][0]
            measured = level_ice.Measured(kept_run(self.program, self.folder, name, scene), self.ship, way)
            if measured.is_within(self.error) or lengths >= MOST:
                break
            lengths *= 2
        of_formulas = self.formula_speeds(thickness)
        has_factor = self.ship["hull"].get("submersion_speed_factor") != "none"
        by_formula = formulas.formula_under_hull(self.hull, self.level(thickness), measured.speed, has_factor)
        resistance = measured.contact + measured.submerged
        return {
            "thickness_m": thickness,
            "speed_m_per_s": measured.speed,
            "error_m_per_s": measured.error,
            "is_steady": measured.is_within(self.error),
            "is_stuck": bool(measured.is_stuck),
            "is_in_validated_range": thickness <= VALIDATED_THICKNESS,
            "beyond_formulas": beyond_band(measured.speed, of_formulas.values()),
            "contact_kN": 1e-3 * measured.contact,
            "submerged_kN": 1e-3 * measured.submerged,
            "formula_share": 0.0 if measured.is_stuck or resistance <= 0 else by_formula / resistance,
            "way_m": measured.way,
            "run": name,
        } | {f"{name}_m_per_s": value for name, value in of_formulas.items()}
