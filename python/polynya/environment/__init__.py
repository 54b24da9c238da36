"""A ship in ice as an environment in Gymnasium's convention (docs/environment.md).

    from polynya.environment import ShipInIce
    environment = ShipInIce("scenes/route-in-ice.json", goal=(600, 0))
    observation, info = environment.reset(seed=3)
    observation, reward, terminated, truncated, info = environment.step((1.0, 0.1))

Here `goal` is a position x, y in the world [m]. The action is the lever, from -1 (full astern) to 1 (full ahead), and
the steering angle as a fraction of the largest, from -1 (starboard) to 1 (port). ShipsInIce steps several such
environments at once. Change has the changes in one step, from which a reward is computed. default_scene(seed) makes the
scene that is used if none is given.

Gymnasium itself is not needed. Without it HAS_GYMNASIUM is False, the spaces are replacements with the same methods,
and gymnasium.make cannot be used. If it is installed, ShipInIce is one of its environments and has its spaces.
Importing this module then registers the class under the name ID, so that gymnasium.make("polynya/ShipInIce-v0") makes
one. Importing it again changes nothing.
"""
from .default_scene import default_scene
from .registration import ID, register
from .ship_in_ice import Change, ShipInIce
from .ships_in_ice import ShipsInIce
from .spaces import HAS_GYMNASIUM

__all__ = ["Change", "HAS_GYMNASIUM", "ID", "ShipInIce", "ShipsInIce", "default_scene"]

register()
