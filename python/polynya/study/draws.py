"""Random draws of a study's parameters (`draw` of a study's file). Each value is the inverse of the parameter's
distribution at a uniform number. The uniform numbers depend only on the seed of the draws (`draw.seed`), the
parameter's path and the number of the draw. So further parameters do not change the draws of the others, and more draws
begin with the same values, except with a Latin hypercube.

`kind` is a key of KINDS, and `given` the numbers of the distribution by name, in the unit of the parameter, with
`least` and `most` if it is cut off. Except in fault_of() they must be valid."""
import math
import random
import statistics

from .located_json import shown

STANDARD = statistics.NormalDist()  # mean 0, standard deviation 1
# Numbers that each distribution needs, besides the optional ones of BOUNDS. "low" and "high" are its ends, "sd" is its
# standard deviation.
KINDS = {
    "uniform": ("low", "high"),
    "log_uniform": ("low", "high"),
    "normal": ("mean", "sd"),
    "log_normal": ("mean", "sd"),  # of the parameter itself, not of its logarithm
}
BOUNDS = ("least", "most")  # numbers that cut a distribution off; the rest keeps its shape and has the probability 1
# Distance of the probabilities from 0 and 1 at which normal and log-normal distributions are cut off [-], because their
# inverse is infinite there. A draw is then at most some 8.2 standard deviations from the mean (of the logarithm). A
# much smaller value would be lost when it is subtracted from 1.
LEAST_P = 1e-16


def fault_of(kind, given):
    """Returns a message that says what is wrong with the numbers of a distribution, or None. Bounds must leave at least
    1e-9 of the distribution, because doubles resolve a smaller part too coarsely. Only the first fault is named."""
    for name in KINDS[kind]:
        if not is_number(given.get(name)):
            found = shown(given[name]) if name in given else "nothing"
            return f"found {found} for {name}, allowed: a number; {kind} needs {' and '.join(KINDS[kind])}"
    for name in given:
        if name not in KINDS[kind] + BOUNDS:
            return f"found an unknown key {shown(name)}, allowed: {', '.join(KINDS[kind] + BOUNDS)}"
        if not is_number(given[name]):
            return f"found {shown(given[name])} for {name}, allowed: a number"
    positive = {"log_uniform": ("low", "high"), "normal": ("sd",), "log_normal": ("mean", "sd")}.get(kind, ())
    for name in positive:
        if given[name] <= 0:
            return f"found {shown(given[name])} for {name}, allowed: a number > 0"
    if "low" in given and given["low"] >= given["high"]:
        return f"found low {given['low']} and high {given['high']}, allowed: low < high"
    least, most = given.get("least", -math.inf), given.get("most", math.inf)
    if least >= most:
        return f"found least {least} and most {most}, allowed: least < most"
    try:
        ends = [value_at(kind, given, p) for p in (LEAST_P, 1 - LEAST_P)]
        share = probability_below(kind, given, most) - probability_below(kind, given, least)
        probability_below(kind, given, ends[0])  # a spread that is lost in rounding gives a division by zero
    except ArithmeticError:
        ends, share = [math.nan], 1
    if not all(map(math.isfinite, ends)):
        numbers = ", ".join(f"{name} {shown(given[name])}" for name in KINDS[kind])
        return f"found {numbers}, allowed: a distribution whose draws are finite numbers"
    if share < 1e-9:
        return "found bounds that leave nothing of the distribution, allowed: bounds around a part of it"
    return None


def is_number(value):
    """Returns True for a finite int or float; true and false are no numbers."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def log_parameters(given):
    """Mean and standard deviation of the logarithm of a log-normal parameter whose own mean and standard deviation are
    given."""
    variance = math.log1p((given["sd"] / given["mean"]) ** 2)
    return math.log(given["mean"]) - variance / 2, math.sqrt(variance)


def value_at(kind, given, p):
    """The value below which the fraction p of the distribution lies, without its bounds: the inverse of
    probability_below. `p` is from 0 to 1. May raise ArithmeticError for numbers that fault_of() refuses."""
    if kind == "uniform":
        return given["low"] + p * (given["high"] - given["low"])
    if kind == "log_uniform":
        return given["low"] * (given["high"] / given["low"]) ** p
    p = min(max(p, LEAST_P), 1 - LEAST_P)
    if kind == "normal":
        return given["mean"] + given["sd"] * STANDARD.inv_cdf(p)
    mean, sd = log_parameters(given)
    return math.exp(mean + sd * STANDARD.inv_cdf(p))


def probability_below(kind, given, value):
    """Fraction of the distribution, without its bounds, that lies below a value, which may be infinite [-]."""
    if value in (-math.inf, math.inf):
        return float(value > 0)
    if kind == "uniform":
        return min(max((value - given["low"]) / (given["high"] - given["low"]), 0), 1)
    if kind == "normal":
        return STANDARD.cdf((value - given["mean"]) / given["sd"])
    if value <= 0:
        return 0.0
    if kind == "log_uniform":
        return min(max(math.log(value / given["low"]) / math.log(given["high"] / given["low"]), 0), 1)
    mean, sd = log_parameters(given)
    return STANDARD.cdf((math.log(value) - mean) / sd)


def uniform_numbers(seed, path, count, method):
    """`count` numbers in [0, 1) for one parameter. The method "independent" draws each alone; "latin_hypercube" draws
    one from each of `count` equal parts, in random order, so that they cover the interval evenly. A larger count then
    changes all numbers."""
    dice = random.Random(f"{seed} {path}")
    if method == "independent":
        return [dice.random() for _ in range(count)]
    strata = list(range(count))
    dice.shuffle(strata)
    return [(stratum + dice.random()) / count for stratum in strata]


def draw(seed, path, kind, given, count, method):
    """Returns a list of `count` values of the parameter `path`, in the order of the draws. The distribution must be
    valid (fault_of). No value is outside the bounds."""
    low = probability_below(kind, given, given.get("least", -math.inf))
    high = probability_below(kind, given, given.get("most", math.inf))
    least, most = given.get("least", -math.inf), given.get("most", math.inf)
    return [
        min(max(value_at(kind, given, low + u * (high - low)), least), most)
        for u in uniform_numbers(seed, path, count, method)
    ]
