"""The table of `polynya performance SHIP --channel`: resistance in a channel of brash and minimum power for each of the
Finnish-Swedish ice classes, as computed by runs and by the rules' formula (ice_class.py)."""
import math

from .. import ice_class
from ..formulas import hull_of
from ..ice_class import KNOT, SPEED, SUPER, THICKNESS

WIDTHS = (8, 11, 10, 8, 7, 9, 9, 13, 20)  # widths of the printed table's columns after the class [characters]
# Diameter of a propeller divided by the ship's draught [-], for a ship that does not state the diameter (a typical
# value from memory). The minimum power is inversely proportional to it: a larger value makes the required power
# smaller.
DIAMETER_OVER_DRAUGHT = 0.65


def propellers_of(ship):
    """Returns the number of a ship's propellers and the diameter of one [m]. `ship` is a ship as in a scene. The number
    is 1 if the ship does not state it, and at most 3, because the rules have no factor for more. The diameter is
    estimated from the draught if the ship does not state it."""
    engine = ship.get("propulsion", {}).get("engine", {})
    diameter = engine.get("propeller_diameter_m") or DIAMETER_OVER_DRAUGHT * ship["hull"]["draught_m"]
    return min(engine.get("propellers", 1), 3), diameter


def computed_at(points, thickness):
    """Returns the computed points whose speed is 5 knots, within 1 %, and whose brash has that thickness [m]. Points
    are rows of the table of resistances (coefficients.py). There may be several, with different covers and piece sizes,
    or none. The tolerance admits the default speed of 2.572 m/s; a wider one would compare other speeds with the
    rule."""
    return [point for point in points if abs(point["speed_m_per_s"] - SPEED) < 0.01 * SPEED
            and math.isclose(point["thickness_m"], thickness)]


def powers(resistance, ship):
    """Returns the minimum power [W] that the rules require for a resistance [N] with the propellers of the ship, for
    fixed and for controllable pitch, by the name of a column. The least power of the classes is not applied."""
    number, diameter = propellers_of(ship)
    return {f"power_{pitch}_pitch_W": ice_class.minimum_power(resistance, diameter, number, pitch)
            for pitch in ice_class.FACTORS}


def row_of(ship, name, thickness, point):
    """Returns a row of ice-class.csv for an ice class with brash of that thickness [m]: the rule's resistance, its
    terms and the power that it requires, and resistance and power of a computed point. A negative computed resistance
    requires no power. Without a point (None) the cells of the point are empty texts."""
    rule = ice_class.channel_resistance(hull_of(ship), thickness, is_frozen=name == SUPER)
    row = {"class": name, "thickness_m": thickness, "cover": "", "piece_size_m": "", "computed_N": "",
           "computed_error_N": "", "rule_N": rule.total, "rule_bow_N": rule.bow, "rule_midbody_N": rule.midbody,
           "rule_waterplane_N": rule.waterplane, "rule_frozen_N": rule.frozen, "computed_power_fixed_pitch_W": "",
           "computed_power_controllable_pitch_W": "",
           **{f"rule_{key}": value for key, value in powers(rule.total, ship).items()}}
    if point is None:
        return row
    computed = {"cover": point["cover"], "piece_size_m": point["floe_size_m"], "computed_N": point["resistance_N"],
                "computed_error_N": point["error_N"]}
    found = {f"computed_{key}": value for key, value in powers(max(0.0, point["resistance_N"]), ship).items()}
    return {**row, **computed, **found}


def rows(ship, points):
    """Returns all rows of the table. IA Super has one row, with the rule alone. IA, IB and IC have a row for each
    computed point at 5 knots in brash of their thickness, or one row with the rule alone if there is no point."""
    found = [row_of(ship, SUPER, THICKNESS["IA"], None)]
    for name, thickness in THICKNESS.items():
        found += [row_of(ship, name, thickness, point) for point in computed_at(points, thickness) or [None]]
    return found


def shown(value, scale, digits):
    """Returns a cell of the printed table: the value times `scale` with `digits` decimals, or a dash if it is empty or
    NaN, as the error of a single field is."""
    return "-" if value == "" or math.isnan(value) else f"{value * scale:.{digits}f}"


def print_table(found, ship):
    """Prints resistance and minimum power by class from rows of rows(), and below them the propellers, the speed and
    the source on which the numbers are based. P for the computed resistance is shown for fixed pitch only."""
    print()
    for heads in (("class", "H_M", "R_ch", "± fields", "rule", "bow", "midbody", "P", "rule, fixed",
                   "rule, controllable"),
                  ("", "[m]", "[kN]", "[kN]", "[kN]", "[kN]", "[kN]", "[MW]", "[MW]", "[MW]")):
        print(f"{heads[0]:<9}" + "".join(f"{head:>{width}}" for head, width in zip(heads[1:], WIDTHS)))
    for row in found:
        cells = (f"{row['thickness_m']:g}", *(shown(row[key], scale, digits) for key, scale, digits in (
            ("computed_N", 1e-3, 0), ("computed_error_N", 1e-3, 1), ("rule_N", 1e-3, 0), ("rule_bow_N", 1e-3, 0),
            ("rule_midbody_N", 1e-3, 0), ("computed_power_fixed_pitch_W", 1e-6, 2),
            ("rule_power_fixed_pitch_W", 1e-6, 2), ("rule_power_controllable_pitch_W", 1e-6, 2))))
        print(f"{row['class']:<9}" + "".join(f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS)))
    number, diameter = propellers_of(ship)
    is_stated = "propeller_diameter_m" in ship.get("propulsion", {}).get("engine", {})
    if all(row["computed_N"] == "" for row in found):
        print("R_ch, P: not computed without runs (polynya performance SHIP --channel, without --list)")
    unstated = "" if is_stated else f" (assumed to be {DIAMETER_OVER_DRAUGHT:g} draughts: the ship does not state it)"
    print(f"H_M: thickness of the brash in the middle. R_ch, P: computed at {SPEED / KNOT:g} knots; P by the rules' "
          f"factor from it,\nfor {number} propeller{'s' if number > 1 else ''} of {diameter:.3g} m with fixed "
          f"pitch{unstated}")
    least = {name: f"{power / 1e6:g} MW" for name, power in ice_class.LEAST_POWER.items()}
    of_super, (others,) = least.pop(SUPER), set(least.values())
    print(f"rule: Finnish-Swedish ice class rules (from memory); at least {of_super} for IA Super and {others} for the "
          "others.\nThe frozen layer of IA Super is not computed here (docs/brash.md).")
