"""Lists whose items have names."""
import typing

Item = typing.TypeVar("Item")


class Named(typing.List[Item]):
    """A list whose items can also be accessed by their `name`: simulation.ships["icebreaker"]. A scene gives each ship
    and structure its own name. If several items had one name, the first of them would be returned."""

    def __getitem__(self, key):
        """Returns the item with the name `key`. A number or a slice is used as in any list; a slice gives a plain list
        without names. Raises KeyError, with a text that lists all names, if no item has the name."""
        if not isinstance(key, str):
            return super().__getitem__(key)
        for item in self:
            if item.name == key:
                return item
        raise KeyError(f"{key}; there are {', '.join(item.name for item in self)}")
