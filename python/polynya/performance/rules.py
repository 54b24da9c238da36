"""Resistance in a channel and minimum power for the Finnish-Swedish ice classes, computed and by the rules' formula."""
import math

from .. import ice_class
from ..formulas import hull_of
from ..ice_class import KNOT, SPEED, SUPER, THICKNESS

DIAMETER_OVER_DRAUGHT = 0.65  # of a propeller whose diameter nobody states (recall)


def propellers_of(ship):
    """The number of a ship's propellers and their diameter [m]."""
    engine = ship.get("propulsion", {}).get("engine", {})
    diameter = engine.get("propeller_diameter_m") or DIAMETER_OVER_DRAUGHT * ship["hull"]["draught_m"]
    return min(engine.get("propellers", 1), 3), diameter


def computed_at(points, thickness):
    """The points at 5 knots in brash of that thickness: of several covers and sizes, all."""
    return [point for point in points if abs(point["speed_m_per_s"] - SPEED) < 0.01 * SPEED
            and math.isclose(point["thickness_m"], thickness)]


def powers(resistance, ship):
    """Minimum power by a resistance [N] for propellers of fixed and of controllable pitch [W]."""
    number, diameter = propellers_of(ship)
    return {f"power_{pitch}_pitch_W": ice_class.minimum_power(resistance, diameter, number, pitch)
            for pitch in ice_class.FACTORS}


def row_of(ship, name, thickness, point):
    """One line: a class with its rule, and a computed point if there is one."""
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
    """The classes IA, IB and IC with each computed point at 5 knots, and IA Super by the rule alone."""
    found = [row_of(ship, SUPER, THICKNESS["IA"], None)]
    for name, thickness in THICKNESS.items():
        found += [row_of(ship, name, thickness, point) for point in computed_at(points, thickness) or [None]]
    return found


def shown(value, scale, width, digits=0):
    """A number in a column; a dash for none."""
    return f"{'-':>{width}}" if value == "" or math.isnan(value) else f"{value * scale:{width}.{digits}f}"


def print_table(found, ship):
    """Prints resistance and minimum power by class, with what the rules' numbers rest on."""
    print()
    print(f"{'class':<9}{'H_M [m]':>8}{'R_ch [kN]':>11}{'± fields':>10}{'by the rule':>13}{'bow':>6}{'midbody':>9}"
          f"{'P [MW]':>9}{'rule, fixed':>13}{'rule, controllable':>20}")
    for row in found:
        print(f"{row['class']:<9}{row['thickness_m']:8g}{shown(row['computed_N'], 1e-3, 11)}"
              f"{shown(row['computed_error_N'], 1e-3, 10, 1)}{shown(row['rule_N'], 1e-3, 13)}"
              f"{shown(row['rule_bow_N'], 1e-3, 6)}{shown(row['rule_midbody_N'], 1e-3, 9)}"
              f"{shown(row['computed_power_fixed_pitch_W'], 1e-6, 9, 2)}"
              f"{shown(row['rule_power_fixed_pitch_W'], 1e-6, 13, 2)}"
              f"{shown(row['rule_power_controllable_pitch_W'], 1e-6, 20, 2)}")
    number, diameter = propellers_of(ship)
    is_stated = "propeller_diameter_m" in ship.get("propulsion", {}).get("engine", {})
    print(f"R_ch, P: computed at {SPEED / KNOT:g} knots; P by the rules' factor from it, for {number} propeller"
          f"{'s' if number > 1 else ''} of {diameter:.3g} m with fixed pitch"
          f"{'' if is_stated else f' (nobody stated the diameter: {DIAMETER_OVER_DRAUGHT:g} draughts)'}")
    print("rule: Finnish-Swedish ice class rules (recall); at least 2.8 MW for IA Super and 1 MW for the others. The "
          "frozen\nlayer of IA Super is not computed here (docs/brash.md).")
