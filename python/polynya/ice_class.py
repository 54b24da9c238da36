"""Resistance in a channel of brash and minimum power by the Finnish-Swedish ice class rules, to compare with.

The rules' text could not be read; coefficients and terms are [FSICR] (recall). SI units, angles in radians. The
simulation uses none of it."""
import dataclasses
import math

from .formulas import KNOT

SPEED = 5 * KNOT  # of the requirement [m/s]
THICKNESS = {"IA": 1.0, "IB": 0.8, "IC": 0.6}  # H_M of the classes: brash in the middle of the channel [m]
SUPER = "IA Super"  # 1.0 m of brash under a frozen layer of 0.1 m
LEAST_POWER = {SUPER: 2.8e6, "IA": 1e6, "IB": 1e6, "IC": 1e6}  # [W]
# K_e by the number of propellers, of fixed pitch and of controllable pitch or electric drive [kW m / kN^(3/2)].
FACTORS = {"fixed": {1: 2.26, 2: 1.60, 3: 1.31}, "controllable": {1: 2.03, 2: 1.44, 3: 1.18}}
BOW, SIDE, SPEED_TERM = 845, 42, 825  # C_3 and C_4 [N/m³], C_5 [N/m]: C_3, C_4 with brash in m, C_5 with areas in m²


@dataclasses.dataclass(frozen=True)
class ChannelResistance:
    """Terms of R_ch [N]: brash pushed aside and down by the bow, brash along the parallel midbody, the term that grows
    with the waterplane of the bow, and the frozen layer of class IA Super."""

    bow: float
    midbody: float
    waterplane: float
    frozen: float = 0.0

    @property
    def total(self):
        return self.bow + self.midbody + self.waterplane + self.frozen


def displaced_thickness(middle, beam):
    """H_F, the thickness of the brash that a hull of that beam has pushed aside [m], by the thickness in the middle."""
    return 0.26 + math.sqrt(middle * beam)


def channel_resistance(hull, middle, is_frozen=False):
    """R_ch of a hull with a wedge bow in brash of the thickness H_M in the middle of the channel [m]."""
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
    """C_1 + C_2, the level ice resistance of a frozen layer of 0.1 m at 5 knots [N]."""
    beam, stem = hull.beam, math.degrees(hull.stem)
    fixed = 23 * beam * hull.parallel / (2 * hull.draught / beam + 1)
    fixed += (1 + 0.021 * stem) * (45.8 * beam + 14.7 * hull.bow + 29 * beam * hull.bow)
    moving = (1 + 0.063 * stem) * (1530 + 170 * beam)
    moving += 400 * (1 + 1.2 * hull.draught / beam) * beam**2 / math.sqrt(hull.length)
    return fixed + moving


def minimum_power(resistance, diameter, propellers, pitch="fixed"):
    """The power that a resistance R_ch [N] asks of propellers of that diameter [m], K_e R_ch^(3/2) / D_P [W]; without
    the least power of the class."""
    return 1e3 * FACTORS[pitch][propellers] * (1e-3 * resistance) ** 1.5 / diameter
