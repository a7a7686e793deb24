"""The kernel's functions as machine code: compiled once a machine, kept on disk, loaded as NumPy ufuncs."""

from typing import Any


def ufunc(name: str) -> Any:
    """The ufunc `name` of `ufuncs`, which are loaded, and compiled if need be, by the first call."""
    from loiter.compiled import ufuncs

    return getattr(ufuncs, name)
