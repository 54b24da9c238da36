"""Scenes in which a ship keeps its speed through pack ice, level ice or a channel of brash ice. The mean force of the
ice is then its resistance at that speed (`polynya performance --pack`, `--level` and `--channel`).

The ice begins at x = 0, and the ship sails along the x axis. A "point" is a dict with speed_m_per_s, thickness_m, cover
[-] and floe_size_m, as a row of the table of resistances."""
import math

from .level_ice import ENDLESS, OF_THE_START, STRENGTH_SPREAD, ice_keys

PACK, LEVEL, CHANNEL = "pack", "level", "channel"  # regimes, named as the options of the command
# Distance that the stem sails in the ice, in lengths of the ship. The first 1.2 lengths are not measured
# (resistance.FULL). A larger value reduces the scatter of the mean and makes runs longer.
LENGTHS = 4
# Width of a channel of brash, in beams of the ship. Another value changes the resistance, because less or more room is
# left between the hull and the fast ice at the sides. The help of --channel states the value.
CHANNEL_WIDTH = 1.5


def ship_at(ship, speed):
    """The ship with its stem 2 m in front of the ice. Its speed [m/s] and heading are prescribed, so that engine,
    rudder, pilot and mooring of the given ship are left out."""
    gone = (*OF_THE_START, "propulsion", "steering", "mooring")
    kept = {key: value for key, value in ship.items() if key not in gone}
    start = {"name": "ship", "position_m": [-0.5 * ship["hull"]["length_m"] - 2, 0], "heading_deg": 0,
             "speed_m_per_s": speed, "propulsion": {"constant_speed_m_per_s": speed}}
    return {**kept, **start}


def field(corner, extent, point):
    """A field of random floes with the cover of the point. Its floe size is the mean of √area of the floes, and their
    standard deviation is 0.3 of it. `corner` is the field's corner with the smallest x and y, `extent` its size along x
    and y [m]."""
    return {"field": {"corner_m": corner, "extent_m": extent, "floe_size_m": point["floe_size_m"], "size_spread": 0.3,
                      "concentration": point["cover"]}}


def ice_of(regime, hull, way, point):
    """Returns the scene's `floes`, and keys of its `fracture` that belong to them, for `way` metres of ice in front of
    the ship. Pack ice is at least ten beams and ten floes wide, and its floes may split. Level ice is a plate five
    beams wide. Plates and channels are held by fast ice, do not split, and pieces under the hull do not surface
    again (level_ice.ENDLESS). The thickness of pack and level ice is set with the scene's `ice`."""
    beam = hull["beam_m"]
    if regime == PACK:
        width = max(10 * beam, 10 * point["floe_size_m"])
        return [field([0, -0.5 * width], [way, width], point)], {}
    if regime == LEVEL:
        width = 5 * beam
        return [{"rectangle": {"corner_m": [0, -0.5 * width], "size_m": [way, width]}, "fast_ice": True}], ENDLESS
    return [brash_channel(beam, way, point)], ENDLESS


def brash_channel(beam, way, point):
    """A channel of brash of `way` metres. The point's thickness is that of the brash with its pores, and of the fast
    ice, which is one beam wide on each side. The point's floe size is the mean size √area of the pieces."""
    return {"channel": {"centreline_m": [[0, 0], [way, 0]], "width_m": CHANNEL_WIDTH * beam,
                        "thickness_m": point["thickness_m"], "cover": point["cover"],
                        "sizes": {"mean_m": point["floe_size_m"], "spread": 0.3},
                        "fast_ice_thickness_m": point["thickness_m"], "fast_ice_width_m": beam}}


def scene(regime, ship, ice, point, seed, step):
    """The scene of a point. `ice` is a formulas.Ice with the properties of the ice and the thickness of the point,
    `seed` selects random floes and strengths, `step` is the time step [s], or None for the default of a scene. Forces
    are recorded 20 times per ship length, at intervals of at least 0.1 s."""
    length, speed = ship["hull"]["length_m"], point["speed_m_per_s"]
    way = LENGTHS * length
    floes, settings = ice_of(regime, ship["hull"], way, point)
    until = math.ceil((way + 2) / speed)
    return {
        "name": f"{regime}-resistance",
        "seed": seed,
        "time": {"until_s": until, **({} if step is None else {"step_s": step})},
        "ice": ice_keys(ice),
        "fracture": {**settings, "bending": {"strength_spread": STRENGTH_SPREAD}},
        "ships": [ship_at(ship, speed)],
        "floes": floes,
        "record": {"forces_interval_s": round(max(0.1, 0.05 * length / speed), 3), "frames_interval_s": until,
                   "contacts": "none"},
    }
