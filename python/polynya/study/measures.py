"""Measures of one finished run, from its files (docs/run-folder.md): the columns of a study's table, which
docs/studies.md explains, "Measures". Written in plain Python, so that a job needs little memory.

`collect` are the settings of that name in the study's file. `columns` are the columns of forces.csv of one ship, by
name; each row covers the interval since the previous one, and speeds, poses and powers are those at its end. Units are
those in the names of columns and measures. Forces are in the ship's frame: surge ahead, sway to port."""
import json
import math
import subprocess

from .. import files

# Columns of forces.csv that are measured always, before those of collect.loads. They are loads of contacts with ice.
LOADS = ("surge_N", "sway_N", "yaw_Nm")
# Probabilities of the quantiles of loads if collect.quantiles gives none. They are in the names of columns, such as
# resistance_q99_N.
QUANTILES = (0.5, 0.9, 0.99)
# Speed below which a ship counts as stopped if collect.stop_speed_m_per_s is not given [m/s]. A larger value gives more
# stopped time, and more often the outcome "stuck".
STOP_SPEED = 0.05
TEXT_COLUMNS = {"ship"}  # columns of forces.csv that are not numbers


def measure(run, collect, program):
    """Measures of the finished run in the folder `run`, by name; None if there is no value. They are those of the ship
    collect.ship, otherwise of the first one in forces.csv; without such a row there are no measures of loads and motion
    and no outcome. In a run with several ships or structures, `bends` and `splits` count only those of that ship.
    `program` is the path of polynya, for the channel. The same run gives the same measures on any machine. Raises
    ValueError for a ship or a load that the run does not have, and FolderError for a damaged folder."""
    files.check_run(run)
    summary = files.read_json(run / "summary.json")
    counts = summary["counts"]
    ships = rows_by_ship(run / "forces.csv")
    ship = collect.get("ship") or next(iter(ships), None)
    if ship is not None and ship not in ships:
        raise ValueError(f'the run has no ship or structure "{ship}" with a row in forces.csv')
    found = {"sim_time_s": summary["sim_time_s"]}
    found.update(
        {
            name: counts[name]
            for name in ("bends", "splits", "tilted_under", "rejected_cuts", "unconverged_steps", "floes_initial",
                         "floes_final")
        }
    )
    if len(ships) > 1:
        found.update(fractures_of(run / "events.ndjson", ship))
    if ship is not None:
        found.update(measures_of_ship(ships[ship], collect))
        found["outcome"] = outcome(found, ships[ship], collect)
        if collect.get("channel"):
            found["channel_width_m"] = channel_width(run, ship, program)
    if collect.get("management") is not None:
        from ..management import of_folder  # this needs numpy

        found.update(of_folder(run, collect["management"]))
    found["warnings"] = len(summary["warnings"])
    return found


def rows_by_ship(path):
    """Returns {ship: columns} of the forces.csv in the file `path`: the columns by name, with the rows of that ship or
    structure, in the order of their first rows. Raises FolderError if the file is damaged."""
    cells, rows = files.read_cells(path), {}
    for row, ship in enumerate(cells["ship"]):
        rows.setdefault(ship, []).append(row)
    columns = {
        name: values if name in TEXT_COLUMNS else files.numbers(values, path, name) for name, values in cells.items()
    }
    return {
        ship: files.Columns({name: [values[row] for row in own] for name, values in columns.items()}, path)
        for ship, own in rows.items()
    }


def measures_of_ship(columns, collect):
    """Measures of loads, motion, ramming and targets. Loads and motion count only after collect.from_s, and after the
    ship has sailed collect.from_m; ramming and targets count from the start. If the ship never gets that far, there are
    no columns of loads, and means are None. The resistance is the force of ice against the motion: minus surge, of
    contacts and of ice under the hull. Raises ValueError for a load that forces.csv lacks."""
    start = max(collect.get("from_s", 0), time_to(columns, {"distance_m": collect.get("from_m", 0)}, math.inf))
    kept = [i for i, t in enumerate(columns["t_s"]) if t > start]

    def of(name):
        if name not in columns:
            raise ValueError(f'forces.csv has no column "{name}"')
        column = columns[name]
        return [column[i] for i in kept]

    levels = collect.get("quantiles") or QUANTILES
    found = {}
    ice = of("surge_from_submerged_ice_N")
    resistance = [-(a + b) for a, b in zip(of("surge_N"), ice)]
    found.update(of_load("resistance", "_N", resistance, resistance, levels))
    for load in dict.fromkeys((*LOADS, *collect.get("loads", ()))):
        name, unit = load.rsplit("_", 1)
        values = of(load)
        found.update(of_load(name, "_" + unit, values, [abs(value) for value in values], levels))
        if f"{name}_max_{unit}" in columns:
            found[f"{name}_step_peak_{unit}"] = max((abs(value) for value in of(f"{name}_max_{unit}")), default=None)
    found.update(of_motion(columns, kept, collect))
    found.update(of_rams(columns))
    for name, target in collect.get("time_to", {}).items():
        found[f"time_to_{name}_s"] = time_to(columns, target)
    return found


def of_load(name, unit, values, sizes, levels):
    """Mean and standard deviation of the values of a load, and peak and quantiles of `sizes`, which are the resistance
    itself or the magnitudes of the load. The columns are called <name>_mean<unit> and so on, with a unit such as "_N".
    `levels` are the probabilities of the quantiles. Empty without values; the deviation of a single value is 0."""
    if not values:
        return {}
    mean = math.fsum(values) / len(values)
    found = {
        f"{name}_mean{unit}": mean,
        f"{name}_sd{unit}": math.sqrt(math.fsum((v - mean) ** 2 for v in values) / max(len(values) - 1, 1)),
    }
    ordered = sorted(sizes)
    for level in levels:
        found[f"{name}_q{level * 100:g}{unit}"] = quantile(ordered, level)
    found[f"{name}_peak{unit}"] = ordered[-1]
    return found


def quantile(ordered, level):
    """Quantile with the probability `level`, interpolated linearly between sorted values, as in numpy. There must be a
    value."""
    at = level * (len(ordered) - 1)
    low = int(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (at - low) * (ordered[high] - ordered[low])


def of_motion(columns, kept, collect):
    """Measures of speed, distance, stops and energy over the rows `kept` (indices), and the final pose of the run. A
    stop begins when the speed falls below the stop speed, after it was above twice that, so that a speed that varies
    about the limit is one stop, and a ship that never moved has none; `stopped_s` is its whole time below the limit.
    Energies per kilometre are work of the thrust and delivered power, None without a distance, and for the power
    without an engine."""
    times, speeds = columns["t_s"], columns["speed_m_per_s"]
    steps = [times[0]] + [b - a for a, b in zip(times, times[1:])]
    span = math.fsum(steps[i] for i in kept)
    distance = math.fsum(speeds[i] * steps[i] for i in kept)
    work = math.fsum(columns["thrust_N"][i] * forward_speed(columns, i) * steps[i] for i in kept)
    delivered = math.fsum(columns["delivered_power_W"][i] * steps[i] for i in kept)
    stop_speed = collect.get("stop_speed_m_per_s", STOP_SPEED)
    stops, is_moving = 0, False
    for i in kept:
        if is_moving and speeds[i] < stop_speed:
            stops, is_moving = stops + 1, False
        elif speeds[i] > 2 * stop_speed:
            is_moving = True
    return {
        "mean_speed_m_per_s": distance / span if span > 0 else None,
        "distance_m": distance,
        "stops": stops,
        "stopped_s": math.fsum(steps[i] for i in kept if speeds[i] < stop_speed),
        "energy_per_km_J": 1000 * work / distance if distance > 0 else None,
        "delivered_per_km_J": 1000 * delivered / distance if distance > 0 and delivered > 0 else None,
        "final_x_m": columns["x_m"][-1],
        "final_y_m": columns["y_m"][-1],
        "final_heading_deg": columns["heading_deg"][-1],
    }


def of_rams(columns):
    """Measures of a ramming ship: the number of charges after the first and the distance gained in all; then means per
    charge, from its start to the start of the next: distance gained, duration, and largest speed ahead. A charge starts
    when `rams` increases. Fewer than two such starts give means None, and a run without that column gives nothing."""
    if "rams" not in columns:
        return {}
    rams, gained, times = columns["rams"], columns["gained_m"], columns["t_s"]
    begins = [i for i in range(1, len(rams)) if rams[i] > rams[i - 1]]
    found = {"rams": rams[-1], "gained_m": gained[-1]}
    found |= {"ram_gain_m": None, "ram_time_s": None, "ram_speed_m_per_s": None}
    if len(begins) < 2:
        return found
    charges = len(begins) - 1
    fastest = [max(forward_speed(columns, i) for i in range(a, b)) for a, b in zip(begins, begins[1:])]
    found["ram_gain_m"] = (gained[begins[-1]] - gained[begins[0]]) / charges
    found["ram_time_s"] = (times[begins[-1]] - times[begins[0]]) / charges
    found["ram_speed_m_per_s"] = math.fsum(fastest) / charges
    return found


def forward_speed(columns, i):
    """Velocity over ground along the heading in row i [m/s]; negative astern."""
    heading = math.radians(columns["heading_deg"][i])
    return columns["vx_m_per_s"][i] * math.cos(heading) + columns["vy_m_per_s"][i] * math.sin(heading)


def time_to(columns, target, never=None):
    """Time of the first row in which the ship has reached the target [s], or `never`. A target is one of distance_m
    (sailed over ground), point_m with within_m, x_m and y_m, all in world coordinates [m]. A line x_m or y_m is reached
    from either side: when the ship is on another side of it than in the first row. A distance of 0 is reached at the
    time 0."""
    times, xs, ys = columns["t_s"], columns["x_m"], columns["y_m"]
    if "distance_m" in target:
        gone, before = 0.0, 0.0
        if target["distance_m"] == 0:
            return before
        for t, speed in zip(times, columns["speed_m_per_s"]):
            gone, before = gone + speed * (t - before), t
            if gone >= target["distance_m"]:
                return t
        return never
    if "point_m" in target:
        x, y = target["point_m"]
        return next((t for t, a, b in zip(times, xs, ys) if math.hypot(a - x, b - y) <= target["within_m"]), never)
    values, line = (xs, target["x_m"]) if "x_m" in target else (ys, target["y_m"])
    side = values[0] < line
    return next((t for t, value in zip(times, values) if (value < line) != side), never)


def outcome(found, columns, collect):
    """The outcome of the run in one word: "stuck" if the ship, without a mooring, is slower than the stop speed in the
    last row, otherwise "split" if a floe split, "bent" if a cusp broke by bending, or "pushed" if neither happened. The
    first of these that holds counts, so a ship that broke ice and then stopped is "stuck". pictures.OUTCOMES has the
    same words, and no colour for any other."""
    is_moored = any(columns["surge_from_mooring_N"]) or any(columns["sway_from_mooring_N"])
    if not is_moored and columns["speed_m_per_s"][-1] < collect.get("stop_speed_m_per_s", STOP_SPEED):
        return "stuck"
    return "split" if found["splits"] else "bent" if found["bends"] else "pushed"


def fractures_of(path, ship):
    """Numbers of cusps ("bends") and splits ("splits") that a ship or structure caused, from the file `path` of
    events.ndjson."""
    kinds = {"bend": 0, "split": 0}
    for event in files.read_json_lines(path):
        if event["kind"] in kinds and event["ship"] == ship:
            kinds[event["kind"]] += 1
    return {"bends": kinds["bend"], "splits": kinds["split"]}


def channel_width(run, ship, program):
    """Mean width of the channel behind the ship [m], measured by `polynya channel`; None if there is no channel, or if
    that command fails."""
    printed = subprocess.run(
        [program, "channel", run, "--json", "--ship", ship], capture_output=True, text=True, check=False
    )
    return json.loads(printed.stdout).get("mean_width_m") if printed.returncode == 0 else None
