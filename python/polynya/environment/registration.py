"""Adds the environment to Gymnasium's registry, if Gymnasium is installed."""
ID = "polynya/ShipInIce-v0"  #: name for gymnasium.make


def register():
    """Registers ShipInIce, and ShipsInIce as its vector environment. Does nothing without Gymnasium."""
    try:
        import gymnasium
    except ImportError:
        return
    if ID in getattr(gymnasium, "registry", {}):  # the module was imported before and is being reloaded
        return
    gymnasium.register(id=ID, entry_point="polynya.environment:ShipInIce",
                       vector_entry_point="polynya.environment:ShipsInIce")
