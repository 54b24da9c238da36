"""Gymnasium's base classes and spaces, or replacements with the same names if Gymnasium is not installed. The
replacements have only the parts that the environments of this package need."""
import numpy

try:
    from gymnasium import Env
    from gymnasium.spaces import Box, Dict

    # True: environments derive from Gymnasium's classes, as libraries for training require. False: they derive from the
    # replacements below, and can be stepped by one's own loop only.
    HAS_GYMNASIUM = True
except ImportError:
    HAS_GYMNASIUM = False

    class Box:
        """A space of arrays of one shape and type. Each element has a lower and an upper bound, which are part of the
        space and may be infinite."""

        # `low` and `high` are numbers or arrays that numpy can spread over `shape`. Bounds are rounded to `dtype`.
        def __init__(self, low, high, shape, dtype=numpy.float32):
            self.shape, self.dtype = tuple(shape), numpy.dtype(dtype)
            self.low = numpy.full(shape, low, dtype)
            self.high = numpy.full(shape, high, dtype)
            self._random = numpy.random.default_rng()

        # Restarts the random numbers of sample(); None takes a seed of the system. Returns [seed], as Gymnasium does.
        def seed(self, seed=None):
            self._random = numpy.random.default_rng(seed)
            return [seed]

        def sample(self):
            """Returns a random array: uniform between the bounds of an element, or standard normal if one of its bounds
            is infinite; the latter ignores a finite bound on the other side."""
            bounded = numpy.isfinite(self.low) & numpy.isfinite(self.high)
            even = self._random.uniform(numpy.where(bounded, self.low, 0), numpy.where(bounded, self.high, 1))
            return numpy.where(bounded, even, self._random.normal(size=self.shape)).astype(self.dtype)

        # Returns True if `x` is an array of this shape within the bounds, of a type that converts to `dtype` without
        # loss: a space of float32 does not contain arrays of float64. NaN is in no space.
        def contains(self, x):
            return (isinstance(x, numpy.ndarray) and x.shape == self.shape and numpy.can_cast(x.dtype, self.dtype)
                    and bool(((x >= self.low) & (x <= self.high)).all()))

        def __repr__(self):
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"

    class Dict(dict):
        """A space of dicts with an array of each space by name."""

        # `spaces` is {name: Box or Dict}.
        def __init__(self, spaces):
            super().__init__(spaces)
            self.spaces = dict(self)

        # Gives all spaces the same seed. Returns a list of what their seed() return.
        def seed(self, seed=None):
            return [space.seed(seed) for space in self.values()]

        # Returns a dict with a random array of each space.
        def sample(self):
            return {name: space.sample() for name, space in self.items()}

        # Returns True if `x` is a dict with exactly these names whose values are in their spaces.
        def contains(self, x):
            if not isinstance(x, dict) or x.keys() != self.keys():
                return False
            return all(space.contains(x[name]) for name, space in self.items())

    class Env:
        """Like gymnasium.Env, but without the registry that makes environments by their names."""

        # Members that libraries read: this environment draws no pictures and was not made by name.
        metadata = {"render_modes": []}
        render_mode = None
        spec = None
        _np_random = None

        @property
        def unwrapped(self):
            """The environment itself, because it has no wrapper around it."""
            return self

        @property
        def np_random(self):
            """The random numbers of the environment, from the seed of the last reset() that gave one."""
            if self._np_random is None:
                self._np_random = numpy.random.default_rng()
            return self._np_random

        # Restarts np_random if a seed is given. Environments call it first in their own reset(). Returns nothing.
        def reset(self, *, seed=None, options=None):  # noqa: ARG002, options are for those that have some
            if seed is not None:
                self._np_random = numpy.random.default_rng(seed)

        def close(self):
            pass

        def __enter__(self):
            return self

        def __exit__(self, *error):
            self.close()


try:
    from gymnasium.vector import VectorEnv
    from gymnasium.vector.utils import batch_space
except ImportError:

    class VectorEnv:
        """Like gymnasium.vector.VectorEnv, the base class of environments that run in parallel. It is also used with a
        Gymnasium that lacks it. Derived classes must have close(), which leaving a `with` block calls."""

        @property
        def unwrapped(self):
            return self

        def __enter__(self):
            return self

        def __exit__(self, *error):
            self.close()

    def batch_space(space, n):
        """Returns the space of n values of a space, stacked along a new first axis; for dicts by name."""
        if isinstance(space, Dict):
            return Dict({name: batch_space(one, n) for name, one in space.spaces.items()})
        batched = Box(0, 1, (n, *space.shape), space.dtype)
        batched.low = numpy.broadcast_to(space.low, batched.shape).copy()
        batched.high = numpy.broadcast_to(space.high, batched.shape).copy()
        return batched
