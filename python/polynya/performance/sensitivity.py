"""Sensitivity of the ship's speed in level ice, by the published formulas, to each particular of the ship and the ice:
to those that were stated, estimated or left at their default."""
import dataclasses
import statistics

from .. import formulas

# Relative change of each particular [-]. Larger: the table shows curvature. The column names of sensitivity.csv say 10
# percent and do not follow this value.
STEP = 0.1
MOST_THICKNESSES = 3  # largest number of thicknesses in the printed table, whose lines then have 109 characters


@dataclasses.dataclass(frozen=True)
class Particular:
    """A particular of the ship or of the ice."""

    key: str  # path of the scene's key, such as hull.length_m
    value: float  # in the unit of the key
    source: str  # "estimated" or "default" if nobody stated the value, otherwise "given" or the name of a preset
    # Function of a factor `by` that returns (hull, engine, ice) with the particular multiplied by it, or None if that
    # change is not possible. The number of propellers is not multiplied: a factor above 1 adds one propeller.
    changed: object

    @property
    def is_guess(self):
        """Returns True if nobody stated the value."""
        return self.source in ("estimated", "default")


def particulars(ship, hull, engine, ice, sources, is_given):
    """Returns the list of the Particulars that the formulas use and that a ship file or the command line can state. The
    densities and the elasticity of the ice, which neither has, are left out. `hull`, `engine` and `ice` are the inputs
    of formulas.level_ice_speeds(), made from `ship` of the scene. `sources` has the source of each key of the ship,
    also of keys that have their defaults, `is_given` for "flexural_strength" and "friction" whether the command line
    had them. If the bollard pull is stated, power, diameter and number of propellers do not matter and are left out.
    The number is also left out if it is 3, because there is no factor for 4."""
    found = []

    def of_hull(key, name):
        value = ship["hull"][key]
        found.append(Particular(f"hull.{key}", value, sources[f"hull.{key}"], lambda by: (
            dataclasses.replace(hull, **{name: by * getattr(hull, name)}), engine, ice)))

    def of_engine(key, value, name, power):
        path = f"propulsion.engine.{key}"
        found.append(Particular(path, value, sources[path],
                                lambda by: (hull, engine | {name: by**power * engine[name]}, ice)))

    def of_ice(key, unit_key):
        source = "given" if is_given[key] else "default"
        found.append(Particular(f"ice.{unit_key}", getattr(ice, key), source, lambda by: (
            hull, engine, dataclasses.replace(ice, **{key: by * getattr(ice, key)}))))

    for key, name in (("length_m", "length"), ("beam_m", "beam"), ("draught_m", "draught"),
                      ("stem_angle_deg", "stem"), ("entrance_angle_deg", "entrance")):
        of_hull(key, name)
    given = ship["propulsion"]["engine"]
    of_engine("open_water_speed_m_per_s", given["open_water_speed_m_per_s"], "open_water_speed_m_per_s", 1)
    if "bollard_pull_kN" in given:
        of_engine("bollard_pull_kN", given["bollard_pull_kN"], "bollard_pull_N", 1)
    else:  # K_e (P D)^(2/3)
        of_engine("power_MW", given["power_MW"], "bollard_pull_N", 2 / 3)
        of_engine("propeller_diameter_m", given["propeller_diameter_m"], "bollard_pull_N", 2 / 3)
    of_number = given.get("propellers", 1)
    if "bollard_pull_kN" not in given and of_number < 3:
        path, factors = "propulsion.engine.propellers", formulas.PULL_OF_PROPELLERS
        more = engine | {"bollard_pull_N": engine["bollard_pull_N"] * factors[of_number + 1] / factors[of_number]}
        found.append(Particular(path, of_number, sources[path],
                                lambda by: (hull, more, ice) if by > 1 else None))
    of_ice("flexural_strength", "flexural_strength_Pa")
    of_ice("friction", "friction")
    return found


def mean_speed(hull, engine, ice, thickness):
    """Mean of the speeds in level ice of a thickness [m] by the published formulas [m/s]."""
    return statistics.fmean(formulas.level_ice_speeds(hull, engine, dataclasses.replace(ice, thickness=thickness)
                                                      ).values())


def changes(particular, thicknesses, base):
    """For each thickness the pair of changes of the mean speed [m/s], which are 0 where the ship is stuck before and
    after them, if the particular is smaller and larger by the fraction STEP; for propellers (None, change with one
    more). `base` is the mean speed for each thickness [m/s]."""
    def change(sign, h, speed):
        changed = particular.changed(1 + sign * STEP)
        return None if changed is None else mean_speed(*changed, h) - speed

    return [tuple(change(sign, h, speed) for sign in (-1, 1)) for h, speed in zip(thicknesses, base)]


def most_of(pairs):
    """The largest magnitude of a change [m/s]."""
    return max(abs(change) for pair in pairs for change in pair if change is not None)


def table(found, thicknesses, hull, engine, ice):
    """Returns (Particular, pairs of changes) for each particular `found`: first those that nobody stated, then the
    others, each group in descending order of the largest change of speed."""
    base = [mean_speed(hull, engine, ice, h) for h in thicknesses]
    rows = [(one, changes(one, thicknesses, base)) for one in found]
    return sorted(rows, key=lambda row: (not row[0].is_guess, -most_of(row[1])))


def shown_thicknesses(thicknesses):
    """The indices of the thicknesses that the printed table shows: all, or if there are more than MOST_THICKNESSES the
    first, the middle and the last."""
    if len(thicknesses) <= MOST_THICKNESSES:
        return range(len(thicknesses))
    return (0, len(thicknesses) // 2, len(thicknesses) - 1)


def as_rows(rows, thicknesses):
    """Rows of sensitivity.csv, one for each particular and thickness. The cell of a change of None is empty."""
    return [{"particular": one.key, "value": one.value, "from": one.source, "thickness_m": h,
             "change_at_minus_10_percent_m_per_s": less, "change_at_plus_10_percent_m_per_s": more}
            for one, pairs in rows for h, (less, more) in zip(thicknesses, pairs)]


def print_table(rows, thicknesses):
    """Prints the rows that table() returned, with a mark at particulars that nobody stated."""
    shown = shown_thicknesses(thicknesses)
    print(f"\nHow far the mean of the three formulas' speeds moves with each particular {STEP:.0%} less and more [m/s]")
    print(f"{'particular':<42}{'value':>10}  {'from':<10}" + "".join(f"{f'{thicknesses[k]:g} m':>15}" for k in shown))
    for one, pairs in rows:
        mark = "?" if one.is_guess else " "
        cells = "".join(f"{' '.join('–' if v is None else f'{v:+.2f}' for v in pairs[k]):>15}" for k in shown)
        print(f"{one.key:<42}{one.value:10.6g} {mark}{one.source:<10}{cells}")
    if any(one.is_guess for one, _ in rows):
        print("?: nobody stated it, so its row is part of the answer's uncertainty")
    if any(one.key.endswith(".propellers") for one, _ in rows):
        print("propellers: one more, with the same power in all")
