"""Lists whose items have names."""
import typing

Item = typing.TypeVar("Item")


class Named(typing.List[Item]):
    """A list whose items can also be accessed by their `name`: simulation.ships["icebreaker"]. A scene
    gives each ship and structure its own name."""

    def __getitem__(self, key):
        if not isinstance(key, str):
            return super().__getitem__(key)
        for item in self:
            if item.name == key:
                return item
        raise KeyError(f"{key}; there are {', '.join(item.name for item in self)}")
