"""Ranks the patterns of a study of ice management, for each of the conditions that it varies."""
import dataclasses
import json
import math

from ..errors import InputError
from ..naming import leaf_in_words, names_of, parsed
from . import cautions, ranking

PREFIX = "management_"
UNMANAGED = "not managed"
MEASURES = {  # measures by which patterns are ranked; smaller is better
    "management_ice_load_mean_N": "mean load of the ice [N]",
    "management_ice_load_q99_N": "load of the ice exceeded 1 % of the time [N]",
    "management_mooring_load_mean_N": "mean load of the mooring [N]",
    "management_mooring_load_q99_N": "load of the mooring exceeded 1 % of the time [N]",
    "management_largest_at_body_m": "largest floe that arrives [m]",
}
SEEDS = ("seed", "repetition")


@dataclasses.dataclass
class Condition:
    """Cases that differ only in their pattern and ice field: measure -> pattern -> {field: value}."""

    name: str
    x: float  #: value of the parameter on the x axis of figures; 0 if there is none
    values: dict
    lost: dict  #: pattern -> {field: (area of ice that left the scene [m²], its fraction of all ice)}

    def ranked(self, measure):
        """Patterns by a measure. A measure that is 0 in every case ranks nothing, and neither does a condition in which
        no ice arrived."""
        values = self.values.get(measure, {})
        if not cautions.has_arrived(self) or not any(value for of in values.values() for value in of.values()):
            return []
        return ranking.ranking(values, UNMANAGED)


@dataclasses.dataclass
class Found:
    """Results of a study for its patterns."""

    name: str
    finished: int
    cases: int
    by: list  #: parameters that define patterns
    against: str  #: parameter of the x axis; empty if there is none
    conditions: list
    patterns: list  #: names of patterns in the order of the study
    measures: list
    body: str  #: name of the protected body


def different(table, name):
    return list(dict.fromkeys(str(value) for value in table[name]))


def is_number(value):
    return isinstance(parsed(value), (int, float)) and not isinstance(parsed(value), bool)


def follows(table, name, others):
    """Returns True if a parameter has one value for each combination of the others, because it was set together with
    them."""
    values = {}
    for row in table:
        key = tuple(str(row[other]) for other in others)
        if values.setdefault(key, str(row[name])) != str(row[name]):
            return False
    return True


def roles_of(plan, parameters, table):
    """Finds the roles of parameters: those that define patterns (report.group_by, otherwise those with objects,
    otherwise the first), the one on the x axis (report.against, otherwise one of drift, otherwise one with numbers),
    and the rest, which define conditions."""
    asked = plan.get("report", {})
    varied = [name for name in parameters if name not in SEEDS and len(different(table, name)) > 1]
    if not varied:
        raise InputError("the study varies nothing but seeds: there is nothing to rank")
    objects = [name for name in varied if any(isinstance(parsed(value), dict) for value in different(table, name))]
    given = asked.get("against")
    against = given or next((name for name in varied if "drift" in name and name not in objects), None)
    grouped = asked.get("group_by") or objects or [name for name in varied if name != against][:1] or varied[:1]
    by = [grouped] if isinstance(grouped, str) else list(grouped)
    rest = [name for name in varied if name not in by and not follows(table, name, by)]
    if against not in rest:
        against = next((name for name in rest if all(is_number(value) for value in table[name])), "")
    return by, against or "", rest


def x_of(against, value):
    """A number for a value of the parameter on the x axis; for a velocity its speed."""
    value = parsed(value)
    if isinstance(value, list) and value and all(isinstance(part, (int, float)) for part in value):
        return math.hypot(*value)
    if not is_number(value):
        return None
    return abs(float(value)) if "drift" in against else float(value)


def path_of(name):
    """Parts of the path of a parameter, from which its unit is found."""
    return tuple(name.replace("]", "").replace("[", ".").split("."))


def value_in_words(name, value):
    """"drift 0.5 m/s" for a number with the unit of its path."""
    if not is_number(value):
        return str(value)
    keys = [part for part in path_of(name) if not part.isdigit()]
    return leaf_in_words((keys[-1],), x_of(name, value))


def names_of_values(values):
    """{value: name} of the values of a parameter. If only one of them is a pilot that manages ice, its pattern is its
    name, because it differs from the others in everything."""
    names = names_of(values)
    managing = {value: parsed(value)["manage"] for value in names
                if isinstance(parsed(value), dict) and isinstance(parsed(value).get("manage"), dict)}
    if len(managing) == 1 and len(names) > 1:
        (value, pilot), = managing.items()
        names[value] = str(pilot.get("pattern", names[value])).replace("_", " ")
    return names


def pattern_names(table, by):
    """{values: name} of the patterns, formed from the differences. Patterns without a managing ship are named as not
    managed."""
    names = {name: names_of_values([str(value) for value in table[name]]) for name in by}
    found = {}
    for row in table:
        key = tuple(str(row[name]) for name in by)
        words = ", ".join(names[name][str(row[name])] if isinstance(parsed(row[name]), (dict, list)) or len(by) == 1
                          else value_in_words(name, row[name]) for name in by)
        has_none = f"{PREFIX}icebreakers" in table.dtype.names and row[f"{PREFIX}icebreakers"] == 0
        found.setdefault(key, UNMANAGED if has_none else words)
    managed = [name for name in found.values() if name != UNMANAGED]
    if not managed:  # in a study without icebreakers, groups have their own names
        return {key: ", ".join(names[name][value] for name, value in zip(by, key)) for key in found}
    return found


def conditions_of(rows, by, against, rest, patterns, measures):
    found = {}
    for row in rows:
        key = tuple(str(row[name]) for name in rest)
        words = ", ".join(value_in_words(name, row[name]) for name in rest)
        x = x_of(against, row[against]) if against else 0.0
        condition = found.setdefault(key, Condition(words, x, {}, {}))
        pattern = patterns[tuple(str(row[name]) for name in by)]
        field = tuple(str(row[name]) for name in SEEDS if name in row.dtype.names)
        for measure in measures:
            if not math.isnan(row[measure]):
                condition.values.setdefault(measure, {}).setdefault(pattern, {})[field] = float(row[measure])
        if f"{PREFIX}ice_lost_m2" in row.dtype.names:
            lost = (float(row[f"{PREFIX}ice_lost_m2"]), float(row[f"{PREFIX}ice_lost_share"]))
            condition.lost.setdefault(pattern, {})[field] = lost
    return sorted(found.values(), key=lambda condition: condition.x)


def read(folder):
    from ..results.study import Study

    study = Study(folder, unfinished=True, pandas=False)
    table = study.table
    rows = table[table["state"] == "finished"]
    if not len(rows):
        raise InputError(f"{folder}: no case is finished: polynya study run {folder}, then polynya study gather "
                         f"{folder}")
    measures = [name for name in study.measures if name.startswith(PREFIX) and table[name].dtype.kind == "f"]
    if not measures:
        raise InputError(f"{folder}: the study has no measures of ice management: collect.management asks for them")
    by, against, rest = roles_of(study.plan, study.parameters, table)
    patterns = pattern_names(rows, by)
    conditions = conditions_of(rows, by, against, rest, patterns, measures)
    names = list(dict.fromkeys(patterns.values()))
    body = study.plan.get("collect", {}).get("management", {}).get("body") or "the protected body"
    return Found(study.name, len(rows), len(table), by, against, conditions, names, measures, body)


def in_json(found):
    """All ranked results, and the means of all measures."""
    def of(mean):
        return None if mean is None else dataclasses.asdict(mean)

    def hits(condition):
        known = {name: cautions.hits_of(condition, name) for name in found.patterns}
        return {name: dataclasses.asdict(hits) for name, hits in known.items() if hits}

    return json.dumps({
        "study": found.name, "warnings": cautions.of_study(found), "finished": found.finished, "cases": found.cases,
        "by": found.by, "against": found.against,
        "conditions": [{
            "name": condition.name, "x": condition.x, "contacts": hits(condition),
            "ranking": {measure: [dataclasses.asdict(place) for place in condition.ranked(measure)]
                        for measure in MEASURES if measure in found.measures},
            "means": {measure: {pattern: of(ranking.mean_of(values.values())) for pattern, values in of_pattern.items()}
                      for measure, of_pattern in condition.values.items()},
        } for condition in found.conditions]}, indent=2)
