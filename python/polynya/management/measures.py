"""Measures of ice management of a run, for the table of a study."""
import dataclasses

import numpy

from .gates import gates_of, managed_width, managing, passages

LEVELS = (0.5, 0.9, 0.99)


def hits_on(run, gates):
    """Contacts of the body with floes of at least that size, at the recorded frames. A contact that continues from
    frame to frame counts once. Returns sizes √area [m], number and durations [s]; nothing if contacts were not
    recorded."""
    if run.scene["record"]["contacts"] == "none":
        return None
    contacts, births = run._table("contacts.csv", ""), run.births
    ships, floes = numpy.asarray(contacts["ship"]), numpy.asarray(contacts["floe_id"])
    by_ship, by_floe = numpy.asarray(contacts["by_ship"]), numpy.asarray(contacts["by_floe_id"])
    times = numpy.asarray(contacts["t_s"])
    is_body = ((ships == gates.body) & (by_floe >= 0)) | ((by_ship == gates.body) & (floes >= 0))
    is_body &= times > gates.start
    touched = numpy.where(ships[is_body] == gates.body, by_floe[is_body], floes[is_body]).astype(int)
    touches = set(zip(touched.tolist(), numpy.searchsorted(run.times, times[is_body] - 1e-6).tolist()))
    touches = {(floe, frame) for floe, frame in touches if births["area_m2"][floe] >= gates.size**2}
    begun = [(floe, frame) for floe, frame in touches if (floe, frame - 1) not in touches]
    sizes = numpy.sqrt(births["area_m2"][[floe for floe, _ in begun]]) if begun else numpy.empty(0)
    seconds = len({frame for _, frame in touches}) * run.scene["record"]["frames_interval_s"]
    return sizes, len(begun), float(seconds)


def largest_touch(run, gates):
    """Size √area of the largest floe that touched the body [m]."""
    found = hits_on(run, dataclasses.replace(gates, size=0.0))
    return None if found is None else float(found[0].max(initial=0))


def rows_of(run, ship, start=0.0):
    columns = run.force_columns
    kept = (columns["ship"] == ship) & (columns["t_s"] > start)
    return {name: values[kept] for name, values in columns.items()}


def loads_on(run, gates):
    """Magnitudes of the horizontal loads on the body, one per row of forces.csv [N]: by ice, and by its mooring."""
    rows = rows_of(run, gates.body, gates.start)
    ice = numpy.hypot(rows["surge_N"] + rows["surge_from_submerged_ice_N"], rows["sway_N"])
    mooring = numpy.hypot(rows["surge_from_mooring_N"], rows["sway_from_mooring_N"])
    return {"ice_load": ice, "mooring_load": mooring}


def effort(run, start=0.0):
    """For each ship that manages ice: the distance sailed [m] and the energy that its engine delivered [J]."""
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
    """Area of the ice that left the scene in the whole run [m²], and its fraction of all initial ice [-]. Ice leaves as
    cusps that are removed, as pieces below the size limit with rims and slivers, and as ice that found no room to
    surface. If it is not small, the loads and sizes at the body are too low."""
    area = sum(ledger[f"{place}_area_m2"] for place in ("submerged", "brash", "under_ice"))
    return area, area / ledger["initial_ice_area_m2"] if ledger["initial_ice_area_m2"] > 0 else 0.0


def measures_of(run, given):
    """Measures by name, None if there is no value. `given` is `collect.management` of a study."""
    gates = gates_of(run, given)
    before, after = passages(run, gates)
    found = {}
    for name, passage in (("upstream", before), ("at_body", after)):
        found[f"floes_{name}"] = len(passage.areas)
        found[f"cover_{name}"] = passage.cover
        found[f"mean_size_{name}_m"] = passage.mean_size
        found[f"largest_{name}_m"] = float(passage.sizes.max()) if len(passage.areas) else None
    found["managed_width_m"] = managed_width(after, gates)
    hits = hits_on(run, gates)
    found["hits"], found["hit_s"] = hits[1:] if hits else (None, None)
    found["largest_hit_m"] = largest_touch(run, gates)
    for name, loads in loads_on(run, gates).items():
        if not len(loads):
            continue
        found[f"{name}_mean_N"], found[f"{name}_peak_N"] = float(loads.mean()), float(loads.max())
        for level in LEVELS:
            found[f"{name}_q{level * 100:g}_N"] = float(numpy.quantile(loads, level))
    ships = effort(run, gates.start).values()
    found["icebreakers"] = len(ships)
    found["icebreaker_distance_m"] = sum(ship["distance_m"] for ship in ships)
    found["icebreaker_energy_J"] = sum(ship["energy_J"] for ship in ships)
    found["ice_lost_m2"], found["ice_lost_share"] = ice_lost(run.summary["ledger"])
    return {f"management_{name}": value for name, value in found.items()}
