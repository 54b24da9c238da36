"""Resistance in a channel of brash, and the minimum power that follows from it, by the Finnish-Swedish ice class rules.
Computed resistances are compared with them (docs/brash.md); the simulation uses none of these formulas.

The rules' text could not be read. All coefficients and limits here are from memory ([FSICR], recall), so compare them
with the rules before basing a decision on them. SI units, angles in radians. Symbols such as R_ch are those of the
rules."""
import dataclasses
import math

from .formulas import KNOT

# Speed that a ship must keep in the channel by the rules [m/s]. The coefficients below hold for it alone, so another
# value would only select other computed points for the comparison.
SPEED = 5 * KNOT
# H_M by class: thickness of the brash in the middle of the channel [m]. Thicker brash gives a larger resistance. The
# table of `polynya performance --channel` has a row of a class for each computed point of this thickness.
THICKNESS = {"IA": 1.0, "IB": 0.8, "IC": 0.6}
# The class above IA: the brash of class IA under a frozen layer of 0.1 m. It is not in THICKNESS, because the
# simulation has no frozen layer to compare with.
SUPER = "IA Super"
# Power that the rules require at least, whatever the resistance is [W]. minimum_power() does not apply it; the text
# below the table of `polynya performance --channel` states it.
LEAST_POWER = {SUPER: 2.8e6, "IA": 1e6, "IB": 1e6, "IC": 1e6}
# K_e by the number of propellers, for fixed pitch, and for controllable pitch or electric drive [kW m / kN^(3/2)]. The
# required power is proportional to it.
FACTORS = {"fixed": {1: 2.26, 2: 1.60, 3: 1.31}, "controllable": {1: 2.03, 2: 1.44, 3: 1.18}}
# Coefficients of the three terms of ChannelResistance by the rules: C_3 of the bow [N/m³], C_4 of the midbody [N/m³],
# and C_5 of the waterplane [N/m]. Each term is proportional to its coefficient.
BOW, SIDE, SPEED_TERM = 845, 42, 825


@dataclasses.dataclass(frozen=True)
class ChannelResistance:
    """Terms of the resistance R_ch of a ship in a channel at 5 knots [N]; `total` is their sum."""

    bow: float  #: brash that the bow pushes aside and down
    midbody: float  #: brash along the parallel midbody
    waterplane: float  #: term that is proportional to the area of the bow's waterplane
    frozen: float = 0.0  #: frozen layer of class IA Super; 0 for the other classes

    @property
    def total(self):
        return self.bow + self.midbody + self.waterplane + self.frozen


def displaced_thickness(middle, beam):
    """Returns H_F, the thickness of the brash beside a hull, which has pushed the brash aside [m]. `middle` is H_M, the
    thickness in the middle of the channel [m], and `beam` that of the hull [m]. H_F grows with both."""
    return 0.26 + math.sqrt(middle * beam)


def channel_resistance(hull, middle, is_frozen=False):
    """Returns the terms of R_ch [N] at 5 knots as ChannelResistance. `hull` is a formulas.Hull, whose bow is a wedge,
    and `middle` is H_M, the thickness of the brash in the middle of the channel [m]. With `is_frozen` the frozen layer
    of class IA Super is added. The limits of the factors below (0.45, 0, and 5 to 20) are those of the rules: a hull
    whose factor is beyond a limit has the resistance of one at the limit."""
    beam, stem, entrance = hull.beam, hull.stem, hull.entrance
    displaced = displaced_thickness(middle, beam)
    flare = math.atan(math.tan(stem) / math.sin(entrance))  # ψ
    of_friction = max(0.45, 0.15 * math.cos(stem) + math.sin(flare) * math.sin(entrance))  # C_μ
    of_flare = max(0.0, 0.047 * math.degrees(flare) - 2.115)  # C_ψ
    bow = BOW * of_friction * (displaced + middle) ** 2 * (beam + of_flare * displaced)
    midbody = SIDE * hull.parallel * displaced**2
    slenderness = min(20.0, max(5.0, (hull.length * hull.draught / beam**2) ** 3))
    waterplane = SPEED_TERM * slenderness * 0.5 * beam * hull.bow / hull.length
    return ChannelResistance(bow, midbody, waterplane, frozen_layer(hull) if is_frozen else 0.0)


def frozen_layer(hull):
    """Returns C_1 + C_2, the resistance of a frozen layer of 0.1 m at 5 knots [N]. Thickness and speed are contained in
    the coefficients. The result agrees with [Riska1997] for level ice of that thickness (docs/brash.md)."""
    beam, stem = hull.beam, math.degrees(hull.stem)
    fixed = 23 * beam * hull.parallel / (2 * hull.draught / beam + 1)
    fixed += (1 + 0.021 * stem) * (45.8 * beam + 14.7 * hull.bow + 29 * beam * hull.bow)
    moving = (1 + 0.063 * stem) * (1530 + 170 * beam)
    moving += 400 * (1 + 1.2 * hull.draught / beam) * beam**2 / math.sqrt(hull.length)
    return fixed + moving


def minimum_power(resistance, diameter, propellers, pitch="fixed"):
    """Returns the power that the rules require for a resistance R_ch [N], K_e R_ch^(3/2) / D_P [W]. `diameter` is that
    of a propeller [m], `propellers` their number (1 to 3) and `pitch` a key of FACTORS; others raise KeyError. The
    resistance must not be negative. The result may be below LEAST_POWER, of which the larger one counts."""
    return 1e3 * FACTORS[pitch][propellers] * (1e-3 * resistance) ** 1.5 / diameter
