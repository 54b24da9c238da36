"""The curve of the speed at full power over the thickness of level ice, with one run per thickness. A run is repeated
with a course twice as long until the mean speed is steady. Finished runs are kept and reused."""
import dataclasses
import pathlib

from .. import formulas
from ..runs_kept import kept_run
from . import level_ice

# First length of the course, and the length from which on a run is not repeated, in lengths of the ship. The length is
# doubled from FIRST on: 5, 10, 20. The first 2.2 lengths do not count (level_ice.Measured). With a larger FIRST fewer
# runs are repeated, but each takes longer. With a larger MOST fewer points are marked "not steady", and runs in thick
# ice become longer. The help of the command states 20.
FIRST, MOST = 5, 20
# Largest thickness for which speeds are within or close to the published formulas [m] (docs/validation.md, "A ship in
# level ice"). Rows of thicker ice are marked with "*"; a larger value would hide that they were not validated.
VALIDATED_THICKNESS = 0.5
# Meanings of the marks "*" and "!" below the printed table. The keys of BEYOND are the results of beyond_band.
THICKER = f"thicker than {VALIDATED_THICKNESS:g} m, outside the range of validation"
BEYOND = {1: "faster than by every formula", -1: "slower than by every formula"}


def beyond_band(speed, of_formulas):
    """Returns 1 if a speed is above those of all formulas [m/s], -1 if it is below all, 0 if it is between them or
    equal to the largest or smallest."""
    return int(speed > max(of_formulas)) - int(speed < min(of_formulas))


def mark_of(row):
    """Marks of a row whose speed is not supported: "*" if the ice is thicker than was validated, and "!" if the speed
    is above or below those of all published formulas; both marks are possible. Empty if it is supported. `row` is from
    Curve.point()."""
    return ("*" if not row["is_in_validated_range"] else "") + ("!" if row["beyond_formulas"] else "")


def formula_words(rows):
    """Says how much of the resistance is not computed by mechanics but is Lindqvist's formula for ice under the hull,
    as the range in percent over the rows in which the ship moves against a resistance. Empty if there is no such
    row."""
    shares = [100 * row["formula_share"] for row in rows if row["formula_share"] > 0]
    if not shares:
        return ""
    least, most = f"{min(shares):.0f}", f"{max(shares):.0f}"
    return f"{least if least == most else f'{least} to {most}'} % of its resistance is Lindqvist's formula"


class Curve:
    """The curve of one ship. `ship` is the ship of a scene, `hull` its formulas.Hull, `engine` its bollard pull [N] and
    open-water speed [m/s], and `ice` a formulas.Ice whose thickness is replaced. Runs are in `folder`, which must exist
    for point(), and `program` is the path of polynya. `error` is the largest accepted standard error of a mean speed,
    as a fraction of it; it also limits the change between the halves of the course (level_ice.Measured.is_within).
    `step` is the time step [s]. Only formula_speeds() needs no run."""

    def __init__(self, ship, hull, engine, ice, folder, program, error, step):
        self.ship, self.hull, self.engine, self.ice = ship, hull, engine, ice
        self.folder, self.program, self.error, self.step = pathlib.Path(folder), program, error, step

    def level(self, thickness):
        """The ice with another thickness [m]."""
        return dataclasses.replace(self.ice, thickness=thickness)

    def formula_speeds(self, thickness):
        """Speeds at which the resistances by published formulas equal the net thrust [m/s], by the formula's name:
        lindqvist, riska and spencer_jones. A speed is 0 if the ice stops the ship by that formula."""
        return formulas.level_ice_speeds(self.hull, self.engine, self.level(thickness))

    def first_speed(self, thickness):
        """Initial speed of a run [m/s]: that at which 0.8 of Lindqvist's resistance equals the net thrust, at least
        0.5 m/s. It is near the steady speed, so that the ship settles early. The run lasts as long as the course takes
        at this speed. A larger factor than 0.8 makes runs begin more slowly and last longer."""
        ice = self.level(thickness)
        speed = formulas.equilibrium(
            self.engine["bollard_pull_N"],
            self.engine["open_water_speed_m_per_s"],
            lambda v: 0.8 * sum(formulas.lindqvist(self.hull, ice, v)),
        )
        return max(0.5, speed)

    def point(self, thickness):
        """Runs the ship in ice of a thickness [m] and returns its row of performance.csv (docs/ships.md), from the
        longest course that was run. Forces are means against the motion. A stuck ship has speed and error 0 and counts
        as steady; `is_steady` is false if even the longest course was too short. `way_m` is the distance that the ship
        sailed, `run` the name of its folder. Raises RunFailed, or KeyboardInterrupt if the run was stopped."""
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
