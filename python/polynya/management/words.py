"""The ranking of patterns, as lines of text and as a table."""
import csv

from ..files import writing
from ..readable import plain
from . import cautions, ranking
from .study import MEASURES, UNMANAGED

# For the unit at the end of a measure's meaning in MEASURES, the units in which it may be printed, largest first, with
# the factors by which its values are divided.
UNITS = {"[N]": ((1e6, "MN"), (1e3, "kN"), (1, "N")), "[m]": ((1, "m"),)}


def unit_of(measure, most):
    """Factor and unit in which values of a measure up to `most` are easy to read: the largest unit of UNITS that is at
    most `most`, otherwise the smallest one. Values are divided by the factor."""
    choices = UNITS[MEASURES[measure][-3:]]
    return next(((factor, name) for factor, name in choices if most >= factor), choices[-1])


def interval(mean, factor=1.0):
    """"12.3 ± 0.45": a ranking.Mean and half of its interval, both divided by `factor`, with three and two significant
    digits. Without ± for a single field of ice."""
    half = "" if mean.half is None else f" ± {float(f'{mean.half / factor:.2g}'):.6g}"
    return f"{plain(mean.value / factor)}{half}"


def left(place):
    """The load, or size, with management as a percentage of that without, with limits in brackets. No limits are given
    for a single field of ice, or if the load without management may be 0. Empty for the pattern without management, or
    if the study has none."""
    if place.left is None:
        return ""
    ratio, low, high = place.left
    limits = f" ({100 * low:.0f} to {100 * high:.0f})" if low is not None else ""
    return f"{100 * ratio:.0f} %{limits}"


def lost(condition, name):
    """Ice that left the scene by a rule under the pattern `name`: means over fields of its area and of its fraction of
    all ice at the start. Empty if it was not measured."""
    found = condition.lost.get(name)
    if not found:
        return ""
    areas, shares = zip(*found.values())
    return f"{plain(sum(areas) / len(areas))} m² ({100 * sum(shares) / len(shares):.2g} %)"


def listed(names):
    """Names in a sentence: "a, b and c". If a name has a comma itself, "a; b; c". There must be at least one name."""
    if len(names) == 1:
        return names[0]
    if any("," in name for name in names):
        return "; ".join(names)
    return ", ".join(names[:-1]) + " and " + names[-1]


def not_told_apart(places):
    """Sentences on patterns, given as ranking.Place, between which the study finds no significant difference (LEVEL of
    ranking.py). No sentence for fewer than two patterns."""
    if len(places) < 2:
        return []
    if all(place.mean.half is None for place in places):
        return ["One field of ice: nothing is told apart. Repeat the study with more seeds (repetitions)."]
    groups = ranking.alike(places)
    if not groups:
        return ["All are told apart."]
    return [f"Not distinguishable: {listed(group)}." for group in groups]


def hit(condition, name):
    """"1 of 6" fields in which a ship hit the protected body; an empty text without contacts."""
    found = cautions.hits_of(condition, name)
    return f"{found.hit} of {found.fields}" if found and found.hit else ""


def of_first(condition, places, body):
    """A list with a sentence if the first pattern of a ranking is one whose ship hit the protected body, because small
    loads then say nothing; otherwise an empty list. `places` has at least one."""
    hits = cautions.hits_of(condition, places[0].name)
    if not hits or not hits.hit:
        return []
    return [f"{places[0].name} comes first, but is not the best: a ship hit {body} in {hits.hit} of {hits.fields} "
            "fields."]


def table_of(condition, measure):
    """Rows of text: rank, pattern, mean, remaining load, benefit, lost ice, fields with a hit of a ship; the unit of
    the means; and the places of the ranking, the smallest mean first. All are empty if the measure ranks nothing. The
    first row is the heading. The columns that compare with no management are left out if the study has none, and the
    column of hits is left out if there were none."""
    places = condition.ranked(measure)
    if not places:
        return [], "", places
    factor, unit = unit_of(measure, max(abs(place.mean.value) for place in places))
    has_base = any(place.benefit for place in places)
    has_hits = any(hit(condition, place.name) for place in places)
    head = ["", "pattern", f"mean [{unit}]", *((["of unmanaged", f"less by [{unit}]"]) if has_base else []),
            "ice lost by rule", "fields", *(["hit by a ship in"] if has_hits else [])]
    rows = [[f"{rank}.", place.name, interval(place.mean, factor),
             *([left(place), interval(place.benefit, factor) if place.benefit else ""] if has_base else []),
             lost(condition, place.name), str(place.mean.count), *([hit(condition, place.name)] if has_hits else [])]
            for rank, place in enumerate(places, 1)]
    return [head, *rows], unit, places


def aligned(rows):
    """Rows of equally many texts as lines with aligned columns: the first two to the left, the others to the right."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  " + "  ".join(f"{cell:<{width}}" if k < 2 else f"{cell:>{width}}"
                             for k, (cell, width) in enumerate(zip(row, widths))).rstrip() for row in rows]


def lines_of_ships(found):
    """A table of the encounters of the protected body with other ships: the largest load of a contact is a mean over a
    row of forces.csv, and the distance is the smallest one in all fields. No lines without other ships."""
    rows = [["", "pattern", "fields with a hit", "largest load of a hit", "closest distance"]]
    for condition in found.conditions:
        hits = {name: cautions.hits_of(condition, name) for name in found.patterns}
        rows += [[condition.name, name, f"{of.hit} of {of.fields}", cautions.force(of.load) if of.hit else "-",
                  "-" if of.closest is None else f"{plain(of.closest)} m"] for name, of in hits.items() if of]
    if len(rows) > 1:
        yield ""
        yield f"other ships and {found.body}: hits in the whole run, distance between the waterlines"
        yield from aligned(rows)


def lines_of(found):
    """Returns the lines that the command prints. Warnings come first."""
    yield from (f"WARNING: {sentence}" for sentence in cautions.of_study(found))
    yield f"{found.name}: {found.finished} of {found.cases} cases; patterns by {', '.join(found.by)}"
    for condition in found.conditions:
        for measure, words in MEASURES.items():
            rows, _, places = table_of(condition, measure)
            if not rows:
                continue
            yield ""
            yield f"{words.rpartition(' [')[0]}{', ' + condition.name if condition.name else ''}"
            yield from aligned(rows)
            yield from (f"  {sentence}" for sentence in (*of_first(condition, places, found.body),
                                                         *not_told_apart(places)))
    yield from lines_of_ships(found)
    if not any(condition.ranked(measure) for condition in found.conditions for measure in MEASURES):
        return
    yield ""
    if UNMANAGED not in found.patterns:
        yield ('No case is without management, so no benefit is stated: add the pilot {"constant": {"lever": 0}}, far '
               "downstream, to the study.")
    yield f"±: Student's {100 * ranking.LEVEL:g} % intervals over fields of ice; “less by” is of differences in one"
    yield "field, “of unmanaged” by Fieller's theorem. Distinguishable: by paired t tests, Holm's rule over all pairs."
    if any(name != UNMANAGED for condition in found.conditions for name in condition.lost):
        yield "Ice lost by rule in the whole run: cusps taken to be gone, pieces below the size limit, ice that found"
        yield "no room. Where it is not small, the loads and floes that are counted are too small."


def write_ranking(found, path):
    """Writes the rankings of all conditions and measures in N, m and m², without the rounding of the printed table. An
    existing file is replaced. A cell is empty where there is no value, such as the interval of a single field.
    "of_unmanaged" and "ice_lost_share" are fractions, "half_of_95_percent" is half of an interval."""
    with writing(path, newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["condition", "measure", "rank", "pattern", "fields", "mean", "half_of_95_percent",
                         "of_unmanaged", "of_unmanaged_low", "of_unmanaged_high", "less_by",
                         "less_by_half_of_95_percent", "ice_lost_m2", "ice_lost_share", "fields_hit_by_a_ship",
                         "largest_load_of_a_hit_N", "closest_ship_m", "not_distinguishable_from"])
        for condition in found.conditions:
            for measure in MEASURES:
                for rank, place in enumerate(condition.ranked(measure), 1):
                    areas = condition.lost.get(place.name, {}).values()
                    mean_lost = [sum(column) / len(areas) for column in zip(*areas)] if areas else ["", ""]
                    benefit, hits = place.benefit, cautions.hits_of(condition, place.name)
                    writer.writerow([condition.name, measure, rank, place.name, place.mean.count, place.mean.value,
                                     place.mean.half, *(place.left or ("", "", "")),
                                     benefit.value if benefit else "", benefit.half if benefit else "", *mean_lost,
                                     *((hits.hit, hits.load, hits.closest) if hits else ("", "", "")),
                                     "; ".join(place.like)])


def write_means(found, path):
    """Writes the means of all measures of management by condition and pattern, including those that rank nothing, each
    in the unit at the end of its name. An existing file is replaced."""
    with writing(path, newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["condition", "pattern", "measure", "fields", "mean", "half_of_95_percent"])
        for condition in found.conditions:
            for measure, patterns in condition.values.items():
                for name, values in patterns.items():
                    mean = ranking.mean_of(values.values())
                    writer.writerow([condition.name, name, measure, mean.count, mean.value, mean.half])
