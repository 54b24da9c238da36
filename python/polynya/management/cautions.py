"""Warnings, in sentences, about reasons not to rely on a measurement of ice management: contacts of the protected body
with a ship, ice that did not arrive, a broken mooring, a ship beyond the upstream gate, too few fields of ice.

A study compares patterns, which are ways to manage ice, in conditions, such as speeds of drift. Each pattern meets
several fields of ice, which differ in their seeds. `found` is management.study.Found, `condition` one of its
conditions."""
from __future__ import annotations

import dataclasses
from typing import Optional

from ..readable import force

#: Intervals over fewer fields of ice than this get a warning, because so few values barely show the scatter. A larger
#: number warns more studies; results do not change.
LEAST_FIELDS = 5
MOST_LISTED = 4  #: largest number of conditions that a sentence lists; it gives only the number of the others
PREFIX = "management_"  # of the names of measures in the tables of studies
ARRIVALS = ("floes_at_body", "ice_load_peak_N")  # if these are 0, no ice arrived at the body


@dataclasses.dataclass(frozen=True)
class Hits:
    """Contacts of the protected body with other ships, of one pattern in one condition."""

    hit: int  #: number of fields with a contact
    fields: int  #: number of fields in which contacts were measured
    load: float  #: largest load of all contacts, mean over a row of forces.csv [N]
    closest: Optional[float]  #: smallest distance between the waterlines in all fields [m]; None: not measured


def values_of(condition, measure, pattern):
    """{field: value} of a measure, given without PREFIX; empty if it was not measured."""
    return condition.values.get(PREFIX + measure, {}).get(pattern, {})


def hits_of(condition, pattern) -> Optional[Hits]:
    """Contacts of the body with ships under a pattern, as Hits; None if they were not measured. If loads were not
    measured, `load` is 0; if distances were not, `closest` is None."""
    hits = values_of(condition, "ship_hits", pattern).values()
    if not hits:
        return None
    loads = values_of(condition, "ship_load_peak_N", pattern).values()
    distances = values_of(condition, "ship_distance_m", pattern).values()
    return Hits(sum(hit > 0 for hit in hits), len(hits), max(loads, default=0.0), min(distances, default=None))


def has_arrived(condition):
    """Returns False if it is known that no ice arrived at the body in any field of any pattern. Returns True if neither
    of ARRIVALS was measured. A condition without ice is not ranked (management.study)."""
    known = [values for name in ARRIVALS for values in condition.values.get(PREFIX + name, {}).values()]
    return not known or any(value > 0 for values in known for value in values.values())


def without_ice(condition, pattern):
    """Returns the number of fields of a pattern in which no ice passed the upstream gate and none arrived at the body,
    and the number of its fields in which all three measures are known."""
    of = [values_of(condition, name, pattern) for name in ("floes_upstream", *ARRIVALS)]
    fields = [field for field in of[0] if all(field in values for values in of)]
    return sum(all(values[field] == 0 for values in of) for field in fields), len(fields)


def counted(condition, number, fields):
    """"1 of 6 fields", with the name of the condition if it has one, as in a study with several."""
    return f"{number} of {fields} fields" + (f" ({condition.name})" if condition.name else "")


def listed(parts):
    """Joins texts on conditions, at most MOST_LISTED, with the number of the others."""
    more = f" and {len(parts) - MOST_LISTED} more conditions" if len(parts) > MOST_LISTED else ""
    return ", ".join(parts[:MOST_LISTED]) + more


def contacts(found):
    """A sentence for each pattern with contacts, the one with the largest load first."""
    lines = []
    for pattern in found.patterns:
        pairs = [(condition, hits_of(condition, pattern)) for condition in found.conditions]
        pairs = [(condition, hits) for condition, hits in pairs if hits and hits.hit]
        if pairs:
            most = max(hits.load for _, hits in pairs)
            where = listed([counted(condition, hits.hit, hits.fields) for condition, hits in pairs])
            lines.append((-most, f"{pattern}: a ship hit {found.body} in {where}, with up to {force(most)} (mean over "
                                 "a row of forces.csv). The loads of this pattern are not a benefit: choose a larger "
                                 "distance or safety radius, or less speed."))
    return [line for _, line in sorted(lines)]


def not_measured(found):
    """A list with a sentence for results of an earlier version, which did not measure contacts of ships; empty if any
    contacts were measured, or if no ship managed ice."""
    known = any(hits_of(condition, pattern) for condition in found.conditions for pattern in found.patterns)
    has_ships = any(value for condition in found.conditions for pattern in found.patterns
                    for value in values_of(condition, "icebreakers", pattern).values())
    if known or not has_ships:
        return []
    return [f"it was not measured whether an icebreaker hit {found.body}, because an earlier version ran the cases. "
            "Plan the study in a new folder and run it again."]


def no_ice(found):
    """Sentences on conditions in which no ice arrived in any pattern, and then on patterns with single fields without
    ice in the other conditions."""
    empty = [condition for condition in found.conditions if not has_arrived(condition)]
    lines = []
    if empty:
        names = listed([condition.name for condition in empty if condition.name])
        lines.append(f"{names + ': ' if names else ''}no ice arrived at {found.body} in any pattern, so nothing was "
                     "measured and nothing is ranked. Run longer (time.until_s), count from an earlier time (from_s), "
                     "or check that the ice drifts towards the body.")
    for pattern in found.patterns:
        counts = [(condition, *without_ice(condition, pattern)) for condition in found.conditions
                  if condition not in empty]
        counts = [counted(*of) for of in counts if of[1]]
        if counts:
            lines.append(f"{pattern}: no ice passed either gate in {listed(counts)}. Loads of 0 of these fields are "
                         "not measurements.")
    return lines


def moorings(found):
    """A sentence for each pattern with fields in which the mooring of the body broke."""
    lines = []
    for pattern in found.patterns:
        counts = [(condition, values_of(condition, "moorings_broken", pattern)) for condition in found.conditions]
        counts = [counted(condition, sum(value > 0 for value in values.values()), len(values))
                  for condition, values in counts if any(value > 0 for value in values.values())]
        if counts:
            lines.append(f"{pattern}: the mooring of {found.body} broke in {listed(counts)}. Loads after that are "
                         "those of a ship adrift.")
    return lines


def beyond_gate(found):
    """A sentence on all patterns whose ships sailed beyond the upstream gate; none if there are no such patterns."""
    names = [pattern for pattern in found.patterns for condition in found.conditions
             if any(value > 0 for value in values_of(condition, "ships_beyond_gate_s", pattern).values())]
    if not names:
        return []
    return [f"{'; '.join(dict.fromkeys(names))}: a ship sailed beyond the upstream gate, so the ice that is counted "
            "there is partly broken already. Give a larger upstream_m to compare it."]


def few_fields(found):
    """A list with a sentence if a pattern has fewer than LEAST_FIELDS fields of ice by any measure in any condition. It
    states the smallest number."""
    counts = [len(values) for condition in found.conditions for of in condition.values.values()
              for values in of.values()]
    if not counts or min(counts) >= LEAST_FIELDS:
        return []
    fields = f"{min(counts)} field{'s' if min(counts) > 1 else ''} of ice (seeds)"
    return [f"{fields}: intervals over fewer than {LEAST_FIELDS} are not to be trusted. Give the study six repetitions "
            "or more; finished cases are kept."]


def of_study(found):
    """All sentences on the results of a study, the most serious first."""
    return [*contacts(found), *no_ice(found), *moorings(found), *not_measured(found), *few_fields(found),
            *beyond_gate(found)]


def of_measures(measures, body):
    """Yields the sentences on a single run from its measures by name (measures.measures_of). `body` is the name of the
    protected body. A measure that is missing or None counts as 0."""
    of = lambda name: measures.get(PREFIX + name) or 0
    if of("ship_hits"):
        yield (f"a ship hit {body} {of('ship_hits')} time{'s' if of('ship_hits') > 1 else ''}, with up to "
               f"{force(of('ship_load_peak_N'))} (mean over a row of forces.csv). The loads of this run are not a "
               "benefit.")
    if not any(of(name) for name in ARRIVALS):
        yield f"no ice arrived at {body}, so nothing was measured."
    if of("moorings_broken"):
        yield f"the mooring of {body} broke. Loads after that are those of a ship adrift."
    if of("ships_beyond_gate_s"):
        yield "a ship sailed beyond the upstream gate, so the ice that is counted there is partly broken already."
