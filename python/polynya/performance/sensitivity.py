"""Sensitivity of the speed to each particular of the ship: to those that were stated, estimated or left at their
default."""
import dataclasses
import statistics

from .. import formulas

STEP = 0.1  # relative change of each particular [-]
MOST_THICKNESSES = 3  # largest number of thicknesses in the printed table


@dataclasses.dataclass(frozen=True)
class Particular:
    """A particular of the ship or its ice: key, value in the key's unit, source, and a function that returns (hull,
    engine, ice) for a changed value. Some particulars cannot be reduced; the function then returns None."""

    key: str
    value: float
    source: str
    changed: object

    @property
    def is_guess(self):
        """Returns True if nobody stated the value."""
        return self.source in ("estimated", "default")


def particulars(ship, hull, engine, ice, sources, is_given):
    """All particulars that the formulas use. `sources` gives the source of each key of the ship; `is_given` whether the
    command line had "flexural_strength" and "friction"."""
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
    """Mean of the speeds by the published formulas [m/s]."""
    return statistics.fmean(formulas.level_ice_speeds(hull, engine, dataclasses.replace(ice, thickness=thickness)
                                                      ).values())


def changes(particular, thicknesses, base):
    """Change of the mean speed [m/s] in ice of each thickness if the particular is a tenth smaller and a tenth larger,
    or if there is one propeller more. None if it cannot be smaller."""
    def change(sign, h, speed):
        changed = particular.changed(1 + sign * STEP)
        return None if changed is None else mean_speed(*changed, h) - speed

    return [tuple(change(sign, h, speed) for sign in (-1, 1)) for h, speed in zip(thicknesses, base)]


def most_of(pairs):
    """The largest change."""
    return max(abs(change) for pair in pairs for change in pair if change is not None)


def table(found, thicknesses, hull, engine, ice):
    """A row for each particular: first those that nobody stated, then the others, each group in order of the change of
    speed."""
    base = [mean_speed(hull, engine, ice, h) for h in thicknesses]
    rows = [(one, changes(one, thicknesses, base)) for one in found]
    return sorted(rows, key=lambda row: (not row[0].is_guess, -most_of(row[1])))


def shown_thicknesses(thicknesses):
    """At most three thicknesses of the list: the first, the middle and the last."""
    if len(thicknesses) <= MOST_THICKNESSES:
        return range(len(thicknesses))
    return (0, len(thicknesses) // 2, len(thicknesses) - 1)


def as_rows(rows, thicknesses):
    """Rows of sensitivity.csv, one for each particular and thickness."""
    return [{"particular": one.key, "value": one.value, "from": one.source, "thickness_m": h,
             "change_at_minus_10_percent_m_per_s": less, "change_at_plus_10_percent_m_per_s": more}
            for one, pairs in rows for h, (less, more) in zip(thicknesses, pairs)]


def print_table(rows, thicknesses):
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
