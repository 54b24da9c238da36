"""A ship in ice as an environment in Gymnasium's convention (docs/environment.md).

    from polynya.environment import ShipInIce
    environment = ShipInIce("scenes/route-in-ice.json", goal=(600, 0))
    observation, info = environment.reset(seed=3)
    observation, reward, terminated, truncated, info = environment.step((1.0, 0.1))

Here `goal` is a position x, y [m], and the action is lever and steering angle, each from -1 to 1. ShipsInIce steps
several such environments at once. Change has the changes in one step, from which a reward is computed.

Gymnasium itself is not needed (HAS_GYMNASIUM is False without it). If it is installed, ShipInIce is one of its
environments and has its spaces. Importing this module then registers the class under the name ID, so that
gymnasium.make("polynya/ShipInIce-v0") makes one.
"""
from .default_scene import default_scene
from .registration import ID, register
from .ship_in_ice import Change, ShipInIce
from .ships_in_ice import ShipsInIce
from .spaces import HAS_GYMNASIUM

__all__ = ["Change", "HAS_GYMNASIUM", "ID", "ShipInIce", "ShipsInIce", "default_scene"]

register()
