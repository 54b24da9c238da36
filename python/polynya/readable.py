"""Numbers, forces and durations as people read them."""


def plain(value):
    """A number rounded to three significant digits: 0.0123, 1250, 40000. Only values of a magnitude below 0.0001 have
    an exponent. NaN and infinity become "nan" and "inf"."""
    rounded = float(f"{value:.3g}")
    return f"{rounded:.0f}" if abs(rounded) >= 100 else f"{rounded:.4g}"


def in_hours(value):
    """A duration given in hours, in seconds below 2 min, in minutes below 1 h, otherwise in hours: 90 s, 12 min, 3.5 h.
    The limit for minutes is a little below 1 h, so that a duration which would round to 60 min is shown as 1 h. A
    duration of 1000 h or more is not converted to days."""
    for most, unit, name in ((1 / 30, 3600, "s"), (0.9995, 60, "min")):
        if value < most:
            return f"{plain(value * unit)} {name}"
    return f"{plain(value)} h"


def force(value):
    """A force given in N, in N, kN or MN with three significant digits: 850 N, 12.5 kN, 3.28 MN. The unit follows from
    the rounded magnitude, so 999.9 N is 1 kN. A negative force keeps its sign."""
    rounded = abs(float(f"{value:.3g}"))
    factor, name = (1e6, "MN") if rounded >= 1e6 else (1e3, "kN") if rounded >= 1e3 else (1, "N")
    return f"{plain(value / factor)} {name}"
