"""Reads a study of ice management and ranks its patterns, separately for each of the conditions that it varies.

The parameters of the study have different roles. Some define patterns, which are ranked, such as the pilot of the
icebreaker. Seeds define fields of ice, over which means are taken. The rest, such as the drift, define conditions.
Values of parameters are compared as texts, as they are in the table; objects and lists are JSON."""
import dataclasses
import json
import math

from ..errors import InputError
from ..naming import leaf_in_words, names_of, parsed
from ..study.sample import follows
from . import cautions, ranking

# Beginning of the names of all measures of ice management in a study's table, as measures.measures_of() makes them.
PREFIX = "management_"
UNMANAGED = "not managed"  # name of the pattern without a managing ship, with which the others are compared
# Measures by which patterns are ranked, with their meanings and units; smaller is better. A measure that the study does
# not have is left out.
MEASURES = {
    "management_ice_load_mean_N": "mean load of the ice [N]",
    "management_ice_load_q99_N": "load of the ice exceeded 1 % of the time [N]",
    "management_mooring_load_mean_N": "mean load of the mooring [N]",
    "management_mooring_load_q99_N": "load of the mooring exceeded 1 % of the time [N]",
    "management_largest_at_body_m": "largest floe that arrives [m]",
}
SEEDS = ("seed", "repetition")  # columns of a study's table that together name a field of ice


@dataclasses.dataclass
class Condition:
    """Cases that differ only in their pattern and ice field."""

    name: str  #: values of the parameters that define it, in words; empty if there are none
    x: float  #: value of the parameter on the x axis of figures; 0 if there is none
    values: dict  #: measure -> pattern -> {field: value}, in the unit of the measure; a field is a tuple of seeds
    lost: dict  #: pattern -> {field: (area of ice that left the scene [m²], its fraction of all ice [-])}

    def ranked(self, measure):
        """Returns the patterns ranked by a measure, as a list of ranking.Place. The list is empty if the measure is 0
        in every case, or if no ice arrived in this condition, because then nothing was measured."""
        values = self.values.get(measure, {})
        if not cautions.has_arrived(self) or not any(value for of in values.values() for value in of.values()):
            return []
        return ranking.ranking(values, UNMANAGED)


@dataclasses.dataclass
class Found:
    """The finished cases of a study, arranged by conditions and patterns."""

    name: str  #: name of the study
    finished: int  #: number of finished cases
    cases: int  #: number of all cases
    by: list  #: names of the parameters that define patterns
    against: str  #: name of the parameter of the x axis; empty if there is none
    conditions: list  #: list of Condition in ascending order of `x`; one if only patterns and seeds vary
    patterns: list  #: names of patterns in the order of the study
    measures: list  #: names of all measures of ice management in the table that are numbers, with PREFIX
    body: str  #: name of the protected body, for messages; "the protected body" if the study does not state it


# Returns the different values of a column as texts, in the order of the table.
def different(table, name):
    return list(dict.fromkeys(str(value) for value in table[name]))


# Returns True if a cell of the table is a number. Truth values, texts, lists and objects are none.
def is_number(value):
    return isinstance(parsed(value), (int, float)) and not isinstance(parsed(value), bool)


def roles_of(plan, parameters, table):
    """Returns the roles of the parameters that the study varies: (by, against, rest).

    by: those that define patterns: report.group_by of the study, otherwise those whose values are objects, such as
    pilots, otherwise the first one. rest: the others, which define conditions. against: one of the rest for the x axis:
    report.against, otherwise one whose name contains "drift", otherwise the first one with only numbers; empty if there
    is none. A parameter of `by`, or one that follows from them, cannot be on the x axis; then the last of these rules
    holds. Raises InputError if only seeds are varied, or if report.against has values that are no numbers (x_of())."""
    asked = plan.get("report", {})
    varied = [name for name in parameters if name not in SEEDS and len(different(table, name)) > 1]
    if not varied:
        raise InputError("the study varies nothing but seeds: there is nothing to rank")
    objects = [name for name in varied if any(isinstance(parsed(value), dict) for value in different(table, name))]
    given = asked.get("against")
    if given in varied and not has_axis(table, given):
        raise InputError(f"report.against: {given} has values that are no numbers, so it cannot be an axis")
    against = given or next((name for name in varied if "drift" in name and has_axis(table, name)), None)
    grouped = asked.get("group_by") or objects or [name for name in varied if name != against][:1] or varied[:1]
    by = [grouped] if isinstance(grouped, str) else list(grouped)
    rest = [name for name in varied if name not in by and not follows(table, name, by)]
    if against not in rest:
        against = next((name for name in rest if all(is_number(value) for value in table[name])), "")
    return by, against or "", rest


def x_of(against, value):
    """Returns a number for a value of the parameter `against` on the x axis: the magnitude of a list of numbers, such
    as a velocity, and the absolute value of a drift, because the direction does not matter there. It is in the unit of
    the parameter. None if the value is neither a number nor such a list."""
    value = parsed(value)
    if isinstance(value, list) and value and all(isinstance(part, (int, float)) for part in value):
        return math.hypot(*value)
    if not is_number(value):
        return None
    return abs(float(value)) if "drift" in against else float(value)


def has_axis(table, name):
    """Returns True if every value of a parameter has a place on the x axis of a figure."""
    return all(x_of(name, value) is not None for value in table[name])


def path_of(name):
    """Returns the keys and indices of the path of a parameter, such as ("ships", "0", "speed_m_per_s"). The unit is
    found from the last key."""
    return tuple(name.replace("]", "").replace("[", ".").split("."))


def value_in_words(name, value):
    """Returns a text such as "drift 0.5 m/s" for a number, with the unit of the path `name`; a drift has no sign. Other
    values are returned as they are."""
    if not is_number(value):
        return str(value)
    keys = [part for part in path_of(name) if not part.isdigit()]
    return leaf_in_words((keys[-1],), x_of(name, value))


def names_of_values(values):
    """Returns {value: name} of the values of a parameter. Objects are named by their differences. If only one of them
    is a pilot that manages ice, its pattern is its name, because it differs from the others in everything."""
    names = names_of(values)
    managing = {value: parsed(value)["manage"] for value in names
                if isinstance(parsed(value), dict) and isinstance(parsed(value).get("manage"), dict)}
    if len(managing) == 1 and len(names) > 1:
        (value, pilot), = managing.items()
        names[value] = str(pilot.get("pattern", names[value])).replace("_", " ")
    return names


def pattern_names(table, by):
    """Returns {values of the parameters `by`: name} of the patterns, where the values are a tuple of texts. Names are
    formed from the differences; a pattern without a managing ship is named UNMANAGED, unless no pattern has one.
    Without the measure of icebreakers in the table, each pattern counts as managed."""
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


# Returns the conditions of the finished cases `rows`, in ascending order of x. A measure that is NaN in a case is left
# out. Of two cases with the same condition, pattern and field the later one counts; patterns with the same name are one
# pattern. For `by`, `against` and `rest` see roles_of(); `patterns` are the names of pattern_names().
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


# Reads a gathered study as Found. Unfinished cases are left out. Raises InputError if no case is finished, if the study
# has no measures of ice management or varies nothing but seeds, and FolderError if the folder is no gathered study.
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
    """Returns a Found as JSON for other programs: for each condition its contacts, its rankings by each of MEASURES
    that the study has, and the means of all measures by pattern. A mean without values is null. The keys are part of
    the interface of `polynya management`."""
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
