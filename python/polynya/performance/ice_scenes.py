"""Scenes in which a ship keeps its speed through pack ice, level ice or a channel of brash ice, to measure its
resistance."""
import math

from .level_ice import ENDLESS, OF_THE_START, STRENGTH_SPREAD, ice_keys

PACK, LEVEL, CHANNEL = "pack", "level", "channel"
LENGTHS = 4  # distance in the ice, in lengths of the ship; longer: less scatter, longer runs
CHANNEL_WIDTH = 1.5  # width of a channel in beams of the ship


def ship_at(ship, speed):
    """The ship in front of the ice, with a pilot that keeps speed [m/s] and heading."""
    gone = (*OF_THE_START, "propulsion", "steering", "mooring")
    kept = {key: value for key, value in ship.items() if key not in gone}
    start = {"name": "ship", "position_m": [-0.5 * ship["hull"]["length_m"] - 2, 0], "heading_deg": 0,
             "speed_m_per_s": speed, "propulsion": {"constant_speed_m_per_s": speed}}
    return {**kept, **start}


def field(corner, extent, point):
    return {"field": {"corner_m": corner, "extent_m": extent, "floe_size_m": point["floe_size_m"], "size_spread": 0.3,
                      "concentration": point["cover"]}}


def ice_of(regime, hull, way, point):
    """Entries of the scene's floes, and settings that belong to them."""
    beam = hull["beam_m"]
    if regime == PACK:
        width = max(10 * beam, 10 * point["floe_size_m"])
        return [field([0, -0.5 * width], [way, width], point)], {}
    if regime == LEVEL:
        width = 5 * beam
        return [{"rectangle": {"corner_m": [0, -0.5 * width], "size_m": [way, width]}, "fast_ice": True}], ENDLESS
    return [brash_channel(beam, way, point)], ENDLESS


def brash_channel(beam, way, point):
    """A channel of brash: the point's thickness is that of the brash, its floe size that of the pieces."""
    return {"channel": {"centreline_m": [[0, 0], [way, 0]], "width_m": CHANNEL_WIDTH * beam,
                        "thickness_m": point["thickness_m"], "cover": point["cover"],
                        "sizes": {"mean_m": point["floe_size_m"], "spread": 0.3},
                        "fast_ice_thickness_m": point["thickness_m"], "fast_ice_width_m": beam}}


def scene(regime, ship, ice, point, seed, step):
    """The scene of a point, which has a speed [m/s], a thickness [m], a cover [-] and a floe size [m]."""
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
