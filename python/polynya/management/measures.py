"""Measures of ice management of a run, for the table of a study (`collect.management`). The protected body is the ship
or structure that icebreakers keep free of ice. Gates are lines across the drift upstream of it (gates.py). Only times
after `gates.start` count, if nothing else is said."""
import dataclasses

import numpy

from .cover import covers
from .encounters import beyond_gate, encounters_of
from .gates import gates_of, managed_width, managing, passages

# Quantiles of loads over time that are measured [-]. The names of the measures contain them: 0.99 makes ice_load_q99_N.
# Another value renames a column of the tables, and rankings by it (study.MEASURES) no longer find it.
LEVELS = (0.5, 0.9, 0.99)


def hits_on(run, gates):
    """Contacts of the body with floes of at least the size `gates.size`, from the rows of contacts.csv. A row at a peak
    between two frames counts at the later frame, so a contact between frames without a recorded peak is missed. A
    contact that continues from frame to frame counts once. Returns the size √area of the floe of each contact [m], in
    no order, the number of contacts, and the time with any contact [s], which is the number of such frames times their
    interval. Returns None if the scene records no contacts. `run` is a results.run.Run, `gates` a gates.Gates."""
    if run.scene["record"]["contacts"] == "none":
        return None
    contacts, births = run._table("contacts.csv", ""), run.births
    ships, floes = numpy.asarray(contacts["ship"]), numpy.asarray(contacts["floe_id"])
    by_ship, by_floe = numpy.asarray(contacts["by_ship"]), numpy.asarray(contacts["by_floe_id"])
    times = numpy.asarray(contacts["t_s"])
    is_body = ((ships == gates.body) & (by_floe >= 0)) | ((by_ship == gates.body) & (floes >= 0))
    is_body &= times > gates.start
    touched = numpy.where(ships[is_body] == gates.body, by_floe[is_body], floes[is_body]).astype(int)
    # A time between two frames counts at the later one; 1e-6 s are for times that files round differently.
    touches = set(zip(touched.tolist(), numpy.searchsorted(run.times, times[is_body] - 1e-6).tolist()))
    touches = {(floe, frame) for floe, frame in touches if births["area_m2"][floe] >= gates.size**2}
    begun = [(floe, frame) for floe, frame in touches if (floe, frame - 1) not in touches]
    sizes = numpy.sqrt(births["area_m2"][[floe for floe, _ in begun]]) if begun else numpy.empty(0)
    seconds = len({frame for _, frame in touches}) * run.scene["record"]["frames_interval_s"]
    return sizes, len(begun), float(seconds)


def largest_touch(run, gates):
    """Size √area of the largest floe that touched the body, of any size [m]: 0 if none did, None if contacts were not
    recorded."""
    found = hits_on(run, dataclasses.replace(gates, size=0.0))
    return None if found is None else float(found[0].max(initial=0))


def rows_of(run, ship, start=0.0):
    """Columns of forces.csv, as {name: array}, with only the rows of a ship or structure after a time [s]. The arrays
    are empty if there is no such row, for example if there is no body of this name."""
    columns = run.force_columns
    kept = (columns["ship"] == ship) & (columns["t_s"] > start)
    return {name: values[kept] for name, values in columns.items()}


def loads_on(run, gates):
    """Magnitudes of the horizontal loads on the body [N], one per row of forces.csv, of which each is the mean of an
    interval. Returns {"ice_load": array}, and "mooring_load" too if the body has a mooring. The load of the ice
    includes the force of the ice under the hull. Only rows after gates.start count."""
    rows = rows_of(run, gates.body, gates.start)
    ice = numpy.hypot(*(rows[f"{along}_N"] + rows[f"{along}_from_submerged_ice_N"] for along in ("surge", "sway")))
    mooring = numpy.hypot(rows["surge_from_mooring_N"], rows["sway_from_mooring_N"])
    return {"ice_load": ice, **({"mooring_load": mooring} if is_moored(run.scene, gates.body) else {})}


def is_moored(scene, body):
    """Returns True if the body is a ship with a mooring in the scene, also if it breaks in the run. A structure has
    none."""
    return any(ship["name"] == body and ship.get("mooring") for ship in scene["ships"])


def broken_moorings(run, body):
    """Number of moorings of the body that broke in the whole run; None if it has none. A ship adrift loads no mooring,
    so the loads of its mooring are then too small."""
    if not is_moored(run.scene, body):
        return None
    events = run.event_columns
    return int(numpy.count_nonzero((events["kind"] == "mooring_break") & (events["ship"] == body)))


def effort(run, start=0.0):
    """For each ship that manages ice, after the time `start` [s]: the distance sailed [m] and the energy that its
    engine delivered [J], both as sums over rows of forces.csv of the value of a row times its interval. Returns {ship:
    {"distance_m", "energy_J"}}, empty without such a ship."""
    found = {}
    for ship in managing(run.scene):
        rows = rows_of(run, ship)
        steps = numpy.diff(rows["t_s"], prepend=0)
        kept = rows["t_s"] > start
        found[ship] = {
            "distance_m": float((rows["speed_m_per_s"] * steps)[kept].sum()),
            "energy_J": float((rows["delivered_power_W"] * steps)[kept].sum()),
        }
    return found


def ice_lost(ledger):
    """Area of the ice that left the scene in the whole run [m²], and its fraction of all initial ice [-], 0 without
    initial ice. `ledger` is that of summary.json. Ice leaves as cusps that are removed, as pieces below the size limit
    with rims and slivers, and as ice that found no room to surface. If it is not small, the loads and sizes at the body
    are too low."""
    area = sum(ledger[f"{place}_area_m2"] for place in ("submerged", "brash", "under_ice"))
    return area, area / ledger["initial_ice_area_m2"] if ledger["initial_ice_area_m2"] > 0 else 0.0


def ice_measures(run, gates):
    """Measures of the ice that passed the gate upstream and the gate at the body: numbers of floes, fractions of cover,
    sizes √area [m], of which the mean is weighted by area, and the width around the body in which no floe of gates.size
    or more passed [m]. Sizes are None if no floe passed."""
    found, (before, after) = {}, passages(run, gates)
    for name, passage, cover in zip(("upstream", "at_body"), (before, after), covers(run, gates)):
        found[f"floes_{name}"] = len(passage.areas)
        found[f"cover_{name}"] = cover
        found[f"mean_size_{name}_m"] = passage.mean_size
        found[f"largest_{name}_m"] = float(passage.sizes.max()) if len(passage.areas) else None
    found["managed_width_m"] = managed_width(after, gates)
    return found


def load_measures(run, gates):
    """Measures of the loads on the body by ice and mooring [N]: mean, largest value and quantiles of the rows of
    forces.csv, and the number of broken moorings. Those of a mooring are None if the body has none; all loads are None
    if forces.csv has no row of the body after gates.start. Each row is a mean over an interval, so a peak within it is
    larger."""
    loads, found = loads_on(run, gates), {}
    for name in ("ice_load", "mooring_load"):
        of = loads.get(name, ())
        found[f"{name}_mean_N"], found[f"{name}_peak_N"] = (float(of.mean()), float(of.max())) if len(of) else (None,
                                                                                                                None)
        for level in LEVELS:
            found[f"{name}_q{level * 100:g}_N"] = float(numpy.quantile(of, level)) if len(of) else None
    found["moorings_broken"] = broken_moorings(run, gates.body)
    return found


def ship_measures(run, gates):
    """Measures of the ships that manage ice: number, distance [m], energy [J], and time beyond the upstream gate [s].
    Measures of encounters of the body with any other ship in the whole run, also before gates.start: number of
    contacts, largest load [N] and smallest distance [m], None if there is no other ship. Without a managing ship the
    first three are 0."""
    ships, met = effort(run, gates.start).values(), encounters_of(run, gates.body)
    return {"icebreakers": len(ships),
            "icebreaker_distance_m": sum(ship["distance_m"] for ship in ships),
            "icebreaker_energy_J": sum(ship["energy_J"] for ship in ships),
            "ship_hits": met.hits if met else None,
            "ship_load_peak_N": met.load if met else None,
            "ship_distance_m": met.distance if met else None,
            "ships_beyond_gate_s": beyond_gate(run, gates)}


def measures_of(run, given):
    """All measures by name, with the prefix management_ of the table's columns; None if there is no value. `given` is
    `collect.management` of a study, which may state the body and the gates. Raises InputError if they can be neither
    found in it nor derived (gates.gates_of()), and FolderError if a file of the run is missing or damaged."""
    gates = gates_of(run, given)
    found = ice_measures(run, gates)
    hits = hits_on(run, gates)
    found["hits"], found["hit_s"] = hits[1:] if hits else (None, None)
    found["largest_hit_m"] = largest_touch(run, gates)
    found.update(load_measures(run, gates))
    found.update(ship_measures(run, gates))
    found["ice_lost_m2"], found["ice_lost_share"] = ice_lost(run.summary["ledger"])
    return {f"management_{name}": value for name, value in found.items()}
