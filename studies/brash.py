#!/usr/bin/env python3
"""The tables of docs/brash.md.

    studies/brash.py              runs every study and prints the tables; name some to make these alone
    studies/brash.py --write      puts them into the page
    studies/brash.py --check      compares them with the page (ctest -L validation)

Needs numpy (./setup.sh python) and a release build. All of it takes some half an hour of one processor.
"""
import math
import sys

import tables
from tables import Table, formulas, mean_and_error
from polynya import ice_class

PAGE = "docs/brash.md"
STUDIES = "../scenes/studies/"
THICKNESS, WIDTH, POROSITY = "floes[0].channel.thickness_m", "floes[0].channel.width_m", "floes[0].channel.porosity"
SHIP, FACTOR, FRICTION = "ships[0].ship", "ships[0].hull.submersion_speed_factor", "ice.friction"
COVER, SIZE = "floes[0].channel.cover", "floes[0].channel.sizes.mean_m"
SIDES = "floes[0].channel.side_thickness_m"
SPEED, MU = 2.572, 0.1  # speed of the studies at constant speed [m/s], and their friction if it is not varied
MEASURED = 14 * formulas.KNOT  # Polaris in an old channel of 1.74 m (Aker Arctic, newsletter of September 2017) [m/s]
HULLS = {"reference": tables.REFERENCE, "araon": formulas.Hull(95, 19, 6.8, math.radians(35), math.radians(30)),
         "oden": formulas.Hull(95, 29.4, 8, math.radians(22), math.radians(40)),
         "polaris": formulas.Hull(100, 24, 8, math.radians(25), math.radians(30))}


def loads(study, cases):
    """Mean contact, its friction along the waterline (of ships that sail), mean ice under the hull, and the sum with
    its error [kN]."""
    of = lambda name: -1e-3 * study.table[name][cases]
    contact, under = of("surge_mean_N"), of("surge_from_submerged_ice_mean_N")
    name = "surge_from_ice_friction_mean_N"
    friction = of(name).mean() if name in study.table else 0.0
    return contact.mean(), friction, under.mean(), *mean_and_error(contact + under)


def parts_under(hull, under, speed, mu, has_factor=True):
    """What pushes the ice down, its friction along the hull, and what Lindqvist's factor of speed adds to both, of a
    mean force of the ice under a hull: each piece goes all the way along it."""
    factor = 1 + formulas.submersion_growth(hull, speed) if has_factor else 1
    at_rest = under / factor
    down = at_rest * formulas.rise(hull) / (formulas.rise(hull) + mu * formulas.slide(hull))
    return down, at_rest - down, under - at_rest


def side_pressure(hull, thickness, mu, porosity=0.2, lateral=0.27):
    """Friction of thickened brash along a parallel midbody, which the model has not (docs/theory/brash.md) [kN]."""
    displaced = ice_class.displaced_thickness(thickness, hull.beam)
    return 1e-3 * mu * lateral * (1 - porosity) * 100 * formulas.G * displaced**2 * hull.parallel


def resistance(runs):
    study, rows = runs.study(STUDIES + "brash-channel.json"), []
    for (ship, thickness), cases in tables.groups(study, SHIP, THICKNESS).items():
        hull = HULLS[ship]
        contact, _, _, total, error = loads(study, cases)
        rule = ice_class.channel_resistance(hull, thickness)
        rows.append([ship, f"{math.degrees(hull.stem):.0f}, {math.degrees(hull.entrance):.0f}", f"{thickness:g}",
                     f"{total:.0f} ± {error:.1f}", f"{1e-3 * rule.total:.0f}", f"{1e3 * total / rule.total:.2f}",
                     f"{side_pressure(hull, thickness, MU):.0f}"])
    return Table(["ship", "stem, entrance [°]", "H_M [m]", "R_ch [kN]", "rule [kN]", "R_ch / rule",
                  "side pressure, not in R_ch [kN]"], rows)


def parts(runs):
    study, rows = runs.study(STUDIES + "brash-channel.json"), []
    for (ship, thickness), cases in tables.groups(study, SHIP, THICKNESS).items():
        contact, _, under, _, _ = loads(study, cases)
        down, sliding, growth = parts_under(HULLS[ship], under, SPEED, MU)
        rule = ice_class.channel_resistance(HULLS[ship], thickness)
        rows.append([ship, f"{thickness:g}", f"{contact:.0f}", f"{down:.0f}",
                     f"{sliding:.0f}", f"{growth:.0f}", f"{1e-3 * rule.bow:.0f}", f"{1e-3 * rule.midbody:.0f}",
                     f"{1e-3 * rule.waterplane:.0f}"])
    return Table(["ship", "H_M [m]", "contact at the waterline", "pressing ice down", "friction under the hull",
                  "growth with speed", "rule: bow", "rule: midbody", "rule: waterplane"], rows)


def variations(runs):
    study, rows = runs.study(STUDIES + "brash-channel-variations.json"), []
    names = {FRICTION: "friction", COVER: "cover", SIZE: "piece size [m]", POROSITY: "porosity",
             WIDTH: "width of the channel [m]", SIDES: "brash at the sides [m]", FACTOR: "factor of speed"}
    settings = tables.groups(study, *names)
    base = next(iter(settings))
    for key, cases in settings.items():
        changed = [f"{name} {new if isinstance(new, str) else f'{new:g}'}"
                   for name, old, new in zip(names.values(), base, key) if old != new]
        contact, _, under, total, error = loads(study, cases)
        mu, porosity = key[0], key[3]
        rows.append([", ".join(changed) or "as in the scene", f"{contact:.0f}", f"{under:.0f}",
                     f"{total:.0f} ± {error:.1f}", f"{side_pressure(HULLS['reference'], 1.0, mu, porosity):.0f}"])
    return Table(["changed", "contact [kN]", "under the hull [kN]", "R_ch [kN]", "side pressure, not in R_ch [kN]"],
                 rows)


def polaris(runs):
    study, rows = runs.study(STUDIES + "brash-channel-polaris.json"), []
    for (mu, factor), cases in tables.groups(study, FRICTION, FACTOR).items():
        contact, friction, under, _, _ = loads(study, cases)
        speed, error = mean_and_error(study.table["mean_speed_m_per_s"][cases])
        rows.append([f"{mu:g}", factor, f"{contact:.0f}", f"{friction:.0f}", f"{under:.0f}",
                     f"{speed:.2f} ± {error:.3f}", f"{speed / MEASURED:.2f}"])
    return Table(["friction", "factor of speed", "contact [kN]", "of which friction [kN]", "under the hull [kN]",
                  "speed [m/s]", "speed / measured"], rows)


TABLES = {"resistance": resistance, "parts": parts, "polaris": polaris, "variations": variations}

if __name__ == "__main__":
    sys.exit(tables.run_page(PAGE, TABLES, __doc__))
