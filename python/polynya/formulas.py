"""Published formulas for the resistance and thrust of a ship in ice, for comparison. SI units, angles in radians.

Keys in brackets are those of docs/references.md; "recall" marks formulas from memory, which were not compared with the
publication. Of these formulas the simulation uses only those for bollard pull, net thrust and Lindqvist's resistance of
ice under the hull, each in its own implementation in C++."""
import dataclasses
import math

G = 9.81  # acceleration of gravity [m/s²]
KNOT = 1852 / 3600  # [m/s]


@dataclasses.dataclass(frozen=True)
class Hull:
    """Main dimensions: length, beam, draught [m], stem angle from the horizontal and entrance angle from the centreline
    [rad]."""

    length: float
    beam: float
    draught: float
    stem: float
    entrance: float

    @property
    def bow(self):
        """Length of a wedge-shaped bow, from the stem to the largest beam [m]."""
        return 0.5 * self.beam / math.tan(self.entrance)

    @property
    def parallel(self):
        """Length of the parallel midbody, from the bow to a square stern [m]."""
        return self.length - self.bow


def hull_of(ship):
    """The main dimensions of a ship that has the keys of a scene's ship with a wedge bow."""
    hull = ship["hull"]
    angles = (math.radians(hull[key]) for key in ("stem_angle_deg", "entrance_angle_deg"))
    return Hull(hull["length_m"], hull["beam_m"], hull["draught_m"], *angles)


@dataclasses.dataclass(frozen=True)
class Ice:
    """Level ice in water. The defaults are those of a scene."""

    thickness: float  # [m]
    flexural_strength: float = 0.8e6  # [Pa]
    friction: float = 0.2  # coefficient of friction between hull and ice [-]
    density: float = 900  # [kg/m³]
    water_density: float = 1000  # [kg/m³]
    young: float = 5.4e9  # Young's modulus [Pa]
    poisson: float = 0.3  # Poisson's ratio [-]


def lindqvist(hull, ice, speed):
    """The three parts of the resistance of [Lindqvist1989] (recall) at a speed [m/s], each with its factor of speed
    [N]: crushing, bending and submersion. The resistance is their sum,

    R = (R_c + R_b)(1 + 1.4 v/√(g h)) + R_s (1 + 9.4 v/√(g L)).

    Crushing is infinite if the hull cannot press the ice down."""
    stem, entrance, mu, h = hull.stem, hull.entrance, ice.friction, ice.thickness
    psi = math.atan(math.tan(stem) / math.sin(entrance))
    # Vertical share of the ice force. It is negative if the stem is so steep or rough that it only crushes the ice.
    downward = 1 - mu * math.sin(stem) / math.cos(psi)
    crushing = (
        0.5 * ice.flexural_strength * h**2 * (math.tan(stem) + mu * math.cos(stem) / math.cos(psi)) / downward
        if downward > 0
        else math.inf
    )
    modulus = ice.young / (12 * (1 - ice.poisson**2) * ice.water_density * G)
    bending = (
        (27 / 64)
        * ice.flexural_strength
        * hull.beam
        * h**1.5
        / math.sqrt(modulus)
        * (math.tan(psi) + mu * math.cos(stem) / (math.sin(entrance) * math.cos(psi)))
        * (1 + 1 / math.cos(psi))
    )
    submersion = lift(hull, ice) * (rise(hull) + mu * slide(hull))
    factor = 1 + 1.4 * speed / math.sqrt(G * h)
    return crushing * factor, bending * factor, submersion * (1 + submersion_growth(hull, speed))


def lift(hull, ice):
    """Force per metre of depth by which the buoyancy of ice under the hull resists [N/m]: (ρ_w − ρ_i) g h B."""
    return (ice.water_density - ice.density) * G * ice.thickness * hull.beam


def submersion_growth(hull, speed):
    """Growth of Lindqvist's submersion with speed, 9.4 v/√(g L), by which its factor exceeds 1 [-]."""
    return 9.4 * speed / math.sqrt(G * hull.length)


def rise(hull):
    """z̄, the mean depth to which ice is pushed under the hull [m]."""
    return hull.draught * (hull.beam + hull.draught) / (hull.beam + 2 * hull.draught)


def slide(hull):
    """s̄, the distance that ice slides along the hull, for friction [m]; at least 0, as for short and blunt hulls."""
    psi = math.atan(math.tan(hull.stem) / math.sin(hull.entrance))
    return max(
        0.0,
        0.7 * hull.length
        - hull.draught / math.tan(hull.stem)
        - hull.beam / (4 * math.tan(hull.entrance))
        + hull.draught
        * math.cos(hull.stem)
        * math.cos(psi)
        * math.sqrt(1 / math.sin(hull.stem) ** 2 + 1 / math.tan(hull.entrance) ** 2),
    )


def formula_under_hull(hull, ice, speed, has_factor=True):
    """The part of the simulated resistance in level ice that comes from Lindqvist's formula for ice under the hull [N]:
    R_s, of which only friction behind the bow grows with speed (docs/theory/under-hull.md). `has_factor` is false for
    hulls on which it does not grow at all."""
    behind_bow = max(0.0, slide(hull) - hull.draught / math.tan(hull.stem))
    growth = ice.friction * behind_bow * submersion_growth(hull, speed) if has_factor else 0
    return lift(hull, ice) * (rise(hull) + ice.friction * slide(hull) + growth)


def riska(hull, ice, speed, bow=None, parallel=None):
    """Resistance C1 + C2 v of [Riska1997] at a speed [m/s] [N]. `bow` and `parallel` are the lengths of the bow and the
    parallel midbody [m]; if not given, they are those of a wedge-shaped bow."""
    h, b, t, length = ice.thickness, hull.beam, hull.draught, hull.length
    bow = hull.bow if bow is None else bow
    parallel = hull.parallel if parallel is None else parallel
    stem = math.degrees(hull.stem)
    fixed = 0.23 * b * parallel * h / (2 * t / b + 1) + (1 + 0.021 * stem) * (
        4.58 * b * h**2 + 1.47 * bow * h**2 + 0.29 * b * bow * h
    )
    of_speed = (1 + 0.063 * stem) * (18.9 * h**1.5 + 0.67 * b * h) + 1.55 * h * (
        1 + 1.2 * t / b
    ) * b**2 / math.sqrt(length)
    return 1e3 * (fixed + of_speed * speed)


def spencer_jones(hull, ice, speed):
    """Resistance by strength number and Froude number [SpencerJones2001] (recall) at a speed [m/s] [N]. The speed must
    be above 0."""
    h, b = ice.thickness, hull.beam
    strength = speed / math.sqrt(ice.flexural_strength * h / (ice.density * b))
    froude = speed / math.sqrt(G * h)
    breaking = (2.73 * strength**-1.54 + 1.11 * froude**-1.157) * ice.density * b * h * speed**2
    return breaking + 0.5 * (ice.water_density - ice.density) * G * h * b * hull.draught


# Factor K_e of the bollard pull by number of propellers [kN/(kW m)^⅔]. At the same power in all, more propellers pull
# more.
PULL_OF_PROPELLERS = {1: 0.78, 2: 0.98, 3: 1.12}


def bollard_pull(power, diameter, propellers, has_nozzles=False):
    """Bollard pull K_e (P D)^⅔ of the ice class rules [FSICR] (recall) [N], the thrust of all propellers at rest. P is
    the power of all propellers [W], D the diameter of one [m]. `propellers` is 1, 2 or 3. Nozzles multiply the pull by
    1.4."""
    factor = PULL_OF_PROPELLERS[propellers] * (1.4 if has_nozzles else 1)
    return 1e3 * factor * (1e-3 * power * diameter) ** (2 / 3)


def net_thrust(bollard, open_water_speed, speed):
    """Thrust that is left for breaking ice at a speed v [m/s], T_B [1 − v/(3 v_ow) − ⅔ (v/v_ow)²] [N]. T_B is the
    bollard pull [N], and v_ow the speed in open water [m/s], at which nothing is left."""
    share = speed / open_water_speed
    return bollard * (1 - share / 3 - 2 / 3 * share**2)


def equilibrium(bollard, open_water_speed, resistance):
    """The speed at which the net thrust equals the function resistance(speed) [m/s], by bisection to 1e-9 m/s. The
    resistance must grow with speed, so that there is one such speed. The result is 0 if the resistance at 1 mm/s is not
    below the thrust; 1 mm/s is used because some formulas are undefined at rest. The resistance of open water is part
    of the net thrust."""

    def excess(speed):
        return net_thrust(bollard, open_water_speed, speed) - resistance(speed)

    slow, fast = 1e-3, open_water_speed
    if excess(slow) <= 0:
        return 0.0
    while fast - slow > 1e-9:
        middle = 0.5 * (slow + fast)
        slow, fast = (middle, fast) if excess(middle) > 0 else (slow, middle)
    return 0.5 * (slow + fast)


def level_ice_speeds(hull, engine, ice):
    """The speeds {formula: speed} [m/s] that a ship reaches under full power by the published resistances. `engine` is
    a mapping with bollard_pull_N and open_water_speed_m_per_s."""
    resistances = {
        "lindqvist": lambda v: sum(lindqvist(hull, ice, v)),
        "riska": lambda v: riska(hull, ice, v),
        "spencer_jones": lambda v: spencer_jones(hull, ice, v),
    }
    pull, fast = engine["bollard_pull_N"], engine["open_water_speed_m_per_s"]
    return {name: equilibrium(pull, fast, of) for name, of in resistances.items()}
