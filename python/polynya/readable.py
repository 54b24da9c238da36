"""Numbers, forces and durations as people read them."""


def plain(value):
    """A number with three digits, without an exponent: 0.0123, 1250, 40000."""
    rounded = float(f"{value:.3g}")
    return f"{rounded:.0f}" if abs(rounded) >= 100 else f"{rounded:.4g}"


def in_hours(value):
    """A duration given in hours, in a suitable unit: 90 s, 12 min, 3.5 h."""
    for most, unit, name in ((1 / 30, 3600, "s"), (0.9995, 60, "min")):
        if value < most:
            return f"{plain(value * unit)} {name}"
    return f"{plain(value)} h"


def force(value):
    """A force given in N, in a suitable unit: 850 N, 12.5 kN, 3.28 MN."""
    for factor, name in ((1e6, "MN"), (1e3, "kN")):
        if abs(value) >= factor:
            return f"{value / factor:.3g} {name}"
    return f"{value:.3g} N"
