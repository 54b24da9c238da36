"""A ship in ice as an environment in Gymnasium's convention (docs/environment.md).

    from polynya.environment import ShipInIce
    environment = ShipInIce("scenes/route-in-ice.json", goal=(600, 0))
    observation, info = environment.reset(seed=3)
    observation, reward, terminated, truncated, info = environment.step((1.0, 0.1))

Gymnasium itself is not needed: where it is installed, ShipInIce is one of its environments and has its spaces, and
gymnasium.make("polynya/ShipInIce-v0") makes one once this module is imported.
"""
from .default_scene import default_scene
from .registration import ID, register
from .ship_in_ice import Change, ShipInIce
from .ships_in_ice import ShipsInIce
from .spaces import HAS_GYMNASIUM

__all__ = ["Change", "HAS_GYMNASIUM", "ID", "ShipInIce", "ShipsInIce", "default_scene"]

register()
