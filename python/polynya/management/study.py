"""A study of ice management: means of its measures, by what it varies."""
import csv
import json
import math

from ..errors import InputError

SHOWN = {
    "management_mean_size_at_body_m": "mean size at the body, by area [m]",
    "management_largest_hit_m": "largest floe that touched it [m]",
    "management_hit_s": "time with floes of the size on it [s]",
    "management_ice_load_mean_N": "mean load of the ice [N]",
    "management_ice_load_q99_N": "load exceeded 1 % of the time [N]",
    "management_managed_width_m": "managed width [m]",
}


def mean_of(values):
    """Mean, and half of Student's 95 % interval."""
    from scipy import stats

    count = len(values)
    if not count:
        return None, 0.0
    mean = math.fsum(values) / count
    if count < 2:
        return mean, 0.0
    deviation = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (count - 1))
    return mean, float(stats.t.ppf(0.975, count - 1)) * deviation / math.sqrt(count)


def axes_of(found):
    """What the study varies: the parameter of the x axis (report.against, else one of drift, else the first that is a
    number), and the one that names groups (report.group_by, else what is left)."""
    asked = found.plan.get("report", {})
    seeds = ("seed", "repetition")
    varied = [name for name in found.parameters if name not in seeds
              and len({str(value) for value in found.table[name]}) > 1]
    if not varied:
        raise InputError("the study varies nothing but seeds")
    wanted = asked.get("against") or [name for name in varied if "drift" in name] or varied
    against = wanted if isinstance(wanted, str) else wanted[0]
    grouped = asked.get("group_by") or [name for name in varied if name != against]
    return against, ([grouped] if isinstance(grouped, str) else list(grouped))[:1]


def x_of(value):
    """A number of a parameter's value: of a velocity its speed."""
    try:
        parsed = json.loads(str(value))
    except ValueError:
        return None
    return math.hypot(*parsed) if isinstance(parsed,
                                             list) else float(parsed) if isinstance(parsed, (int, float)) else None


def name_of(value):
    """Of a pilot its pattern; of anything else what it is."""
    try:
        parsed = json.loads(str(value))
    except ValueError:
        return str(value)
    if not isinstance(parsed, dict):
        return str(value)
    return parsed["manage"]["pattern"] if "manage" in parsed else "not managed"


def groups_of(rows, against, by, measures):
    """name -> measure -> [(x, mean, half)], in the order of the table."""
    cells = {}
    for row in rows:
        x = x_of(row[against])
        x = abs(x) if "drift" in against and x is not None else x  # its speed
        group = ", ".join(name_of(row[name]) for name in by) or "all"
        for measure in measures:
            value = row[measure]
            kept = cells.setdefault(group, {}).setdefault(measure, {}).setdefault(x, [])
            if not math.isnan(value):
                kept.append(float(value))
    return {
        group: {measure: [(x, *mean_of(values)) for x, values in sorted(by_x.items())] for measure, by_x in of.items()}
        for group, of in cells.items()
    }


def report(folder, out, as_json, draw):
    from ..results.study import Study

    found = Study(folder, unfinished=True, pandas=False)
    measures = [name for name in found.measures if name.startswith("management_")]
    if not measures:
        raise InputError(f"{folder}: the study has no measures of ice management: collect.management asks for them")
    against, by = axes_of(found)
    table = found.table
    rows = [row for row in table if row["state"] == "finished"]
    numeric = [name for name in measures if table[name].dtype.kind == "f"]
    groups = groups_of(rows, against, by, numeric)
    if as_json:
        print(json.dumps(groups, indent=2))
        return 0
    shown = {name: words for name, words in SHOWN.items() if name in numeric}
    print(f"{len(rows)} of {len(table)} cases; against {against}, by {', '.join(by) or 'nothing'}")
    for measure, words in shown.items():
        print(words)
        for group, of in groups.items():
            cells = [f"{x:g}: {mean:.4g} ± {half:.2g}" for x, mean, half in of[measure] if mean is not None]
            print(f"  {group:20}" + "".join(f"{cell:>26}" for cell in cells))
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "management.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["group", against, "measure", "mean", "half_of_95_percent"])
        for group, of in groups.items():
            for measure, points in of.items():
                writer.writerows([group, x, measure, mean, half] for x, mean, half in points)
    print(f"table   {out / 'management.csv'}")
    draw(lambda figure, path: figure.draw_study(groups, against, shown, path), out / "management.png")
    return 0
