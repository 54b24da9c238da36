"""Short names of values, runs and cases for figures and tables, formed from what differs between them."""
from __future__ import annotations

import json
import pathlib

#: Largest length of a name [characters]; longer ones are shortened in the middle. Larger: legends take more room.
#: Smaller: names that differ only in the middle become equal, and get numbers.
LONGEST = 40


def parsed(value):
    """The value of a cell of a study's table: parsed JSON if the cell is the text of an object or a list, otherwise the
    cell itself, also if the text is no JSON."""
    if isinstance(value, str) and value[:1] in ("{", "["):
        try:
            return json.loads(value)
        except ValueError:
            return value
    return value


def leaves(value, path=()):
    """{path: value} of all numbers, texts, truth values, nulls, and empty lists or objects within a JSON value. A path
    is a tuple of keys and indices; `path` is that of the value itself. A value that is neither an object nor a list is
    the only leaf."""
    if isinstance(value, dict) and value:
        return {at: leaf for key, item in value.items() for at, leaf in leaves(item, (*path, key)).items()}
    if isinstance(value, list) and value:
        return {at: leaf for key, item in enumerate(value) for at, leaf in leaves(item, (*path, key)).items()}
    return {path: value}


def number_in_words(value):
    """A number with up to six significant digits, a truth value or None as in JSON, and any other value as str() writes
    it."""
    if isinstance(value, bool) or value is None:
        return json.dumps(value)
    return f"{value:.6g}" if isinstance(value, (int, float)) else str(value)


#: Endings of keys that state a unit, without their underscore, and the unit for people. If several endings fit, the
#: longest one counts. Other endings remain a part of the name.
UNITS = {"m_per_s": "m/s", "deg": "°", "Pa": "Pa", "N": "N", "Nm": "N m", "J": "J", "kg": "kg", "MW": "MW", "m2": "m²",
         "m": "m", "s": "s"}


def leaf_in_words(path, value):
    """Describes one member of a value by its key and value: "depth 120 m" for depth_m. The key is the last text of the
    path; an item of a list also has its index, from 0: "position[1] 20 m". A text that is not empty is its own name,
    such as "circular" for pattern, and so is a value without a key. Underscores become blanks."""
    words = number_in_words(value) if not isinstance(value, (list, dict)) else json.dumps(value)
    key = next((part for part in reversed(path) if isinstance(part, str)), "")
    if not key or (isinstance(value, str) and value):
        return words.replace("_", " ")
    unit = next((unit for unit in sorted(UNITS, key=len, reverse=True) if key.endswith("_" + unit)), "")
    name = key.removesuffix("_" + unit) if unit else key
    index = f"[{path[-1]}]" if isinstance(path[-1], int) else ""
    shown = UNITS.get(unit, "")
    return f"{name.replace('_', ' ')}{index} {words}{'' if shown in ('', '°') else ' '}{shown}"


def short(words, longest=LONGEST):
    """Replaces the middle of a text by "…" if it has more than `longest` characters, so that it has at most so many.
    Both ends stay, because the differences of paths and lists are often there."""
    if len(words) <= longest:
        return words
    head = (longest - 1) // 2
    return f"{words[:head].rstrip()}…{words[head + 1 - longest:].lstrip()}"


def telling_paths(flat):
    """Paths of a few leaves that together distinguish as many of the values as possible. `flat` has the leaves of each
    value. The path that distinguishes most values is chosen first, then that which together with it distinguishes most,
    and so on; so the set is small, but perhaps not the smallest. Among equal paths those with texts are preferred,
    because they are better names, and then the first ones. The list is empty if all values have the same leaves."""
    paths = list(dict.fromkeys(path for leaf in flat for path in leaf))
    differing = [path for path in paths if len({repr(leaf.get(path)) for leaf in flat}) > 1]
    chosen, groups = [], 1

    def count(of):  # the number of values that the paths `of` distinguish
        return len({tuple(repr(leaf.get(path)) for path in of) for leaf in flat})

    while groups < len(flat):
        best = max((path for path in differing if path not in chosen), default=None,
                   key=lambda path: (count([*chosen, path]),
                                     any(isinstance(leaf.get(path), str) for leaf in flat), -paths.index(path)))
        if best is None or count([*chosen, best]) == groups:
            break
        chosen.append(best)
        groups = count(chosen)
    return chosen


def name_of_leaves(flat, chosen):
    """Describes a value with the leaves `flat` by those at the paths `chosen`. If it has none of these, its outermost
    keys are its name, or "none" if there are none."""
    found = [leaf_in_words(path, flat[path]) for path in chosen if path in flat]
    if found:
        return ", ".join(found)
    keys = list(dict.fromkeys(str(path[0]) for path in flat if path))
    return ", ".join(key.replace("_", " ") for key in keys) or "none"


def names_of(values):
    """{value: name} of the different values of a parameter, which are cells of a table. If all are numbers or texts, or
    all are lists of these, they are their own names. Otherwise they are named by a few of their members that
    distinguish them (telling_paths()); a single value is named by its texts, or else by its first member. Names are
    shortened to LONGEST, and equal names then get numbers."""
    different = list(dict.fromkeys(values))
    read = {value: parsed(value) for value in different}
    if not any(isinstance(item, (dict, list)) for item in read.values()):
        return unique({value: short(number_in_words(value)) for value in different})
    if all(isinstance(item, list) and not any(isinstance(part, (dict, list)) for part in item)
           for item in read.values()):  # a list of numbers is its own name
        return unique({value: short(json.dumps(item, ensure_ascii=False)) for value, item in read.items()})
    flat = {value: leaves(item) for value, item in read.items()}
    chosen = telling_paths(list(flat.values()))
    if not chosen:  # there is only one value
        words = [path for path, leaf in next(iter(flat.values())).items() if isinstance(leaf, str)]
        chosen = words or list(next(iter(flat.values())))[:1]
    return unique({value: short(name_of_leaves(flat[value], chosen)) for value in different})


def unique(names):
    """Returns {value: name} with numbers after names that several values have: "a (1)", "a (2)". `names` is {value:
    name}. That a name with its number may equal another name is not checked."""
    count, found = {}, {}
    taken = list(names.values())
    for value, name in names.items():
        count[name] = count.get(name, 0) + 1
        found[value] = name if taken.count(name) == 1 else f"{name} ({count[name]})"
    return found


def names_of_folders(folders):
    """Names of run folders, in their order: as many of their last path components as distinguish them, without final
    components that all share. A/run and B/run become A and B. A name of six digits is that of a study's case, and
    becomes "case 137". The same folder given twice gets numbers. For a single folder, or the same one only, a last
    component "run" is left out. Links are resolved before. `folders` must not be empty."""
    parts = [list(pathlib.Path(folder).resolve().parts) for folder in folders]
    is_told_apart = len(set(map(tuple, parts))) > 1
    while all(len(part) > 2 for part in parts) and len({part[-1] for part in parts}) == 1 and (
            is_told_apart or parts[0][-1] == "run"):
        parts = [part[:-1] for part in parts]
    depth = 1
    while depth < max(map(len, parts)) and len({tuple(part[-depth:]) for part in parts}) < len(set(map(tuple, parts))):
        depth += 1
    names = ["/".join(part[-depth:]) for part in parts]
    names = [f"case {int(name)}" if len(name) == 6 and name.isdigit() else name for name in names]
    return list(unique(dict(enumerate(map(short, names)))).values())
